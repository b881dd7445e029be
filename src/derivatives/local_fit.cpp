// SPDX-License-Identifier: BSD-3-Clause
#include "derivatives/local_fit.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

constexpr std::size_t terms = derivativesOf(FitScheme::Quadratic);

/** Exponent of the weight at the farthest neighbour but one part in 21: measured best
 * for gradients and curvatures of random samples. */
constexpr double weight_exponent = 2.0, weight_radius = 1.05;

/** In parts of a term's own diagonal entry: a smaller pivot is rounding, and the term
 * cannot be told from those before it. */
constexpr double smallest_pivot = 1e-7;

/** In parts of the largest eigenvalue: neighbours extend less than a ten thousandth as
 * far across as along; for smoothing less than a fifth. */
constexpr double smallest_eigenvalue = 1e-8, smoothing_eigenvalue = 0.04;

/** Terms of a quadratic about the sample: x y z, xx xy xz yy yz zz, halved where the
 * second derivative is twice the factor. */
void
setTerms(const double* u, double* term)
{
  term[0] = u[0];
  term[1] = u[1];
  term[2] = u[2];
  term[3] = 0.5 * u[0] * u[0];
  term[4] = u[0] * u[1];
  term[5] = u[0] * u[2];
  term[6] = 0.5 * u[1] * u[1];
  term[7] = u[1] * u[2];
  term[8] = 0.5 * u[2] * u[2];
}

} // namespace

FitOutcome
LocalFit::fit(const std::vector<Position>& positions,
              std::uint32_t sample,
              const std::uint32_t* neighbors,
              std::size_t count)
{
  count_ = count;
  offsets_.resize(3 * count);
  weights_.assign(derivativesOf(scheme_) * count, 0.0);
  double sq_reach = 0.0;
  for (std::size_t j = 0; j < count; ++j) {
    double sq_dist = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double offset = static_cast<double>(positions[neighbors[j]][axis]) -
                            static_cast<double>(positions[sample][axis]);
      offsets_[3 * j + static_cast<std::size_t>(axis)] = offset;
      sq_dist += offset * offset;
    }
    sq_reach = std::max(sq_reach, sq_dist);
  }
  reach_ = std::sqrt(sq_reach);
  if (count == 0)
    return FitOutcome::Singular;
  for (double& offset : offsets_)
    offset /= reach_;
  if (scheme_ == FitScheme::Quadratic && count >= terms && fitQuadratic())
    return FitOutcome::Full;
  if (!fitPlane(smallest_eigenvalue))
    return FitOutcome::Singular;
  return scheme_ == FitScheme::Linear ? FitOutcome::Full : FitOutcome::Reduced;
}

bool
LocalFit::fitQuadratic()
{
  // Normal equations. The weights begin as what they are solved for, a row per term.
  double factor[terms][terms] = {};
  for (std::size_t j = 0; j < count_; ++j) {
    const double* const u = &offsets_[3 * j];
    const double sq_dist = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    const double weight =
        std::exp(-weight_exponent * sq_dist / (weight_radius * weight_radius));
    double term[terms];
    setTerms(u, term);
    for (std::size_t i = 0; i < terms; ++i) {
      const double weighted = weight * term[i];
      weights_[i * count_ + j] = weighted;
      for (std::size_t l = 0; l <= i; ++l)
        factor[i][l] += weighted * term[l];
    }
  }
  // Cholesky, in place.
  for (std::size_t i = 0; i < terms; ++i) {
    for (std::size_t l = 0; l < i; ++l) {
      for (std::size_t m = 0; m < l; ++m)
        factor[i][l] -= factor[i][m] * factor[l][m];
      factor[i][l] /= factor[l][l];
    }
    const double diagonal = factor[i][i];
    for (std::size_t m = 0; m < i; ++m)
      factor[i][i] -= factor[i][m] * factor[i][m];
    if (!(factor[i][i] > smallest_pivot * diagonal)) {
      std::fill(weights_.begin(), weights_.end(), 0.0);
      return false;
    }
    factor[i][i] = std::sqrt(factor[i][i]);
  }
  // All neighbours side by side.
  const auto row = [&](std::size_t i) {
    return Eigen::Map<Eigen::ArrayXd>(&weights_[i * count_],
                                      static_cast<Eigen::Index>(count_));
  };
  for (std::size_t i = 0; i < terms; ++i) {
    for (std::size_t l = 0; l < i; ++l)
      row(i) -= factor[i][l] * row(l);
    row(i) *= 1.0 / factor[i][i];
  }
  for (std::size_t i = terms; i-- > 0;) {
    for (std::size_t l = i + 1; l < terms; ++l)
      row(i) -= factor[l][i] * row(l);
    row(i) *= 1.0 / factor[i][i];
  }
  for (std::size_t i = 0; i < terms; ++i)
    row(i) *= 1.0 / (i < 3 ? reach_ : reach_ * reach_);
  return true;
}

