// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/remeshing.h"

#include "common/parallel.h"
#include "mesh/half_edges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t remeshing_block = 1u << 10;

/** Share of the way to the mean of the neighbours, per round of smoothing. */
constexpr double relaxation = 0.7;

/** Share of the local length: shorter edges collapse, and none longer may come of it.
 */
constexpr double shortest_edge = 0.4, longest_edge = 1.4;

/** Share of the local length: a vertex that glides farther may have met another sheet.
 */
constexpr double farthest_vertex_move = 2.0;

/** Cosine of 60 degrees, between a triangle and its vertices' normals. */
constexpr double least_flip_agreement = 0.5;

/** A vertex of fewer neighbours would fold. */
constexpr std::size_t least_neighbors = 4;

constexpr int first_rounds = 5, later_rounds = 3, last_turns = 2, flip_passes = 5;

/** Passes over all edges, each of which leaves those that others nearby have spoilt; a
 * pass that removes a smaller part of the vertices is the last one. */
constexpr int collapse_passes = 30;
constexpr double least_collapsed = 0.01;

/** Local length of vertices over that of the edges that come of it, where it is the
 * same everywhere. */
constexpr double size_per_edge = 1.56;

/** Parts of a round or a pass that are told when they are done. */
constexpr std::size_t parts_of_pass = 16;

class Remesher {
public:
  Remesher(WorkingMesh& mesh, double edge_length, unsigned threads, StepTimer& step)
      : mesh_(mesh)
      , edges_(mesh.triangles, mesh.vertices.size())
      , is_gone_(mesh.triangles.size(), false)
      , threads_(threads)
      , step_(step)
  {
    feet_.reserve(mesh.vertices.size());
    for (WorkingVertex& vertex : mesh.vertices) {
      feet_.push_back(vertex.foot);
      vertex.size = std::max(vertex.size, size_per_edge * edge_length);
    }
  }

  void
  smooth(int rounds)
  {
    LargeArray<Foot> moved(mesh_.vertices.size());
    for (int round = 0; round < rounds; ++round) {
      parallelBlocks(
          moved.size(), remeshing_block, threads_, [&](auto begin, auto end) {
            std::vector<std::uint32_t> around;
            std::vector<Foot> feet;
            for (std::size_t i = begin; i < end; ++i) {
              const auto vertex = static_cast<std::uint32_t>(i);
              moved[i] = edges_.firstOf(vertex) == HalfEdges::none
                             ? mesh_.vertices[i].foot
                             : glide(vertex, around, feet);
            }
          });
      for (std::size_t i = 0; i < moved.size(); ++i)
        mesh_.vertices[i].foot = moved[i];
      step_.advance(parts_of_pass);
    }
  }

  void
  collapseShort()
  {
    std::size_t left = mesh_.vertices.size();
    int pass = 0;
    bool is_done = false;
    while (!is_done && pass < collapse_passes) {
      const std::size_t collapsed = collapseOnce();
      flipToDelaunay();
      left -= collapsed;
      is_done =
          static_cast<double>(collapsed) < least_collapsed * static_cast<double>(left);
      ++pass;
    }
    step_.advance(parts_of_pass * static_cast<std::uint64_t>(collapse_passes - pass));
  }

  void
  flipToDelaunay()
  {
    for (int pass = 0; pass < flip_passes; ++pass) {
      std::size_t flipped = 0;
      for (HalfEdge edge = 0; edge < 3 * mesh_.triangles.size(); ++edge)
        if (!is_gone_[edge / 3] && edges_.twinOf(edge) != HalfEdges::none &&
            edges_.originOf(edge) < edges_.targetOf(edge))
          flipped += flip(edge);
      if (flipped == 0)
        break;
    }
  }

  /** Leave out triangles that are gone. */
  void
  finish()
  {
    mesh_.dropTriangles([&](std::size_t i) { return is_gone_[i]; });
  }

private:
  /** One pass, of which step_ is told. */
  std::size_t
  collapseOnce()
  {
    std::vector<std::pair<double, HalfEdge>> shorts;
    for (HalfEdge edge = 0; edge < 3 * mesh_.triangles.size(); ++edge)
      if (!is_gone_[edge / 3] && edges_.originOf(edge) < edges_.targetOf(edge))
        if (const double length = lengthOf(edge); isShort(edge, length))
          shorts.emplace_back(length, edge);
    std::sort(shorts.begin(), shorts.end());
    std::size_t collapsed = 0;
    for (std::size_t part = 0; part < parts_of_pass; ++part) {
      const std::size_t end = shorts.size() * (part + 1) / parts_of_pass;
      for (std::size_t i = shorts.size() * part / parts_of_pass; i < end; ++i)
        if (const HalfEdge edge = shorts[i].second;
            !is_gone_[edge / 3] && isShort(edge, lengthOf(edge)))
          collapsed += collapse(edge);
      step_.advance(1);
    }
    return collapsed;
  }

  const Eigen::Vector3d&
  placeOf(std::uint32_t vertex) const
  {
    return mesh_.vertices[vertex].foot.place;
  }

