// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/kriging_model.h"

#include "interpolation/query_search.h"
#include "interpolation/support_finder.h"
#include "neighbors/metric_finder.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

/** Share of the samples that estimates rest on: where octants are asked for, so many
 * are looked through. */
constexpr std::size_t octant_pool = 4;

/** From offsets to those along the axes of the anisotropy, divided by the ratios of
 * ranges: the axes are those of the coordinates turned about z, then the new x, then
 * the new z. */
Eigen::Matrix3d
makeMetric(const KrigingParameters& parameters)
{
  constexpr double degree = 3.14159265358979323846 / 180.0;
  const auto turn = [&](Eigen::Index i, const Vector3d& axis) {
    return Eigen::AngleAxisd(degree * static_cast<double>(parameters.rotation[i]), axis)
        .toRotationMatrix();
  };
  const Eigen::Matrix3d axes = turn(0, Vector3d::UnitZ()) * turn(1, Vector3d::UnitX()) *
                               turn(2, Vector3d::UnitZ());
  const Vector3d ratios = parameters.ratios.matrix().cast<double>();
  return ratios.cwiseInverse().asDiagonal() * axes.transpose();
}

/** Samples that an estimate rests on. */
class NeighborhoodFinder {
public:
  NeighborhoodFinder(const SampleSet& samples,
                     const KrigingParameters& parameters,
                     const Eigen::Matrix3d& metric,
                     const Query* queries,
                     std::size_t count)
      : samples_(samples)
      , parameters_(parameters)
      , metric_(metric)
      , is_even_((parameters.ratios == 1.0f).all())
      , queries_(queries)
      , search_(samples, poolOf(parameters), queries, count)
      , finder_(samples, poolOf(parameters))
  {
  }

  /** \return offsets in the metric, by index of the sample */
  const std::vector<std::pair<std::uint32_t, Vector3d>>&
  find(std::size_t query)
  {
    found_.clear();
    const auto add = [&](std::uint32_t sample) {
      const Position& x = samples_.getPositions()[sample];
      Vector3d offset;
      for (int axis = 0; axis < 3; ++axis)
        offset[axis] = static_cast<double>(x[axis]) - queries_[query].x[axis];
      found_.emplace_back(sample, metric_ * offset);
    };
    if (is_even_) {
      const auto near = search_.find(query);
      std::for_each(near.samples, near.samples + near.size, add);
    }
    else
      for (const std::uint32_t sample :
           finder_.find(queries_[query].toPosition(), metric_))
        add(sample);
    if (parameters_.octants)
      keepOctants();
    std::sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
      return a.first < b.first;
    });
    return found_;
  }

private:
  static std::size_t
  poolOf(const KrigingParameters& parameters)
  {
    return parameters.octants ? octant_pool * parameters.k : parameters.k;
  }

  /** Keep no more than an eighth of k in each octant, the nearest. */
  void
  keepOctants()
  {
    std::sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
      const double to_a = a.second.squaredNorm(), to_b = b.second.squaredNorm();
      return to_a != to_b ? to_a < to_b : a.first < b.first;
    });
    const std::size_t most = (parameters_.k + 7) / 8;
    std::size_t counts[8] = {};
    const auto isTooMany = [&](const auto& sample) {
      const Vector3d& x = sample.second;
      return ++counts[(x[0] < 0.0) + 2 * (x[1] < 0.0) + 4 * (x[2] < 0.0)] > most;
    };
    std::vector<std::pair<std::uint32_t, Vector3d>> kept;
    for (const auto& sample : found_)
      if (!isTooMany(sample))
        kept.push_back(sample);
    found_.swap(kept);
  }

  const SampleSet& samples_;
  const KrigingParameters& parameters_;
  const Eigen::Matrix3d& metric_;
  bool is_even_;
  const Query* queries_;
  QuerySearch search_;
  MetricFinder finder_;
  std::vector<std::pair<std::uint32_t, Vector3d>> found_;
};

double
computeVariance(const SampledFields& sampled, std::size_t field)
{
  const std::size_t count = sampled.samples->size();
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    sum += sampled.valuesOf(i)[field];
  const double mean = sum / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double rest = sampled.valuesOf(i)[field] - mean;
    squares += rest * rest;
  }
  return squares / static_cast<double>(count);
}

} // namespace