bool
LocalFit::fitInPlane()
{
  constexpr int plane_terms = 5; // u v, uu uv vv
  const auto count = static_cast<Eigen::Index>(count_);
  if (scheme_ != FitScheme::Quadratic || count < plane_terms)
    return false;
  const Eigen::Map<const Eigen::Matrix3Xd> offsets(offsets_.data(), 3, count);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(offsets *
                                                             offsets.transpose());
  if (eigen.eigenvalues()[0] > smallest_eigenvalue * eigen.eigenvalues()[2])
    return false;
  Eigen::Matrix<double, 3, 2> axes;
  axes << eigen.eigenvectors().col(2), eigen.eigenvectors().col(1);
  const Eigen::Matrix2Xd in_plane = axes.transpose() * offsets;
  Eigen::Matrix<double, plane_terms, Eigen::Dynamic> terms_of(plane_terms, count);
  terms_of.topRows(2) = in_plane;
  terms_of.row(2) = 0.5 * in_plane.row(0).cwiseAbs2();
  terms_of.row(3) = in_plane.row(0).cwiseProduct(in_plane.row(1));
  terms_of.row(4) = 0.5 * in_plane.row(1).cwiseAbs2();
  const Eigen::RowVectorXd weights =
      (-weight_exponent / (weight_radius * weight_radius) *
       offsets.colwise().squaredNorm().array())
          .exp();
  const auto weighted = (terms_of * weights.asDiagonal()).eval();
  const Eigen::Matrix<double, plane_terms, plane_terms> normal =
      weighted * terms_of.transpose();
  const Eigen::LDLT<Eigen::Matrix<double, plane_terms, plane_terms>> factors(normal);
  if (!(factors.vectorD().minCoeff() > smallest_pivot * factors.vectorD().maxCoeff()))
    return false;
  const auto rows = factors.solve(weighted).eval();
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<Rows> all(weights_.data(), terms, count);
  all.topRows(3) = axes * rows.topRows(2) / reach_;
  Eigen::Index row = 3;
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k, ++row)
      all.row(row) =
          (axes(i, 0) * axes(k, 0) * rows.row(2) +
           (axes(i, 0) * axes(k, 1) + axes(i, 1) * axes(k, 0)) * rows.row(3) +
           axes(i, 1) * axes(k, 1) * rows.row(4)) /
          (reach_ * reach_);
  return true;
}

bool
LocalFit::fitPlane(double least_eigenvalue)
{
  // About the mean of the neighbours and the sample itself, which takes care of the
  // constant term.
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t j = 0; j < count_; ++j)
    mean += Eigen::Map<const Eigen::Vector3d>(&offsets_[3 * j]);
  mean /= static_cast<double>(count_ + 1);
  Eigen::Matrix3d scatter = mean * mean.transpose();
  for (std::size_t j = 0; j < count_; ++j) {
    const Eigen::Vector3d u =
        Eigen::Map<const Eigen::Vector3d>(&offsets_[3 * j]) - mean;
    scatter += u * u.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
  const Eigen::Vector3d& values = eigen.eigenvalues();
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  bool is_regular = true;
  for (int i = 0; i < 3; ++i) {
    if (!(values[i] > least_eigenvalue * values[2])) {
      is_regular = false;
      continue;
    }
    const Eigen::Vector3d axis = eigen.eigenvectors().col(i);
    inverse += axis * axis.transpose() / values[i];
  }
  for (std::size_t j = 0; j < count_; ++j) {
    const Eigen::Vector3d u =
        Eigen::Map<const Eigen::Vector3d>(&offsets_[3 * j]) - mean;
    const Eigen::Vector3d weights = inverse * u / reach_;
    for (int axis = 0; axis < 3; ++axis)
      weights_[static_cast<std::size_t>(axis) * count_ + j] = weights[axis];
  }
  return is_regular;
}

void
LocalFit::makeIsotropic()
{
  // A share of the squared deviations from the plane: less would be no curvature.
  constexpr double least_curvature = 0.05;
  std::fill(weights_.begin(), weights_.end(), 0.0);
  fitPlane(smoothing_eigenvalue);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t j = 0; j < count_; ++j)
    sum += Eigen::Map<const Eigen::Vector3d>(&offsets_[3 * j]);
  // The sum of the deviations from the plane through the sample, and what it is for
  // half the squared distance.
  std::vector<double> deviation(count_, 1.0);
  double curvature = 0.0, squares = 0.0;
  for (std::size_t j = 0; j < count_; ++j) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      deviation[j] -=
          reach_ * sum[static_cast<Eigen::Index>(axis)] * weights_[axis * count_ + j];
    const double sq_dist =
        Eigen::Map<const Eigen::Vector3d>(&offsets_[3 * j]).squaredNorm();
    curvature += 0.5 * sq_dist * deviation[j];
    squares += 0.5 * sq_dist;
  }
  if (!(curvature > least_curvature * squares))
    return;
  // Distances have no second derivative along the normal: two axes share it all.
  constexpr double along_normal = 1.5;
  constexpr std::size_t xx = 3, yy = 6, zz = 8;
  for (std::size_t j = 0; j < count_; ++j)
    for (const std::size_t row : {xx, yy, zz})
      weights_[row * count_ + j] =
          along_normal * deviation[j] / (curvature * reach_ * reach_);
}

} // namespace pcl_uvol
