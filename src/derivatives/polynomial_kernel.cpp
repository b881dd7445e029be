// SPDX-License-Identifier: BSD-3-Clause
#include "derivatives/polynomial_kernel.h"

#include "derivatives/polynomial_lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

static_assert(polynomial_terms == cubic_terms, "the terms of a cubic");

/** Share of the range of the values with a weight: a larger residual is no noise on a
 * slope any more, but all there is. */
constexpr double largest_residual = 0.15;

/** Polynomials of one field. */
class FieldFit {
public:
  FieldFit(const NormalEquations& equations,
           const PolynomialSample* samples,
           std::size_t count,
           const int* weighted,
           std::size_t first)
      : equations_(equations)
      , samples_(samples)
      , count_(count)
      , first_(first)
  {
    for (std::size_t lane = 0; lane < register_lanes; ++lane)
      neighbors_[lane] = weighted[first + lane];
    Lanes influence[cubic_terms]{};
    influence[0] = Lanes{} + 1.0;
    equations.forward(influence);
    leverage_[1] = sumSquares(influence, 0, linear_terms);
    leverage_[2] = leverage_[1] + sumSquares(influence, linear_terms, quadratic_terms);
    leverage_[3] = leverage_[2] + sumSquares(influence, quadratic_terms, cubic_terms);
    possible_[1] =
        equations.linear_regular & (neighbors_ >= linear_terms + least_freedom);
    possible_[2] =
        equations.quadratic_regular & (neighbors_ >= quadratic_terms + least_freedom);
    possible_[3] =
        equations.cubic_regular & (neighbors_ >= cubic_terms + least_freedom);
  }

  /** \param values of the field, that of the first lane's first neighbour first */
  void
  fit(const double* values, PolynomialFit& fit)
  {
    const Lanes zero{};
    values_ = values;
    for (int i = 0; i < cubic_terms; ++i)
      coefficient_[i] = zero;
    Lanes reduced[cubic_terms], correction[cubic_terms];
    reduce(reduced);
    // What terms leave of the squares is good enough to choose by.
    const Lanes quadratic =
        atLeastZero(squares_ - sumSquares(reduced, 0, quadratic_terms));
    const Lanes cubic =
        atLeastZero(quadratic - sumSquares(reduced, quadratic_terms, cubic_terms));
    choose(quadratic, cubic);
    addSolution(reduced);
    reduce(correction);
    addSolution(correction);
    const Lanes residuals =
        atLeastZero(squares_ - sumSquares(correction, 0, cubic_terms));
    finish(residuals, fit);
  }

private:
  /** The right sides for what the coefficients leave of the values, solved with the
   * lower triangle; and the squares of what they leave. */
  void
  reduce(Lanes* reduced)
  {
    const Lanes zero{};
    squares_ = zero;
    lowest_ = zero;
    highest_ = zero;
    for (int i = 0; i < cubic_terms; ++i)
      reduced[i] = zero;
    for (std::size_t j = 0; j < count_; ++j) {
      const Term sample(samples_[j], first_);
      Lanes term[cubic_terms];
      evaluateTerms(sample.x, sample.y, sample.z, term);
      const Lanes value = load(values_ + j * polynomial_lanes + first_);
      Lanes rest = value;
#pragma GCC unroll 20
      for (int i = 0; i < cubic_terms; ++i)
        rest -= coefficient_[i] * term[i];
      const Lanes weighted = sample.weight * rest;
      squares_ += weighted * rest;
      const Lanes counted = sample.weight > zero ? value : zero;
      lowest_ = counted < lowest_ ? counted : lowest_;
      highest_ = counted > highest_ ? counted : highest_;
#pragma GCC unroll 20
      for (int i = 0; i < cubic_terms; ++i)
        reduced[i] += weighted * term[i];
    }
    equations_.forward(reduced);
  }

  void
  choose(const Lanes& quadratic, const Lanes& cubic)
  {
    const Lanes one = Lanes{} + 1.0;
    const Lanes quadratic_variance =
        leverage_[2] * quadratic / (neighbors_ - quadratic_terms);
    const Lanes cubic_variance = leverage_[3] * cubic / (neighbors_ - cubic_terms);
    const Mask is_cubic =
        possible_[3] & (~possible_[2] | (cubic_variance <= quadratic_variance));
    const Mask is_higher = is_cubic | possible_[2];
    const Lanes range = highest_ - lowest_;
    const Lanes left = is_cubic ? cubic : quadratic;
    const Mask is_step = left > largest_residual * largest_residual * range * range *
                                    equations_.moment[0];
    degree_ = is_higher & ~(is_step & possible_[1]) ? (is_cubic ? 3.0 * one : 2.0 * one)
                                                    : (possible_[1] ? one : Lanes{});
  }

  /** Add what a solution with the lower triangle leads to, of the terms that the degree
   * has. */
  void
  addSolution(Lanes* reduced)
  {
    const Lanes zero{};
    for (int i = linear_terms; i < cubic_terms; ++i)
      reduced[i] = degree_ >= (i < quadratic_terms ? 2.0 : 3.0) ? reduced[i] : zero;
    Lanes solution[cubic_terms];
    equations_.backward(reduced, cubic_terms, solution);
    for (int i = 0; i < cubic_terms; ++i)
      coefficient_[i] += solution[i];
  }

  void
  finish(const Lanes& residuals, PolynomialFit& fit) const
  {
    const Mask is_cubic = degree_ == 3.0, is_quadratic = degree_ == 2.0;
    const Lanes terms = is_cubic       ? Lanes{} + cubic_terms
                        : is_quadratic ? Lanes{} + quadratic_terms
                                       : Lanes{} + linear_terms;
    const Lanes leverage = is_cubic       ? leverage_[3]
                           : is_quadratic ? leverage_[2]
                                          : leverage_[1];
    const Lanes variance = leverage * residuals / (neighbors_ - terms);
    for (int i = 0; i < cubic_terms; ++i)
      store(coefficient_[i], fit.coefficient[i] + first_);
    store(squareRoot(variance), fit.error + first_);
    store(equations_.least_pivot, fit.pivot + first_);
    for (std::size_t lane = 0; lane < register_lanes; ++lane)
      fit.degree[first_ + lane] = static_cast<int>(degree_[lane]);
  }

  const NormalEquations& equations_;
  const PolynomialSample* samples_;
  std::size_t count_, first_;
  const double* values_ = nullptr;
  Lanes neighbors_, leverage_[degree + 1], degree_{};
  Mask possible_[degree + 1];
  Lanes coefficient_[cubic_terms], squares_, lowest_, highest_;
};

} // namespace

void
fitPolynomials(const PolynomialSample* samples,
               std::size_t count,
               const int* weighted,
               const double* values,
               std::size_t fields,
               PolynomialFit* fits)
{
  for (std::size_t first = 0; first < polynomial_lanes; first += register_lanes) {
    NormalEquations equations;
    equations.accumulate(samples, count, first);
    equations.factorize();
    FieldFit field(equations, samples, count, weighted, first);
    for (std::size_t f = 0; f < fields; ++f)
      field.fit(values + f * count * polynomial_lanes, fits[f]);
  }
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
