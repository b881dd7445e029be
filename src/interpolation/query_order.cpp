// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/query_order.h"

#include "common/parallel.h"

#include <algorithm>
#include <numeric>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t order_block = 1u << 14;

/** Bits per axis of the curve: three of them make a number of 63. */
constexpr int axis_bits = 21;

/** Leave two zeros behind every bit. */
std::uint64_t
spreadBits(std::uint64_t x)
{
  x = (x | x << 32) & 0x1f00000000ffffu;
  x = (x | x << 16) & 0x1f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  x = (x | x << 2) & 0x1249249249249249u;
  return x;
}

/** Place on the Z-order curve (Morton 1966). */
std::uint64_t
placeOnCurve(const Query& query, const KdBox& box)
{
  constexpr double cells = 1u << axis_bits;
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis], extent = box.high[axis] - low;
    const double part = extent > 0.0 ? (query.x[axis] - low) / extent : 0.0;
    const double cell = std::clamp(part * cells, 0.0, cells - 1.0);
    place |= spreadBits(static_cast<std::uint64_t>(cell)) << axis;
  }
  return place;
}

} // namespace

std::vector<std::uint32_t>
orderInSpace(const std::vector<Query>& queries, const KdBox& box, unsigned threads)
{
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places(queries.size());
  parallelBlocks(queries.size(), order_block, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      places[i] = {placeOnCurve(queries[i], box), static_cast<std::uint32_t>(i)};
  });
  if (!std::is_sorted(places.begin(), places.end()))
    parallelSort(places.begin(), places.end(), threads, std::less<>());
  std::vector<std::uint32_t> order(queries.size());
  std::transform(places.begin(), places.end(), order.begin(), [](const auto& place) {
    return place.second;
  });
  return order;
}

} // namespace pcl_uvol::detail
