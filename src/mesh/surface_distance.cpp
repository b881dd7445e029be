// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/surface_distance.h"

#include "common/parallel.h"
#include "mesh/curved_triangle.h"
#include "mesh/measured_mesh.h"
#include "mesh/triangle_tree.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace pcl_uvol::detail {

namespace {

/** Places that a thread looks up at a time. */
constexpr std::size_t distance_block = 1024;

/** Share of the surface: farther away lies what counts as an outlier. */
constexpr double outliers = 1e-3;

/** A place on a surface, by its corners, and the area that it stands for. */
struct SurfacePlace {
  Triangle corners;
  std::array<double, 3> lambda;
  double weight; ///< 0 for vertices of triangles, which count for the largest distance
};

/** A surface in double, relative to the origin of another one. */
class PlacedSurface {
public:
  PlacedSurface(const ComparedSurface& surface, const std::array<double, 3>& origin)
      : vertices_(viewOf(surface.vertices.cloud))
      , has_triangles_(!surface.triangles.empty())
      , triangles_(surface.triangles)
  {
    if (vertices_.count == 0)
      throw InvalidArgument("surface_without_points", {});
    if (!has_triangles_)
      for (std::uint32_t i = 0; i < vertices_.count; ++i)
        triangles_.push_back({i, i, i});
    checkTriangles(vertices_, triangles_);
    const auto& own = surface.vertices.origin;
    const Eigen::Vector3d offset(
        own[0] - origin[0], own[1] - origin[1], own[2] - origin[2]);
    for (std::size_t i = 0; i < vertices_.count; ++i) {
      const float* const place = vertices_.xyz(i);
      places_.emplace_back(Eigen::Vector3d(place[0], place[1], place[2]) + offset);
    }
  }

  const CloudView&
  getVertices() const
  {
    return vertices_;
  }

  const std::vector<Eigen::Vector3d>&
  getPlaces() const
  {
    return places_;
  }

  const std::vector<Triangle>&
  getTriangles() const
  {
    return triangles_;
  }

  Eigen::Vector3d
  placeOf(const SurfacePlace& place) const
  {
    return place.lambda[0] * places_[place.corners[0]] +
           place.lambda[1] * places_[place.corners[1]] +
           place.lambda[2] * places_[place.corners[2]];
  }

  /** A field at a place. */
  double
  valueOf(const FieldComponent& field,
          const Triangle& corners,
          const std::array<double, 3>& lambda) const
  {
    double value = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      if (lambda[i] != 0.0) // a corner without a value may be far away
        value += lambda[i] * field.read(vertices_.point(corners[i]));
    return value;
  }

  /** The vertices in their order, then places in all triangles. */
  std::vector<SurfacePlace>
  listPlaces() const
  {
    std::vector<SurfacePlace> list;
    for (std::uint32_t i = 0; i < places_.size(); ++i)
      list.push_back({{i, i, i}, {1.0, 0.0, 0.0}, has_triangles_ ? 0.0 : 1.0});
    if (has_triangles_)
      for (const Triangle& triangle : triangles_)
        for (const auto& [lambda, weight] : triangleQuadrature())
          list.push_back({triangle, lambda, weight * normalOf(triangle).norm()});
    return list;
  }

  /** Whether a place is inside of the triangle that it is nearest to. */
  bool
  isBehind(const TriangleTree::Nearest& nearest, const Eigen::Vector3d& place) const
  {
    const Triangle& triangle = triangles_[nearest.triangle];
    return normalOf(triangle).dot(place - nearest.point.place) < 0.0;
  }

private:
  Eigen::Vector3d
  normalOf(const Triangle& triangle) const
  {
    const Eigen::Vector3d& a = places_[triangle[0]];
    return (places_[triangle[1]] - a).cross(places_[triangle[2]] - a);
  }

