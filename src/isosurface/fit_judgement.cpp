// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/fit_judgement.h"

#include "neighbors/empty_cone.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl_uvol {

namespace {

/** Error over standard error, and over bias: together they cover 95 to 100 % of the
 * deviations of analytic fields, whose truncation errors have longer tails than noise,
 * and 90 to 97 % of noisy ones. Where fields grow tenfold in ten spacings standard
 * errors alone cover two thirds (tests/benchmarks). */
constexpr double error_factor = 3.5, bias_factor = 2.0;

/** A slope whose standard error is a larger part of it may be as much less steep as so
 * many of these parts beyond: noise that is as large as a spacing puts isopoints where
 * it makes fits steep. It leaves at least that part of the slope. */
constexpr double certain_slope = 0.05, slope_factor = 2.6, least_slope = 0.25;

/** Share of the radius of the support: farther from an edge no surface is expected. */
constexpr double most_reach = 1.2;

/** Share of the range of values among the fitted samples: a larger residual is no noise
 * on a slope any more, but all there is. */
constexpr double largest_residual = 0.15;

/** A step (a label, a jump, a clipped value), which no polynomial follows, shows by a
 * residual above the first part of the range where the edge spans more than the second;
 * a smooth function has no such residual, and noise no such edges. */
constexpr double step_residual = 0.06, step_span = 0.6;

/** Share of the radius of the support: a shift, or an error, beyond it and beyond the
 * edge's own length leaves the surroundings of the edge. */
constexpr double farthest_shift = 0.5;

/** Share of the edge's length in the samples' own space: farther from an edge across
 * which values jump, as at the core of a planet, no fit in another metric may shift a
 * root, unless its standard error, in radii of the support, tells that nothing jumps
 * there. Smooth fields on rotated lattices have up to 0.005, jumps from 0.015 on
 * (tests/benchmarks).
 */
constexpr double farthest_from_jump = 0.5, smooth_error = 0.009;

/** Different whole numbers among the fitted samples that are labels. Quantised data on
 * a slope of 1.5 steps per spacing have more; of a flatter slope 40 samples tell
 * little. */
constexpr std::size_t most_labels = 4;

/** Share of the radius of the support: a nearest sample that far away lies on the
 * border of a gap. */
constexpr double empty_ball = 0.5;

/** In radians, 140 degrees: 20 random samples around a point in a plane leave no such
 * sector empty at 99.8 % of all places. */
constexpr double empty_sector = 2.44, full_turn = 6.283185307179586;

/** Share of the radius of the support: a longer edge reaches across a gap, or past the
 * samples around. Where a lattice meets one of twice its spacing, edges through
 * channels that cross no surface there have from 1.04 on. */
constexpr double bridging_edge = 1.0;

/** Share of the radius of the support, see findOtherSide(): values that jump have no
 * fit that tells where an edge crosses the surface. On such long edges between random
 * samples 95 % of the isopoints within 0.75 spacings of a jump have up to 0.33; in
 * lattices all that lie 1.5 spacings off it, or farther, have from 0.41 on. */
constexpr double other_side = 0.4;

/** How much farther away the nearest sample on the other side of the isovalue is than
 * the nearest one, in radii of the support; infinite if all are on one side. */
double
findOtherSide(const std::vector<FitSample>& samples, std::size_t lane)
{
  constexpr double all = 2.0; // samples that only fill a lane up lie beyond
  double sq_nearest[2] = {std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::infinity()};
  for (const FitSample& sample : samples) {
    const double x = sample.x[lane], y = sample.y[lane], z = sample.z[lane];
    const double sq_dist = x * x + y * y + z * z;
    double& sq_least = sq_nearest[sample.value[lane] >= 0.0f ? 1 : 0];
    if (sq_dist < all)
      sq_least = std::min(sq_least, sq_dist);
  }
  return std::abs(std::sqrt(sq_nearest[0]) - std::sqrt(sq_nearest[1]));
}

} // namespace

bool
areLabels(const std::vector<float>& values,
          const std::uint32_t* neighbors,
          std::size_t count)
{
  float seen[most_labels];
  std::size_t different = 0;
  bool are_whole = true;
  for (std::size_t j = 0; j < count; ++j) {
    const float value = values[neighbors[j]];
    if (std::find(seen, seen + different, value) != seen + different)
      continue;
    are_whole = are_whole && value == std::floor(value);
    if (different == most_labels || (different == 2 && !are_whole))
      return false;
    seen[different++] = value;
  }
  return true;
}

