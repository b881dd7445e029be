// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/measured_points.h"

#include "mesh/disjoint_sets.h"
#include "mesh/point_fans.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/point_types.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_uvol::detail {

namespace {

/** Share of the root of the sum of squares of what is not agreed on: at least three
 * times what it makes on spheres and tori. */
constexpr double disagreement = 0.2;

/** More points without a triangle, or with neighbours that look to the other side, are
 * worth a warning. @{ */
constexpr double most_alone = 0.05, most_contrary = 0.05;
/** @} */

/** Share of the area: where more is in gaps, the area is not known to a third. */
constexpr double most_in_gaps = 1.0 / 3.0;

/** Corners and isovalues of points, in the order of samples. */
struct SortedPoints {
  SampleSet::ConstPtr samples;
  std::vector<SurfaceCorner> corners;
  std::vector<double> isovalues;
  std::vector<bool> is_in_gap; ///< by their support, if they have it

  bool
  isInGap(std::uint32_t point) const
  {
    return !is_in_gap.empty() && is_in_gap[point];
  }
};

/** Whether an isopoint lies in a gap of the samples or at its rim. */
bool
isInGap(double support)
{
  return support == static_cast<double>(IsoSupport::Bridged) ||
         support == static_cast<double>(IsoSupport::Rim);
}

SortedPoints
sortPoints(const CloudView& points,
           const std::vector<SurfaceCorner>& corners,
           unsigned threads,
           Report& report)
{
  std::vector<std::uint32_t> use;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corners[i].place.allFinite() && !corners[i].normal.isZero())
      use.push_back(static_cast<std::uint32_t>(i));
  if (use.empty())
    throw InvalidArgument("surface_points_without_normal", {});
  SortedPoints sorted;
  sorted.samples = SampleSet::build(points.xyz(0),
                                    points.stride(),
                                    use,
                                    Position{{1.0f, 1.0f, 1.0f}},
                                    threads,
                                    report);
  const std::optional<ScalarField> isovalue = findScalar(points, "isovalue"),
                                   support = findScalar(points, "support");
  for (std::size_t i = 0; i < sorted.samples->size(); ++i) {
    const std::uint32_t source = sorted.samples->getInputIndex(i);
    sorted.corners.push_back(corners[source]);
    if (isovalue)
      sorted.isovalues.push_back(isovalue->read(points.point(source)));
    if (support)
      sorted.is_in_gap.push_back(isInGap(support->read(points.point(source))));
  }
  return sorted;
}

/** Parts of the area of a flat triangle that are nearest to its first corner. */
double
voronoiPart(const SurfaceCorner& a, const SurfaceCorner& b, const SurfaceCorner& c)
{
  const Eigen::Vector3d ab = b.place - a.place, ac = c.place - a.place,
                        bc = c.place - b.place;
  const double sq_area = ab.cross(ac).squaredNorm(); // four times that of the triangle
  if (sq_area == 0.0)
    return 0.0;
  return (ab.squaredNorm() * ac.dot(bc) - ac.squaredNorm() * ab.dot(bc)) /
         (4.0 * sq_area);
}

/** Makes a surface of points. */
class PointSurface {
public:
  PointSurface(const SortedPoints& points, const PointFans& fans, std::size_t count)
      : points_(points)
      , fans_(fans)
  {
    surface.list.of_vertex.assign(count, -1);
    surface.shares.assign(count, 0.0);
    surface.sources.resize(count);
    std::iota(surface.sources.begin(), surface.sources.end(), 0u);
  }

  void
  findPieces()
  {
    const std::size_t count = points_.corners.size();
    DisjointSets sets(count);
    for (std::uint32_t i = 0; i < count; ++i)
      for (const FanTriangle& others : fans_.getFan(i)) {
        sets.join(i, others[0]);
        sets.join(i, others[1]);
      }
    std::vector<std::int32_t> number(count, -1);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (fans_.getFan(i).empty())
        continue;
      std::int32_t& piece = number[sets.find(i)];
      if (piece < 0) {
        piece = static_cast<std::int32_t>(surface.list.pieces.size());
        surface.list.pieces.push_back({0.0, 0, 0, 0, 0});
      }
      SurfacePiece& own = surface.list.pieces[static_cast<std::size_t>(piece)];
      ++own.vertices;
      own.rims |= fans_.isOnRim(i) ? 1u : 0u;
      surface.list.of_vertex[sourceOf(i)] = piece;
    }
    sortPieces(surface.list);
  }

  void
  integrate()
  {
    surface.integrals.resize(surface.list.pieces.size());
    uncertain_.resize(surface.list.pieces.size());
    for (std::uint32_t i = 0; i < points_.corners.size(); ++i)
      for (const FanTriangle& others : fans_.getFan(i)) {
        const bool is_agreed = fans_.isAgreedOn(i, others);
        if (!is_agreed || (i < others[0] && i < others[1]))
          add(i, others, is_agreed);
      }
    clearNegativeShares();
    // Where the surface ends is known no better than by a point, nor whether it goes
    // on in gaps of the samples.
    for (std::uint32_t i = 0; i < points_.corners.size(); ++i)
      if ((fans_.isOnRim(i) || points_.isInGap(i)) && !fans_.getFan(i).empty())
        surface.integrals[pieceOf(i)].area_error += surface.shares[sourceOf(i)];
    for (std::size_t piece = 0; piece < uncertain_.size(); ++piece) {
      SurfaceIntegrals& all = surface.integrals[piece];
      all.area_error += disagreement * std::sqrt(uncertain_[piece].area_error);
      all.volume_error += disagreement * std::sqrt(uncertain_[piece].volume_error);
    }
  }

  void
  warnOfGaps(Report& report) const
  {
    double area = 0.0, in_gaps = 0.0;
    for (std::uint32_t i = 0; i < points_.corners.size(); ++i) {
      const double share = surface.shares[sourceOf(i)];
      area += share;
      in_gaps += points_.isInGap(i) ? share : 0.0;
    }
    if (in_gaps > most_in_gaps * area)
      report.warn("area_in_gaps", {{"percent", std::lround(100.0 * in_gaps / area)}});
  }

  MeasuredSurface surface;

