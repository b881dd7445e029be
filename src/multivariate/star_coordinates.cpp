// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "common/parameter_json.h"
#include "multivariate/cluster_attributes.h"
#include "multivariate/cluster_moments.h"
#include "multivariate/cluster_separation.h"
#include "multivariate/linear_algebra.h"
#include "multivariate/projections.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;

/** A later start must be better by this part, so that rounding picks no winner. */
constexpr double tie = 1e-9;
/** Weight of all rows in a frame made for cluster centres: decides where these leave a
 * choice. */
constexpr double weight_of_rows = 1e-6;

/** The given axes made orthonormal, without those that are none of their own, and then
 * the directions of largest variance perpendicular to them, as far as there are any. */
MatrixXd
completeAxes(const MatrixXd& axes, const MatrixXd& covariance)
{
  const Index m = covariance.rows(), wanted = std::min<Index>(3, m);
  MatrixXd complete = MatrixXd::Zero(m, 3);
  const MatrixXd own = orthonormalized(axes);
  Index count = 0;
  for (Index k = 0; k < own.cols() && count < wanted; ++k)
    if (!own.col(k).isZero())
      complete.col(count++) = own.col(k);
  // What is chosen already has the smallest eigenvalue of all.
  const MatrixXd chosen = complete.lazyProduct(complete.transpose());
  const MatrixXd across = MatrixXd::Identity(m, m) - chosen;
  const MatrixXd half = across.lazyProduct(covariance);
  const MatrixXd rest =
      half.lazyProduct(across) - (2.0 * covariance.trace() + 1.0) * chosen;
  const EigenPairs pairs = computeEigenPairs(rest);
  for (Index k = 0; count < wanted; ++k)
    complete.col(count++) = pairs.vectors.col(m - 1 - k);
  return complete;
}

/** The same space, turned so that the first axis carries most of a variance. */
MatrixXd
turned(const MatrixXd& axes, const MatrixXd& covariance)
{
  const MatrixXd half = covariance.lazyProduct(axes);
  const Matrix3d projected = axes.transpose().lazyProduct(half);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(projected);
  return axes.lazyProduct(solver.eigenvectors().rowwise().reverse().eval());
}

MatrixXd
perUnitTrace(const MatrixXd& covariance)
{
  const double trace = covariance.trace();
  return trace > 0.0 ? MatrixXd(covariance / trace) : covariance;
}

Projection
makeProjection(const AttributeTable& table, const VectorXd& mean, MatrixXd axes)
{
  Projection projection;
  projection.names = table.names;
  projection.offsets = table.means;
  projection.units = table.units;
  projection.mean.assign(mean.data(), mean.data() + mean.size());
  for (Index k = 0; k < 3; ++k) {
    Index largest = 0;
    axes.col(k).cwiseAbs().maxCoeff(&largest);
    if (axes(largest, k) < 0.0)
      axes.col(k) *= -1.0;
    for (Index i = 0; i < axes.rows(); ++i)
      projection.rows[static_cast<std::size_t>(k)].push_back(axes(i, k) + 0.0); // no -0
  }
  return projection;
}

Moments
joined(const std::vector<Moments>& parts)
{
  Moments all;
  for (const Moments& part : parts)
    all.join(part);
  return all;
}

void
checkParameters(const StarCoordinateParameters& parameters)
{
  if (!(parameters.regularization > 0.0 && parameters.regularization <= 1.0))
    throw InvalidArgument("regularization_not_allowed",
                          {{"regularization", parameters.regularization}});
}

/** Ascends from several starts, in attributes; the functionals of the best end. */
MatrixXd
bestAxes(const ClusterSeparation& separation,
         const std::vector<MatrixXd>& starts,
         const StarCoordinateParameters& parameters,
         unsigned threads)
{
  std::vector<MatrixXd> ends(starts.size());
  std::vector<double> ratios(starts.size());
  parallelBlocks(starts.size(), 1, threads, [&](std::size_t s, std::size_t) {
    ends[s] = separation.ascend(separation.toBasis(starts[s]), parameters.steps);
    ratios[s] = separation.findSmallestSeparable(ends[s]);
  });
  std::size_t best = 0;
  for (std::size_t s = 1; s < ends.size(); ++s)
    if (ratios[s] > ratios[best] * (1.0 + tie))
      best = s;
  return separation.toFunctionals(ends[best]);
}

MatrixXd
optimizedAxes(const ClusterSeparation& separation,
              const MatrixXd& covariance,
              const MatrixXd& covariance_with_noise,
              const StarCoordinateParameters& parameters,
              unsigned threads)
{
  MatrixXd discriminants =
      completeAxes(separation.toFunctionals(separation.discriminants()), covariance);
  if (separation.countClusters() == 2)
    return discriminants; // the first one is the best there is
  std::vector<MatrixXd> starts = {discriminants};
  for (const bool favours_close : {true, false})
    starts.push_back(completeAxes(
        separation.toFunctionals(separation.centreAxes(favours_close)), covariance));
  starts.push_back(completeAxes(MatrixXd(), covariance_with_noise));
  return completeAxes(bestAxes(separation, starts, parameters, threads), covariance);
}

} // namespace

