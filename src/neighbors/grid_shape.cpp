// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pcl_uvol {

namespace {

void
checkBox(const std::array<double, 3>& low, const std::array<double, 3>& high)
{
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(low[axis]) || !std::isfinite(high[axis]) ||
        high[axis] < low[axis])
      throw InvalidArgument("grid_box_not_ordered", {});
}

void
checkCells(double cells)
{
  if (!(cells >= 1.0 && cells <= GridShape::largest_side))
    throw InvalidArgument(
        "grid_cells_out_of_range",
        {{"most", GridShape::largest_side}, {"cells", std::llround(cells)}});
}

} // namespace

GridShape
GridShape::cubes(const std::array<double, 3>& low,
                 const std::array<double, 3>& high,
                 std::uint32_t cells_of_longest,
                 std::uint32_t margin)
{
  checkBox(low, high);
  checkCells(cells_of_longest);
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    longest = std::max(longest, high[axis] - low[axis]);
  const double side = longest > 0.0 ? longest / cells_of_longest : 1.0;
  GridShape shape;
  for (int axis = 0; axis < 3; ++axis) {
    // Rounding must not add a cell to the longest side.
    constexpr double rounding = 1e-9;
    const double needed =
        std::max(1.0, std::ceil((high[axis] - low[axis]) / side * (1.0 - rounding)));
    const double cells = needed + 2.0 * margin;
    checkCells(cells);
    shape.cells[axis] = static_cast<std::uint32_t>(cells);
    shape.spacing[axis] = side;
    shape.origin[axis] = 0.5 * (low[axis] + high[axis] - cells * side);
  }
  return shape;
}

GridShape
GridShape::boxes(const std::array<double, 3>& low,
                 const std::array<double, 3>& high,
                 const std::array<std::uint32_t, 3>& cells)
{
  checkBox(low, high);
  GridShape shape;
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    longest = std::max(longest, high[axis] - low[axis]);
  for (int axis = 0; axis < 3; ++axis) {
    checkCells(cells[axis]);
    // An axis along which the box is flat gets cells as thick as they are elsewhere.
    const double length = high[axis] - low[axis];
    const double extent = length > 0.0 ? length : (longest > 0.0 ? longest : 1.0);
    shape.cells[axis] = cells[axis];
    shape.spacing[axis] = extent / cells[axis];
    shape.origin[axis] = 0.5 * (low[axis] + high[axis] - extent);
  }
  return shape;
}

GridCell
GridShape::cellAt(const std::array<double, 3>& place) const
{
  GridCell cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = std::floor((place[axis] - origin[axis]) / spacing[axis]);
    cell[axis] = static_cast<std::uint16_t>(std::clamp(along, 0.0, cells[axis] - 1.0));
  }
  return cell;
}

double
GridShape::distance(const GridCell& a, const GridCell& b) const
{
  double sq_dist = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = spacing[axis] * (static_cast<int>(a[axis]) - b[axis]);
    sq_dist += along * along;
  }
  return std::sqrt(sq_dist);
}

} // namespace pcl_uvol
