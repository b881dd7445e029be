// SPDX-License-Identifier: BSD-3-Clause
#include "support/smooth_fields.h"

#include "common/random.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace uvol_test {

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Vector = Eigen::Vector3d;

Vector
gradientOf(const SmoothField& field, const Vector& x)
{
  const double step = 1e-6 * field.side;
  Vector gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector d = step * Vector::Unit(axis);
    gradient[axis] = (field.value(x + d) - field.value(x - d)) / (2 * step);
  }
  return gradient;
}

/** Distance to the isosurface, along the gradient. */
double
deviation(const SmoothField& field, const pcl_uvol::PointIso& point)
{
  const Vector start(point.x, point.y, point.z);
  Vector x = start;
  for (int i = 0; i < 20; ++i) {
    const Vector gradient = gradientOf(field, x);
    const Vector step =
        (field.value(x) - field.isovalue) / gradient.squaredNorm() * gradient;
    x -= step;
    if (step.norm() < 1e-10 * field.side)
      break;
  }
  return std::abs((start - x).dot(gradientOf(field, x).normalized()));
}

} // namespace

SmoothField
makeSmoothField(const std::string& name, std::size_t n)
{
  const double side = std::cbrt(static_cast<double>(n)), radius = 46.0 / 160.0 * side;
  const auto r = [](const Vector& x) { return x.norm(); };
  if (name == "radial")
    return {"radial", r, radius, side};
  if (name == "fourth_power")
    return {"fourth_power",
            [radius](const Vector& x) { return std::pow(x.norm() / radius, 4); },
            1.0,
            side};
  if (name == "growth") // tenfold over ten spacings
    return {
        "growth",
        [radius](const Vector& x) { return std::pow(10.0, 0.1 * (x.norm() - radius)); },
        1.0,
        side};
  if (name == "waves")
    return {"waves",
            [](const Vector& x) {
              return x.norm() + 0.8 * std::sin(0.35 * x[0]) * std::sin(0.3 * x[1]) *
                                    std::sin(0.4 * x[2]);
            },
            radius,
            side};
  if (name == "decay")
    return {"decay",
            [side](const Vector& x) {
              return std::exp(-6 * x.norm() / side) * (1 + 0.6 * x[0] / side);
            },
            std::exp(-1.5),
            side};
  if (name == "gyroid")
    return {"gyroid",
            [side](const Vector& x) {
              const Vector p = 4 * M_PI / side * x;
              return std::sin(p[0]) * std::cos(p[1]) + std::sin(p[1]) * std::cos(p[2]) +
                     std::sin(p[2]) * std::cos(p[0]);
            },
            0.3,
            side};
  if (name == "torus")
    return {"torus",
            [side](const Vector& x) {
              const Vector p = 2 / side * x;
              return 0.25 - std::hypot(std::hypot(p[0], p[1]) - 0.65, p[2]);
            },
            0.02,
            side};
  throw std::invalid_argument("There is no smooth field '" + name + "'.");
}

double
meanCurvatureOf(const SmoothField& field, const Vector& x)
{
  const double step = 1e-4 * field.side;
  double divergence = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector d = step * Vector::Unit(axis);
    divergence += (gradientOf(field, x + d).normalized()[axis] -
                   gradientOf(field, x - d).normalized()[axis]) /
                  (2 * step);
  }
  return 0.5 * divergence;
}

Cloud::Ptr
sampleSmoothField(const SmoothField& field,
                  std::size_t n,
                  std::uint64_t seed,
                  bool clustered,
                  double noise)
{
  Cloud::Ptr cloud(new Cloud(static_cast<std::uint32_t>(n), 1));
  for (std::size_t i = 0; i < n; ++i) {
    const auto u = [&](std::uint64_t draw) {
      return pcl_uvol::uniformAt(seed, i, draw);
    };
    Vector x = field.side * (Vector(u(0), u(1), u(2)) - Vector::Constant(0.5));
    if (clustered) {
      const double r = 0.5 * field.side * std::pow(30.0, u(0) - 1.0);
      const double z = 2 * u(1) - 1, angle = 2 * M_PI * u(2),
                   flat = std::sqrt(1 - z * z);
      x = r * Vector(flat * std::cos(angle), flat * std::sin(angle), z);
    }
    pcl::PointXYZI& point = (*cloud)[i];
    point.getVector3fMap() = x.cast<float>();
    point.intensity =
        static_cast<float>(field.value(point.getVector3fMap().cast<double>()) +
                           noise * field.isovalue * pcl_uvol::normalAt(seed, i, 5));
  }
  return cloud;
}

Cloud::Ptr
sampleOnLines(const SmoothField& field,
              pcl_uvol::Scatter lines,
              std::uint64_t n,
              std::uint64_t seed)
{
  Cloud::Ptr cloud(new Cloud(static_cast<std::uint32_t>(n), 1));
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto place =
        pcl_uvol::scatterAt(lines, seed, i, n, -0.5 * field.side, 0.5 * field.side);
    pcl::PointXYZI& point = (*cloud)[i];
    for (std::size_t axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(place[axis]);
    point.intensity =
        static_cast<float>(field.value(point.getVector3fMap().cast<double>()));
  }
  return cloud;
}

std::vector<double>
deviations(const SmoothField& field, const pcl::PointCloud<pcl_uvol::PointIso>& surface)
{
  std::vector<double> result;
  for (const pcl_uvol::PointIso& point : surface)
    result.push_back(deviation(field, point));
  return result;
}

double
mean(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(values.size());
}

double
quantile(std::vector<double> values, double part)
{
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part *
                                         static_cast<double>(values.size() - 1))];
}

} // namespace uvol_test
