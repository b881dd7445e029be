// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/smooth_roots.h"

#include "common/dispatch.h"
#include "common/parallel.h"
#include "isosurface/fit_judgement.h"
#include "isosurface/left_out_lines.h"
#include "isosurface/logarithmic_fits.h"
#include "isosurface/planar_roots.h"
#include "neighbors/empty_cone_kernel.h"
#include "neighbors/local_metric.h"
#include "neighbors/nearest_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr std::size_t root_block = 256;

/** Samples with a weight in a fit; the next farther one sets the radius of the support.
 * Twice the 20 terms of a cubic: fewer follow noise, more flatten details. */
constexpr std::size_t fitted_samples = 40;

/** Least pivot of a fit that needs no other metric: of uniform random samples one fit
 * in a thousand has less, of layers all have. */
constexpr double good_pivot = 0.02;

/** A fit of less is worth nothing, and a little stretching matters: curved lattices. */
constexpr double singular_pivot = 1e-3, little_stretching = 1.1;

/** Spacings that differ by less may be those of random samples: they are no reason to
 * doubt a good fit, or that a gap is one. */
constexpr double certain_stretching = 2.0;

const KernelTable<FitKernel> fit_kernels{
    baseline::fitZeroLevel, avx2::fitZeroLevel, avx512::fitZeroLevel};

double
distance(const Position& a, const Position& b)
{
  return std::hypot(static_cast<double>(a[0]) - b[0],
                    static_cast<double>(a[1]) - b[1],
                    static_cast<double>(a[2]) - b[2]);
}

/** A fit that a stretched sampling may have spoilt. */
struct UncertainFit {
  std::size_t point;
  Position center; ///< the linear root, in the stretched space
  double pivot;
  bool is_in_gap; ///< a wide one, where there was no fit
  bool is_past;   ///< its edge goes past samples, see goesPastSamples()
  bool has_all;   ///< there are no more samples than it was made from
  PointIso given; ///< the isopoint without a fit
};

/** Fits of consecutive isopoints; one object per thread. */
class RootSmoother {
public:
  RootSmoother(const IsopointInput& input, float isovalue)
      : input_(input)
      , finder_(input.samples, fitted_samples + 1)
      , nearest_(input.samples, fitted_samples + 1, true)
      , metrics_(input.samples)
      , group_metrics_(input.samples)
      , planar_(input, isovalue)
      , samples_(fitted_samples + 2) // an even number
      , fit_(fit_kernels.get())
      , logarithmic_(fit_, isovalue)
      , left_out_(fit_)
      , isovalue_(isovalue)
  {
  }

  /** Fit consecutive points in the metric of the stretched space, where that serves.
   * \param searched null, or for each point where is looked */
  void
  smooth(const IsoEdge* edges,
         std::size_t count,
         PointIso* points,
         RootFit* fits,
         std::vector<Ball>* searched)
  {
    searched_ = searched;
    uncertain_.clear();
    flat_.clear();
    for (std::size_t first = 0; first < count; first += fit_lanes)
      fitAsTheyAre(first, std::min(fit_lanes, count - first), edges, points, fits);
    for (std::size_t first = 0; first < uncertain_.size(); first += fit_lanes)
      fitInLocalMetrics(&uncertain_[first],
                        std::min(fit_lanes, uncertain_.size() - first),
                        edges,
                        points,
                        fits);
    for (const UncertainFit& uncertain : flat_)
      planar_.smooth(uncertain.center,
                     edges[uncertain.point],
                     uncertain.given,
                     points[uncertain.point],
                     fits[uncertain.point]);
  }

private:
  /** The linear root in the stretched space. */
  Position
  centerOf(const PointIso& point) const
  {
    const Position& scale = input_.samples.getScale();
    return {{point.x * scale[0], point.y * scale[1], point.z * scale[2]}};
  }

