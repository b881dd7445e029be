// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "common/parameter_json.h"
#include "derivatives/local_fit.h"
#include "neighbors/nearest_neighbors.h"
#include "neighbors/sample_values.h"
#include <pcl_uvol/derivatives/gradient_estimation.h>

#include <Eigen/Core>

#include <atomic>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

constexpr std::size_t block_samples = 1024;

/** Gradient and mean curvature of a sample. */
struct Derivatives {
  Eigen::Vector3d gradient;
  double mean_curvature;
};

/** From the second derivatives: (tr H - n^T H n) / (2 |grad f|). */
double
computeCurvature(const double* d)
{
  const Eigen::Map<const Eigen::Vector3d> gradient(d);
  const double slope = gradient.norm();
  if (!(slope > 0.0))
    return std::numeric_limits<double>::quiet_NaN();
  Eigen::Matrix3d hessian;
  hessian << d[3], d[4], d[5], d[4], d[6], d[7], d[5], d[7], d[8];
  const Eigen::Vector3d normal = gradient / slope;
  return (hessian.trace() - normal.dot(hessian * normal)) / (2.0 * slope);
}

/** Fits of all samples, one after another. */
class GradientFinder {
public:
  GradientFinder(const SampleSet& samples,
                 const NeighborGraph& neighbors,
                 const GradientParameters& parameters,
                 unsigned threads)
      : samples_(samples)
      , neighbors_(neighbors)
      , parameters_(parameters)
      , threads_(threads)
  {
  }

  std::vector<Derivatives>
  find(const std::vector<float>& f, Report& report) const
  {
    std::vector<Derivatives> found(samples_.size());
    std::atomic<std::uint64_t> reduced{0}, singular{0};
    sweep(report, "gradients", [&](std::size_t i, LocalFit& fit, auto outcome) {
      reduced += outcome == FitOutcome::Reduced;
      singular += outcome == FitOutcome::Singular;
      if (neighbors_[i].size() == 0) { // the only sample
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        found[i] = {Eigen::Vector3d::Constant(none), none};
        return;
      }
      const bool has_curvature = outcome == FitOutcome::Full || fit.fitInPlane();
      double d[9] = {};
      for (std::size_t j = 0; j < neighbors_[i].size(); ++j) {
        const double difference =
            static_cast<double>(f[neighbors_[i].first[j]]) - static_cast<double>(f[i]);
        for (std::size_t row = 0; row < derivativesOf(parameters_.scheme); ++row)
          d[row] += fit.getWeights(row)[j] * difference;
      }
      found[i] = {Eigen::Vector3d(d),
                  has_curvature ? computeCurvature(d)
                                : std::numeric_limits<double>::quiet_NaN()};
    });
    report.count("reduced_fits", reduced);
    report.count("singular_fits", singular);
    if (parameters_.scheme == FitScheme::Linear)
      findCurvatures(found, report);
    return found;
  }

private:
  /** Call visit(sample, its fit, outcome) for all samples. */
  template <typename Visit>
  void
  sweep(Report& report, const char* name, const Visit& visit) const
  {
    StepTimer step(report, name, samples_.size());
    parallelBlocks(samples_.size(), block_samples, threads_, [&](auto begin, auto end) {
      LocalFit fit(parameters_.scheme);
      for (std::size_t i = begin; i < end; ++i) {
        const auto row = neighbors_[i];
        visit(i,
              fit,
              fit.fit(samples_.getPositions(),
                      static_cast<std::uint32_t>(i),
                      row.first,
                      row.size()));
      }
      step.advance(end - begin);
    });
  }

  /** Half the divergence of the normalised gradients (thesis 3.3); where a neighbour
   * has no gradient its direction counts as the sample's own. */
  void
  findCurvatures(std::vector<Derivatives>& found, Report& report) const
  {
    sweep(report, "curvatures", [&](std::size_t i, LocalFit& fit, auto) {
      const double slope = found[i].gradient.norm();
      if (!(slope > 0.0)) {
        found[i].mean_curvature = std::numeric_limits<double>::quiet_NaN();
        return;
      }
      const Eigen::Vector3d normal = found[i].gradient / slope;
      double divergence = 0.0;
      for (std::size_t j = 0; j < neighbors_[i].size(); ++j) {
        const Eigen::Vector3d& other = found[neighbors_[i].first[j]].gradient;
        const double length = other.norm();
        if (!(length > 0.0))
          continue;
        for (int axis = 0; axis < 3; ++axis)
          divergence += fit.getWeights(static_cast<std::size_t>(axis))[j] *
                        (other[axis] / length - normal[axis]);
      }
      found[i].mean_curvature = 0.5 * divergence;
    });
  }

  const SampleSet& samples_;
  const NeighborGraph& neighbors_;
  const GradientParameters& parameters_;
  unsigned threads_;
};

} // namespace

std::vector<PointGradient>
detail::estimateGradients(const CloudView& cloud,
                          const pcl::Indices& indices,
                          const GradientParameters& parameters,
                          const pcl::search::Search<pcl::PointXYZ>::Ptr& search,
                          unsigned threads,
                          Report& report)
{
  const std::size_t least = derivativesOf(parameters.scheme);
  if (parameters.k < least)
    throw InvalidArgument("few_neighbors_for_scheme",
                          {{"neighbors", parameters.k}, {"least", least}});
  checkIndices(indices, cloud.count, "GradientEstimation");
  const ScalarField field(cloud.fields, parameters.field);
  const ValueFrame frame = findValueRange(cloud, field, threads).findFrame();
  const auto values = readValues(cloud, field, frame, threads);
  const auto use = pointsWithValue(values, indices, field);
  const auto samples = SampleSet::build(
      cloud.xyz(0), cloud.stride(), use, Position{{1.0f, 1.0f, 1.0f}}, threads, report);
  report.countSamples("no_value", indices.size() - use.size());
  report.countSamples("samples", samples->size());
  const auto f = gatherValues(*samples, values, threads, report).values;
  const NeighborGraph neighbors =
      search ? computeNearestNeighbors(*samples, parameters.k, threads, search, report)
             : computeNearestNeighbors(*samples, parameters.k, threads, report);
  const auto found =
      GradientFinder(*samples, neighbors, parameters, threads).find(f, report);

  std::vector<PointGradient> by_point(cloud.count);
  const double per_length = samples->getUnit().factor;
  const auto assign = [&](std::uint32_t point, const Derivatives& derivatives) {
    const Eigen::Vector3d gradient = per_length / frame.factor * derivatives.gradient;
    by_point[point].gradient_x = static_cast<float>(gradient[0]);
    by_point[point].gradient_y = static_cast<float>(gradient[1]);
    by_point[point].gradient_z = static_cast<float>(gradient[2]);
    by_point[point].mean_curvature =
        static_cast<float>(per_length * derivatives.mean_curvature);
  };
  for (std::size_t i = 0; i < samples->size(); ++i)
    assign(samples->getInputIndex(i), found[i]);
  for (const SampleSet::Merged& merged : samples->getMerged())
    for (const std::uint32_t member : merged.members)
      assign(member, found[merged.sample]);
  std::vector<PointGradient> gradients;
  gradients.reserve(indices.size());
  for (const int index : indices)
    gradients.push_back(by_point[static_cast<std::size_t>(index)]);
  return gradients;
}

std::string
GradientParameters::toJson() const
{
  return writeJson(*this);
}

GradientParameters
GradientParameters::fromJson(const std::string& text)
{
  return readJson<GradientParameters>(text);
}

} // namespace pcl_uvol
