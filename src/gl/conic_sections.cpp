// SPDX-License-Identifier: BSD-3-Clause
#include "gl/conic_sections.h"

#include "gl/cone_painter.h"
#include "gl/errors.h"

#include <algorithm>
#include <limits>
#include <string>

namespace pcl_uvol {

namespace {

/** Triangles lie a little above their cones. */
constexpr double radius_margin = 1.01;

/** Radii of cones grow by this factor after a layer that they did not cover. */
constexpr double radius_growth = 1.5;

/** From the sites of a layer to its farthest cell; infinite if a cell has no site. */
double
findFarthest(const GridShape& shape,
             const std::vector<GridCell>& sites,
             std::uint32_t layer,
             const std::uint32_t* nearest)
{
  double farthest = 0.0;
  GridCell cell{0, 0, static_cast<std::uint16_t>(layer)};
  for (cell[1] = 0; cell[1] < shape.cells[1]; ++cell[1])
    for (cell[0] = 0; cell[0] < shape.cells[0]; ++cell[0]) {
      const std::uint32_t site = *nearest++;
      if (site == no_site)
        return std::numeric_limits<double>::infinity();
      farthest = std::max(farthest, shape.distance(cell, sites[site]));
    }
  return farthest;
}

/** The reach of random sites in a grid: hardly a cell is farther from all of them. */
double
estimateRadius(const GridShape& shape, std::size_t sites)
{
  const std::array<double, 3>& s = shape.spacing;
  const double volume = static_cast<double>(shape.size()) * s[0] * s[1] * s[2];
  return 2.0 * std::cbrt(volume / static_cast<double>(sites)) +
         *std::max_element(s.begin(), s.end());
}

/** Cones that end there cover any layer, whatever their triangles. */
double
largestRadius(const GridShape& shape, const ConeRings& rings)
{
  const GridCell last{static_cast<std::uint16_t>(shape.cells[0]),
                      static_cast<std::uint16_t>(shape.cells[1]),
                      static_cast<std::uint16_t>(shape.cells[2])};
  return 4.0 * (shape.distance({0, 0, 0}, last) + rings.inner_radius);
}

void
drawLayers(const GlFunctions& gl,
           const GridShape& shape,
           const std::vector<GridCell>& sites,
           const ConeRings& rings,
           StepTimer& timer,
           std::vector<std::uint32_t>& nearest)
{
  ConePainter painter(gl, shape, sites);
  const std::size_t layer_size = std::size_t{shape.cells[0]} * shape.cells[1];
  const double largest_radius = largestRadius(shape, rings);
  double radius = estimateRadius(shape, sites.size());
  for (std::uint32_t layer = 0; layer < shape.cells[2]; ++layer) {
    std::uint32_t* const cells = nearest.data() + layer * layer_size;
    const auto draw = [&] {
      painter.setMesh(ConeMesh(rings, shape.spacing, radius, shape.cells[2]));
      painter.draw(layer, cells);
      checkErrors(gl, "fewer cells", "the FeatureTransform");
      return findFarthest(shape, sites, layer, cells);
    };
    double farthest = draw();
    while (std::isinf(farthest)) {
      if (radius > largest_radius)
        throw GlError("gl_layer_left_open", {});
      radius *= radius_growth;
      farthest = draw();
    }
    // From layer to layer, no cell's distance changes by more than the spacing.
    radius = radius_margin * farthest + shape.spacing[2];
    timer.advance(1);
  }
}

} // namespace

ConicSections::ConicSections(const std::shared_ptr<GlContext>& context,
                             double inner_radius,
                             unsigned first_triangles)
    : context_(context)
    , inner_radius_(inner_radius)
    , first_triangles_(first_triangles)
{
  if (!context)
    throw InvalidArgument("conic_sections_without_context", {});
  if (!(inner_radius >= 1.0 && inner_radius <= largest_inner_radius))
    throw InvalidArgument("bad_first_ring_radius",
                          {{"most", largest_inner_radius}, {"radius", inner_radius}});
  if (first_triangles < 3 || first_triangles > most_first_triangles)
    throw InvalidArgument(
        "bad_first_ring_triangles",
        {{"most", most_first_triangles}, {"triangles", first_triangles}});
}

std::vector<std::uint32_t>
ConicSections::find(const GridShape& shape,
                    const std::vector<GridCell>& sites,
                    unsigned /*threads*/,
                    Report& report)
{
  StepTimer timer(report, "conic_sections", shape.cells[2]);
  std::vector<std::uint32_t> nearest(shape.size(), no_site);
  if (sites.empty())
    return nearest;
  const ConeRings rings{inner_radius_ * std::min(shape.spacing[0], shape.spacing[1]),
                        first_triangles_};
  context_->run([&] {
    const GlFunctions gl(*context_);
    forgetErrors(gl);
    drawLayers(gl, shape, sites, rings, timer, nearest);
  });
  return nearest;
}

} // namespace pcl_uvol
