// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/foot.h"

#include <Eigen/Geometry>

namespace pcl_uvol::detail {

namespace {

/** Steps towards the surface, of which one nearly arrives. */
constexpr int steps = 2;

/** Share of the length between feet: nearer ones weigh no more. */
constexpr double least_distance = 0.1;

struct Blend {
  double height = 0.0, mean_curvature = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

Blend
blend(const std::vector<Foot>& feet, const Eigen::Vector3d& place, double length)
{
  Blend sum;
  double weights = 0.0;
  for (const Foot& foot : feet) {
    const double square = (place - foot.place).squaredNorm() / (length * length) +
                          least_distance * least_distance;
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

Foot
blendFeet(const std::vector<Foot>& feet, const Eigen::Vector3d& place, double length)
{
  Foot foot;
  foot.place = place;
  for (int step = 0; step < steps; ++step) {
    const Blend found = blend(feet, foot.place, length);
    foot.place -= found.height * found.normal;
  }
  const Blend found = blend(feet, foot.place, length);
  foot.normal = found.normal;
  foot.mean_curvature = found.mean_curvature;
  return foot;
}

} // namespace pcl_uvol::detail
