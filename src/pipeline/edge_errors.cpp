// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/edge_errors.h"

#include "common/eigen_solvers.h"
#include "common/median.h"
#include "isosurface/fit_judgement.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl_uvol {

namespace {

using Eigen::Vector3d;

/** Isopoints that the paraboloid rests on: those of edges that fan out from one line of
 * samples are many, and 15 were nearly always of one fan, which a paraboloid follows.
 */
constexpr std::size_t most_around = 40;

/** Fewer do not tell. */
constexpr std::size_t least_around = 20;

constexpr Eigen::Index terms = 6;

/** Residuals by which nine in ten deviations are covered on tracks, casts and holes of
 * three fields (tests/benchmarks, calibration). */
constexpr double residual_factor = 5.0;

/** Isopoints around lie on a line rather than a surface where that is less wide. */
constexpr double least_width = 0.1;

/** Cosine between the normal of the paraboloid's plane and the edge: isopoints in a
 * plane of samples have no heights over it. */
constexpr double least_crossing = 0.1;

/** Part of the range of the values around that half of the edges span where these jump:
 * between rock types it is all of it. */
constexpr double jump_span = 0.8;

constexpr float infinite = std::numeric_limits<float>::infinity();

/** Axes of the extents of points around their mean, the smallest first. */
struct Extents {
  Eigen::Matrix3d axes;
  Vector3d lengths;

  explicit Extents(const Eigen::Matrix3Xd& points)
  {
    const Eigen::Matrix3Xd offsets = points.colwise() - points.rowwise().mean();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(offsets *
                                                                offsets.transpose());
    axes = solver.eigenvectors();
    lengths = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  }
};

/** How far points deviate from the paraboloid over a plane that fits them best: the
 * deviation, or that of the point at the origin if it is larger. */
double
findDeviation(const Eigen::Matrix3Xd& points, const Extents& extents)
{
  const double radius = std::sqrt(points.colwise().squaredNorm().maxCoeff());
  const Eigen::Matrix3Xd local = extents.axes.transpose() * points / radius;
  const auto heights = local.row(0).transpose(), x = local.row(1).transpose(),
             y = local.row(2).transpose();
  Eigen::MatrixXd matrix(points.cols(), terms);
  matrix << Eigen::VectorXd::Ones(points.cols()), x, y, x.cwiseProduct(x),
      x.cwiseProduct(y), y.cwiseProduct(y);
  const Eigen::VectorXd right = heights;
  const Eigen::VectorXd paraboloid = matrix.colPivHouseholderQr().solve(right);
  const double free = static_cast<double>(points.cols() - terms);
  const double deviation = (matrix * paraboloid - heights).norm() / std::sqrt(free);
  return radius * std::max(deviation, std::abs(paraboloid[0]));
}

} // namespace

EdgeErrorFinder::EdgeErrorFinder(const SampleSet& places,
                                 const pcl::PointCloud<PointIso>& isopoints,
                                 const StretchedEdges& edges)
    : places_(places)
    , isopoints_(isopoints)
    , edges_(edges)
    , search_(places, most_around)
{
}

Vector3d
EdgeErrorFinder::stretch(const PointIso& point) const
{
  const Position& scale = places_.getUnit().scale;
  return point.getVector3fMap().cast<double>().cwiseProduct(
      Vector3d(scale[0], scale[1], scale[2]));
}

bool
EdgeErrorFinder::valuesJump(const std::vector<std::uint32_t>& around) const
{
  std::vector<double> spans;
  auto lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const std::uint32_t i : around) {
    const auto [first, second] = edges_.readValues(i);
    spans.push_back(std::abs(second - first));
    lowest = std::min({lowest, first, second});
    highest = std::max({highest, first, second});
  }
  return !(computeMedian(spans) <= jump_span * (highest - lowest));
}

float
EdgeErrorFinder::find(std::size_t isopoint)
{
  const PointIso& point = isopoints_[isopoint];
  const std::vector<std::uint32_t>& around = search_.find(point);
  if (around.size() < least_around || valuesJump(around))
    return infinite;
  Eigen::Matrix3Xd points(3, around.size());
  for (std::size_t i = 0; i < around.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) =
        stretch(isopoints_[around[i]]) - stretch(point);
  const Extents extents(points);
  const Vector3d normal = extents.axes.col(0);
  if (!(extents.lengths[1] > least_width * extents.lengths[2]) ||
      !(std::abs(normal.dot(edges_.findOutside(isopoint))) > least_crossing))
    return infinite;
  // The normal is a covector: heights over the plane shrink by its length when it is
  // carried back.
  const Position& scale = places_.getUnit().scale;
  const double slope =
      normal.cwiseProduct(Vector3d(scale[0], scale[1], scale[2])).norm();
  const double error = residual_factor * findDeviation(points, extents) / slope;
  return static_cast<float>(std::hypot(error, computeRounding(point)));
}

} // namespace pcl_uvol