  void
  fitAsTheyAre(std::size_t first,
               std::size_t count,
               const IsoEdge* edges,
               PointIso* points,
               RootFit* fits)
  {
    Position centers[fit_lanes], searched[fit_lanes];
    float gaps[fit_lanes] = {};
    std::size_t searches = 0;
    for (std::size_t lane = 0; lane < count; ++lane) {
      centers[lane] = centerOf(points[first + lane]);
      gaps[lane] = findGap(centers[lane], edges[first + lane]);
      if (gaps[lane] == 0.0f)
        searched[searches++] = centers[lane];
    }
    finder_.expect(searched, searches);
    Surroundings surroundings[fit_lanes];
    int weighted[fit_lanes] = {};
    for (std::size_t lane = 0; lane < fit_lanes; ++lane)
      weighted[lane] =
          lane < count && gaps[lane] == 0.0f
              ? gather(centers[lane], edges[first + lane], lane, surroundings[lane])
              : clear(lane, 0);
    FitResult result;
    if (searches > 0)
      fit(weighted, surroundings, result);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::size_t i = first + lane;
      if (gaps[lane] > 0.0f || surroundings[lane].is_wide_gap) {
        const float radius = gaps[lane] > 0.0f
                                 ? gaps[lane]
                                 : static_cast<float>(surroundings[lane].radius);
        fits[i] = {RootOutcome::Far, radius, std::numeric_limits<float>::quiet_NaN()};
        keepInGap(edges[i], points[i]);
        uncertain_.push_back({i, centers[lane], 0.0, true, false, false, points[i]});
        continue;
      }
      const bool has_all = weighted[lane] < static_cast<int>(fitted_samples);
      const float radius = has_all ? std::numeric_limits<float>::infinity()
                                   : static_cast<float>(surroundings[lane].radius);
      fits[i] = {judge(result, lane, surroundings[lane]),
                 radius,
                 static_cast<float>(result.value[lane])};
      const bool is_past =
          goesPastSamples(result, lane, fits[i].outcome, surroundings[lane], samples_);
      const UncertainFit uncertain{
          i, centers[lane], result.pivot[lane], false, is_past, has_all, points[i]};
      if (has_all)
        flat_.push_back(uncertain);
      else if (is_past || !(result.pivot[lane] >= good_pivot) ||
               surroundings[lane].support != IsoSupport::Measured)
        uncertain_.push_back(uncertain);
      setIsopoint(input_,
                  result,
                  lane,
                  surroundings[lane],
                  fits[i].outcome <= RootOutcome::Quadratic,
                  edges[i],
                  points[i]);
    }
  }

  void
  fit(const int* weighted, Surroundings* surroundings, FitResult& result)
  {
    fit_(samples_.data(), samples_.size(), weighted, result);
    logarithmic_.improve(weighted, surroundings, samples_, result);
  }

  /** See NearestFinder::findGap: of points between ends that are not much farther apart
   * than neighbours nearby it is not asked. */
  float
  findGap(const Position& center, const IsoEdge& edge)
  {
    const std::vector<Position>& positions = input_.samples.getPositions();
    const double to_first = distance(positions[edge.first], center);
    const double to_second = distance(positions[edge.second], center);
    return 2.0 * std::min(to_first, to_second) > last_radius_
               ? finder_.findGap(center, edge.first, edge.second, wide_gap)
               : 0.0f;
  }

  /** How far samples that stretch one metric let a fit in it be trusted. */
  static double
  leastRatio(const UncertainFit& uncertain)
  {
    if (uncertain.is_in_gap)
      return certain_stretching;
    return uncertain.pivot < singular_pivot ? little_stretching
           : uncertain.pivot < good_pivot   ? LocalMetricFinder::even_ratio
                                            : certain_stretching;
  }

  /** What is known of a metric. */
  enum class Spacings {
    Unknown,  ///< there is none, or no use in it
    Even,     ///< as they are
    Stretched ///< metrics_ has it
  };

  /** Find the metric around an edge.
   * \param point has the support Bridged afterwards if it lies in a gap in the metric,
   * or if its edge goes past samples that need none; among stretched ones it is right
   */
  Spacings
  findMetric(const UncertainFit& uncertain, const IsoEdge& edge, PointIso& point)
  {
    const double least_ratio = leastRatio(uncertain);
    const std::uint32_t anchor = group_metrics_.findAnchor(edge.first);
    const bool has_group = group_metrics_.find(anchor, least_ratio);
    noteSearches(uncertain.point, group_metrics_.getSearched());
    if (group_metrics_.hasFailed() || (uncertain.is_in_gap && !has_group))
      return Spacings::Unknown;
    if (has_group && liesInGap(group_metrics_, uncertain.center)) {
      noteSearches(uncertain.point, {nearest_.getSearched()});
      if (group_metrics_.getRatio() >= certain_stretching)
        point.support = static_cast<std::uint8_t>(IsoSupport::Bridged);
      return Spacings::Unknown;
    }
    const bool is_found = has_group
                              ? metrics_.refine(edge.first, group_metrics_, least_ratio)
                              : metrics_.find(edge.first, least_ratio);
    noteSearches(uncertain.point, metrics_.getSearched());
    const bool is_even = !is_found && metrics_.isEven(least_ratio);
    if (uncertain.is_past && is_even)
      point.support = static_cast<std::uint8_t>(IsoSupport::Bridged);
    if (is_found && metrics_.reaches(uncertain.center))
      return Spacings::Stretched;
    return is_even ? Spacings::Even : Spacings::Unknown;
  }

  /** Whether a point certainly lies in a wide gap, as distances are in a metric. */
  bool
  liesInGap(const LocalMetricFinder& metrics, const Position& center)
  {
    return metrics.getPoolSize() > fitted_samples &&
           nearest_.isEmpty(
               center, metrics.getMetric(), wide_gap * metrics.findPoolRadius(center));
  }

  void
  noteSearches(std::size_t point, const std::vector<Ball>& balls)
  {
    if (searched_)
      searched_[point].insert(searched_[point].end(), balls.begin(), balls.end());
  }

  /** Fit again in the metrics of the samples around, where these are stretched. */
  void
  fitInLocalMetrics(const UncertainFit* uncertain,
                    std::size_t count,
                    const IsoEdge* edges,
                    PointIso* points,
                    RootFit* fits)
  {
    Surroundings surroundings[fit_lanes];
    Eigen::Matrix3d metrics[fit_lanes];
    double ratios[fit_lanes];
    SampleLines lines[fit_lanes];
    int weighted[fit_lanes] = {};
    bool has_any = false;
    for (std::size_t lane = 0; lane < fit_lanes; ++lane) {
      clear(lane, 0);
      if (lane >= count)
        continue;
      const std::size_t i = uncertain[lane].point;
      const Position& center = uncertain[lane].center;
      const Spacings spacings = findMetric(uncertain[lane], edges[i], points[i]);
      const bool may_be_on_lines =
          spacings == Spacings::Unknown || (spacings == Spacings::Stretched &&
                                            metrics_.getRatio() >= certain_stretching);
      // Unless a fit in the metric takes its place, it is no better than its edge.
      if (may_be_on_lines && !(uncertain[lane].pivot >= singular_pivot))
        raiseErrorToEdge(edges[i], points[i]);
      if (spacings == Spacings::Stretched) {
        metrics[lane] = metrics_.getMetric();
        ratios[lane] = metrics_.getRatio();
        lines[lane] = findLines(metrics_.getSpacings());
        weighted[lane] =
            gatherStretched(metrics_, center, edges[i], lane, surroundings[lane]);
        noteSearches(i, {nearest_.getSearched()});
        has_any = true;
      }
      else if (!uncertain[lane].is_in_gap && group_metrics_.hasFailed())
        flat_.push_back(uncertain[lane]);
    }
    FitResult result;
    if (has_any)
      fit(weighted, surroundings, result);
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (weighted[lane] == 0)
        continue;
      const std::size_t i = uncertain[lane].point;
      const double pivot = uncertain[lane].pivot;
      if (ratios[lane] < certain_stretching)
        surroundings[lane].support = static_cast<IsoSupport>(points[i].support);
      points[i].support = static_cast<std::uint8_t>(surroundings[lane].support);
      const RootOutcome outcome = judge(result, lane, surroundings[lane]);
      if (outcome > RootOutcome::Quadratic ||
          surroundings[lane].support == IsoSupport::Bridged ||
          (fits[i].outcome <= RootOutcome::Quadratic && !(result.pivot[lane] > pivot)))
        continue;
      addErrorOfLines(lines[lane], lane, surroundings[lane].radius, result);
      leaveMetric(metrics[lane], lane, result);
      const auto& positions = input_.samples.getPositions();
      if (isFarFromJump(
              result,
              lane,
              surroundings[lane],
              distance(positions[edges[i].first], positions[edges[i].second])))
        continue;
      fits[i].outcome = outcome;
      fits[i].value = static_cast<float>(result.value[lane]);
      setIsopoint(input_, result, lane, surroundings[lane], true, edges[i], points[i]);
    }
  }

  /** Let the error of a fit to samples on lines tell of what lies between these. */
  void
  addErrorOfLines(SampleLines lines, std::size_t lane, double radius, FitResult& result)
  {
    if (lines.spacing == 0.0)
      return;
    lines.spacing /= radius;
    result.error[lane] = std::hypot(
        result.error[lane], left_out_.measureError(samples_, lane, lines, result));
  }

  /** Leave a lane without samples from the given one on. */
  int
  clear(std::size_t lane, std::size_t first)
  {
    constexpr float outside = 2.0f; // no weight there
    for (std::size_t j = first; j < samples_.size(); ++j) {
      samples_[j].x[lane] = outside;
      samples_[j].y[lane] = samples_[j].z[lane] = samples_[j].value[lane] = 0.0f;
    }
    return 0;
  }

  /** Fill a lane; returns the number of samples with a weight. */
  int
  gather(const Position& center,
         const IsoEdge& edge,
         std::size_t lane,
         Surroundings& surroundings)
  {
    const std::vector<Position>& positions = input_.samples.getPositions();
    surroundings.center = center;
    surroundings.edge_length = distance(positions[edge.first], positions[edge.second]);
    const auto neighbors =
        finder_.find(center, static_cast<float>(surroundings.edge_length));
    float sq_nearest = std::numeric_limits<float>::infinity(), sq_farthest = 0.0f;
    for (std::size_t j = 0; j < neighbors.size; ++j) {
      sq_nearest = std::min(sq_nearest, neighbors.sq_dists[j]);
      sq_farthest = std::max(sq_farthest, neighbors.sq_dists[j]);
      const Position& x = positions[neighbors.samples[j]];
      for (int axis = 0; axis < 3; ++axis)
        direction_[axis][j] = x[axis] - center[axis];
    }
    surroundings.is_wide_gap = neighbors.size > fitted_samples &&
                               sq_nearest > wide_gap * wide_gap * sq_farthest;
    last_radius_ = std::sqrt(sq_farthest);
    return fill(neighbors.samples,
                neighbors.size,
                sq_nearest,
                sq_farthest,
                edge,
                lane,
                surroundings);
  }

  /** The same in another metric. */
  int
  gatherStretched(const LocalMetricFinder& metrics,
                  const Position& center,
                  const IsoEdge& edge,
                  std::size_t lane,
                  Surroundings& surroundings)
  {
    const Eigen::Matrix3d& metric = metrics.getMetric();
    const double pool_radius = metrics.getPoolSize() > fitted_samples
                                   ? metrics.findPoolRadius(center)
                                   : std::numeric_limits<double>::infinity();
    const auto image = [&](std::uint32_t sample, const Position& origin) {
      const Position& x = input_.samples.getPositions()[sample];
      Eigen::Vector3d offset;
      for (int axis = 0; axis < 3; ++axis)
        offset[axis] = static_cast<double>(x[axis]) - origin[axis];
      return Eigen::Vector3d(metric * offset);
    };
    surroundings.center = center;
    surroundings.edge_length =
        image(edge.second, input_.samples.getPositions()[edge.first]).norm();
    const std::vector<std::uint32_t>& neighbors =
        nearest_.find(center, metric, pool_radius * pool_radius);
    double sq_nearest = std::numeric_limits<double>::infinity(), sq_farthest = 0.0;
    for (std::size_t j = 0; j < neighbors.size(); ++j) {
      const Eigen::Vector3d u = image(neighbors[j], center);
      sq_nearest = std::min(sq_nearest, u.squaredNorm());
      sq_farthest = std::max(sq_farthest, u.squaredNorm());
      for (int axis = 0; axis < 3; ++axis)
        direction_[axis][j] = static_cast<float>(u[axis]);
    }
    return fill(neighbors.data(),
                neighbors.size(),
                static_cast<float>(sq_nearest),
                static_cast<float>(sq_farthest),
                edge,
                lane,
                surroundings);
  }

  /** Fill a lane with neighbours, the directions to which are not scaled yet. */
  int
  fill(const std::uint32_t* neighbors,
       std::size_t count,
       float sq_nearest,
       float sq_farthest,
       const IsoEdge& edge,
       std::size_t lane,
       Surroundings& surroundings)
  {
    const std::vector<float>& values = input_.values;
    const float radius = std::sqrt(sq_farthest), per_radius = 1.0f / radius;
    float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
    for (std::size_t j = 0; j < count; ++j) {
      FitSample& sample = samples_[j];
      const float value = values[neighbors[j]];
      for (auto& coordinate : direction_)
        coordinate[j] *= per_radius;
      sample.x[lane] = direction_[0][j];
      sample.y[lane] = direction_[1][j];
      sample.z[lane] = direction_[2][j];
      sample.value[lane] = value - isovalue_;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    const std::size_t directions = (count + cone_lanes - 1) / cone_lanes * cone_lanes;
    for (auto& coordinate : direction_)
      std::fill(coordinate + count, coordinate + directions, 0.0f);
    clear(lane, count);
    surroundings.radius = radius;
    surroundings.values = {lowest, highest, {values[edge.first], values[edge.second]}};
    surroundings.has_steps = areLabels(values, neighbors, count);
    surroundings.support =
        judgeSupport(surroundings,
                     std::sqrt(static_cast<double>(sq_nearest)),
                     {direction_[0], direction_[1], direction_[2], directions});
    return static_cast<int>(count) - 1;
  }

  static constexpr std::size_t direction_room =
      (fitted_samples + cone_lanes) / cone_lanes * cone_lanes;
  alignas(64) float direction_[3][direction_room]; // to the neighbours
  const IsopointInput& input_;
  NearestFinder finder_;
  MetricFinder nearest_;
  LocalMetricFinder metrics_, group_metrics_;
  PlanarRoots planar_;
  std::vector<UncertainFit> uncertain_;
  std::vector<UncertainFit> flat_; ///< maybe: no samples are seen beside a plane
  std::vector<FitSample> samples_;
  FitKernel fit_;
  LogarithmicFits logarithmic_;
  LeftOutLines left_out_;
  float isovalue_;
  double last_radius_ = 0.0; ///< of a support found before
  std::vector<Ball>* searched_ = nullptr;
};

