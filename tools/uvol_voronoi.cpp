// SPDX-License-Identifier: BSD-3-Clause
// Discrete Voronoi diagrams of points as grids and pictures (thesis 2.1).
#include "common/options.h"
#include "common/point_files.h"
#include "common/progress_bar.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/gl/conic_sections.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/grid_file.h>
#include <pcl_uvol/io/image_file.h>
#include <pcl_uvol/render/voronoi_slices.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace {

using pcl_uvol::GridShape;
using pcl_uvol::Report;
using uvol_tools::Options;
using uvol_tools::UsageError;

struct Arguments {
  std::string input, output, picture, grid = "128", method = "transform";
  std::string backend = "osmesa", axis = "z";
  double inner_radius = 2.0;
  std::uint64_t triangles = 6, slices = 6, margin = 0;
};

void
declare(Options& options, Arguments& arguments)
{
  options.file("in", arguments.input);
  options.file("out", arguments.output);
  options.text("grid",
               "n|NxNxN",
               arguments.grid,
               "cubic cells, so many along the longest side of the points' box; or as "
               "many boxes along x, y and z");
  options.integer(
      "margin", arguments.margin, 0, 1000, "more cubic cells around the box");
  options.choice("method",
                 {"transform", "cones"},
                 arguments.method,
                 "exact, axis by axis; or as the thesis does, by cones and the depth "
                 "test of OpenGL: slower, a cell here and there is a little off");
  options.choice(
      "backend", {"osmesa", "egl"}, arguments.backend, "where cones are drawn");
  options.number("inner-radius",
                 arguments.inner_radius,
                 1.0,
                 pcl_uvol::ConicSections::largest_inner_radius,
                 "of the first ring of a cone's triangles, cells");
  options.integer("triangles",
                  arguments.triangles,
                  3,
                  pcl_uvol::ConicSections::most_first_triangles,
                  "of the first ring; the thesis has 4");
  options.output(
      "png", "out.png", arguments.picture, "draw slices, a colour per region");
  options.integer("slices", arguments.slices, 1, 1000, "slices of the picture");
  options.choice(
      "axis", {"x", "y", "z"}, arguments.axis, "slices are perpendicular to it");
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
                       ", as in 128, or three, as in 256x256x475, not " + text + ".");
    cells.push_back(static_cast<std::uint32_t>(number));
  }
  if ((cells.size() != 1 && cells.size() != 3) || text.back() == 'x')
    throw UsageError("-grid is one number of cells, as in 128, or three, as in "
                     "256x256x475, not " +
                     text + ".");
  return cells;
}

GridShape
shapeFor(const pcl_uvol::CloudView& view,
         const std::vector<std::uint32_t>& cells,
         std::uint32_t margin)
{
  std::array<double, 3> low{{1e300, 1e300, 1e300}}, high{{-1e300, -1e300, -1e300}};
  for (std::size_t i = 0; i < view.count; ++i) {
    const float* const p = view.xyz(i);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min<double>(low[axis], p[axis]);
      high[axis] = std::max<double>(high[axis], p[axis]);
    }
  }
  if (low[0] > high[0])
    throw pcl_uvol::InvalidArgument("The input has no point with finite coordinates.");
  return cells.size() == 1
             ? GridShape::cubes(low, high, cells[0], margin)
             : GridShape::boxes(low, high, {{cells[0], cells[1], cells[2]}});
}

int
run(int argc, char** argv)
{
  Arguments arguments;
  Options options(
      "uvol_voronoi",
      "in.ply out.vti [options]",
      "Finds the nearest point to every cell of a grid: the discrete Voronoi "
      "diagram.\nThe arrays are site, the index of a point in the nearest "
      "cell that holds any, and distance, between the centres of the cells.");
  declare(options, arguments);
  if (!options.parse(argc, argv))
    return 0;
  const std::vector<std::uint32_t> cells = parseGrid(arguments.grid);
  if (cells.size() == 3 && arguments.margin > 0)
    throw UsageError("-margin is for cubic cells: give -grid one number.");
  pcl_uvol::checkGridPath(arguments.output);
  if (!arguments.picture.empty())
    pcl_uvol::checkPngPath(arguments.picture);
  else if (options.given("slices") || options.given("axis"))
    throw UsageError("-slices and -axis need -png.");

  Report report;
  uvol_tools::ProgressBar bar;
  report.progress = std::ref(bar);
  const pcl_uvol::Dataset dataset = uvol_tools::loadPoints(arguments.input, report);
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(dataset.cloud);
  std::vector<std::uint32_t> all(view.count);
  std::iota(all.begin(), all.end(), 0u);
  std::unique_ptr<pcl_uvol::NearestSites> way;
  if (arguments.method == "cones")
    way = std::make_unique<pcl_uvol::ConicSections>(
        pcl_uvol::createHeadlessContext(arguments.backend),
        arguments.inner_radius,
        static_cast<unsigned>(arguments.triangles));
  else
    way = std::make_unique<pcl_uvol::FeatureTransform>();
  report.count("points", view.count);
  const pcl_uvol::VoronoiGrid grid(
      shapeFor(view, cells, static_cast<std::uint32_t>(arguments.margin)),
      view.xyz(0),
      view.stride(),
      all,
      *way,
      options.threads(),
      report);
  {
    const pcl_uvol::StepTimer timer(report, "write");
    pcl_uvol::saveVoronoiGrid(
        arguments.output, grid, dataset.origin, options.threads());
    if (!arguments.picture.empty())
      pcl_uvol::savePng(
          arguments.picture,
          pcl_uvol::drawVoronoiSlices(
              grid, arguments.axis[0] - 'x', static_cast<int>(arguments.slices)));
  }
  const auto& shape = grid.getShape();
  std::ostringstream grid_text;
  grid_text << shape.cells[0] << " x " << shape.cells[1] << " x " << shape.cells[2]
            << " cells of " << shape.spacing[0] << " x " << shape.spacing[1] << " x "
            << shape.spacing[2];
  uvol_tools::printReport(options,
                          report,
                          {{"input", arguments.input},
                           {"output", arguments.output},
                           {"grid", grid_text.str()}});
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  return uvol_tools::runTool("uvol_voronoi", [&] { return run(argc, argv); });
}
