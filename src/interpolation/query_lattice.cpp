// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/query_lattice.h"

#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

Vector3d
vectorOf(const Place& place)
{
  return Vector3d(place.data());
}

Place
placeOf(const Vector3d& vector)
{
  return {vector.x(), vector.y(), vector.z()};
}

void
checkBox(const Bounds& box)
{
  bool is_empty = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(box.high[axis] - box.low[axis]) ||
        box.high[axis] < box.low[axis])
      throw InvalidArgument("unordered_box", {});
    is_empty = is_empty && box.high[axis] == box.low[axis];
  }
  if (is_empty)
    throw InvalidArgument("single_point_box", {});
}

double
extentOf(const Bounds& box, std::size_t axis)
{
  return box.high[axis] - box.low[axis];
}

/** Places along an axis, centred in a box. */
void
setAxis(QueryLattice& lattice,
        const Bounds& box,
        std::size_t axis,
        std::size_t count,
        double spacing)
{
  lattice.counts[axis] = count;
  lattice.steps[axis] = {};
  lattice.steps[axis][axis] = spacing;
  lattice.origin[axis] =
      0.5 * (box.low[axis] + box.high[axis] - spacing * static_cast<double>(count - 1));
}

/** Directions of the axes of a slice's picture to the right and upwards. */
struct Directions {
  Vector3d right, up;
};

Directions
directionsOf(const Vector3d& normal)
{
  const Vector3d abs = normal.cwiseAbs();
  if (abs.y() == 1.0)
    return {Vector3d::UnitX(), Vector3d::UnitZ()};
  const Vector3d top = abs.z() > 1.0 - 1e-9 ? Vector3d::UnitY() : Vector3d::UnitZ();
  const Vector3d up = (top - normal * normal.dot(top)).normalized();
  // Slices along the coordinates are seen the same from both sides.
  const Vector3d right = up.cross(abs.maxCoeff() == 1.0 ? abs : normal);
  return {right, up};
}

/** Where a plane cuts the edges of a box. */
std::vector<Vector3d>
cutEdges(const Vector3d& point, const Vector3d& normal, const Bounds& box)
{
  const auto cornerOf = [&](int corner) {
    Vector3d place;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      place[axis] = (corner >> axis & 1) != 0 ? box.high[i] : box.low[i];
    }
    return place;
  };
  std::vector<Vector3d> cuts;
  for (int from = 0; from < 8; ++from)
    for (int axis = 0; axis < 3; ++axis) {
      if ((from >> axis & 1) != 0)
        continue;
      const Vector3d a = cornerOf(from), b = cornerOf(from | 1 << axis);
      const double side_a = normal.dot(a - point), side_b = normal.dot(b - point);
      if (side_a == 0.0)
        cuts.push_back(a);
      if (side_b == 0.0)
        cuts.push_back(b);
      if ((side_a < 0.0 && side_b > 0.0) || (side_a > 0.0 && side_b < 0.0))
        cuts.push_back(a + (b - a) * (side_a / (side_a - side_b)));
    }
  return cuts;
}

[[noreturn]] void
throwMiss(const Bounds& box)
{
  throw InvalidArgument("plane_misses_data",
                        {{"low_x", box.low[0]},
                         {"low_y", box.low[1]},
                         {"low_z", box.low[2]},
                         {"high_x", box.high[0]},
                         {"high_y", box.high[1]},
                         {"high_z", box.high[2]}});
}

/** The axis of the coordinates that a unit vector is, 3 for another one. */
std::size_t
axisAlong(const Vector3d& direction)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (direction[static_cast<Eigen::Index>(axis)] == 1.0)
      return axis;
  return 3;
}

} // namespace

Place
QueryLattice::at(std::size_t index) const
{
  const std::size_t row = index / counts[0];
  const std::size_t along[] = {index % counts[0], row % counts[1], row / counts[1]};
  Place place = origin;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] += static_cast<double>(along[k]) * steps[k][axis];
  return place;
}

double
QueryLattice::spacing(std::size_t axis) const
{
  // Exact for a step along an axis of the coordinates.
  const Vector3d step = vectorOf(steps[axis]);
  const double largest = step.cwiseAbs().maxCoeff();
  return largest * (step / largest).norm();
}

Bounds
findBounds(const CloudView& cloud)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Bounds box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const float* const x = cloud.xyz(i);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
      continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], static_cast<double>(x[axis]));
      box.high[axis] = std::max(box.high[axis], static_cast<double>(x[axis]));
    }
  }
  if (!(box.low[0] <= box.high[0]))
    throw InvalidArgument("no_finite_point", {});
  return box;
}

QueryLattice
makeLine(const Place& from, const Place& to, std::size_t count)
{
  const Vector3d way = vectorOf(to) - vectorOf(from);
  if (!(way.norm() > 0.0) || !way.allFinite() || count < 2)
    throw InvalidArgument("line_without_ends", {});
  QueryLattice line;
  line.origin = from;
  line.steps[0] = placeOf(way / static_cast<double>(count - 1));
  line.counts[0] = count;
  return line;
}

