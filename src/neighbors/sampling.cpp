// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/sampling.h"

#include "common/parallel.h"
#include "common/stretch_axes.h"
#include "neighbors/sample_values.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

constexpr std::size_t look_block = 256;

/** Samples that a summary looks at, at most. */
constexpr std::size_t most_looks = 1024;

/** Spacings that differ by more part lines from sheets and these from volumes. Of
 * uniform random samples hardly any reach it, and cells stretched by less are as good
 * as cubes. */
constexpr double least_contrast = 4.0;

/** A sample is alone where its nearest neighbour is so many times as far as that one's
 * own. */
constexpr double isolated_ratio = 8.0;

/** Neighbours that tell a line from a sheet where nothing lies beside them. */
constexpr std::size_t around_samples = 13;

constexpr float infinite = std::numeric_limits<float>::infinity();

/** Judges by three lengths in ascending order: spacings, or the inverse of extents. */
LocalDimension
findDimension(const Eigen::Vector3d& lengths)
{
  if (lengths[1] > least_contrast * lengths[0])
    return LocalDimension::Line;
  return lengths[2] > least_contrast * lengths[1] ? LocalDimension::Sheet
                                                  : LocalDimension::Volume;
}

} // namespace

SamplingFinder::SamplingFinder(const SampleSet& samples)
    : samples_(samples)
    , metrics_(samples)
    , nearest_(samples, 2)
    , around_(samples, around_samples)
{
}

bool
SamplingFinder::isAlone(std::uint32_t sample, double& nearest)
{
  const auto& positions = samples_.getPositions();
  std::uint32_t other = sample;
  const auto find = [&](std::uint32_t of) {
    const auto row = nearest_.find(positions[of], 1.0f);
    double distance = 0.0; // a sample finds itself as well
    for (std::size_t i = 0; i < row.size; ++i)
      if (row.samples[i] != of) {
        other = row.samples[i];
        distance = std::sqrt(static_cast<double>(row.sq_dists[i]));
      }
    return distance;
  };
  nearest = find(sample);
  return other == sample || nearest > isolated_ratio * find(other);
}

LocalSampling
SamplingFinder::find(std::uint32_t sample)
{
  double nearest = 0.0;
  const auto length = [&](double of) {
    return static_cast<float>(samples_.getUnit().toInput(of));
  };
  if (isAlone(sample, nearest))
    return {LocalDimension::Isolated, length(nearest), infinite};
  metrics_.find(sample);
  if (std::isfinite(metrics_.getRatio())) {
    const Eigen::Vector3d spacings =
        Solver(metrics_.getSpacings()).eigenvalues().cwiseMax(0.0).cwiseSqrt();
    const LocalDimension dimension = findDimension(spacings);
    const bool is_line = dimension == LocalDimension::Line;
    return {dimension, length(spacings[0]), length(spacings[is_line ? 1 : 2])};
  }
  // Nothing is seen beside: the extent of the nearest ones tells a line from a sheet.
  const auto& positions = samples_.getPositions();
  const Position& place = positions[sample];
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  const auto row = around_.find(place, static_cast<float>(nearest));
  for (std::size_t i = 0; i < row.size; ++i) {
    Eigen::Vector3d offset;
    for (int axis = 0; axis < 3; ++axis)
      offset[axis] = static_cast<double>(positions[row.samples[i]][axis]) - place[axis];
    moments += offset * offset.transpose();
  }
  const Eigen::Vector3d extents = Solver(moments).eigenvalues().cwiseMax(0.0);
  const bool is_line =
      extents[2] > least_contrast * least_contrast * extents[1] || row.size < 3;
  return {is_line ? LocalDimension::Line : LocalDimension::Sheet,
          length(nearest),
          infinite};
}

std::vector<LocalSampling>
diagnoseSampling(const SampleSet& samples,
                 unsigned threads,
                 const ProgressCallback& progress)
{
  std::vector<LocalSampling> found(samples.size());
  Report report;
  report.progress = progress;
  StepTimer step(report, "sampling", found.size());
  parallelBlocks(found.size(), look_block, threads, [&](auto begin, auto end) {
    SamplingFinder finder(samples);
    for (std::size_t i = begin; i < end; ++i)
      found[i] = finder.find(static_cast<std::uint32_t>(i));
    step.advance(end - begin);
  });
  return found;
}

std::vector<LocalSampling>
lookAtSome(const SampleSet& samples,
           std::uint64_t begin,
           std::uint64_t total,
           unsigned threads)
{
  const std::uint64_t step = (total + most_looks - 1) / most_looks;
  const std::uint64_t before = (begin + step - 1) / step; // that other parts look at
  std::vector<LocalSampling> found((begin + samples.size() + step - 1) / step - before);
  parallelBlocks(found.size(), look_block, threads, [&](auto first, auto last) {
    SamplingFinder finder(samples);
    for (std::size_t i = first; i < last; ++i)
      found[i] = finder.find(static_cast<std::uint32_t>((before + i) * step - begin));
  });
  return found;
}

SamplingSummary
summarizeSampling(const SampleSet& samples, unsigned threads)
{
  return summarizeSampling(lookAtSome(samples, 0, samples.size(), threads));
}

SamplingSummary
summarizeSampling(const std::vector<LocalSampling>& found)
{
  SamplingSummary summary;
  for (const LocalSampling& one : found)
    ++summary.shares[static_cast<std::size_t>(one.dimension)];
  for (double& share : summary.shares)
    share /= static_cast<double>(found.size());
  const auto most = std::max_element(summary.shares.begin(), summary.shares.end());
  summary.most = static_cast<LocalDimension>(most - summary.shares.begin());
  const auto median = [&](float LocalSampling::*length) {
    std::vector<float> lengths;
    for (const LocalSampling& one : found)
      if (one.dimension == summary.most)
        lengths.push_back(one.*length);
    const auto middle =
        lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
  };
  summary.along = median(&LocalSampling::along);
  summary.across = median(&LocalSampling::across);
  return summary;
}

SamplingSummary
summarizeSampling(const CloudView& cloud,
                  const pcl::Indices& indices,
                  const std::string& field,
                  const Eigen::Array3f& scale,
                  const Eigen::Array3d& rotation,
                  unsigned threads)
{
  const detail::StretchAxes axes(rotation);
  const CloudView turned = axes.turn(cloud);
  const ScalarField scalar(turned.fields, field);
  const ValueFrame frame = findValueRange(turned, scalar, threads).findFrame();
  const auto use =
      pointsWithValue(readValues(turned, scalar, frame, threads), indices, scalar);
  Report own; // whoever takes the samples counts them
  return summarizeSampling(
      *SampleSet::build(
          turned.xyz(0), turned.stride(), use, toPosition(scale), threads, own),
      threads);
}

} // namespace pcl_uvol
