// SPDX-License-Identifier: BSD-3-Clause
#include "support/stretched_samples.h"

#include "common/random.h"

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>

namespace uvol_test {

namespace {

using Vector = Eigen::Vector3d;

/** Heights of layers by index: they grow by 1.25 from the first one, and end at a
 * thickness of 1. */
class WallLayers {
public:
  WallLayers(double ratio, int side)
      : ratio_(ratio)
      , bottom_(-0.5 * side)
  {
  }

  /** The integral of the thickness 1 / (1 + (ratio - 1) 1.25^-layer). */
  double
  heightOf(double index) const
  {
    const double layer = index - bottom_;
    return (std::log(std::exp(rate * layer) + ratio_ - 1.0) - std::log(ratio_)) / rate;
  }

  double
  indexAt(double height) const
  {
    return bottom_ + std::log(std::exp(rate * height) * ratio_ - (ratio_ - 1.0)) / rate;
  }

private:
  static constexpr double rate = 0.22314355131420976; // log(1.25)
  double ratio_, bottom_;
};

StretchedSamples
makeLayers(const WallLayers& layers, bool curved, int side)
{
  if (!curved)
    return {[=](const Vector& u) { return Vector(u[0], u[1], layers.heightOf(u[2])); },
            [=](const Vector& x) { return Vector(x[0], x[1], layers.indexAt(x[2])); }};
  const double radius = 2.0 * side;
  return {[=](const Vector& u) {
            const double angle = u[0] / radius, r = radius + layers.heightOf(u[2]);
            return Vector(r * std::sin(angle), u[1], r * std::cos(angle));
          },
          [=](const Vector& x) {
            return Vector(radius * std::atan2(x[0], x[2]),
                          x[1],
                          layers.indexAt(std::hypot(x[0], x[2]) - radius));
          }};
}

} // namespace

pcl::PointCloud<pcl::PointXYZI>::Ptr
StretchedSamples::sample(const SmoothField& field, int side, std::uint64_t seed) const
{
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  std::uint64_t i = 0;
  for (int c = 0; c < side; ++c)
    for (int b = 0; b < side; ++b)
      for (int a = 0; a < side; ++a, ++i) {
        Vector u = Vector(a, b, c) - Vector::Constant(0.5 * (side - 1));
        for (int axis = 0; axis < 3; ++axis)
          u[axis] +=
              jitter *
              (2.0 * pcl_uvol::uniformAt(seed, i, static_cast<std::uint64_t>(axis)) -
               1.0);
        pcl::PointXYZI point;
        point.getVector3fMap() = to_space(u).cast<float>();
        point.intensity = static_cast<float>(
            field.value(to_index(point.getVector3fMap().cast<double>())));
        cloud->push_back(point);
      }
  return cloud;
}

pcl::PointCloud<pcl_uvol::PointIso>
StretchedSamples::inIndexSpace(const pcl::PointCloud<pcl_uvol::PointIso>& surface) const
{
  pcl::PointCloud<pcl_uvol::PointIso> moved(surface);
  for (pcl_uvol::PointIso& point : moved)
    point.getVector3fMap() =
        to_index(point.getVector3fMap().cast<double>()).cast<float>();
  return moved;
}

StretchedSamples
makeStretchedSamples(const std::string& shape, double ratio, int side)
{
  if (shape == "wall" || shape == "curved")
    return makeLayers(WallLayers(ratio, side), shape == "curved", side);
  const Vector spacing(1.0, 1.0, ratio);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (shape == "rotated")
    turn =
        Eigen::AngleAxisd(1.0, Vector(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  StretchedSamples samples{
      [=](const Vector& u) -> Vector { return turn * spacing.cwiseProduct(u); },
      [=](const Vector& x) -> Vector {
        return (turn.transpose() * x).cwiseQuotient(spacing);
      }};
  if (shape == "jittered")
    samples.jitter = 0.5;
  else if (shape == "shaken")
    samples.jitter = 0.1;
  else if (shape != "lattice" && shape != "rotated")
    throw std::invalid_argument("There is no shape of samples '" + shape + "'.");
  return samples;
}

} // namespace uvol_test
