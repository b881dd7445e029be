// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/foot.h"

#include <Eigen/Geometry>

namespace pcl_uvol::detail {

namespace {

/** Steps towards the surface, of which one nearly arrives; within a side, which the
 * surface may cross at a small angle, more are needed. */
constexpr int free_steps = 2, bound_steps = 5;

/** Sine of the angle between surface and side, squared: below it no way leads down. */
constexpr double least_slope = 0.01;

/** Share of the length between feet: nearer ones weigh no more. */
constexpr double least_distance = 0.1;

/** In lengths: a step beyond it tells of curvatures that belong to no surface, and the
 * next one would be longer still, up to infinity. */
constexpr double longest_step = 1e3;

struct Blend {
  double height = 0.0, mean_curvature = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

Blend
blend(const std::vector<Foot>& feet, const Eigen::Vector3d& place, double length)
{
  const double sq_length = length * length;
  Blend sum;
  double weights = 0.0;
  for (const Foot& foot : feet) {
    const double distance =
        sq_length > 0.0 ? (place - foot.place).squaredNorm() / sq_length : 0.0;
    const double square = distance + least_distance * least_distance;
    const double weight = 1.0 / (square * square);
    weights += weight;
    sum.height += weight * foot.heightOf(place);
    sum.mean_curvature += weight * foot.mean_curvature;
    sum.normal += weight * foot.normalAt(place);
  }
  sum.height /= weights;
  sum.mean_curvature /= weights;
  sum.normal.normalize();
  return sum;
}

} // namespace

Eigen::Vector3d
keepWithin(BoxSides sides, const Eigen::Vector3d& direction)
{
  Eigen::Vector3d kept = direction;
  for (int axis = 0; axis < 3; ++axis)
    if (isBound(sides, axis))
      kept[axis] = 0.0;
  return kept;
}

Eigen::Vector3d
wayDown(double height, const Eigen::Vector3d& normal, BoxSides sides)
{
  if (sides == 0)
    return -height * normal;
  const Eigen::Vector3d slope = keepWithin(sides, normal);
  const double square = slope.squaredNorm();
  return square < least_slope ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                              : Eigen::Vector3d(-height / square * slope);
}

Foot
blendFeet(const std::vector<Foot>& feet,
          const Eigen::Vector3d& place,
          double length,
          BoxSides sides)
{
  Foot foot;
  foot.place = place;
  const int steps = sides == 0 ? free_steps : bound_steps;
  for (int step = 0; step < steps; ++step) {
    const Blend found = blend(feet, foot.place, length);
    const Eigen::Vector3d way = wayDown(found.height, found.normal, sides);
    if (!(way.norm() <= longest_step * length))
      break;
    foot.place += way;
  }
  const Blend found = blend(feet, foot.place, length);
  foot.normal = found.normal;
  foot.mean_curvature = found.mean_curvature;
  return foot;
}

} // namespace pcl_uvol::detail
