// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/gap_lattice.h"

#include "common/random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace pcl_uvol::detail {

namespace {

/** Share of the spacing of the lattice: its nodes are moved so far along each axis, at
 * most, since edges slip between samples on a lattice. */
constexpr double jitter = 0.25;

/** Beyond it along an axis, which takes an outlier, no surface is followed. */
constexpr double farthest_node = (1 << 20) - 4;

} // namespace

Lattice::Lattice(double spacing, const Eigen::Array3f& scale, const SampleSet& samples)
    : spacing_(spacing)
    , scale_(scale)
{
  const KdTree& tree = samples.getTree();
  const KdBox box = tree.getBox(tree.getRoot());
  for (int axis = 0; axis < 3; ++axis)
    origin_[static_cast<std::size_t>(axis)] =
        samples.getUnit().toInput(static_cast<double>(box.low[axis]));
}

Place
Lattice::placeOf(const LatticeNode& node) const
{
  std::uint64_t hash = 0;
  for (const std::int32_t coordinate : node)
    hash = mixBits(hash ^ static_cast<std::uint64_t>(coordinate));
  Place place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double shift = jitter * (2.0 * uniformAt(hash, axis, 0) - 1.0);
    const double stretched =
        origin_[axis] + spacing_ * (static_cast<double>(node[axis]) + shift);
    place[axis] = static_cast<double>(static_cast<float>(stretched / factor(axis)));
  }
  return place;
}

LatticeNode
Lattice::cellOf(const Place& place) const
{
  LatticeNode node;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double steps = (place[axis] * factor(axis) - origin_[axis]) / spacing_;
    node[axis] =
        static_cast<std::int32_t>(std::clamp(std::floor(steps), 0.0, farthest_node));
  }
  return node;
}

std::vector<Composite>
averageInCells(std::vector<Composite> samples)
{
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return std::tie(a.cell, a.place, a.value) < std::tie(b.cell, b.place, b.value);
  });
  std::vector<Composite> means;
  for (auto begin = samples.begin(); begin != samples.end();) {
    const auto end = std::find_if(begin, samples.end(), [&](const Composite& sample) {
      return sample.cell != begin->cell;
    });
    const auto count = static_cast<double>(end - begin);
    Composite mean{begin->cell, {}, 0.0};
    for (; begin != end; ++begin) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        mean.place[axis] += begin->place[axis] / count;
      mean.value += begin->value / count;
    }
    means.push_back(mean);
  }
  return means;
}

} // namespace pcl_uvol::detail