constexpr std::pair<const char*, RootOutcome> outcome_counts[] = {
    {"cubic_roots", RootOutcome::Cubic},
    {"quadratic_roots", RootOutcome::Quadratic},
    {"linear_singular", RootOutcome::Singular},
    {"linear_step", RootOutcome::Step},
    {"linear_far", RootOutcome::Far}};

} // namespace

std::vector<RootFit>
fitRoots(const IsopointInput& input,
         float isovalue,
         const IsoEdges& edges,
         std::vector<PointIso>& points,
         StepTimer& step,
         std::vector<std::vector<Ball>>* searched)
{
  std::vector<RootFit> fits(points.size());
  if (searched)
    searched->assign(points.size(), {});
  parallelBlocks(points.size(),
                 root_block,
                 input.threads,
                 [&](std::size_t begin, std::size_t end) {
                   RootSmoother smoother(input, isovalue);
                   smoother.smooth(&edges[begin],
                                   end - begin,
                                   &points[begin],
                                   &fits[begin],
                                   searched ? &(*searched)[begin] : nullptr);
                   step.advance(end - begin);
                 });
  return fits;
}

void
countRoots(const std::vector<RootOutcome>& outcomes,
           const std::vector<std::uint8_t>& supports,
           bool errors_only,
           Report& report)
{
  if (!errors_only)
    for (const auto& [name, outcome] : outcome_counts)
      report.count(name,
                   static_cast<std::uint64_t>(
                       std::count(outcomes.begin(), outcomes.end(), outcome)));
  for (const auto& [name, support] :
       {std::pair("bridged", IsoSupport::Bridged), std::pair("rim", IsoSupport::Rim)})
    report.count(
        name,
        static_cast<std::uint64_t>(std::count(
            supports.begin(), supports.end(), static_cast<std::uint8_t>(support))));
}

void
smoothIsopoints(const IsopointInput& input,
                float isovalue,
                const IsoEdges& edges,
                std::vector<PointIso>& points,
                Report& report)
{
  StepTimer step(report, "smooth_roots", points.size());
  std::vector<RootOutcome> outcomes;
  for (const RootFit& fit : fitRoots(input, isovalue, edges, points, step))
    outcomes.push_back(fit.outcome);
  std::vector<std::uint8_t> supports;
  supports.reserve(points.size());
  for (const PointIso& point : points)
    supports.push_back(point.support);
  countRoots(outcomes, supports, input.errors_only, report);
}

} // namespace pcl_uvol
