// SPDX-License-Identifier: BSD-3-Clause
// Data of many dimensions as points in space, by optimised star coordinates (thesis
// 2.6).
#include "charts/picture_file.h"
#include "charts/scatter_plot.h"
#include "io/table_file.h"
#include "shared/attribute_options.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/size_option.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/multivariate/star_coordinates.h>

#include <iomanip>
#include <limits>
#include <sstream>

namespace {

using pcl_uvol::Report;
using uvol_tools::Options;
using uvol_tools::UsageError;

struct Arguments {
  std::string input, output, axes, picture, label, view = "top";
  pcl_uvol::ProjectionMethod method = pcl_uvol::ProjectionMethod::Star;
  uvol_tools::AttributeOptions attributes;
  uvol_tools::InputOptions reading;
  uvol_tools::SizeOption size;
  bool ascii = false;
};

void
declare(Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.file("out", arguments.output);
  options.group("Input");
  arguments.attributes.declare(options);
  arguments.reading.declare(options);
  options.group("Projection");
  options.choice("method",
                 arguments.method,
                 "keep the clusters apart as well as can be; or principal components");
  options.text(
      "label",
      "name",
      arguments.label,
      "field with the cluster of each point, negative for noise (default: label, else "
      "they are found by density)");
  options.group("Output");
  options.output("axes", "out.csv", arguments.axes, "write the axis of every attribute")
      .check(pcl_uvol::checkTablePath);
  options
      .output("png",
              "out.png|.svg|.pdf",
              arguments.picture,
              "draw the points, by cluster, and the axes")
      .check(uvol_tools::checkPicturePath);
  options.choice("view",
                 {"iso", "front", "back", "left", "right", "top", "bottom"},
                 arguments.view,
                 "side that the camera looks from");
  arguments.size.declareChart(options);
  options.flag("ascii", arguments.ascii, "write PCD and PLY as text");
}

void
writeAxes(const std::string& path, const pcl_uvol::Projection& projection)
{
  std::ostringstream table;
  table << std::setprecision(std::numeric_limits<double>::max_digits10)
        << "attribute,mean,unit,x,y,z\n";
  for (std::size_t i = 0; i < projection.names.size(); ++i)
    table << pcl_uvol::quotedCell(projection.names[i]) << ','
          << projection.offsets[i] + projection.units[i] * projection.mean[i] << ','
          << projection.units[i] << ',' << projection.rows[0][i] << ','
          << projection.rows[1][i] << ',' << projection.rows[2][i] << '\n';
  pcl_uvol::saveTable(path, table.str());
}

void
drawPicture(const Arguments& arguments, const pcl_uvol::ProjectedPoints& found)
{
  const auto& names = found.projection.names;
  const auto& rows = found.projection.rows;
  std::vector<uvol_tools::ScatterAxis> axes;
  for (std::size_t i = 0; i < names.size(); ++i)
    axes.push_back({names[i], {{rows[0][i], rows[1][i], rows[2][i]}}});
  const uvol_tools::Paper& paper = arguments.size.get();
  const uvol_tools::PictureFile file(arguments.picture, paper.dots_per_inch);
  file.save(uvol_tools::drawScatterPlot(
      found.places, found.labels, axes, arguments.view, paper));
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options("uvol_project",
                  "in.csv out.ply -attributes a,b,c [options]",
                  "Project points of many dimensions into space so that their "
                  "clusters are separate.\n"
                  "Output: points at the projected coordinates, with the field label "
                  "of their clusters.");
  declare(options, arguments);
  if (!options.parse(argc, argv))
    return 0;
  arguments.attributes.required();
  pcl_uvol::LoadOptions load = uvol_tools::withoutPositions(arguments.reading);
  load.may_mix_units = true; // attributes are in standard deviations
  pcl_uvol::checkSavePath(arguments.output);
  if (arguments.axes == arguments.output)
    throw UsageError("-axes and the output are the same file.");
  arguments.size.checkChart(options, "png", !arguments.picture.empty());

  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  pcl_uvol::Dataset dataset = uvol_tools::loadPoints(
      arguments.input, report, load, arguments.reading.getWhere(), options.threads());
  arguments.attributes.addFields(options, dataset, report);
  pcl_uvol::checkSavePath(arguments.output, dataset.cloud.fields);
  const pcl_uvol::ProjectedPoints found = arguments.attributes.project(
      options, dataset, arguments.label, arguments.method, report);
  const std::vector<std::uint32_t> sources(found.sources.begin(), found.sources.end());
  pcl_uvol::Dataset result = uvol_tools::takePoints(dataset, sources, found.places);
  pcl_uvol::setField(result, "label", found.labels);
  pcl_uvol::SaveOptions save;
  save.ascii = arguments.ascii;
  uvol_tools::savePoints(arguments.output, result, save, report);
  if (!arguments.axes.empty())
    writeAxes(arguments.axes, found.projection);
  if (!arguments.picture.empty())
    drawPicture(arguments, found);
  uvol_tools::printReport(options,
                          report,
                          {{"input", arguments.input},
                           {"output", arguments.output},
                           {"smallest Fisher ratio", found.smallest_ratio}});
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_project", [&] { return run(argc, argv); });
}
