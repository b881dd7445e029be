// SPDX-License-Identifier: BSD-3-Clause
#include "derivatives/fit_kernel.h"

#include "derivatives/polynomial_lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

constexpr int newton_steps = 6;

/** Newton's last step in radii: far below what coordinates in float resolve. */
constexpr double converged_step = 1e-7;

/** The fourth power of the distance from the centre, what the terms of fourth degree
 * have alike in all directions, as one more term of the fits. */
class QuarticTerm {
public:
  explicit QuarticTerm(const NormalEquations& equations)
      : square_(equations.fourth_square)
      , right_(equations.fourth_right)
  {
    for (int i = 0; i < cubic_terms; ++i)
      reduced_[i] =
          i < quadratic_terms ? sumMoments(equations, i) : equations.fourth_power[i];
    equations.forward(reduced_);
  }

  /** How much the term, as large as it is in the fit with it, adds to the value where
   * the others and it have the given values; zero where the samples do not tell it
   * from the others.
   * \param is_cubic the others are those of a quadratic elsewhere
   * \param values,others after the forward solution */
  Lanes
  computeBias(const Mask& is_cubic,
              const Lanes* values,
              const Lanes* others,
              const Lanes& fourth_power) const
  {
    const Lanes pivot = leaveRest(square_, reduced_, is_cubic);
    const Lanes bias = leaveRest(right_, values, is_cubic) / pivot *
                       leaveRest(fourth_power, others, is_cubic);
    return pivot > smallest_pivot * square_ ? bias : Lanes{};
  }

private:
  /** The weighted sum of the products of the fourth power and a term of the quadratic:
   * those of the cubic are of seventh degree, which no moment is. */
  static Lanes
  sumMoments(const NormalEquations& equations, int term)
  {
    Lanes sum{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int* const of = monomials.power[term];
        int power[3] = {of[0], of[1], of[2]};
        power[i] += 2;
        power[j] += 2;
        sum += equations.moment[monomials.index[power[0]][power[1]][power[2]]];
      }
    return sum;
  }

  /** What the other terms leave of a product with the fourth power. */
  Lanes
  leaveRest(const Lanes& product, const Lanes* reduced, const Mask& is_cubic) const
  {
    const auto sumOf = [&](int begin, int end) {
      Lanes sum{};
      for (int i = begin; i < end; ++i)
        sum += reduced_[i] * reduced[i];
      return sum;
    };
    return product - sumOf(0, quadratic_terms) -
           (is_cubic ? sumOf(quadratic_terms, cubic_terms) : Lanes{});
  }

  Lanes reduced_[cubic_terms]; // its products with the terms
  Lanes square_, right_;       // its products with itself and with the values
};