private:
  /** Fields are averaged by shares: negative ones, of thin triangles that not all of
   * their corners know, become 0, and the others as much smaller. If little but these
   * is left, the area is that of the others. */
  void
  clearNegativeShares()
  {
    std::vector<double> sums(surface.integrals.size()), positive(sums.size());
    const auto forShares = [&](const auto& visit) {
      for (std::uint32_t i = 0; i < points_.corners.size(); ++i)
        if (!fans_.getFan(i).empty())
          visit(pieceOf(i), surface.shares[sourceOf(i)]);
    };
    forShares([&](std::size_t piece, double& share) {
      sums[piece] += share;
      share = std::max(0.0, share);
      positive[piece] += share;
    });
    forShares([&](std::size_t piece, double& share) {
      if (sums[piece] > 0.0 && sums[piece] < positive[piece])
        share *= sums[piece] / positive[piece];
    });
    for (std::size_t piece = 0; piece < sums.size(); ++piece)
      if (sums[piece] <= 0.0) {
        surface.integrals[piece].area = positive[piece];
        surface.integrals[piece].area_error += positive[piece] - sums[piece];
      }
  }

  std::uint32_t
  sourceOf(std::uint32_t point) const
  {
    return points_.samples->getInputIndex(point);
  }

  std::size_t
  pieceOf(std::uint32_t point) const
  {
    return static_cast<std::size_t>(surface.list.of_vertex[sourceOf(point)]);
  }

  void
  add(std::uint32_t point, const FanTriangle& others, bool is_agreed)
  {
    const std::uint32_t sources[] = {
        sourceOf(point), sourceOf(others[0]), sourceOf(others[1])};
    const std::size_t piece = pieceOf(point);
    const SurfaceCorner &a = points_.corners[point], &b = points_.corners[others[0]],
                        &c = points_.corners[others[1]];
    std::array<double, 3> shares;
    const SurfaceIntegrals whole =
        CurvedTriangle({a, b, c}, surface.bounds[piece].center()).integrate(shares);
    if (is_agreed) {
      surface.integrals[piece].add(whole);
      for (std::size_t i = 0; i < 3; ++i)
        surface.shares[sources[i]] += shares[i];
      return;
    }
    const double part = voronoiPart(a, b, c);
    surface.integrals[piece].add(whole, part);
    surface.shares[sources[0]] += part * whole.area;
    uncertain_[piece].area_error += part * part * whole.area * whole.area;
    uncertain_[piece].volume_error += part * part * whole.volume * whole.volume;
  }

  const SortedPoints& points_;
  const PointFans& fans_;
  std::vector<SurfaceIntegrals>
      uncertain_; // by piece: squares of what is not agreed on
};

} // namespace

MeasuredSurface
measurePoints(const CloudView& points, unsigned threads, Report& report)
{
  std::optional<std::vector<SurfaceCorner>> corners = readCorners(points);
  if (!corners)
    throw InvalidArgument("surface_without_normals", {});
  const SortedPoints sorted = sortPoints(points, *corners, threads, report);
  const PointFans fans(*sorted.samples, sorted.corners, sorted.isovalues, threads);
  PointSurface made(sorted, fans, points.count);
  made.findPieces();
  if (made.surface.list.pieces.empty())
    throw InvalidArgument("surface_points_too_few", {});
  const auto alone = static_cast<double>(std::count(
      made.surface.list.of_vertex.begin(), made.surface.list.of_vertex.end(), -1));
  if (const double part = alone / static_cast<double>(points.count); part > most_alone)
    report.warn("points_without_area", {{"percent", std::lround(100.0 * part)}});
  const double contrary = static_cast<double>(fans.countContrary()) /
                          static_cast<double>(sorted.samples->size());
  if (contrary > most_contrary)
    report.warn("contrary_normals", {{"percent", std::lround(100.0 * contrary)}});
  made.surface.corners = std::move(*corners);
  findBounds(made.surface);
  made.integrate();
  made.warnOfGaps(report);
  return std::move(made.surface);
}

} // namespace pcl_uvol::detail