  CloudView vertices_;
  bool has_triangles_;
  std::vector<Triangle> triangles_;
  std::vector<Eigen::Vector3d> places_;
};

/** The distance that all but a part of the weights do not exceed. */
double
computeQuantile(std::vector<std::pair<double, double>> weighted, double part)
{
  std::sort(weighted.begin(), weighted.end());
  double all = 0.0, sum = 0.0;
  for (const auto& [distance, weight] : weighted)
    all += weight;
  for (const auto& [distance, weight] : weighted) {
    sum += weight;
    if (sum >= part * all)
      return distance;
  }
  return weighted.back().first;
}

/** Distances of the places of one surface. */
class Comparison {
public:
  Comparison(const PlacedSurface& from,
             const PlacedSurface& to,
             unsigned threads,
             const ProgressCallback& progress)
      : from_(from)
      , to_(to)
      , places_(from.listPlaces())
      , nearest_(places_.size())
  {
    const TriangleTree tree(to.getPlaces(), to.getTriangles());
    Report report;
    report.progress = progress;
    StepTimer step(report, "distances", places_.size());
    parallelBlocks(places_.size(), distance_block, threads, [&](auto begin, auto end) {
      for (std::size_t i = begin; i < end; ++i)
        nearest_[i] = tree.find(from.placeOf(places_[i]));
      step.advance(end - begin);
    });
  }

  SurfaceDistances
  summarize() const
  {
    SurfaceDistances result{};
    std::vector<std::pair<double, double>> weighted;
    double sum = 0.0, sq_sum = 0.0, all = 0.0;
    result.largest = -1.0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double distance = nearest_[i].distance, weight = places_[i].weight;
      all += weight;
      sum += weight * distance;
      sq_sum += weight * distance * distance;
      weighted.emplace_back(distance, weight);
      if (distance <= result.largest)
        continue;
      result.largest = distance;
      result.farthest = from_.placeOf(places_[i]);
    }
    result.mean = sum / all;
    result.root_mean_square = std::sqrt(sq_sum / all);
    result.permille = computeQuantile(std::move(weighted), 1.0 - outliers);
    for (std::size_t i = 0; i < from_.getPlaces().size(); ++i)
      result.at_vertices.push_back(static_cast<float>(
          to_.isBehind(nearest_[i], from_.getPlaces()[i]) ? -nearest_[i].distance
                                                          : nearest_[i].distance));
    compareFields(result.fields);
    return result;
  }

private:
  /** Those that both have, of which there may be very many. */
  void
  compareFields(std::vector<FieldDifference>& differences) const
  {
    std::unordered_map<std::string, FieldComponent> others;
    for (const NamedScalar& other : listMeasuredFields(to_.getVertices().fields))
      others.emplace(other.name, other.number);
    for (const NamedScalar& scalar : listMeasuredFields(from_.getVertices().fields))
      if (const auto other = others.find(scalar.name); other != others.end())
        differences.push_back(compareField(scalar, other->second));
  }

  FieldDifference
  compareField(const NamedScalar& here, const FieldComponent& there) const
  {
    FieldDifference difference{here.name, 0.0, 0.0};
    double all = 0.0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const SurfacePlace& place = places_[i];
      const double by =
          std::abs(from_.valueOf(here.number, place.corners, place.lambda) -
                   to_.valueOf(there,
                               to_.getTriangles()[nearest_[i].triangle],
                               nearest_[i].point.lambda));
      if (!std::isfinite(by))
        continue;
      all += place.weight;
      difference.mean += place.weight * by;
      difference.largest = std::max(difference.largest, by);
    }
    difference.mean /= all; // not a number where no place has both
    return difference;
  }

  const PlacedSurface &from_, &to_;
  std::vector<SurfacePlace> places_;
  std::vector<TriangleTree::Nearest> nearest_; // by place
};

} // namespace

SurfaceDistances
measureDistances(const ComparedSurface& from,
                 const ComparedSurface& to,
                 unsigned threads,
                 const ProgressCallback& progress)
{
  const std::array<double, 3>& origin = from.vertices.origin;
  const PlacedSurface here(from, origin), there(to, origin);
  SurfaceDistances result = Comparison(here, there, threads, progress).summarize();
  result.farthest += Eigen::Vector3d(origin[0], origin[1], origin[2]);
  return result;
}

SurfaceComparison
compareSurfaces(const ComparedSurface& first,
                const ComparedSurface& second,
                const std::array<std::string, 2>& names,
                unsigned threads,
                Report& report)
{
  if (first.triangles.empty())
    report.warn("no_triangles", {{"surface", names[0]}});
  if (second.triangles.empty())
    report.warn("no_triangles", {{"surface", names[1]}});
  const StepTimer timer(report, "distances");
  return {measureDistances(first, second, threads, report.progress),
          measureDistances(second, first, threads, report.progress)};
}

} // namespace pcl_uvol::detail
