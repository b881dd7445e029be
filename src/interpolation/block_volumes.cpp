// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/block_volumes.h"

#include "common/random.h"
#include "common/stretch_axes.h"
#include "interpolation/kriging_system.h"
#include "interpolation/variogram.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_uvol::detail {

namespace {

using Eigen::Vector3d;

/** They take about a minute of a core for each million inside of the data. */
constexpr double most_blocks = 0x1p24;

/** Pairs of blocks that tell how much their errors add up: the mean of so many
 * correlations, each from 0 to 1, is known to a hundredth. */
constexpr std::size_t drawn_pairs = std::size_t{1} << 14;

/** The blocks, x fastest. */
struct BlockGrid {
  std::array<std::size_t, 3> counts{};
  Vector3d low, sides; ///< middle of the first block

  BlockGrid(const CloudView& samples, const Eigen::Array3f& asked)
      : sides(asked.matrix().cast<double>())
  {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < samples.count; ++i) {
      const Eigen::Map<const Eigen::Vector3f> place(samples.xyz(i));
      if (place.allFinite())
        box.extend(place.cast<double>().eval());
    }
    if (box.isEmpty())
      throw InvalidArgument("no_finite_sample", {});
    double blocks = 1.0;
    Eigen::Array3d along;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      along[axis] = std::max(1.0, std::ceil(box.sizes()[axis] / sides[axis]));
      blocks *= along[axis];
    }
    if (!(blocks <= most_blocks))
      throw InvalidArgument("too_many_blocks", {});
    for (std::size_t axis = 0; axis < 3; ++axis)
      counts[axis] = static_cast<std::size_t>(along[static_cast<Eigen::Index>(axis)]);
    low = box.center() - 0.5 * ((along - 1.0) * sides.array()).matrix();
  }

  std::size_t
  size() const
  {
    return counts[0] * counts[1] * counts[2];
  }

  std::array<double, 3>
  middleOf(std::size_t block) const
  {
    const std::size_t at[] = {block % counts[0],
                              block / counts[0] % counts[1],
                              block / (counts[0] * counts[1])};
    std::array<double, 3> middle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      middle[axis] = low[i] + sides[i] * static_cast<double>(at[axis]);
    }
    return middle;
  }
};

struct KrigedBlock {
  Vector3d middle, stretched;
  double mean, deviation;
};

/** Of a normal variable less an isovalue, where it is not negative: its probability,
 * and the expectations of it and of its square. */
struct PartBeyond {
  double probability, first, second;

  PartBeyond(double mean, double deviation)
  {
    if (!(deviation > 0.0)) {
      probability = mean >= 0.0 ? 1.0 : 0.0;
      first = probability * mean;
      second = first * mean;
      return;
    }
    const double z = mean / deviation,
                 density = std::exp(-0.5 * z * z) * 0.3989422804014327 * deviation;
    probability = 0.5 * std::erfc(-z * std::sqrt(0.5));
    first = std::max(0.0, mean * probability + density);
    second = std::max(0.0, mean * first + deviation * deviation * probability);
  }
};

/** Adds up errors of blocks that are correlated. */
class ErrorSum {
public:
  ErrorSum(const std::vector<KrigedBlock>& blocks, const Variogram& variogram)
      : blocks_(blocks)
      , variogram_(variogram)
  {
  }

  /** The standard deviation of a sum of variables, one of each block. */
  double
  add(const std::vector<double>& variances) const
  {
    std::vector<double> sums(variances.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < variances.size(); ++i)
      sums[i] = sum += std::sqrt(std::max(0.0, variances[i]));
    if (!(sum > 0.0))
      return 0.0;
    // Pairs are drawn in proportion to what they add.
    const auto draw = [&](std::size_t number) {
      const double at = sum * 0x1p-64 * static_cast<double>(mixBits(number));
      const auto found = std::upper_bound(sums.begin(), sums.end() - 1, at);
      return static_cast<std::size_t>(found - sums.begin());
    };
    double correlation = 0.0;
    for (std::size_t pair = 0; pair < drawn_pairs; ++pair)
      correlation += correlate(draw(2 * pair), draw(2 * pair + 1));
    return sum * std::sqrt(correlation / static_cast<double>(drawn_pairs));
  }

private:
  double
  correlate(std::size_t a, std::size_t b) const
  {
    if (a == b || !(variogram_.psill > 0.0))
      return a == b ? 1.0 : 0.0;
    const double distance = (blocks_[a].stretched - blocks_[b].stretched).norm();
    return variogram_.covariance(distance) / variogram_.psill;
  }

