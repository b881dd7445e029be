// SPDX-License-Identifier: BSD-3-Clause
#include "support/flows.h"

#include "common/scalar_field.h"
#include "interpolation/sample_derivatives.h"
#include "support/environment.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/expressions/derived_fields.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace uvol_test {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d
taylorGreen(const Vector3d& x)
{
  return {std::sin(x[0]) * std::cos(x[1]) * std::cos(x[2]),
          -std::cos(x[0]) * std::sin(x[1]) * std::cos(x[2]),
          0.0};
}

Vector3d
abcFlow(const Vector3d& x)
{
  const double a = std::sqrt(3.0), b = std::sqrt(2.0), c = 1.0;
  return {a * std::sin(x[2]) + c * std::cos(x[1]),
          b * std::sin(x[0]) + a * std::cos(x[2]),
          c * std::sin(x[1]) + b * std::cos(x[0])};
}

Vector3d
hillsVortex(const Vector3d& x)
{
  const double r = x.norm();
  if (r <= 1.0)
    return 1.5 * Vector3d(x[0] * x[2],
                          x[1] * x[2],
                          1.0 - 2.0 * (x[0] * x[0] + x[1] * x[1]) - x[2] * x[2]);
  return -Vector3d::UnitZ() -
         0.5 * (Vector3d::UnitZ() / std::pow(r, 3) - 3.0 * x[2] * x / std::pow(r, 5));
}

Vector3d
curlOf(const Matrix3d& jacobian)
{
  return {jacobian(2, 1) - jacobian(1, 2),
          jacobian(0, 2) - jacobian(2, 0),
          jacobian(1, 0) - jacobian(0, 1)};
}

double
qOf(const Matrix3d& jacobian)
{
  return -0.5 * (jacobian * jacobian).trace();
}

double
lambda2Of(const Matrix3d& jacobian)
{
  const Matrix3d strain = 0.5 * (jacobian + jacobian.transpose());
  const Matrix3d spin = 0.5 * (jacobian - jacobian.transpose());
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(strain * strain + spin * spin)
      .eigenvalues()[1];
}

} // namespace

std::vector<Flow>
makeFlows()
{
  const auto always = [](const Vector3d&, double) { return true; };
  return {{"Taylor-Green", 1.6, taylorGreen, always},
          {"ABC", 1.6, abcFlow, always},
          {"Hill", 2.4, hillsVortex, [](const Vector3d& x, double distance) {
             return std::abs(x.norm() - 1.0) > distance;
           }}};
}

Matrix3d
jacobianOf(const Flow& flow, const Vector3d& x)
{
  constexpr double step = 1e-5;
  Matrix3d jacobian;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d shift = step * Vector3d::Unit(axis);
    jacobian.col(axis) =
        (flow.velocity(x + shift) - flow.velocity(x - shift)) / (2.0 * step);
  }
  return jacobian;
}

pcl_uvol::Dataset
sampleFlow(const Flow& flow, std::size_t n, std::uint64_t seed)
{
  Random random(seed);
  std::vector<double> places, components[3];
  for (std::size_t i = 0; i < n; ++i) {
    Vector3d x;
    for (double& along : x) {
      along = static_cast<float>(flow.half_side * (2.0 * random.uniform() - 1.0));
      places.push_back(along);
    }
    const Vector3d v = flow.velocity(x);
    for (int axis = 0; axis < 3; ++axis)
      components[axis].push_back(v[axis]);
  }
  pcl_uvol::Dataset dataset;
  setCoordinates(dataset, places);
  for (int axis = 0; axis < 3; ++axis)
    setField(dataset, std::string("v") + "xyz"[axis], components[axis]);
  return dataset;
}

double
spacingOf(const Flow& flow, std::size_t n)
{
  return 2.0 * flow.half_side / std::cbrt(static_cast<double>(n));
}

FlowErrors
measureDerivatives(const Flow& flow, std::size_t n, std::uint64_t seed, double distance)
{
  pcl_uvol::Dataset dataset = sampleFlow(flow, n, seed);
  pcl_uvol::Report report;
  for (const char* const name : {"Q(v)", "lambda2(v)"})
    addDerivedField(dataset, name, {}, report);
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(dataset.cloud);
  std::vector<std::vector<double>> columns;
  for (const char* const name : {"vx", "vy", "vz", "Q(v)", "lambda2(v)"}) {
    const pcl_uvol::ScalarField field(cloud.fields, name);
    columns.emplace_back();
    for (std::size_t i = 0; i < cloud.count; ++i)
      columns.back().push_back(field.read(cloud.point(i)));
  }
  std::vector<Matrix3d> jacobians(n);
  pcl_uvol::detail::computeDerivatives(
      cloud,
      {columns.begin(), columns.begin() + 3},
      0,
      [&](std::size_t point, const pcl_uvol::detail::PointDerivatives* fields) {
        for (int i = 0; i < 3; ++i)
          jacobians[point].row(i) = fields[i].gradient.transpose();
      },
      report);
  FlowErrors sums{};
  double count = 0.0;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const Vector3d x = Eigen::Map<const Eigen::Vector3f>(cloud.xyz(i)).cast<double>();
    if (x.cwiseAbs().maxCoeff() > flow.half_side - distance ||
        !flow.is_smooth(x, distance))
      continue;
    const Matrix3d truth = jacobianOf(flow, x);
    sums.gradient += (jacobians[i] - truth).squaredNorm();
    sums.curl += (curlOf(jacobians[i]) - curlOf(truth)).squaredNorm();
    sums.q += std::pow(columns[3][i] - qOf(truth), 2);
    sums.lambda2 += std::pow(columns[4][i] - lambda2Of(truth), 2);
    ++count;
  }
  return {std::sqrt(sums.gradient / count),
          std::sqrt(sums.curl / count),
          std::sqrt(sums.q / count),
          std::sqrt(sums.lambda2 / count)};
}

} // namespace uvol_test
