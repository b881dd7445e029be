// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

void
checkParameters(const VoronoiParameters& parameters)
{
  const auto is_allowed = [](std::uint32_t cells) {
    return cells >= 1 && cells <= GridShape::largest_side;
  };
  const bool are_cubes = parameters.cells_y == 0 && parameters.cells_z == 0;
  if (!is_allowed(parameters.cells_x) ||
      (!are_cubes &&
       (!is_allowed(parameters.cells_y) || !is_allowed(parameters.cells_z))))
    throw InvalidArgument("voronoi_cells_out_of_range",
                          {{"most", GridShape::largest_side}});
  if (!are_cubes && parameters.margin > 0)
    throw InvalidArgument("margin_of_oblong_cells", {});
}

GridShape
makeShape(const CloudView& cloud,
          const pcl::Indices& indices,
          const VoronoiParameters& parameters)
{
  std::array<double, 3> low{{1e300, 1e300, 1e300}}, high{{-1e300, -1e300, -1e300}};
  for (const auto index : indices) {
    const float* const p = cloud.xyz(static_cast<std::size_t>(index));
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min<double>(low[axis], p[axis]);
      high[axis] = std::max<double>(high[axis], p[axis]);
    }
  }
  if (low[0] > high[0])
    throw InvalidArgument("input_without_point", {});
  return parameters.cells_y == 0
             ? GridShape::cubes(low, high, parameters.cells_x, parameters.margin)
             : GridShape::boxes(
                   low,
                   high,
                   {{parameters.cells_x, parameters.cells_y, parameters.cells_z}});
}

} // namespace

std::shared_ptr<const VoronoiGrid>
detail::computeVoronoiGrid(const CloudView& cloud,
                           const pcl::Indices& indices,
                           const VoronoiParameters& parameters,
                           NearestSites& way,
                           unsigned threads,
                           Report& report)
{
  checkParameters(parameters);
  const std::vector<std::uint32_t> use(indices.begin(), indices.end());
  return std::make_shared<VoronoiGrid>(makeShape(cloud, indices, parameters),
                                       cloud.xyz(0),
                                       cloud.stride(),
                                       use,
                                       way,
                                       threads,
                                       report);
}

std::string
VoronoiParameters::toJson() const
{
  return writeJson(*this);
}

VoronoiParameters
VoronoiParameters::fromJson(const std::string& text)
{
  return readJson<VoronoiParameters>(text);
}

} // namespace pcl_uvol
