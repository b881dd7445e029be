// SPDX-License-Identifier: BSD-3-Clause
// A picture of a surface given as points (thesis 4.3).
#include "charts/picture_file.h"
#include "shared/point_files.h"
#include "shared/render_options.h"
#include "shared/series.h"
#include <pcl_uvol/io/dataset.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

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
                "dpi",
                "backend",
                "device",
                "orbit",
                "silhouettes",
                "features",
                "opacity"});
  for (const std::string& name : names)
    if (options.given(name))
      throw uvol_tools::UsageError("-" + name + " is for pictures, not for web pages.");
}

/** A picture or page on its way. */
struct Job {
  std::string input, output;
  uvol_tools::RenderOptions look;
  uvol_tools::Options options{
      "uvol_render",
      "in.ply out.png|.svg|.pdf|.html [options]",
      "Draw a surface given as points with normals, lit, smooth and without holes: "
      "as an image or as\n"
      "a one-file web page that rotates in any browser."};
  bool is_page = false;
  Report report;

  void
  draw(const pcl_uvol::Dataset& surface)
  {
    std::string backend = "web page";
    if (is_page)
      look.writePage(options, surface, output, report);
    else
      backend = look.drawCloud(options, surface, output, report);
    uvol_tools::printReport(options,
                            report,
                            {{"input", input},
                             {"output", output},
                             {"backend", backend},
                             uvol_tools::describeMemory()});
  }
};

int
run(int argc, char** argv, uvol_tools::SeriesStep* step)
{
  const auto job = std::make_shared<Job>();
  auto& [input, output, look, options, is_page, report] = *job;
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
  is_page = std::filesystem::path(output).extension() == ".html";
  if (is_page)
    checkPage(options);
  else
    uvol_tools::checkDrawingPath(output);

  pcl_uvol::Dataset dataset = uvol_tools::loadPoints(input, report);
  look.addColor(options, dataset, report);
  look.exaggerate(dataset);
  if (step && look.sharesView())
    step->pictures.add(options, look, std::move(dataset), [job](const auto& surface) {
      job->draw(surface);
    });
  else
    job->draw(dataset);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runSeries("uvol_render", argc, argv, run);
}
