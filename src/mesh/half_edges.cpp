// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/half_edges.h"

#include <algorithm>

namespace pcl_uvol::detail {

HalfEdges::HalfEdges(std::vector<Triangle>& triangles, std::size_t vertices)
    : triangles_(triangles)
    , twins_(3 * triangles.size(), none)
    , firsts_(vertices, none)
{
  // Half edges by their origins.
  std::vector<std::uint32_t> begin(vertices + 1, 0);
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t vertex : triangle)
      ++begin[vertex + 1];
  for (std::size_t i = 0; i < vertices; ++i)
    begin[i + 1] += begin[i];
  struct Outgoing {
    std::uint32_t target;
    HalfEdge edge;
  };
  std::vector<Outgoing> from(twins_.size());
  std::vector<std::uint32_t> end(begin.begin(), begin.end() - 1);
  for (HalfEdge edge = 0; edge < twins_.size(); ++edge)
    from[end[originOf(edge)]++] = {targetOf(edge), edge};

  // By their targets: in broken files many triangles share one vertex, or one edge.
  const auto isBefore = [](const Outgoing& a, const Outgoing& b) {
    return a.target < b.target;
  };
  for (std::size_t i = 0; i < vertices; ++i)
    std::sort(from.begin() + begin[i], from.begin() + begin[i + 1], isBefore);
  const auto countOf = [&](std::uint32_t origin, std::uint32_t target) {
    const auto [first, last] = std::equal_range(from.begin() + begin[origin],
                                                from.begin() + begin[origin + 1],
                                                Outgoing{target, none},
                                                isBefore);
    return std::pair(last - first, first == last ? none : first->edge);
  };
  for (HalfEdge edge = 0; edge < twins_.size(); ++edge) {
    const std::uint32_t a = originOf(edge), b = targetOf(edge);
    const std::ptrdiff_t same = countOf(a, b).first;
    const auto [opposite, twin] = countOf(b, a);
    defects_.edges += a == b || same > 1 || opposite > 1;
    if (a != b && same == 1 && opposite == 1)
      twins_[edge] = twin;
  }
  for (HalfEdge edge = 0; edge < twins_.size(); ++edge) {
    HalfEdge& first = firsts_[originOf(edge)];
    if (first == none || twins_[edge] == none)
      first = edge;
  }
  for (std::uint32_t vertex = 0; vertex < vertices; ++vertex)
    if (firsts_[vertex] != none) {
      std::uint32_t met = 0;
      forEachAround(vertex, [&](HalfEdge) { ++met; });
      defects_.vertices += met != begin[vertex + 1] - begin[vertex];
    }
}

void
HalfEdges::findAround(std::uint32_t vertex, std::vector<std::uint32_t>& around) const
{
  around.clear();
  HalfEdge last = none;
  forEachAround(vertex, [&](HalfEdge edge) {
    around.push_back(targetOf(edge));
    last = previousOf(edge);
  });
  if (twins_[last] == none)
    around.push_back(originOf(last));
}

std::size_t
HalfEdges::countRimEdges() const
{
  return static_cast<std::size_t>(std::count(twins_.begin(), twins_.end(), none));
}

void
HalfEdges::join(HalfEdge a, HalfEdge b)
{
  if (a != none)
    twins_[a] = b;
  if (b != none)
    twins_[b] = a;
}

void
HalfEdges::collapse(HalfEdge edge)
{
  const HalfEdge other = twins_[edge];
  const std::uint32_t kept = originOf(edge), gone = targetOf(edge);
  const auto closeGap = [&](HalfEdge side) {
    // Only the twins of the triangle's other two edges stay, as each other's.
    const HalfEdge a = twins_[nextOf(side)], b = twins_[previousOf(side)];
    const std::uint32_t tip = originOf(previousOf(side));
    if (firsts_[tip] == previousOf(side))
      firsts_[tip] = a;
    join(a, b);
    return b;
  };
  forEachAround(gone, [&](HalfEdge out) { triangles_[out / 3][out % 3] = kept; });
  firsts_[kept] = closeGap(edge);
  closeGap(other);
  firsts_[gone] = none;
}

void
HalfEdges::flip(HalfEdge edge)
{
  const HalfEdge other = twins_[edge];
  const HalfEdge next = nextOf(edge), previous = previousOf(edge);
  const HalfEdge other_next = nextOf(other), other_previous = previousOf(other);
  const std::uint32_t a = originOf(edge), b = originOf(other);
  const std::uint32_t c = originOf(previous), d = originOf(other_previous);
  const HalfEdge to_c = twins_[next], from_c = twins_[previous];
  const HalfEdge to_d = twins_[other_next], from_d = twins_[other_previous];
  // (a, b, c) and (b, a, d) become (a, d, c) and (b, c, d).
  Triangle& first = triangles_[edge / 3];
  Triangle& second = triangles_[other / 3];
  first[next % 3] = d;
  second[other_next % 3] = c;
  join(edge, to_d);
  join(next, other_next);
  join(previous, from_c);
  join(other, to_c);
  join(other_previous, from_d);
  const auto renew = [&](std::uint32_t vertex, HalfEdge from) {
    if (firsts_[vertex] == none || twins_[firsts_[vertex]] != none ||
        originOf(firsts_[vertex]) != vertex)
      firsts_[vertex] = from;
  };
  renew(a, edge);
  renew(b, other);
  renew(c, previous);
  renew(d, other_previous);
}

} // namespace pcl_uvol::detail