QueryLattice
makeCubicGrid(const Bounds& box, std::size_t count)
{
  checkBox(box);
  if (count < 2)
    throw InvalidArgument("few_points_of_grid", {});
  const double longest =
      std::max({extentOf(box, 0), extentOf(box, 1), extentOf(box, 2)});
  const double spacing = longest / static_cast<double>(count - 1);
  // Rounding shall not lose the last place.
  constexpr double tolerance = 1e-9;
  QueryLattice grid;
  for (std::size_t axis = 0; axis < 3; ++axis)
    setAxis(grid,
            box,
            axis,
            1 + static_cast<std::size_t>(extentOf(box, axis) / spacing + tolerance),
            spacing);
  return grid;
}

QueryLattice
makeGrid(const Bounds& box, const std::array<std::size_t, 3>& counts)
{
  checkBox(box);
  const double longest =
      std::max({extentOf(box, 0), extentOf(box, 1), extentOf(box, 2)});
  QueryLattice grid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (counts[axis] < 1)
      throw InvalidArgument("no_points_along_axis", {});
    const double extent = extentOf(box, axis);
    const auto gaps = static_cast<double>(std::max<std::size_t>(counts[axis] - 1, 1));
    // Steps of axes without extent have to be of some length.
    const double spacing = (extent > 0.0 ? extent : longest) / gaps;
    if (extent == 0.0 && counts[axis] > 1)
      throw InvalidArgument("flat_box", {{"points", counts[axis]}});
    setAxis(grid, box, axis, counts[axis], spacing);
  }
  return grid;
}

Slice
makeSlice(const Plane& plane,
          const Bounds& box,
          const std::array<std::size_t, 2>& counts)
{
  Vector3d normal = vectorOf(plane.normal).stableNormalized();
  if (!(normal.norm() > 0.5) || !vectorOf(plane.point).allFinite())
    throw InvalidArgument("plane_without_normal", {});
  if (std::min(counts[0], counts[1]) < 2)
    throw InvalidArgument("few_points_of_slice", {});
  const Vector3d point = vectorOf(plane.point);
  const std::vector<Vector3d> cuts = cutEdges(point, normal, box);
  if (cuts.empty())
    throwMiss(box);
  const Directions directions = directionsOf(normal);
  const Vector3d sides[] = {directions.right, directions.up};
  double low[2], extent[2];
  for (int i = 0; i < 2; ++i) {
    const auto [least, most] = std::minmax_element(
        cuts.begin(), cuts.end(), [&](const Vector3d& a, const Vector3d& b) {
          return sides[i].dot(a) < sides[i].dot(b);
        });
    low[i] = sides[i].dot(*least);
    extent[i] = sides[i].dot(*most) - low[i];
  }
  const double spacing = std::max(extent[0] / static_cast<double>(counts[0] - 1),
                                  extent[1] / static_cast<double>(counts[1] - 1));
  if (!(spacing > 0.0))
    throw InvalidArgument("plane_touches_data", {});

  constexpr double tolerance = 1e-9; // rounding shall not lose the last place
  Slice slice;
  const std::size_t axes[] = {axisAlong(sides[0]), axisAlong(sides[1])};
  const bool is_along_axes = axes[0] < 3 && axes[1] < 3;
  slice.horizontal = is_along_axes ? axes[0] : 0;
  slice.vertical = is_along_axes ? axes[1] : 1;
  const std::size_t places[] = {slice.horizontal, slice.vertical};
  Vector3d origin = normal * normal.dot(point);
  for (int i = 0; i < 2; ++i) {
    const auto gaps = static_cast<std::size_t>(extent[i] / spacing + tolerance);
    slice.lattice.counts[places[i]] = gaps + 1;
    slice.lattice.steps[places[i]] = placeOf(sides[i] * spacing);
    origin +=
        sides[i] * (low[i] + 0.5 * (extent[i] - spacing * static_cast<double>(gaps)));
  }
  slice.lattice.origin = placeOf(origin);
  const std::size_t across = 3 - slice.horizontal - slice.vertical;
  slice.lattice.steps[across] =
      placeOf((is_along_axes ? Vector3d(normal.cwiseAbs()) : normal) * spacing);
  return slice;
}

std::uint8_t
findFileType(const std::vector<pcl::PCLPointField>& fields, const std::string& name)
{
  using Type = pcl::PCLPointField;
  const ScalarField field(fields, name);
  const auto& components = field.getComponents();
  const bool is_short =
      std::all_of(components.begin(), components.end(), [](const auto& component) {
        return component.datatype == Type::FLOAT32 ||
               datatypeSize(component.datatype) <= 2;
      });
  return is_short ? Type::FLOAT32 : Type::FLOAT64;
}

} // namespace pcl_uvol::detail
