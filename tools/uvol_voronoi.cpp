// SPDX-License-Identifier: BSD-3-Clause
// Discrete Voronoi diagrams of points as grids and pictures (thesis 2.1).
#include "charts/picture_file.h"
#include "common/printable.h"
#include "gl/conic_sections.h"
#include "io/grid_file.h"
#include "render/voronoi_slices.h"
#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/progress_bar.h"
#include "shared/size_option.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <memory>
#include <sstream>

namespace {

using pcl_uvol::GridShape;
using pcl_uvol::Report;
using uvol_tools::Options;
using uvol_tools::UsageError;

struct Arguments {
  std::string input, output, picture, grid = "128", method = "transform";
  std::string backend = "osmesa", axis = "z";
  int card = -1; // not given
  double inner_radius = 2.0;
  std::uint64_t triangles = 6, slices = 6, margin = 0;
  uvol_tools::SizeOption size;
  uvol_tools::InputOptions reading;
};

void
declare(Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.file("out", arguments.output);
  options.group("Input");
  arguments.reading.declare(options);
  options.group("Grid");
  options.text("grid",
               "n|NxNxN",
               arguments.grid,
               "cubic cells, so many along the longest side of the points' box; or as "
               "many boxes along x, y and z");
  options.integer(
      "margin", arguments.margin, 0, 1000, "more cubic cells around the box");
  options.group("Method");
  options.choice("method",
                 {"transform", "cones"},
                 arguments.method,
                 "exact, axis by axis; or as the thesis does, by cones and the depth "
                 "test of OpenGL: slower, a cell here and there is a little off");
  options.choice(
      "backend", {"osmesa", "egl"}, arguments.backend, "renderer of the cones");
  options.integer("device",
                  arguments.card,
                  0,
                  1000,
                  "zero-based index of the graphics card, with -backend egl (default: "
                  "the first that can draw)");
  options.number("inner-radius",
                 arguments.inner_radius,
                 1.0,
                 pcl_uvol::ConicSections::largest_inner_radius,
                 "radius of the first ring of triangles of a cone, in cells");
  options.integer("triangles",
                  arguments.triangles,
                  3,
                  pcl_uvol::ConicSections::most_first_triangles,
                  "number of triangles of the first ring; 4 in the thesis");
  options.group("Picture");
  options
      .output("png",
              "out.png|.svg|.pdf",
              arguments.picture,
              "draw slices, a colour per region")
      .check(uvol_tools::checkPicturePath);
  options.integer("slices", arguments.slices, 1, 1000, "number of slices in the image");
  options.choice(
      "axis", {"x", "y", "z"}, arguments.axis, "slices are perpendicular to it");
  arguments.size.declareChart(options);
}

std::vector<std::uint32_t>
parseGrid(const std::string& text)
{
  std::vector<std::uint32_t> cells;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, 'x');) {
    const bool is_number = !word.empty() && word.size() <= 5 &&
                           word.find_first_not_of("0123456789") == std::string::npos;
    const unsigned long number = is_number ? std::stoul(word) : 0;
    if (number < 1 || number > GridShape::largest_side)
      throw UsageError("-grid is a number of cells from 1 to " +
                       std::to_string(GridShape::largest_side) +
                       ", as in 128, or three, as in 256x256x475, not " +
                       pcl_uvol::quoteText(text) + ".");
    cells.push_back(static_cast<std::uint32_t>(number));
  }
  if ((cells.size() != 1 && cells.size() != 3) || text.back() == 'x')
    throw UsageError("-grid is one number of cells, as in 128, or three, as in "
                     "256x256x475, not " +
                     text + ".");
  return cells;
}

/** The diagram as the options ask for it. */
std::shared_ptr<const pcl_uvol::VoronoiGrid>
computeDiagram(const Options& options,
               const Arguments& arguments,
               const std::vector<std::uint32_t>& cells,
               const pcl_uvol::Dataset& dataset,
               Report& report)
{
  pcl_uvol::VoronoiDiagram<pcl::PCLPointCloud2> diagram;
  diagram.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&dataset.cloud, [](const void*) {}));
  if (cells.size() == 1)
    diagram.setCells(cells[0]);
  else
    diagram.setCells(cells[0], cells[1], cells[2]);
  diagram.setMargin(static_cast<std::uint32_t>(arguments.margin));
  if (arguments.method == "cones")
    diagram.setNearestSites(std::make_shared<pcl_uvol::ConicSections>(
        pcl_uvol::createHeadlessContext(
            arguments.backend,
            options.given("device") ? std::optional(arguments.card) : std::nullopt),
        arguments.inner_radius,
        static_cast<unsigned>(arguments.triangles)));
  diagram.setNumberOfThreads(options.threads());
  diagram.setProgressCallback(report.progress);
  auto grid = diagram.compute();
  report.merge(diagram.getReport());
  return grid;
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options(
      "uvol_voronoi",
      "in.ply out.vti [options]",
      "Find the nearest point to every grid cell: the discrete Voronoi diagram.\n"
      "Output: site (index of a point in the nearest occupied cell) and distance "
      "(between cell centres).");
  declare(options, arguments);
  if (!options.parse(argc, argv))
    return 0;
  const std::vector<std::uint32_t> cells = parseGrid(arguments.grid);
  if (cells.size() == 3 && arguments.margin > 0)
    throw UsageError("-margin is for cubic cells: give -grid one number.");
  const pcl_uvol::LoadOptions load = arguments.reading.makeLoadOptions();
  pcl_uvol::checkGridPath(arguments.output);
  if (options.given("device") && arguments.backend != "egl")
    throw UsageError("-device is a graphics card, which -backend egl draws on.");
  if (arguments.picture.empty() && (options.given("slices") || options.given("axis")))
    throw UsageError("-slices and -axis need -png.");
  arguments.size.checkChart(options, "png", !arguments.picture.empty());

  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  const pcl_uvol::Dataset dataset = uvol_tools::loadPoints(
      arguments.input, report, load, arguments.reading.getWhere(), options.threads());
  report.count("points", dataset.cloud.width);
  const auto grid = computeDiagram(options, arguments, cells, dataset, report);
  {
    const pcl_uvol::StepTimer timer(report, "write");
    pcl_uvol::saveVoronoiGrid(
        arguments.output, *grid, dataset.origin, options.threads());
    const uvol_tools::Paper& paper = arguments.size.get();
    if (!arguments.picture.empty())
      uvol_tools::PictureFile(arguments.picture, paper.dots_per_inch)
          .save(pcl_uvol::drawVoronoiSlices(*grid,
                                            arguments.axis[0] - 'x',
                                            static_cast<int>(arguments.slices),
                                            paper.width,
                                            paper.height));
  }
  const auto& shape = grid->getShape();
  uvol_tools::FactText grid_text;
  grid_text << shape.cells[0] << " x " << shape.cells[1] << " x " << shape.cells[2]
            << " cells of " << shape.spacing[0] << " x " << shape.spacing[1] << " x "
            << shape.spacing[2];
  uvol_tools::printReport(
      options,
      report,
      {{"input", arguments.input},
       {"output", arguments.output},
       {"grid",
        grid_text.str(),
        uvol_tools::Fact::Members{{"cells", uvol_tools::toNumbers(shape.cells)},
                                  {"spacing", uvol_tools::toNumbers(shape.spacing)}}}});
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_voronoi", [&] { return run(argc, argv); });
}
