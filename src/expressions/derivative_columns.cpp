// SPDX-License-Identifier: BSD-3-Clause
#include "expressions/derivative_columns.h"

#include "interpolation/sample_derivatives.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/** Share of the samples: with more of them on few planes or lines the user is told. */
constexpr double most_reduced = 0.5;

/** Row i is the gradient of component i. */
Eigen::Matrix3d
jacobianOf(const detail::PointDerivatives* fields)
{
  Eigen::Matrix3d jacobian;
  for (int i = 0; i < 3; ++i)
    jacobian.row(i) = fields[i].gradient.transpose();
  return jacobian;
}

/** Half the divergence of the normalised gradient. */
double
computeMeanCurvature(const detail::PointDerivatives& field)
{
  const double slope = field.gradient.norm();
  if (!(slope > 0.0))
    return none;
  const Eigen::Vector3d normal = field.gradient / slope;
  return (field.hessian.trace() - normal.dot(field.hessian * normal)) / (2.0 * slope);
}

double
computeLambda2(const Eigen::Matrix3d& jacobian)
{
  if (!jacobian.allFinite())
    return none;
  const Eigen::Matrix3d strain = 0.5 * (jacobian + jacobian.transpose());
  const Eigen::Matrix3d spin = 0.5 * (jacobian - jacobian.transpose());
  const Eigen::Matrix3d sum = strain * strain + spin * spin;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum, Eigen::EigenvaluesOnly)
      .eigenvalues()[1];
}

bool
areFinite(const detail::PointDerivatives* fields, std::size_t count)
{
  return std::all_of(fields, fields + count, [](const detail::PointDerivatives& field) {
    return field.gradient.allFinite();
  });
}

/** \param[out] result as many numbers as the derivative has */
void
compute(Derivative derivative,
        const detail::PointDerivatives* fields,
        std::array<double, 3>& result)
{
  switch (derivative) {
  case Derivative::Gradient:
    Eigen::Vector3d::Map(result.data()) = fields[0].gradient;
    break;
  case Derivative::Laplacian:
    result[0] = fields[0].hessian.trace();
    break;
  case Derivative::Curvature:
    result[0] = computeMeanCurvature(fields[0]);
    break;
  case Derivative::Divergence:
    result[0] = jacobianOf(fields).trace();
    break;
  case Derivative::Curl: {
    const Eigen::Matrix3d jacobian = jacobianOf(fields);
    result = {jacobian(2, 1) - jacobian(1, 2),
              jacobian(0, 2) - jacobian(2, 0),
              jacobian(1, 0) - jacobian(0, 1)};
    break;
  }
  case Derivative::Q: {
    const Eigen::Matrix3d jacobian = jacobianOf(fields);
    result[0] = -0.5 * (jacobian * jacobian).trace();
    break;
  }
  case Derivative::Lambda2:
    result[0] = computeLambda2(jacobianOf(fields));
    break;
  }
}

} // namespace

Columns
deriveColumns(Derivative derivative,
              const Columns& fields,
              const FormulaPoints& points,
              unsigned threads,
              std::uint64_t& undefined,
              Report& report)
{
  const bool is_vector =
      derivative == Derivative::Gradient || derivative == Derivative::Curl;
  const std::size_t count = points.with_images.count;
  Columns columns(is_vector ? 3 : 1, std::vector<double>(count, none));
  std::atomic<std::uint64_t> missing{0}, unknown{0};
  Report own; // its counts are those of the samples, which others count as well
  own.progress = report.progress;
  const std::uint64_t few = detail::computeDerivatives(
      points.with_images,
      fields,
      threads,
      [&](std::size_t point, const detail::PointDerivatives* derivatives) {
        if (!areFinite(derivatives, fields.size())) {
          unknown += point < points.own.count;
          return;
        }
        std::array<double, 3> result{};
        compute(derivative, derivatives, result);
        for (std::size_t i = 0; i < columns.size(); ++i)
          if (std::isfinite(result[i]))
            columns[i][point] = result[i];
          else if (point < points.own.count)
            ++missing;
      },
      own);
  for (auto& column : columns) // those of the outermost images are one-sided
    for (std::size_t i = 0; i < points.image_of.size(); ++i)
      column[points.own.count + i] = column[points.image_of[i]];
  undefined += missing;
  if (unknown > 0)
    report.warn("unknown_derivatives",
                {{"unknown", unknown.load()}, {"points", points.own.count}});
  const auto reduced = static_cast<double>(few);
  if (reduced > most_reduced * static_cast<double>(count))
    report.warn("reduced_derivatives", {{"samples", reduced}});
  return columns;
}

} // namespace pcl_uvol