namespace {

/** \param is_open whether samples leave a wide angle empty */
IsoSupport
supportBy(bool is_open, const Surroundings& surroundings, double nearest)
{
  if (!is_open && nearest <= empty_ball * surroundings.radius)
    return IsoSupport::Measured;
  return surroundings.edge_length > bridging_edge * surroundings.radius
             ? IsoSupport::Bridged
             : IsoSupport::Rim;
}

} // namespace

IsoSupport
judgeSupport(const Surroundings& surroundings,
             double nearest,
             const NeighborDirections& directions)
{
  const bool is_open =
      EmptyCone().isEmpty(directions.x, directions.y, directions.z, directions.count);
  return supportBy(is_open, surroundings, nearest);
}

namespace {

/** Error of the place of a fit's zero level on its slope, in radii of the support. */
double
errorOfRoot(const FitResult& result, std::size_t lane)
{
  return std::hypot(error_factor * result.error[lane], bias_factor * result.bias[lane]);
}

/** The widest sector without a sample, in radians. */
double
findEmptySector(const Eigen::Matrix2Xd& places)
{
  std::vector<double> angles;
  for (Eigen::Index i = 0; i < places.cols(); ++i)
    angles.push_back(std::atan2(places(1, i), places(0, i)));
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + full_turn - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest;
}

} // namespace

IsoSupport
supportInPlane(const Surroundings& surroundings,
               const FitSample* samples,
               std::size_t count,
               std::size_t lane,
               const PlaneAxes& axes)
{
  Eigen::Matrix2Xd places(2, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i)
    places.col(static_cast<Eigen::Index>(i)) =
        axes.transpose() *
        Eigen::Vector3f(samples[i].x[lane], samples[i].y[lane], samples[i].z[lane])
            .cast<double>();
  return supportBy(findEmptySector(places) > empty_sector,
                   surroundings,
                   surroundings.radius * places.col(0).norm());
}

RootOutcome
judge(const FitResult& result, std::size_t lane, const Surroundings& surroundings)
{
  if (result.order[lane] == fit_failed)
    return RootOutcome::Singular;
  if (surroundings.has_steps)
    return RootOutcome::Step;
  const double residual = result.residual[lane] / surroundings.values.range();
  if (!(residual <= (surroundings.values.partOfEdge() > step_span ? step_residual
                                                                  : largest_residual)))
    return RootOutcome::Step;
  const double shift = std::hypot(
      result.offset[0][lane], result.offset[1][lane], result.offset[2][lane]);
  const double room =
      std::max(surroundings.edge_length, farthest_shift * surroundings.radius);
  // In this order an error that is no number is none that serves.
  if (!(surroundings.radius * std::max(errorOfRoot(result, lane), shift) <= room))
    return RootOutcome::Far;
  return result.order[lane] == fit_cubic ? RootOutcome::Cubic : RootOutcome::Quadratic;
}

double
errorOfFit(const FitResult& result, std::size_t lane)
{
  const double doubt = std::max(0.0, result.slope_error[lane] - certain_slope);
  return errorOfRoot(result, lane) / std::max(1.0 - slope_factor * doubt, least_slope);
}

bool
goesPastSamples(const FitResult& result,
                std::size_t lane,
                RootOutcome outcome,
                const Surroundings& surroundings,
                const std::vector<FitSample>& samples)
{
  if (outcome <= RootOutcome::Quadratic ||
      surroundings.edge_length <= bridging_edge * surroundings.radius)
    return false;
  const bool has_no_root =
      result.order[lane] == fit_failed && !std::isnan(result.value[lane]);
  return has_no_root || findOtherSide(samples, lane) > other_side;
}

bool
isFarFromJump(const FitResult& result,
              std::size_t lane,
              const Surroundings& surroundings,
              double edge_length)
{
  const double shift = std::hypot(
      result.offset[0][lane], result.offset[1][lane], result.offset[2][lane]);
  return surroundings.values.partOfEdge() > step_span &&
         surroundings.radius * shift > farthest_from_jump * edge_length &&
         !(result.error[lane] <= smooth_error);
}

