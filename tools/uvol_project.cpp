// SPDX-License-Identifier: BSD-3-Clause
// Data of many dimensions as points in space, by optimised star coordinates (thesis
// 2.6).
#include "common/attribute_options.h"
#include "common/options.h"
#include "common/point_files.h"
#include "common/progress_bar.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/image_file.h>
#include <pcl_uvol/io/scatter_plot.h>
#include <pcl_uvol/io/table_file.h>
#include <pcl_uvol/multivariate/density_clustering.h>
#include <pcl_uvol/multivariate/star_coordinates.h>

#include <iomanip>
#include <limits>
#include <sstream>

namespace {

using pcl_uvol::Report;
using uvol_tools::Options;
using uvol_tools::UsageError;

struct Arguments {
  std::string input, output, axes, picture, label, method = "star", view = "top";
  uvol_tools::AttributeOptions attributes;
  bool ascii = false;
};

void
declare(Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.file("out", arguments.output);
  arguments.attributes.declare(options);
  options.choice("method",
                 {"star", "pca"},
                 arguments.method,
                 "keep the clusters apart as well as can be; or principal components");
  options.text(
      "label",
      "name",
      arguments.label,
      "field that tells the clusters, negative for noise (default: label, else "
      "they are found by density)");
  options.output(
      "axes", "out.csv", arguments.axes, "write the axis of every attribute");
  options.output(
      "png", "out.png", arguments.picture, "draw the points, by cluster, and the axes");
  options.choice("view",
                 {"iso", "front", "back", "left", "right", "top", "bottom"},
                 arguments.view,
                 "side that the picture is seen from");
  options.flag("ascii", arguments.ascii, "write PCD and PLY as text");
}

void
writeAxes(const std::string& path,
          const pcl_uvol::AttributeTable& attributes,
          const pcl_uvol::Projection& projection)
{
  std::ostringstream table;
  table << std::setprecision(std::numeric_limits<double>::max_digits10)
        << "attribute,mean,unit,x,y,z\n";
  for (std::size_t i = 0; i < projection.names.size(); ++i)
    table << pcl_uvol::quotedCell(projection.names[i]) << ','
          << attributes.means[i] + attributes.units[i] * projection.mean[i] << ','
          << attributes.units[i] << ',' << projection.rows[0][i] << ','
          << projection.rows[1][i] << ',' << projection.rows[2][i] << '\n';
  pcl_uvol::saveTable(path, table.str());
}

/** Labels of the rows of a table: those of a field, else by density. */
std::vector<std::int32_t>
labelsOf(const Options& options,
         const Arguments& arguments,
         const pcl_uvol::CloudView& cloud,
         const pcl_uvol::AttributeTable& table,
         Report& report)
{
  const auto field = uvol_tools::labelField(cloud, arguments.label);
  if (field.empty())
    return pcl_uvol::detail::clusterAttributes(table, {}, options.threads(), report)
        .labels;
  const std::vector<std::int32_t> all = uvol_tools::readLabels(cloud, field);
  std::vector<std::int32_t> labels;
  for (const std::uint32_t point : table.points)
    labels.push_back(all[point]);
  return labels;
}

void
drawPicture(const Arguments& arguments,
            const pcl_uvol::Projection& projection,
            const std::vector<std::array<float, 3>>& points,
            const std::vector<std::int32_t>& labels)
{
  std::vector<pcl_uvol::ScatterAxis> axes;
  for (std::size_t i = 0; i < projection.names.size(); ++i)
    axes.push_back(
        {projection.names[i],
         {{projection.rows[0][i], projection.rows[1][i], projection.rows[2][i]}}});
  constexpr int width = 640, height = 512;
  pcl_uvol::savePng(
      arguments.picture,
      pcl_uvol::drawScatterPlot(points, labels, axes, arguments.view, width, height));
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options("uvol_project",
                  "in.csv out.ply -attributes a,b,c [options]",
                  "Projects points of many dimensions into space, so that their "
                  "clusters lie apart.\nThe coordinates of the output are those of the "
                  "projection; its field label tells the clusters.");
  declare(options, arguments);
  if (!options.parse(argc, argv))
    return 0;
  const std::vector<std::string> names = arguments.attributes.required();
  pcl_uvol::checkSavePath(arguments.output);
  if (arguments.axes == arguments.output)
    throw UsageError("-axes and the output are the same file.");
  if (!arguments.picture.empty())
    pcl_uvol::checkPngPath(arguments.picture);
  if (!arguments.axes.empty())
    pcl_uvol::checkTablePath(arguments.axes);

  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  const pcl_uvol::Dataset dataset =
      uvol_tools::loadPoints(arguments.input, report, uvol_tools::withoutPositions());
  pcl_uvol::checkSavePath(arguments.output, dataset.cloud.fields);
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(dataset.cloud);
  const pcl_uvol::AttributeTable table =
      arguments.attributes.read(options, dataset, names, report);
  const auto labels = labelsOf(options, arguments, cloud, table, report);
  pcl_uvol::StarCoordinateParameters parameters;
  parameters.threads = options.threads();
  const pcl_uvol::Projection projection =
      arguments.method == "star"
          ? pcl_uvol::starCoordinates(table, labels, parameters, report)
          : pcl_uvol::principalAxes(table, options.threads());
  std::vector<std::array<float, 3>> points;
  for (std::size_t row = 0; row < table.rows(); ++row)
    points.push_back(projection.project(table.row(row)));
  pcl_uvol::Dataset result = uvol_tools::takePoints(dataset, table.points, points);
  pcl_uvol::setField(result, "label", labels);
  pcl_uvol::SaveOptions save;
  save.ascii = arguments.ascii;
  uvol_tools::savePoints(arguments.output, result, save, report);
  if (!arguments.axes.empty())
    writeAxes(arguments.axes, table, projection);
  if (!arguments.picture.empty())
    drawPicture(arguments, projection, points, labels);
  std::ostringstream ratio;
  ratio << pcl_uvol::smallestFisherRatio(table, labels, projection, parameters);
  uvol_tools::printReport(options,
                          report,
                          {{"input", arguments.input},
                           {"output", arguments.output},
                           {"smallest Fisher ratio", ratio.str()}});
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_project", [&] { return run(argc, argv); });
}
