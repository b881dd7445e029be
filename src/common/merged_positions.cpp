// SPDX-License-Identifier: BSD-3-Clause
#include "common/merged_positions.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

using Exact = std::array<double, 3>;
using Rounded = std::array<float, 3>;

/** Bits per point of a table of hashes: few points share one by chance. */
constexpr std::size_t table_bits = 8;

/** Positions that are compared, at least, and points per one that is: enough to tell of
 * merging, and few beside the points. */
constexpr std::size_t least_compared = 1u << 16, points_per_compared = 16;

/** Adding zero turns -0 into 0. */
Rounded
roundPosition(const Exact& position, const Exact& origin)
{
  Rounded rounded;
  for (std::size_t axis = 0; axis < 3; ++axis)
    rounded[axis] = static_cast<float>(position[axis] - origin[axis]) + 0.0f;
  return rounded;
}

bool
isFinite(const Rounded& position)
{
  return std::all_of(
      position.begin(), position.end(), [](float x) { return std::isfinite(x); });
}

/** Whether a position can be told from its rounded one: two of these that differ are
 * not rounded to the same. */
bool
isExact(const Exact& position, const Rounded& rounded, const Exact& origin)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (origin[axis] + rounded[axis] != position[axis])
      return false;
  return true;
}

/** The finalizer of SplitMix64, for each coordinate in turn. */
std::uint64_t
hashOf(const Rounded& position)
{
  std::uint64_t hash = 0;
  for (const float coordinate : position) {
    std::uint32_t bits;
    std::memcpy(&bits, &coordinate, sizeof(bits));
    hash += bits + 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    hash ^= hash >> 31;
  }
  return hash;
}

/** Which hashes have been seen, and which more than once; some seem to be. */
class HashTable {
public:
  explicit HashTable(std::size_t points)
  {
    std::size_t size = 64;
    while (size < table_bits * points)
      size *= 2;
    is_seen_.resize(size);
    is_repeated_.resize(size);
  }

  void
  add(std::uint64_t hash)
  {
    const std::size_t place = hash & (is_seen_.size() - 1);
    is_repeated_[place] = is_repeated_[place] || is_seen_[place];
    is_seen_[place] = true;
  }

  bool
  isRepeated(std::uint64_t hash) const
  {
    return is_repeated_[hash & (is_repeated_.size() - 1)];
  }

private:
  std::vector<bool> is_seen_, is_repeated_;
};

/** The other half of a hash. */
std::uint64_t
upper(std::uint64_t hash)
{
  return hash >> 32;
}

double
distance(const Exact& a, const Exact& b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

} // namespace

MergedPositions
findMergedPositions(std::size_t count,
                    const std::function<Exact(std::size_t)>& position_at,
                    const Exact& origin)
{
  // Of floats that are held as doubles none are merged, and there is no need to look.
  const auto isRounded = [&](std::size_t i) {
    const Exact position = position_at(i);
    const Rounded rounded = roundPosition(position, origin);
    return isFinite(rounded) && !isExact(position, rounded, origin);
  };
  std::size_t first_rounded = 0;
  while (first_rounded < count && !isRounded(first_rounded))
    ++first_rounded;
  if (first_rounded == count)
    return {};
  const auto forHashes = [&](const auto& visit) {
    for (std::size_t i = 0; i < count; ++i)
      if (const Rounded rounded = roundPosition(position_at(i), origin);
          isFinite(rounded))
        visit(hashOf(rounded), i, rounded);
  };
  // Two tables: what shares a place in one by chance hardly does in the other.
  HashTable lower_halves(count);
  forHashes(
      [&](std::uint64_t hash, std::size_t, const Rounded&) { lower_halves.add(hash); });
  HashTable upper_halves(count);
  bool has_repeated = false;
  forHashes([&](std::uint64_t hash, std::size_t, const Rounded&) {
    if (lower_halves.isRepeated(hash)) {
      upper_halves.add(upper(hash));
      has_repeated = has_repeated || upper_halves.isRepeated(upper(hash));
    }
  });
  const std::size_t most = std::max(least_compared, count / points_per_compared);
  std::set<std::pair<Rounded, Exact>> points;
  if (has_repeated)
    forHashes([&](std::uint64_t hash, std::size_t i, const Rounded& rounded) {
      if (lower_halves.isRepeated(hash) && upper_halves.isRepeated(upper(hash)) &&
          points.size() < most)
        points.emplace(rounded, position_at(i));
    });
  MergedPositions merged;
  auto first = points.begin();
  for (auto point = points.begin(); point != points.end(); ++point) {
    if (point->first != first->first)
      first = point;
    if (point == first)
      continue;
    ++merged.count;
    merged.distance = std::max(merged.distance, distance(point->second, first->second));
  }
  return merged;
}

std::optional<Message>
describe(const MergedPositions& merged)
{
  if (merged.count == 0)
    return std::nullopt;
  return Message("merged_positions",
                 {{"positions", merged.count}, {"distance", merged.distance}});
}

} // namespace pcl_uvol
