// SPDX-License-Identifier: BSD-3-Clause
#include "multivariate/cluster_hull.h"

#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr std::uint32_t no_face = std::numeric_limits<std::uint32_t>::max();

/** Connected pieces of equal label on a triangulated surface, each a disc. */
class Pieces {
public:
  Pieces(const std::vector<Triangle>& triangles,
         const std::vector<std::uint32_t>& regions)
      : triangles_(triangles)
      , piece_of_(regions.size(), no_face)
  {
    connect(regions.size());
    for (std::uint32_t vertex = 0; vertex < regions.size(); ++vertex)
      if (piece_of_[vertex] == no_face && neighborsOf(vertex).first != nullptr) {
        regions_.push_back(regions[vertex]);
        grow(vertex, regions);
      }
    for (std::uint32_t piece = 0; piece < regions_.size(); ++piece)
      cutToDiscs(piece);
  }

  const std::vector<std::uint32_t>&
  getPieces() const
  {
    return piece_of_;
  }

  const std::vector<std::uint32_t>&
  regions() const
  {
    return regions_;
  }

  std::uint32_t
  splits() const
  {
    return splits_;
  }

private:
  using Range = std::pair<const std::uint32_t*, const std::uint32_t*>;

  /** Neighbours and triangles of every vertex. */
  void
  connect(std::size_t vertices)
  {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Triangle& triangle : triangles_)
      for (int corner = 0; corner < 3; ++corner) {
        const std::uint32_t a = triangle[corner], b = triangle[(corner + 1) % 3];
        edges.emplace_back(a, b);
        edges.emplace_back(b, a);
      }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    edge_offsets_.assign(vertices + 1, 0);
    triangle_offsets_.assign(vertices + 1, 0);
    for (const auto& edge : edges) {
      ++edge_offsets_[edge.first + 1];
      neighbors_.push_back(edge.second);
    }
    for (const Triangle& triangle : triangles_)
      ++triangle_offsets_[triangle[0] + 1];
    for (std::size_t i = 0; i < vertices; ++i) {
      edge_offsets_[i + 1] += edge_offsets_[i];
      triangle_offsets_[i + 1] += triangle_offsets_[i];
    }
    auto next = triangle_offsets_;
    triangles_of_.resize(triangles_.size());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
      triangles_of_[next[triangles_[i][0]]++] = i;
  }

  Range
  neighborsOf(std::uint32_t vertex) const
  {
    const std::size_t begin = edge_offsets_[vertex], end = edge_offsets_[vertex + 1];
    if (begin == end)
      return {nullptr, nullptr};
    return {&neighbors_[begin], &neighbors_[begin] + (end - begin)};
  }

  void
  grow(std::uint32_t seed, const std::vector<std::uint32_t>& regions)
  {
    const auto piece = static_cast<std::uint32_t>(vertices_.size());
    std::vector<std::uint32_t> found = {seed};
    piece_of_[seed] = piece;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Range range = neighborsOf(found[i]);
      for (const std::uint32_t* other = range.first; other != range.second; ++other)
        if (piece_of_[*other] == no_face && regions[*other] == regions[seed]) {
          piece_of_[*other] = piece;
          found.push_back(*other);
        }
    }
    vertices_.push_back(std::move(found));
  }

  /** Euler characteristic of what a piece's vertices span: 1 for a disc. */
  std::int64_t
  eulerCharacteristic(std::uint32_t piece) const
  {
    std::int64_t directed_edges = 0, faces = 0;
    for (const std::uint32_t vertex : vertices_[piece]) {
      const Range range = neighborsOf(vertex);
      directed_edges +=
          std::count_if(range.first, range.second, [&](std::uint32_t other) {
            return piece_of_[other] == piece;
          });
      for (std::size_t i = triangle_offsets_[vertex]; i < triangle_offsets_[vertex + 1];
           ++i) {
        const Triangle& triangle = triangles_[triangles_of_[i]];
        faces += piece_of_[triangle[1]] == piece && piece_of_[triangle[2]] == piece;
      }
    }
    return static_cast<std::int64_t>(vertices_[piece].size()) - directed_edges / 2 +
           faces;
  }

  /** A piece that reaches around a hole is cut in two halves, each nearer to one of two
   * ends of it; a whole component of the surface stays as it is. */
  void
  cutToDiscs(std::uint32_t piece)
  {
    std::vector<std::uint32_t> open = {piece};
    while (!open.empty()) {
      const std::uint32_t next = open.back();
      open.pop_back();
      if (eulerCharacteristic(next) >= 1)
        continue;
      halve(next);
      ++splits_;
      open.push_back(next);
      open.push_back(static_cast<std::uint32_t>(vertices_.size() - 1));
    }
  }

  void
  halve(std::uint32_t piece)
  {
    const std::uint32_t far = walk(piece, {vertices_[piece].front()}, nullptr).back();
    const std::uint32_t opposite = walk(piece, {far}, nullptr).back();
    std::vector<std::uint8_t> side;
    const auto order = walk(piece, {far, opposite}, &side);
    const auto half = static_cast<std::uint32_t>(vertices_.size());
    std::vector<std::uint32_t> stay, leave;
    for (std::size_t i = 0; i < order.size(); ++i) {
      (side[i] == 0 ? stay : leave).push_back(order[i]);
      if (side[i] == 1)
        piece_of_[order[i]] = half;
    }
    vertices_[piece] = std::move(stay);
    vertices_.push_back(std::move(leave));
    regions_.push_back(regions_[piece]);
  }

  /** The vertices of a piece by their distance, in edges, from some of them.
   * \param side null, or set to the index of the start that each was reached from */
  std::vector<std::uint32_t>
  walk(std::uint32_t piece,
       const std::vector<std::uint32_t>& starts,
       std::vector<std::uint8_t>* side) const
  {
    std::vector<std::uint32_t> order;
    std::vector<std::uint8_t> reached_from;
    std::vector<std::uint32_t> members = vertices_[piece];
    std::sort(members.begin(), members.end());
    std::vector<bool> seen(members.size(), false);
    const auto visit = [&](std::uint32_t vertex, std::uint8_t start) {
      const auto place = static_cast<std::size_t>(
          std::lower_bound(members.begin(), members.end(), vertex) - members.begin());
      if (seen[place])
        return;
      seen[place] = true;
      order.push_back(vertex);
      reached_from.push_back(start);
    };
    for (std::size_t i = 0; i < starts.size(); ++i)
      visit(starts[i], static_cast<std::uint8_t>(i));
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Range range = neighborsOf(order[i]);
      for (const std::uint32_t* other = range.first; other != range.second; ++other)
        if (piece_of_[*other] == piece)
          visit(*other, reached_from[i]);
    }
    if (side != nullptr)
      *side = std::move(reached_from);
    return order;
  }

  const std::vector<Triangle>& triangles_;
  std::vector<std::size_t> edge_offsets_, triangle_offsets_;
  std::vector<std::uint32_t> neighbors_;    ///< per vertex, ascending
  std::vector<std::uint32_t> triangles_of_; ///< per vertex, those that start there
  std::vector<std::uint32_t> piece_of_;     ///< per vertex
  std::vector<std::vector<std::uint32_t>> vertices_; ///< per piece
  std::vector<std::uint32_t> regions_;               ///< per piece
  std::uint32_t splits_ = 0;
};

} // namespace

ClusterHull
makeClusterHull(const std::vector<Triangle>& surface,
                const std::vector<std::uint32_t>& regions)
{
  for (const Triangle& triangle : surface)
    for (const std::uint32_t corner : triangle)
      if (corner >= regions.size())
        throw InvalidArgument("vertex_without_region",
                              {{"vertex", corner}, {"regions", regions.size()}});
  const Pieces pieces(surface, regions);
  const auto& piece_of = pieces.getPieces();
  ClusterHull hull;
  hull.split_pieces = pieces.splits();
  std::vector<std::uint32_t> number_of(pieces.regions().size(), no_face);
  for (const Triangle& triangle : surface) {
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = piece_of[triangle[i]];
    if (corners[0] == corners[1] || corners[1] == corners[2] ||
        corners[2] == corners[0])
      continue;
    for (std::uint32_t& corner : corners) {
      if (number_of[corner] == no_face) {
        number_of[corner] = static_cast<std::uint32_t>(hull.regions.size());
        hull.regions.push_back(pieces.regions()[corner]);
      }
      corner = number_of[corner];
    }
    hull.triangles.push_back(corners);
  }
  return hull;
}

} // namespace pcl_uvol
