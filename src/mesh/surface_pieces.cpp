// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/surface_pieces.h"

#include "mesh/disjoint_sets.h"
#include "mesh/half_edges.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace pcl_uvol::detail {

namespace {

/** Closed lines of half edges without a twin, added to the pieces of their vertices. */
void
countRims(const HalfEdges& edges, std::size_t count, PieceList& list)
{
  std::vector<bool> is_met(count);
  for (HalfEdge start = 0; start < count; ++start) {
    if (is_met[start] || edges.twinOf(start) != HalfEdges::none)
      continue;
    const auto piece = static_cast<std::size_t>(list.of_vertex[edges.originOf(start)]);
    ++list.pieces[piece].rims;
    for (HalfEdge edge = start; !is_met[edge];
         edge = edges.firstOf(edges.targetOf(edge)))
      is_met[edge] = true;
  }
}

/** What pieces are sorted by. */
std::uint32_t
sizeOf(const SurfacePiece& piece)
{
  return piece.triangles > 0 ? piece.triangles : piece.vertices;
}

} // namespace

PieceList
findPieces(std::vector<Triangle>& triangles, std::size_t vertices)
{
  const HalfEdges edges(triangles, vertices);
  const ManifoldDefects& defects = edges.getDefects();
  if (defects.edges > 0 || defects.vertices > 0)
    throw std::logic_error("The mesh has " + std::to_string(defects.edges) +
                           " edges and " + std::to_string(defects.vertices) +
                           " vertices at which it is not a manifold: this is a defect "
                           "of the program, please "
                           "report it together with the samples.");
  DisjointSets sets(vertices);
  for (const Triangle& triangle : triangles) {
    sets.join(triangle[0], triangle[1]);
    sets.join(triangle[1], triangle[2]);
  }
  PieceList list;
  list.of_vertex.assign(vertices, -1);
  std::vector<std::int32_t> number(vertices, -1);
  std::vector<std::size_t> half_edges, rim_edges;
  for (HalfEdge edge = 0; edge < 3 * triangles.size(); ++edge) {
    const std::uint32_t vertex = edges.originOf(edge), root = sets.find(vertex);
    if (number[root] < 0) {
      number[root] = static_cast<std::int32_t>(list.pieces.size());
      list.pieces.push_back({0.0, 0, 0, 0, 0});
      half_edges.push_back(0);
      rim_edges.push_back(0);
    }
    const auto piece = static_cast<std::size_t>(number[root]);
    ++half_edges[piece];
    rim_edges[piece] += edges.twinOf(edge) == HalfEdges::none;
    list.pieces[piece].vertices += list.of_vertex[vertex] < 0;
    list.of_vertex[vertex] = number[root];
  }
  list.rim_edges = edges.countRimEdges();
  countRims(edges, 3 * triangles.size(), list);
  for (std::size_t i = 0; i < list.pieces.size(); ++i) {
    SurfacePiece& piece = list.pieces[i];
    piece.triangles = static_cast<std::uint32_t>(half_edges[i] / 3);
    // Euler: vertices - edges + triangles = 2 - 2 genus - rims.
    const auto all_edges = static_cast<std::int64_t>(half_edges[i] + rim_edges[i]) / 2;
    const std::int64_t euler =
        std::int64_t{piece.vertices} - all_edges + piece.triangles;
    piece.genus =
        static_cast<std::uint32_t>((2 - std::int64_t{piece.rims} - euler) / 2);
  }
  sortPieces(list);
  return list;
}

void
sortPieces(PieceList& list)
{
  std::vector<std::uint32_t> first(list.pieces.size());
  for (std::size_t i = list.of_vertex.size(); i-- > 0;)
    if (list.of_vertex[i] >= 0)
      first[static_cast<std::size_t>(list.of_vertex[i])] =
          static_cast<std::uint32_t>(i);
  std::vector<std::size_t> order(list.pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::make_pair(sizeOf(list.pieces[b]), first[a]) <
           std::make_pair(sizeOf(list.pieces[a]), first[b]);
  });
  std::vector<std::int32_t> place(order.size());
  std::vector<SurfacePiece> sorted;
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = static_cast<std::int32_t>(i);
    sorted.push_back(list.pieces[order[i]]);
  }
  list.pieces = std::move(sorted);
  for (std::int32_t& piece : list.of_vertex)
    if (piece >= 0)
      piece = place[static_cast<std::size_t>(piece)];
}

std::size_t
splitPinchedVertices(std::vector<Triangle>& triangles,
                     std::size_t vertices,
                     std::vector<std::uint32_t>& source_of)
{
  const HalfEdges edges(triangles, vertices);
  if (edges.getDefects().vertices == 0)
    return 0;
  std::vector<bool> is_met(3 * triangles.size());
  for (std::uint32_t vertex = 0; vertex < vertices; ++vertex)
    if (edges.firstOf(vertex) != HalfEdges::none)
      edges.forEachAround(vertex, [&](HalfEdge edge) { is_met[edge] = true; });
  std::vector<std::pair<HalfEdge, std::uint32_t>> renamed;
  std::size_t copies = 0;
  const auto rename = [&](HalfEdge start) {
    const auto copy = static_cast<std::uint32_t>(vertices + copies++);
    source_of.push_back(edges.originOf(start));
    for (HalfEdge edge = start; edge != HalfEdges::none && !is_met[edge];
         edge = edges.twinOf(previousOf(edge))) {
      is_met[edge] = true;
      renamed.emplace_back(edge, copy);
    }
  };
  // Fans begin at half edges without a twin; what is left then are rounds.
  for (HalfEdge start = 0; start < is_met.size(); ++start)
    if (!is_met[start] && edges.twinOf(start) == HalfEdges::none)
      rename(start);
  for (HalfEdge start = 0; start < is_met.size(); ++start)
    if (!is_met[start])
      rename(start);
  for (const auto& [edge, copy] : renamed)
    triangles[edge / 3][edge % 3] = copy;
  return copies;
}

} // namespace pcl_uvol::detail