KrigingModel::KrigingModel(const SampledFields& sampled,
                           const KrigingParameters& parameters,
                           const Eigen::Matrix3d& turn,
                           const std::vector<ValueFrame>& frames,
                           const std::vector<std::string>& names)
    : sampled_(sampled)
    , parameters_(parameters)
    , metric_(makeMetric(parameters))
    , sparse_(sparseSamples(*sampled.samples))
{
  const Position& scale = sampled.samples->getUnit().scale;
  const Eigen::MatrixX3d block = KrigingTarget::divideBlock(
      parameters.block,
      metric_ * Eigen::Map<const Eigen::Vector3f>(scale.x).cast<double>().asDiagonal() *
          turn);
  for (std::size_t f = 0; f < sampled.fields; ++f) {
    const double factor = frames[f].factor * frames[f].factor;
    const Variogram given{parameters.variogram,
                          parameters.nugget * factor,
                          parameters.psill * factor,
                          parameters.range * sampled.samples->getUnit().factor};
    EmpiricalVariograms empirical =
        computeEmpiricalVariograms(sampled, f, metric_, parameters.trend);
    const Variogram fitted = fitVariogram(empirical.all, given);
    variograms_.push_back({fitted, std::move(empirical)});
    targets_.push_back((parameters.block > 0.0f).any() ? KrigingTarget(fitted, block)
                                                       : KrigingTarget(fitted));
    if (!(fitted.psill + fitted.nugget > 0.0))
      constant_.push_back(names[f]);
    if (!(given.psill > given.nugget)) // or one of them is not given
      continue;
    // Does it fit the variance, and not the rest that the nugget leaves of it?
    const double variance = computeVariance(sampled, f);
    if (std::abs(given.psill - variance) < 0.5 * given.nugget)
      total_sills_.push_back({"total_sill",
                              {{"field", names[f]},
                               {"psill", parameters.psill},
                               {"variance", variance / factor},
                               {"nugget", parameters.nugget},
                               {"rest", parameters.psill - parameters.nugget}}});
  }
}

void
KrigingModel::evaluate(const Query* queries,
                       std::size_t count,
                       const Estimates& estimates) const
{
  SupportFinder support(*sampled_.samples, sparse_);
  support.expect(queries, count);
  NeighborhoodFinder finder(*sampled_.samples, parameters_, metric_, queries, count);
  Eigen::MatrixX3d offsets;
  Eigen::VectorXd values;
  for (std::size_t i = 0; i < count; ++i) {
    estimates.support[i] = support.findExpected(i);
    if (estimates.support[i] == FieldSupport::Outside && !estimates.extrapolate)
      continue;
    const auto& near = finder.find(i);
    const auto size = static_cast<Eigen::Index>(near.size());
    offsets.resize(size, 3);
    values.resize(size);
    for (Eigen::Index j = 0; j < size; ++j)
      offsets.row(j) = near[static_cast<std::size_t>(j)].second.transpose();
    for (std::size_t f = 0; f < sampled_.fields; ++f) {
      for (Eigen::Index j = 0; j < size; ++j)
        values[j] = sampled_.valuesOf(near[static_cast<std::size_t>(j)].first)[f];
      const Variogram& variogram = variograms_[f].model;
      KrigingEstimate estimate{values[0], 0.0, Vector3d::Zero()};
      if (variogram.psill + variogram.nugget > 0.0)
        estimate = KrigingSystem(offsets, variogram, targets_[f], parameters_.trend)
                       .estimate(values);
      const std::size_t place = i * sampled_.fields + f;
      estimates.values[place] = estimate.value;
      if (estimates.errors)
        estimates.errors[place] = std::sqrt(estimate.variance);
      if (estimates.gradients) {
        const Vector3d gradient = metric_.transpose() * estimate.gradient;
        std::copy_n(gradient.data(), 3, estimates.gradients + 3 * place);
      }
    }
  }
}

void
KrigingModel::addTo(Report& report) const
{
  for (const std::string& name : constant_)
    report.warn("no_variogram", {{"field", name}});
  report.warn(total_sills_);
}

} // namespace pcl_uvol::detail
