// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/gap_test.h"

#include "common/eigen_solvers.h"
#include "common/parallel.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pcl_uvol::detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

/** Samples that take part, and those that are asked for. */
constexpr std::size_t most_samples = 4096, most_asked = 400;

constexpr std::size_t block_asked = 16;

/** Nearest samples that lie all around, if not on a line or a sheet. */
constexpr std::size_t first_around = 8;

/** Samples around another whose smallest moment is below that part of the largest one
 * lie on a line or a sheet. */
constexpr double least_moment = 0.05;

/** Nearest samples that an error is kriged from, and the fewest of them. */
constexpr std::size_t kriged_samples = 16, least_kriged = 4;

/** These carry no trend where their smallest extent is below that part of the largest
 * one. */
constexpr double least_extent = 0.2;

using Near = std::pair<double, std::size_t>; ///< squared distance, sample

/** The first so many come to the front, in their order. */
void
selectNearest(std::vector<Near>& near, std::size_t count)
{
  const auto end = near.begin() + static_cast<std::ptrdiff_t>(count);
  if (count < near.size())
    std::nth_element(near.begin(), end, near.end());
  std::sort(near.begin(), end);
}

bool
carriesTrend(const MatrixXd& offsets)
{
  const MatrixXd centered = offsets.rowwise() - offsets.colwise().mean();
  const Eigen::Matrix3d moments = centered.transpose() * centered;
  const Vector3d squared =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return squared[0] >= least_extent * least_extent * squared[2];
}

/** Weights of samples for the value at the origin: kriging with the variogram h.
 * \param offsets one row per sample, the largest of them near 1 */
Eigen::VectorXd
krigingWeights(const MatrixXd& offsets)
{
  const Index count = offsets.rows();
  const Index terms = count > 4 && carriesTrend(offsets) ? 4 : 1;
  MatrixXd system = MatrixXd::Zero(count + terms, count + terms);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count + terms);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < i; ++j)
      system(i, j) = system(j, i) = (offsets.row(i) - offsets.row(j)).norm();
    right[i] = offsets.row(i).norm();
    system(i, count) = system(count, i) = 1.0;
    for (Index term = 1; term < terms; ++term)
      system(i, count + term) = system(count + term, i) = offsets(i, term - 1);
  }
  right[count] = 1.0;
  return system.colPivHouseholderQr().solve(right).head(count);
}

} // namespace

GapTest::GapTest(const SampleSet& samples,
                 const std::vector<double>& values,
                 int dimensions,
                 unsigned threads)
{
  const std::size_t step = (samples.size() + most_samples - 1) / most_samples;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    const Position& position = samples.getPositions()[i];
    places_.emplace_back(position[0], position[1], position[2]);
    values_.push_back(values[i]);
  }
  const std::size_t every = (places_.size() + most_asked - 1) / most_asked;
  for (std::size_t i = 0; i < places_.size(); i += every)
    asked_.push_back({i, 0.0});
  parallelBlocks(asked_.size(), block_asked, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double width = findWidth(asked_[i].sample, dimensions);
      asked_[i].sq_width = width * width;
    }
  });
}

double
GapTest::findWidth(std::size_t sample, int dimensions) const
{
  std::vector<Near> near;
  for (std::size_t i = 0; i < places_.size(); ++i)
    near.emplace_back((places_[i] - places_[sample]).squaredNorm(), i);
  for (std::size_t count = first_around;; count *= 2) {
    count = std::min(count, near.size());
    selectNearest(near, count);
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d offset = places_[near[i].second] - places_[sample];
      moments += offset * offset.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments,
                                                                Eigen::EigenvaluesOnly);
    const Vector3d& values = solver.eigenvalues(); // ascending
    const bool is_around = values[3 - dimensions] >= least_moment * values[2];
    if (!is_around && 4 * count < near.size())
      continue;
    return count == first_around ? 0.0 : std::sqrt(near[count - 1].first) / 2.0;
  }
}

double
GapTest::computeError(const Asked& asked, const Eigen::Array3d& factors) const
{
  const Vector3d& place = places_[asked.sample];
  std::vector<Near> near;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Vector3d offset = places_[i] - place;
    if (i != asked.sample && offset.squaredNorm() > asked.sq_width)
      near.emplace_back((factors * offset.array()).matrix().squaredNorm(), i);
  }
  const std::size_t count = std::min(near.size(), kriged_samples);
  if (count < least_kriged)
    return 0.0;
  selectNearest(near, count);
  MatrixXd offsets(static_cast<Index>(count), 3);
  for (std::size_t i = 0; i < count; ++i)
    offsets.row(static_cast<Index>(i)) =
        (factors * (places_[near[i].second] - place).array()).matrix().transpose();
  const double largest = offsets.cwiseAbs().maxCoeff();
  const Eigen::VectorXd weights = krigingWeights(offsets / largest);
  double error = -values_[asked.sample];
  for (std::size_t i = 0; i < count; ++i)
    error += weights[static_cast<Index>(i)] * values_[near[i].second];
  return std::sqrt(std::abs(error));
}

std::vector<double>
GapTest::computeErrors(const Eigen::Array3d& factors, unsigned threads) const
{
  std::vector<double> errors(asked_.size());
  parallelBlocks(asked_.size(), block_asked, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      errors[i] = computeError(asked_[i], factors);
  });
  return errors;
}

} // namespace pcl_uvol::detail