  double
  lengthOf(HalfEdge edge) const
  {
    return (placeOf(edges_.targetOf(edge)) - placeOf(edges_.originOf(edge))).norm();
  }

  double
  sizeOf(HalfEdge edge) const
  {
    return 0.5 * (mesh_.vertices[edges_.originOf(edge)].size +
                  mesh_.vertices[edges_.targetOf(edge)].size);
  }

  bool
  isShort(HalfEdge edge, double length) const
  {
    return length < shortest_edge * sizeOf(edge);
  }

  /** The foot of a place that belongs to a vertex, by the feet that were there before
   * anything moved; where the surface meets a cap they are hardly known. */
  Foot
  footBelow(std::uint32_t vertex,
            const Eigen::Vector3d& place,
            const std::vector<std::uint32_t>& around,
            std::vector<Foot>& feet) const
  {
    const WorkingVertex& own = mesh_.vertices[vertex];
    if (!own.is_on_surface) {
      Foot foot = own.foot;
      foot.place = place;
      return foot;
    }
    feet.clear();
    if (own.sides == 0)
      feet.push_back(feet_[vertex]);
    for (const std::uint32_t other : around)
      if (mesh_.vertices[other].is_on_surface && mesh_.vertices[other].sides == 0)
        feet.push_back(feet_[other]);
    if (feet.empty())
      feet.push_back(feet_[vertex]);
    return mesh_.footBelow(own, place, feet);
  }

  /** Whether the surface meets a cap here, or caps one another. */
  bool
  isCrease(HalfEdge edge) const
  {
    return mesh_.regions[edge / 3] != mesh_.regions[edges_.twinOf(edge) / 3];
  }

  /** Where a vertex glides to; along the crease that it is on, if it is on one. */
  Foot
  glide(std::uint32_t vertex,
        std::vector<std::uint32_t>& around,
        std::vector<Foot>& feet) const
  {
    const WorkingVertex& own = mesh_.vertices[vertex];
    edges_.findAround(vertex, around);
    const int freedom = freedomOf(vertex);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    edges_.forEachAround(vertex, [&](HalfEdge edge) {
      if (freedom == 2 || (freedom == 1 && isCrease(edge))) {
        mean += placeOf(edges_.targetOf(edge));
        ++count;
      }
    });
    mean =
        count > 0 ? Eigen::Vector3d(mean / static_cast<double>(count)) : own.foot.place;
    Eigen::Vector3d way = relaxation * (mean - own.foot.place);
    way -= own.foot.normal.dot(way) * own.foot.normal;
    way = keepWithin(own.sides, way);
    const Foot moved = footBelow(vertex, own.foot.place + way, around, feet);
    const bool is_near =
        (moved.place - own.foot.place).norm() < farthest_vertex_move * own.size &&
        mesh_.isWithinBox(moved.place);
    return is_near ? moved : own.foot;
  }

  /** In how many directions a vertex may move: within the surface or a cap in two,
   * along a crease in one. */
  int
  freedomOf(std::uint32_t vertex) const
  {
    const WorkingVertex& own = mesh_.vertices[vertex];
    int freedom = own.is_on_surface ? 2 : 3;
    for (BoxSides sides = own.sides; sides != 0; sides &= sides - 1)
      --freedom;
    return std::max(freedom, 0);
  }

  /** Whether the ends of an edge may become one as far as regions go, where the first
   * one is the less free one: these keep their parts and their creases. */
  bool
  mayShrink(HalfEdge edge) const
  {
    const int freedom = freedomOf(edges_.targetOf(edge));
    if (freedom == 2)
      return true;
    for (const HalfEdge side : {edge, edges_.twinOf(edge)})
      if (isCrease(nextOf(side)) && isCrease(previousOf(side)))
        return false;
    return freedom == 1 && isCrease(edge);
  }

  bool
  collapse(HalfEdge edge)
  {
    if (freedomOf(edges_.targetOf(edge)) < freedomOf(edges_.originOf(edge)))
      edge = edges_.twinOf(edge);
    const std::uint32_t a = edges_.originOf(edge), b = edges_.targetOf(edge);
    WorkingVertex &kept = mesh_.vertices[a], &gone = mesh_.vertices[b];
    if (!mayShrink(edge))
      return false;
    edges_.findAround(a, around_);
    edges_.findAround(b, other_around_);
    if (!mayMerge(edge))
      return false;
    around_.insert(around_.end(), other_around_.begin(), other_around_.end());
    const bool is_fixed = freedomOf(a) < freedomOf(b);
    const Foot foot =
        is_fixed
            ? kept.foot
            : footBelow(
                  a, 0.5 * (kept.foot.place + gone.foot.place), around_, nearby_feet_);
    const double longest = longest_edge * sizeOf(edge);
    for (const std::uint32_t other : around_)
      if (other != a && other != b && (placeOf(other) - foot.place).norm() > longest)
        return false;
    const Foot kept_foot = kept.foot, gone_foot = gone.foot;
    kept.foot = gone.foot = foot;
    const std::size_t bad = countBadAround(edge);
    kept.foot = kept_foot;
    gone.foot = gone_foot;
    // Beside a crease triangles may be folded, of which fewer are left.
    if (bad > 0 && (freedomOf(a) == 2 || bad >= countBadAround(edge) + isBad(edge) +
                                                    isBad(edges_.twinOf(edge))))
      return false;
    is_gone_[edge / 3] = is_gone_[edges_.twinOf(edge) / 3] = true;
    edges_.collapse(edge);
    kept.foot = feet_[a] = foot;
    kept.size = 0.5 * (kept.size + gone.size);
    return true;
  }

