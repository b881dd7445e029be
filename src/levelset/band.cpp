// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/band.h"

#include "common/median.h"
#include "common/parallel.h"
#include "neighbors/nearest_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t band_block = 4096;

/** Samples that a median is taken over, at most. */
constexpr std::size_t most_measured = 8192;

/** Samples that share a look at what is near, crossing or not. */
constexpr std::size_t shared_samples = 64;

/** Marks the samples of a box, and some beside it. */
class BoxMarker {
public:
  explicit BoxMarker(const SampleSet& samples)
      : tree_(samples.getTree())
      , marked_(samples.size(), false)
  {
  }

  void
  mark(const Position& low, const Position& high)
  {
    mark(tree_.getRoot(), low, high);
  }

  bool
  isMarked(std::size_t sample) const
  {
    return marked_[sample];
  }

private:
  void
  mark(const KdNode& node, const Position& low, const Position& high)
  {
    if (node.count <= shared_samples) {
      std::fill_n(marked_.begin() + node.begin, node.count, true);
      return;
    }
    const int axis = tree_.getAxis(node);
    const float plane = tree_.getPlane(node).coordinate;
    if (low[axis] <= plane)
      mark(node.left(), low, high);
    if (high[axis] >= plane)
      mark(node.right(), low, high);
  }

  const KdTree& tree_;
  std::vector<char> marked_;
};

struct NearSample {
  std::uint32_t sample;
  float distance;
};

std::vector<NearSample>
samplesNear(const SampleSet& samples,
            const std::vector<std::uint32_t>& crossing,
            float width,
            unsigned threads)
{
  const std::vector<Position>& positions = samples.getPositions();
  std::vector<Position> near;
  near.reserve(crossing.size());
  for (const std::uint32_t sample : crossing)
    near.push_back(positions[sample]);
  BoxMarker marker(samples);
  // Crossing samples lie in spatial order: so many of them span a small box.
  for (std::size_t begin = 0; begin < near.size(); begin += shared_samples) {
    Position low = near[begin], high = low;
    const std::size_t end = std::min(near.size(), begin + shared_samples);
    for (std::size_t i = begin; i < end; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], near[i][axis] - width);
        high[axis] = std::max(high[axis], near[i][axis] + width);
      }
    marker.mark(low, high);
  }
  std::vector<std::uint32_t> all(near.size());
  std::iota(all.begin(), all.end(), 0u);
  Report ignored;
  const auto crossings =
      SampleSet::buildInUnit(near.front().x, 3, all, LengthUnit{}, threads, ignored);
  return parallelGather<NearSample>(
      samples.size(),
      band_block,
      threads,
      [&](std::size_t begin, std::size_t end, std::vector<NearSample>& found) {
        NearestFinder finder(*crossings, 1);
        for (std::size_t first = begin; first < end; first += shared_samples) {
          const std::size_t last = std::min(end, first + shared_samples);
          bool is_expected = false;
          for (std::size_t i = first; i < last; ++i) {
            if (!marker.isMarked(i))
              continue;
            if (!is_expected)
              finder.expect(&positions[first], last - first);
            is_expected = true;
            const auto row = finder.findWithin(positions[i], width);
            if (row.size > 0 && row.sq_dists[0] <= width * width)
              found.push_back(
                  {static_cast<std::uint32_t>(i), std::sqrt(row.sq_dists[0])});
          }
        }
      });
}

/** Number the samples by place, and find the neighbours that are no centres. */
void
assignPlaces(std::size_t sample_count, Band& band)
{
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(sample_count, none);
  for (std::size_t i = 0; i < band.centers.size(); ++i)
    place[band.centers[i]] = static_cast<std::uint32_t>(i);
  const StencilView stencils = band.stencils.view();
  for (std::size_t i = 0; i < band.centerPlaces() * stencils.neighbors; ++i)
    if (place[stencils.indices[i]] == none) {
      place[stencils.indices[i]] = 0; // found
      band.others.push_back(stencils.indices[i]);
    }
  std::sort(band.others.begin(), band.others.end());
  for (std::size_t i = 0; i < band.others.size(); ++i)
    place[band.others[i]] = static_cast<std::uint32_t>(band.centerPlaces() + i);
  band.stencils.renumber(place);
}

void
findSupports(const std::vector<Position>& positions, Band& band)
{
  band.supports.assign(band.others.size(), {0, std::numeric_limits<float>::infinity()});
  const StencilView stencils = band.stencils.view();
  for (std::size_t i = 0; i < band.centers.size(); ++i) {
    const std::uint32_t* const row =
        stencils.indicesOf(i / stencil_lanes) + i % stencil_lanes;
    for (std::size_t j = 0; j < stencils.neighbors; ++j) {
      const std::uint32_t place = row[j * stencil_lanes];
      if (place < band.centerPlaces())
        continue;
      const std::size_t other = place - band.centerPlaces();
      const Position &a = positions[band.centers[i]],
                     &b = positions[band.others[other]];
      const float distance = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      if (distance < band.supports[other].distance)
        band.supports[other] = {static_cast<std::uint32_t>(i), distance};
    }
  }
}

} // namespace

void
Band::extrapolate(std::vector<float>& phi) const
{
  for (std::size_t i = 0; i < others.size(); ++i) {
    const float beside = phi[supports[i].place];
    phi[centerPlaces() + i] =
        std::copysign(std::abs(beside) + supports[i].distance, beside);
  }
}

double
spacingOf(double reach, double neighbors)
{
  constexpr double ball = 4.0 / 3.0 * 3.14159265358979;
  return reach * std::cbrt(ball / neighbors);
}

double
medianSpacing(const SampleSet& samples,
              const std::vector<std::uint32_t>& around,
              std::size_t k,
              unsigned threads)
{
  const std::size_t count = std::min(around.size(), most_measured);
  const std::size_t neighbors = std::min(k, samples.size() - 1);
  std::vector<double> spacings(count);
  parallelBlocks(count, band_block, threads, [&](auto begin, auto end) {
    NearestFinder finder(samples, neighbors + 1);
    for (std::size_t i = begin; i < end; ++i) {
      const auto row =
          finder.find(samples.getPositions()[around[i * around.size() / count]], 1.0f);
      const double sq_reach = *std::max_element(row.sq_dists, row.sq_dists + row.size);
      spacings[i] = spacingOf(std::sqrt(sq_reach), static_cast<double>(neighbors));
    }
  });
  return computeMedian(spacings);
}

Band
makeBand(const SampleSet& samples,
         const std::vector<std::uint32_t>& crossing,
         double width,
         FitScheme scheme,
         std::size_t k,
         unsigned threads,
         Report& report)
{
  Band band;
  {
    const StepTimer timer(report, "band");
    if (width > 0.0)
      for (const NearSample& near :
           samplesNear(samples, crossing, static_cast<float>(width), threads)) {
        band.centers.push_back(near.sample);
        band.distance.push_back(near.distance);
      }
    else {
      band.centers.resize(samples.size());
      std::iota(band.centers.begin(), band.centers.end(), 0u);
    }
  }
  band.stencils.compute(samples, band.centers, scheme, k, threads, report);
  assignPlaces(samples.size(), band);
  findSupports(samples.getPositions(), band);
  return band;
}

} // namespace pcl_uvol