std::array<float, 3>
Projection::project(const float* attributes) const
{
  std::array<float, 3> place;
  for (std::size_t k = 0; k < 3; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i)
      sum += rows[k][i] * (attributes[i] - mean[i]);
    place[k] = static_cast<float>(sum);
  }
  return place;
}

Projection
principalAxes(const AttributeTable& table, unsigned threads)
{
  const Moments all = joined(
      momentsPerCluster(table, std::vector<std::int32_t>(table.rows(), 0), threads));
  return makeProjection(table, all.mean, completeAxes(MatrixXd(), all.covariance()));
}

Projection
starCoordinates(const AttributeTable& table,
                const std::vector<std::int32_t>& labels,
                const StarCoordinateParameters& parameters,
                unsigned threads,
                Report& report)
{
  checkParameters(parameters);
  std::vector<Moments> clusters;
  {
    StepTimer step(report, "moments");
    clusters = momentsPerCluster(table, labels, threads);
  }
  StepTimer step(report, "optimization");
  const Moments all = joined(clusters);
  clusters.erase(clusters.begin()); // noise
  if (clusters.size() < 2)
    report.warn("few_clusters", {{"clusters", clusters.size()}});
  if (clusters.size() < 2 || table.columns() <= 3)
    return principalAxes(table, threads);

  const Moments clustered = joined(clusters);
  const MatrixXd covariance = perUnitTrace(clustered.covariance());
  const ClusterSeparation separation(clusters, clustered, parameters.regularization);
  report.count("inseparable_pairs", separation.countInseparable());
  const MatrixXd axes =
      optimizedAxes(separation, covariance, all.covariance(), parameters, threads);
  const MatrixXd frame =
      perUnitTrace(separation.computeCentreCovariance()) + weight_of_rows * covariance;
  return makeProjection(table, all.mean, turned(axes, frame));
}

double
smallestFisherRatio(const AttributeTable& table,
                    const std::vector<std::int32_t>& labels,
                    const Projection& projection,
                    const StarCoordinateParameters& parameters,
                    unsigned threads)
{
  checkParameters(parameters);
  if (projection.names != table.names)
    throw InvalidArgument("projection_of_other_attributes", {});
  std::vector<Moments> clusters = momentsPerCluster(table, labels, threads);
  clusters.erase(clusters.begin());
  if (clusters.size() < 2)
    return std::numeric_limits<double>::infinity();
  const ClusterSeparation separation(
      clusters, joined(clusters), parameters.regularization);
  const auto m = static_cast<Index>(table.columns());
  MatrixXd functionals(m, 3);
  for (Index k = 0; k < 3; ++k)
    functionals.col(k) = Eigen::Map<const VectorXd>(
        projection.rows[static_cast<std::size_t>(k)].data(), m);
  return separation.smallestRatio(separation.toBasis(functionals));
}

ProjectedPoints
detail::projectPoints(const CloudView& cloud,
                      const pcl::Indices& indices,
                      const std::vector<int>& labels,
                      const StarCoordinateParameters& parameters,
                      unsigned threads,
                      Report& report)
{
  if (!labels.empty() && labels.size() != cloud.count)
    throw InvalidArgument("labels_of_other_points",
                          {{"labels", labels.size()}, {"points", cloud.count}});
  const std::vector<std::uint32_t> use(indices.begin(), indices.end());
  const AttributeTable table = readAttributes(
      cloud, use, parameters.attributes, parameters.is_standardized, threads, report);
  ProjectedPoints result;
  result.sources.assign(table.points.begin(), table.points.end());
  if (labels.empty())
    result.labels = clusterAttributes(table, {}, threads, report).labels;
  else
    for (const std::uint32_t point : table.points)
      result.labels.push_back(labels[point]);
  result.projection =
      parameters.method == ProjectionMethod::Star
          ? starCoordinates(table, result.labels, parameters, threads, report)
          : principalAxes(table, threads);
  for (std::size_t row = 0; row < table.rows(); ++row)
    result.places.push_back(result.projection.project(table.row(row)));
  result.smallest_ratio =
      smallestFisherRatio(table, result.labels, result.projection, parameters, threads);
  return result;
}

std::string
StarCoordinateParameters::toJson() const
{
  return writeJson(*this);
}

StarCoordinateParameters
StarCoordinateParameters::fromJson(const std::string& text)
{
  return readJson<StarCoordinateParameters>(text);
}

} // namespace pcl_uvol