  /** Whether the surface stays a manifold: the ends of the edge have two neighbours in
   * common, each of which keeps enough of its own. */
  bool
  mayMerge(HalfEdge edge)
  {
    std::size_t common = 0;
    for (const std::uint32_t other : around_)
      common += static_cast<std::size_t>(
          std::count(other_around_.begin(), other_around_.end(), other));
    if (common != 2)
      return false;
    for (const HalfEdge side : {edge, edges_.twinOf(edge)}) {
      edges_.findAround(edges_.originOf(previousOf(side)), tip_around_);
      if (tip_around_.size() < least_neighbors)
        return false;
    }
    return true;
  }

  /** How many triangles at the ends of an edge, but the two beside it, disagree with
   * their normals. */
  std::size_t
  countBadAround(HalfEdge edge) const
  {
    std::size_t bad = 0;
    for (const std::uint32_t end : {edges_.originOf(edge), edges_.targetOf(edge)})
      edges_.forEachAround(end, [&](HalfEdge out) {
        if (out / 3 != edge / 3 && out / 3 != edges_.twinOf(edge) / 3)
          bad += agreementOf(mesh_.triangles[out / 3], out) < least_flip_agreement;
      });
    return bad;
  }

  bool
  isBad(HalfEdge edge) const
  {
    return agreementOf(mesh_.triangles[edge / 3], edge) < least_flip_agreement;
  }

  /** The agreement of a triangle in the region of an edge. */
  double
  agreementOf(const Triangle& triangle, HalfEdge edge) const
  {
    return mesh_.agreementOf(triangle, mesh_.regions[edge / 3]);
  }

  bool
  flip(HalfEdge edge)
  {
    const HalfEdge twin = edges_.twinOf(edge);
    const std::uint32_t a = edges_.originOf(edge), b = edges_.targetOf(edge),
                        c = edges_.originOf(previousOf(edge)),
                        d = edges_.originOf(previousOf(twin));
    const Triangle first{a, d, c}, second{b, c, d};
    if (isCrease(edge))
      return false;
    const double before = std::min(agreementOf(mesh_.triangles[edge / 3], edge),
                                   agreementOf(mesh_.triangles[twin / 3], edge));
    const bool is_bad = before < least_flip_agreement;
    if (!is_bad && !isAgainstDelaunay(a, b, c, d))
      return false;
    const double after = std::min(agreementOf(first, edge), agreementOf(second, edge));
    if (is_bad ? after <= before : after < least_flip_agreement)
      return false;
    for (const std::uint32_t end : {a, b}) {
      edges_.findAround(end, around_);
      if (around_.size() < least_neighbors)
        return false;
    }
    edges_.findAround(c, around_);
    if (std::find(around_.begin(), around_.end(), d) != around_.end())
      return false;
    edges_.flip(edge);
    return true;
  }

  /** Whether the angles opposite of an edge are more than two right ones: the sum of
   * their cotangents is negative. */
  bool
  isAgainstDelaunay(std::uint32_t a,
                    std::uint32_t b,
                    std::uint32_t c,
                    std::uint32_t d) const
  {
    const auto cotangent = [&](std::uint32_t tip) {
      const Eigen::Vector3d u = placeOf(a) - placeOf(tip),
                            v = placeOf(b) - placeOf(tip);
      return u.dot(v) / u.cross(v).norm();
    };
    constexpr double rounding = 1e-9;
    return cotangent(c) + cotangent(d) < -rounding;
  }

  WorkingMesh& mesh_;
  HalfEdges edges_;
  LargeArray<Foot> feet_; // by vertex, where the surface is known
  std::vector<bool> is_gone_;
  unsigned threads_;
  StepTimer& step_;
  std::vector<std::uint32_t> around_, other_around_, tip_around_;
  std::vector<Foot> nearby_feet_;
};

} // namespace

void
remesh(WorkingMesh& mesh, double edge_length, unsigned threads, Report& report)
{
  StepTimer step(report,
                 "remeshing",
                 parts_of_pass *
                     (first_rounds + collapse_passes + last_turns * later_rounds));
  Remesher remesher(mesh, edge_length, threads, step);
  remesher.smooth(first_rounds);
  remesher.collapseShort();
  for (int i = 0; i < last_turns; ++i) {
    remesher.smooth(later_rounds);
    remesher.flipToDelaunay();
  }
  remesher.finish();
}

} // namespace pcl_uvol::detail
