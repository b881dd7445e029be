// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/dual_surface.h"

#include "common/parallel.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pcl_uvol::detail {

namespace {

/** Enough for the cells of one pair to serve the next ones. */
constexpr std::size_t block_pairs = 1u << 11;

/** Four cells that meet in a corner, positively oriented. */
using Corner = std::array<std::uint32_t, 4>;

CellPair
pairOf(std::uint32_t a, std::uint32_t b)
{
  return {std::min(a, b), std::max(a, b)};
}

/** The triangles within one corner after another. */
class Marcher {
public:
  Marcher(const std::vector<CellPair>& pairs,
          const CellSide& is_above,
          const PairDistance& distance,
          std::vector<Triangle>& triangles)
      : pairs_(pairs)
      , is_above_(is_above)
      , distance_(distance)
      , triangles_(triangles)
  {
  }

  /** Append the triangles of a corner if this is the first of its pairs. */
  void
  march(std::size_t pair, Corner corner)
  {
    std::array<bool, 4> above;
    for (std::size_t i = 0; i < 4; ++i)
      above[i] = is_above_(corner[i]);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        if (above[i] != above[j] && pairOf(corner[i], corner[j]) < pairs_[pair])
          return;
    const auto count = std::count(above.begin(), above.end(), true);
    const bool rare = count < 3; // the side of one or two cells
    const auto first = static_cast<std::size_t>(
        std::find(above.begin(), above.end(), rare) - above.begin());
    if (count != 2)
      return addTriangle(reorder(corner, first, 1), !rare);
    const auto second = static_cast<std::size_t>(
        std::find(
            above.begin() + static_cast<std::ptrdiff_t>(first) + 1, above.end(), true) -
        above.begin());
    addQuadrangle(reorder(corner, first, first ^ second));
  }

private:
  /** The cells in another order of the same orientation, which starts with one cell and
   * that whose place differs from it by the given bits. */
  static Corner
  reorder(const Corner& corner, std::size_t first, std::size_t bits)
  {
    // Even permutations of four places; an exclusive or with the same number makes
    // another one of each.
    constexpr std::size_t order[][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}};
    Corner reordered;
    for (std::size_t i = 0; i < 4; ++i)
      reordered[i] = corner[order[bits - 1][i] ^ first];
    return reordered;
  }

  std::uint32_t
  findVertex(std::uint32_t a, std::uint32_t b) const
  {
    const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), pairOf(a, b));
    return static_cast<std::uint32_t>(found - pairs_.begin());
  }

  /** The first cell is alone on its side. */
  void
  addTriangle(const Corner& corner, bool is_below)
  {
    const std::uint32_t a = findVertex(corner[0], corner[1]),
                        b = findVertex(corner[0], corner[2]),
                        c = findVertex(corner[0], corner[3]);
    triangles_.push_back(is_below ? Triangle{a, c, b} : Triangle{a, b, c});
  }

  /** The first two cells are above. */
  void
  addQuadrangle(const Corner& corner)
  {
    const std::uint32_t around[] = {findVertex(corner[0], corner[2]),
                                    findVertex(corner[0], corner[3]),
                                    findVertex(corner[1], corner[3]),
                                    findVertex(corner[1], corner[2])};
    // No other corner draws these diagonals: the two pairs of one name all four cells.
    const bool is_first = distance_(pairs_[around[0]], pairs_[around[2]]) <=
                          distance_(pairs_[around[1]], pairs_[around[3]]);
    const std::size_t s = is_first ? 0 : 1;
    triangles_.push_back({around[s], around[s + 1], around[s + 2]});
    triangles_.push_back({around[s], around[s + 2], around[(s + 3) % 4]});
  }

  const std::vector<CellPair>& pairs_;
  const CellSide& is_above_;
  const PairDistance& distance_;
  std::vector<Triangle>& triangles_;
};

} // namespace

std::vector<Triangle>
marchTetrahedra(const CellTiling& tiling,
                const std::vector<CellPair>& pairs,
                const CellSide& is_above,
                const PairDistance& distance,
                const PairsDone& done,
                unsigned threads)
{
  return parallelGather<Triangle>(
      pairs.size(),
      block_pairs,
      threads,
      [&](std::size_t begin, std::size_t end, std::vector<Triangle>& triangles) {
        Marcher marcher(pairs, is_above, distance, triangles);
        CellCache cache(tiling);
        std::vector<std::uint32_t> ring;
        for (std::size_t i = begin; i < end; ++i) {
          const auto [a, b] = pairs[i];
          tiling.findRing(a, b, cache, ring);
          for (std::size_t k = 0; k < ring.size(); ++k)
            marcher.march(i, {a, b, ring[(k + 1) % ring.size()], ring[k]});
        }
        done(begin, end);
      });
}

} // namespace pcl_uvol::detail