/** The fits of one register, from the given lane on. */
void
fitRegister(const FitSample* samples,
            std::size_t count,
            const int* weighted,
            std::size_t first,
            FitResult& result)
{
  const Lanes zero{}, one = zero + 1.0;
  NormalEquations equations;
  equations.accumulate(samples, count, first);
  equations.factorize();

  Lanes reduced[cubic_terms];
  for (int i = 0; i < cubic_terms; ++i)
    reduced[i] = equations.right[i];
  equations.forward(reduced);
  Lanes coefficient[cubic_terms], quadratic[cubic_terms]{};
  equations.backward(reduced, cubic_terms, coefficient);
  equations.backward(reduced, quadratic_terms, quadratic);

  // Squared residuals are what the terms leave of the squares. The difference is good
  // to 1e-7 of the values' range, where single precision of the values ends.
  const Lanes quadratic_residuals =
      atLeastZero(equations.squares - sumSquares(reduced, 0, quadratic_terms));
  const Lanes cubic_residuals = atLeastZero(
      quadratic_residuals - sumSquares(reduced, quadratic_terms, cubic_terms));
  Lanes neighbors;
  for (std::size_t lane = 0; lane < register_lanes; ++lane)
    neighbors[lane] = weighted[first + lane];
  const Lanes cubic_variance = cubic_residuals / (neighbors - cubic_terms);
  const Lanes quadratic_variance = quadratic_residuals / (neighbors - quadratic_terms);

  // Leverage at the centre, where the value is the constant term.
  Lanes influence[cubic_terms]{};
  influence[0] = one;
  equations.forward(influence);
  const Lanes quadratic_leverage = sumSquares(influence, 0, quadratic_terms);
  const Lanes cubic_leverage =
      quadratic_leverage + sumSquares(influence, quadratic_terms, cubic_terms);
  const Mask quadratic_possible =
      equations.quadratic_regular & (neighbors >= quadratic_terms + least_freedom);
  const Mask cubic_possible =
      equations.cubic_regular & (neighbors >= cubic_terms + least_freedom);
  const Mask is_cubic =
      cubic_possible &
      (~quadratic_possible |
       (cubic_leverage * cubic_variance <= quadratic_leverage * quadratic_variance));
  for (int i = 0; i < cubic_terms; ++i)
    coefficient[i] = is_cubic ? coefficient[i] : quadratic[i];

  const Mask determined = is_cubic | quadratic_possible;
  Lanes x = zero, y = zero, z = zero, gradient[3];
  for (int step = 0; step < newton_steps; ++step) {
    evaluateGradient(coefficient, x, y, z, gradient);
    const Lanes factor = evaluate(coefficient, x, y, z) / sumSquares(gradient, 0, 3);
    x -= factor * gradient[0];
    y -= factor * gradient[1];
    z -= factor * gradient[2];
  }
  Lanes hessian[6];
  evaluateGradient(coefficient, x, y, z, gradient);
  evaluateHessian(coefficient, x, y, z, hessian);
  const Lanes slope = squareRoot(sumSquares(gradient, 0, 3));
  const Lanes rest = evaluate(coefficient, x, y, z) / slope;
  const Mask found = (rest < converged_step) & (rest > -converged_step) &
                     (x * x + y * y + z * z < one) & determined;

  // Leverage at the zero level, of the value and of its derivative across.
  const Lanes direction[3] = {
      gradient[0] / slope, gradient[1] / slope, gradient[2] / slope};
  Lanes slope_influence[cubic_terms];
  evaluateTerms(x, y, z, influence);
  differentiateTerms(influence, x, y, z, direction, slope_influence);
  equations.forward(influence);
  equations.forward(slope_influence);
  const auto leverageOf = [&](const Lanes* of) {
    return sumSquares(of, 0, quadratic_terms) +
           (is_cubic ? sumSquares(of, quadratic_terms, cubic_terms) : zero);
  };
  const Lanes variance = is_cubic ? cubic_variance : quadratic_variance;

  const Lanes square = x * x + y * y + z * z;
  const Lanes bias = QuarticTerm(equations).computeBias(
                         is_cubic, reduced, influence, square * square) /
                     slope;
  store(determined ? coefficient[0] : zero / zero, result.value + first);
  store(squareRoot(is_cubic ? cubic_leverage * cubic_variance
                            : quadratic_leverage * quadratic_variance),
        result.value_error + first);
  store(x, result.offset[0] + first);
  store(y, result.offset[1] + first);
  store(z, result.offset[2] + first);
  for (int axis = 0; axis < 3; ++axis)
    store(gradient[axis], result.gradient[axis] + first);
  for (int i = 0; i < 6; ++i)
    store(hessian[i], result.hessian[i] + first);
  store(equations.least_pivot, result.pivot + first);
  store(squareRoot(leverageOf(influence) * variance) / slope, result.error + first);
  store(bias < zero ? -bias : bias, result.bias + first);
  store(squareRoot(leverageOf(slope_influence) * variance) / slope,
        result.slope_error + first);
  store(squareRoot((is_cubic ? cubic_residuals : quadratic_residuals) /
                   equations.moment[0]),
        result.residual + first);
  for (std::size_t lane = 0; lane < register_lanes; ++lane)
    result.order[first + lane] = !found[lane]     ? fit_failed
                                 : is_cubic[lane] ? fit_cubic
                                                  : fit_quadratic;
}

} // namespace

void
fitZeroLevel(const FitSample* samples,
             std::size_t count,
             const int* weighted,
             FitResult& result)
{
  for (std::size_t first = 0; first < fit_lanes; first += register_lanes)
    fitRegister(samples, count, weighted, first, result);
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