void
leaveMetric(const Eigen::Matrix3d& metric, std::size_t lane, FitResult& result)
{
  constexpr int entry[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}; // of the Hessian
  Eigen::Vector3d offset, gradient;
  Eigen::Matrix3d hessian;
  for (int i = 0; i < 3; ++i) {
    offset[i] = result.offset[i][lane];
    gradient[i] = result.gradient[i][lane];
    for (int j = 0; j < 3; ++j)
      hessian(i, j) = result.hessian[entry[i][j]][lane];
  }
  const double slope = gradient.norm();
  offset = metric.inverse() * offset;
  gradient = metric.transpose() * gradient;
  hessian = metric.transpose() * hessian * metric;
  for (int i = 0; i < 3; ++i) {
    result.offset[i][lane] = offset[i];
    result.gradient[i][lane] = gradient[i];
    for (int j = 0; j < 3; ++j)
      result.hessian[entry[i][j]][lane] = hessian(i, j);
  }
  for (double* const length : {result.error, result.bias})
    length[lane] *= slope / gradient.norm();
}

namespace {

/** The surface crosses the edge somewhere. */
float
errorOnEdge(const IsoEdge& edge, const PointIso& point)
{
  return std::max(edge.t, 1.0f - edge.t) * point.edge_length;
}

/** How far from its edge a fit that does not serve would have an isopoint, at most, in
 * radii of the support: where values scatter, the surface may lie beyond the edge.
 * Across a step it does not, and samples that determine no fit do not tell. */
double
reachOfFit(const FitResult& result, std::size_t lane, const Surroundings& surroundings)
{
  if (surroundings.has_steps || surroundings.values.partOfEdge() > step_span ||
      std::isnan(result.value[lane]))
    return 0.0;
  if (result.order[lane] == fit_failed)
    return most_reach;
  return std::min(most_reach,
                  std::hypot(result.offset[0][lane],
                             result.offset[1][lane],
                             result.offset[2][lane]) +
                      errorOfFit(result, lane));
}

} // namespace

double
computeRounding(const PointIso& point)
{
  return std::sqrt(3.0) * 0x1p-24 *
         std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
}

void
keepInGap(const IsoEdge& edge, PointIso& point)
{
  point.support = static_cast<std::uint8_t>(IsoSupport::Bridged);
  point.error = errorOnEdge(edge, point);
}

void
raiseErrorToEdge(const IsoEdge& edge, PointIso& point)
{
  point.error = std::max(point.error, errorOnEdge(edge, point));
}

void
setIsopoint(const IsopointInput& input,
            const FitResult& result,
            std::size_t lane,
            const Surroundings& surroundings,
            bool is_smooth,
            const IsoEdge& edge,
            PointIso& point)
{
  point.support = static_cast<std::uint8_t>(surroundings.support);
  if (!is_smooth) {
    const double per_radius =
        surroundings.radius * point.edge_length / surroundings.edge_length;
    point.error = std::max(
        errorOnEdge(edge, point),
        static_cast<float>(per_radius * reachOfFit(result, lane, surroundings)));
    return;
  }
  // Derivatives by original coordinates: the fit was made in the stretched space.
  const Position& scale = input.samples.getScale();
  double stretch[3], gradient[3], sq_slope = 0.0, sq_fit_slope = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    point.data[axis] = static_cast<float>(
        (surroundings.center[axis] + surroundings.radius * result.offset[axis][lane]) /
        scale[axis]);
    stretch[axis] = scale[axis] / surroundings.radius;
    gradient[axis] = stretch[axis] * result.gradient[axis][lane];
    sq_slope += gradient[axis] * gradient[axis];
    sq_fit_slope += result.gradient[axis][lane] * result.gradient[axis][lane];
  }
  const double slope = std::sqrt(sq_slope);
  const double side = input.outside == Outside::Lower ? -1.0 : 1.0;
  constexpr int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
  double trace = 0.0, along = 0.0; // of the Hessian, and along the gradient
  for (std::size_t i = 0; i < 6; ++i) {
    const double entry = stretch[row[i]] * stretch[column[i]] * result.hessian[i][lane];
    if (row[i] == column[i])
      trace += entry;
    along += (row[i] == column[i] ? 1.0 : 2.0) * entry * gradient[row[i]] *
             gradient[column[i]] / sq_slope;
  }
  for (int axis = 0; axis < 3; ++axis)
    point.data_n[axis] = static_cast<float>(side * gradient[axis] / slope);
  point.mean_curvature = static_cast<float>(side * (trace - along) / (2.0 * slope));
  const double error = errorOfFit(result, lane) * std::sqrt(sq_fit_slope) / slope;
  point.error = static_cast<float>(std::hypot(error, computeRounding(point)));
}

} // namespace pcl_uvol
