// SPDX-License-Identifier: BSD-3-Clause
// A picture of a surface given as points (thesis 4.3).
#include "shared/point_files.h"
#include "shared/render_options.h"
#include "shared/series.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/image_file.h>

#include <filesystem>

namespace {

using pcl_uvol::Report;

/** What a page cannot show. */
void
checkPage(const uvol_tools::Options& options)
{
  std::vector<std::string> names = uvol_tools::FigureOptions::names();
  names.insert(names.end(),
               {"size",
                "supersample",
                "backend",
                "orbit",
                "silhouettes",
                "features",
                "opacity"});
  for (const std::string& name : names)
    if (options.given(name))
      throw uvol_tools::UsageError("-" + name + " is for pictures, not for web pages.");
}

int
run(int argc, char** argv)
{
  std::string input, output;
  uvol_tools::RenderOptions look;
  uvol_tools::Options options(
      "uvol_render",
      "in.ply out.png|out.html [options]",
      "Draws a surface given as points with normals: lit, smooth and without holes; as "
      "a\n"
      "picture, or as a web page in one file that turns in any browser.");
  options.file("in", input);
  options.file("out", output);
  look.declareView(options);
  look.declareExaggeration(options);
  look.declareFigure(options);
  look.declareOpacity(options);
  look.declareOrbit(options);
  look.declarePasses(options);
  uvol_tools::declareSeries(options);
  if (!options.parse(argc, argv))
    return 0;
  look.check(options);
  const bool is_page = std::filesystem::path(output).extension() == ".html";
  if (is_page)
    checkPage(options);
  else
    pcl_uvol::checkPngPath(output);

  Report report;
  pcl_uvol::Dataset dataset = uvol_tools::loadPoints(input, report);
  look.addColor(options, dataset, report);
  look.exaggerate(dataset);
  std::string backend = "web page";
  if (is_page)
    look.writePage(options, dataset, output, report);
  else
    backend = look.drawCloud(options, dataset, output, report);
  uvol_tools::printReport(
      options, report, {{"input", input}, {"output", output}, {"backend", backend}});
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_render", argc, argv, run);
}
