// SPDX-License-Identifier: BSD-3-Clause
#include "render/camera_fit.h"

#include "common/constants.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Right, left, below and above of the image. */
constexpr std::size_t frustum_sides = 4;
using Sides = std::array<double, frustum_sides>;

/** Largest values of linear functions over discs in the directions of a camera. */
class Extremes {
public:
  /** \param slopes of the image's planes */
  explicit Extremes(const Sides& slopes)
  {
    for (std::size_t side = 0; side < frustum_sides; ++side) {
      const auto axis = static_cast<Eigen::Index>(side / 2);
      sq_lengths_[side] = 1.0 + slopes[side] * slopes[side];
      planes_[side] = Eigen::Vector3d(0.0, 0.0, -slopes[side]);
      planes_[side][axis] = side % 2 == 0 ? 1.0 : -1.0;
    }
    beyond_.fill(-std::numeric_limits<double>::infinity());
  }

  /** \param normal of length 1 */
  void
  add(const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& normal)
  {
    for (std::size_t side = 0; side < frustum_sides; ++side) {
      const double across = planes_[side].dot(normal);
      const double sq_within = sq_lengths_[side] - across * across;
      extend(side,
             planes_[side].dot(center) + radius * std::sqrt(std::max(sq_within, 0.0)));
    }
    nearest_ = std::min(nearest_, center.z() - radius);
    farthest_ = std::max(farthest_, center.z() + radius);
  }

  /** The ring that a ball around a disc describes about an axis of length 1 through 0:
   * over a circle a linear function is largest where it points to. */
  void
  addRing(const Eigen::Vector3d& center, double radius, const Eigen::Vector3d& axis)
  {
    const double height = center.dot(axis);
    const double distance = (center - height * axis).norm();
    const auto largest = [&](const Eigen::Vector3d& plane) {
      const double along = plane.dot(axis);
      return height * along + distance * (plane - along * axis).norm();
    };
    for (std::size_t side = 0; side < frustum_sides; ++side)
      extend(side, largest(planes_[side]) + radius * std::sqrt(sq_lengths_[side]));
    const Eigen::Vector3d forward = Eigen::Vector3d::UnitZ();
    nearest_ = std::min(nearest_, -largest(-forward) - radius);
    farthest_ = std::max(farthest_, largest(forward) + radius);
  }

  /** Beyond a plane through 0. */
  double
  beyond(std::size_t side) const
  {
    return beyond_[side];
  }

  double
  nearest() const
  {
    return nearest_;
  }

  double
  middle() const
  {
    return 0.5 * (nearest_ + farthest_);
  }

private:
  void
  extend(std::size_t side, double value)
  {
    beyond_[side] = std::max(beyond_[side], value);
  }

  Sides sq_lengths_; ///< of planes_
  std::array<Eigen::Vector3d, frustum_sides> planes_;
  Sides beyond_;
  double nearest_ = std::numeric_limits<double>::infinity(), farthest_ = -nearest_;
};

/** Calls with the place and the disc of every point that counts. */
template <typename Function>
void
forPoints(const FittedPoints& points, const Function& call)
{
  constexpr FittedDisc none{0.0f, {0.0f, 0.0f, 1.0f}};
  for (std::size_t i = 0; i < points.cloud.count; ++i) {
    const Eigen::Vector3f point =
        Eigen::Map<const Eigen::Vector3f>(points.cloud.xyz(i));
    const FittedDisc& disc = points.discs.empty() ? none : points.discs[i];
    if (point.allFinite() && !std::isnan(disc.radius))
      call(point.cast<double>(), disc);
  }
}

} // namespace

Camera
fitToPoints(const Camera& camera,
            const FittedPoints& points,
            double aspect,
            const ImageFill& fill)
{
  // A point x is in the image of a camera at e if |x - e|_x <= slope (x - e)_z: all of
  // them are if e lies behind four planes that touch the points from outside.
  const Eigen::Matrix3d turn = camera.rotation();
  const double half_y = std::tan(camera.vertical_fov * pi / 360.0),
               half_x = half_y * aspect;
  Sides slopes{
      fill.right * half_x, fill.left * half_x, fill.bottom * half_y, fill.top * half_y};
  if (points.axis)
    for (const std::size_t first : {0u, 2u})
      slopes[first] = slopes[first + 1] = std::min(slopes[first], slopes[first + 1]);
  Eigen::Vector3d axis = Eigen::Vector3d::Zero(), center = camera.at;
  if (points.axis) {
    axis = (turn * *points.axis).normalized();
    Eigen::AlignedBox3d box;
    forPoints(points, [&](const Eigen::Vector3d& point, const FittedDisc&) {
      box.extend(point);
    });
    if (!box.isEmpty())
      center = box.center();
  }
  Extremes most(slopes);
  forPoints(points, [&](const Eigen::Vector3d& point, const FittedDisc& disc) {
    const Eigen::Vector3d seen = turn * (point - center);
    if (points.axis)
      most.addRing(seen, disc.radius, axis);
    else
      most.add(
          seen, disc.radius, turn * Eigen::Vector3f(disc.normal.data()).cast<double>());
  });
  const auto leastBehind = [&](std::size_t first) {
    return (most.beyond(first) + most.beyond(first + 1)) /
           (slopes[first] + slopes[first + 1]);
  };
  const double behind = std::max(leastBehind(0), leastBehind(2));
  if (!(behind + most.nearest() > 0.0) || !std::isfinite(behind))
    return camera;
  const auto middleOf = [&](std::size_t first) {
    return 0.5 * (most.beyond(first) - most.beyond(first + 1) +
                  (slopes[first + 1] - slopes[first]) * behind);
  };
  const Eigen::Vector3d eye(middleOf(0), middleOf(2), -behind);
  // What a turning camera looks at stays on the axis, which may be its line of sight.
  constexpr double least_sine = 1e-6;
  const double depth =
      std::abs(axis.y()) > least_sine ? eye.y() / axis.y() * axis.z() : most.middle();
  Camera fitted = camera;
  fitted.eye = center + turn.transpose() * eye;
  fitted.at = center + turn.transpose() * Eigen::Vector3d(eye.x(), eye.y(), depth);
  return fitted;
}

} // namespace pcl_uvol
