// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/reliable_fits.h"

#include "common/parallel.h"
#include "neighbors/nearest_finder.h"
#include <pcl_uvol/common/cloud_view.h>

#include <cmath>
#include <cstddef>
#include <numeric>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t vote_block = 256;

/** Share of the spacing of predicted samples: a kriged surface that is farther off an
 * isopoint contradicts it. Half of them are off by no more than 0.09 to 0.17 on
 * generated tracks, casts and holes, where predicted samples put more of those left out
 * on their side of the surface, and by 0.37 in stretched cells of CFD, where they put
 * fewer there (tests/benchmarks, holdout). */
constexpr double contradicting_part = 0.25;

/** Crossings around one that decide: errors of single fits scatter by a factor of ten.
 */
constexpr std::size_t voters = 128;

/** What a crossing tells. */
enum class Vote : std::uint8_t {
  Kriging, ///< that it is more certain
  Fit,     ///< that fits are, and that kriging agrees
  FitAlone ///< that fits are, and that kriging is wrong or gains nothing
};

Vote
voteAt(const PointIso& crossing,
       bool is_supported,
       const KrigedSlope& kriged,
       const Eigen::Array3d& scale,
       double spacing)
{
  if (!(static_cast<double>(crossing.error) < kriged.findError(scale)))
    return Vote::Kriging;
  const double offset = kriged.findOffset(static_cast<double>(crossing.isovalue));
  const bool is_alone = is_supported || std::abs(offset) > contradicting_part * spacing;
  return is_alone ? Vote::FitAlone : Vote::Fit;
}

} // namespace

ReliableFits::ReliableFits(const pcl::PointCloud<PointIso>& crossings,
                           const std::vector<std::uint8_t>& are_supported,
                           const std::vector<KrigedSlope>& kriged,
                           const Eigen::Array3f& scale,
                           double spacing,
                           unsigned threads)
{
  if (crossings.empty())
    return;
  std::vector<std::uint32_t> every(crossings.size());
  std::iota(every.begin(), every.end(), 0u);
  Report own;
  const CloudView view = viewOf(crossings);
  crossings_ = SampleSet::build(
      view.xyz(0), view.stride(), every, toPosition(scale), threads, own);
  const std::size_t count = crossings_->size();
  std::vector<Vote> votes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t crossing = crossings_->getInputIndex(i);
    votes[i] = voteAt(crossings[crossing],
                      are_supported[crossing] != 0,
                      kriged[crossing],
                      scale.cast<double>(),
                      spacing);
  }
  are_reliable_.resize(count);
  parallelBlocks(count, vote_block, threads, [&](auto begin, auto end) {
    NearestFinder nearest(*crossings_, voters);
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = nearest.find(crossings_->getPositions()[i], 1.0f);
      std::size_t counts[3] = {};
      for (std::size_t j = 0; j < row.size; ++j)
        ++counts[static_cast<std::size_t>(votes[row.samples[j]])];
      const auto [by_kriging, agreeing, alone] = counts;
      are_reliable_[i] = agreeing + alone > by_kriging && alone > agreeing;
    }
  });
}

std::vector<std::uint8_t>
ReliableFits::find(const std::vector<std::array<double, 3>>& places,
                   unsigned threads) const
{
  std::vector<std::uint8_t> found(places.size());
  if (!crossings_)
    return found;
  parallelBlocks(places.size(), vote_block, threads, [&](auto begin, auto end) {
    NearestFinder nearest(*crossings_, 1);
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [x, y, z] = places[i];
      const Position place{
          {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}};
      const auto row = nearest.find(crossings_->getUnit().apply(place), 1.0f);
      found[i] = are_reliable_[row.samples[0]];
    }
  });
  return found;
}

} // namespace pcl_uvol::detail