  const std::vector<KrigedBlock>& blocks_;
  const Variogram& variogram_;
};

/** \param sign -1 where what is below the isovalue is beyond it */
BlockVolume
sumUp(const std::vector<KrigedBlock>& blocks,
      const ErrorSum& errors,
      double isovalue,
      double sign,
      double block_volume)
{
  std::vector<PartBeyond> parts;
  double volume = 0.0, excess = 0.0;
  Vector3d moment = Vector3d::Zero();
  for (const KrigedBlock& block : blocks) {
    parts.emplace_back(sign * (block.mean - isovalue), block.deviation);
    volume += parts.back().probability;
    excess += parts.back().first;
    moment += parts.back().probability * block.middle;
  }
  // The sum of part.first + shift * part.probability.
  const auto findError = [&](double factor, double shift) {
    std::vector<double> variances;
    for (const PartBeyond& part : parts) {
      const double mean = factor * part.first + shift * part.probability;
      variances.push_back(factor * part.second + 2.0 * factor * shift * part.first +
                          shift * shift * part.probability - mean * mean);
    }
    return errors.add(variances);
  };
  const double mean_excess = excess / volume; // not a number without any
  BlockVolume sum;
  sum.isovalue = isovalue;
  sum.volume = block_volume * volume;
  sum.volume_error = block_volume * findError(0.0, 1.0);
  sum.mean = isovalue + sign * mean_excess;
  sum.mean_error = volume > 0.0 ? findError(1.0, -mean_excess) / volume
                                : std::numeric_limits<double>::quiet_NaN();
  sum.integral = block_volume * (isovalue * volume + sign * excess);
  sum.integral_error = block_volume * findError(1.0, sign * isovalue);
  sum.centroid = moment / volume;
  return sum;
}

} // namespace

BlockVolumes
estimateBlockVolumes(const CloudView& samples,
                     const BlockParameters& parameters,
                     unsigned threads,
                     Report& report)
{
  const Eigen::Array3f& sides = parameters.sides;
  if (!(sides > 0.0f).all() || !sides.allFinite())
    throw InvalidArgument("block_sides_not_positive", {});
  const BlockGrid grid(samples, sides);
  InterpolationParameters kriging;
  kriging.fields = {parameters.field};
  kriging.model = InterpolationModel::Kriging;
  kriging.kriging.octants = true;
  kriging.kriging.block = sides;
  kriging.gradients = false;
  kriging.scale = parameters.scale;
  kriging.rotation = parameters.rotation;
  pcl::Indices every(samples.count);
  std::iota(every.begin(), every.end(), 0);
  const FieldInterpolator field(samples, every, kriging, threads, report);
  const Variogram variogram = field.findVariogram(0)->model;
  const Eigen::Matrix3d stretch =
      parameters.scale.matrix().cast<double>().asDiagonal() *
      StretchAxes(parameters.rotation).getRows();
  const double prior =
      KrigingTarget(variogram, KrigingTarget::divideBlock(sides, stretch)).variance;

  BlockVolumes found;
  found.blocks = grid.counts;
  std::vector<KrigedBlock> blocks;
  for (std::size_t begin = 0; begin < grid.size(); begin += lattice_block) {
    std::vector<std::array<double, 3>> middles;
    for (std::size_t i = begin; i < std::min(begin + lattice_block, grid.size()); ++i)
      middles.push_back(grid.middleOf(i));
    Report own;
    own.progress = report.progress;
    const InterpolatedFields answers = field.interpolate(middles, threads, own);
    for (std::size_t i = 0; i < middles.size(); ++i) {
      const double mean = answers.getValue(0, i), error = answers.getError(0, i);
      if (std::isfinite(mean) && (error == 0.0 || error * error < prior)) {
        const Vector3d middle(middles[i].data());
        blocks.push_back({middle, stretch * middle, mean, error});
      }
    }
  }
  found.estimated = blocks.size();
  if (blocks.empty())
    throw InvalidArgument("no_block_estimated", {});
  const ErrorSum errors(blocks, variogram);
  for (const double isovalue : parameters.isovalues)
    found.isovalues.push_back(sumUp(blocks,
                                    errors,
                                    isovalue,
                                    parameters.is_lower_outside ? 1.0 : -1.0,
                                    grid.sides.prod()));
  return found;
}

} // namespace pcl_uvol::detail
