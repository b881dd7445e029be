// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/delaunay_cavity.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

/** Share of the cell's volume, and of the distance of its farthest neighbour: what sums
 * that are to vanish may be off by rounding. */
constexpr double rounding = 1e-11;

/** Tetrahedra of a hole with that many corners; those of random samples have about
 * three for two corners. More than a few for each are a sign of confusion. */
constexpr std::size_t
mostTetrahedra(std::size_t corners)
{
  return 4 * corners;
}

std::uint32_t
keyOf(std::array<std::uint8_t, 3> corners)
{
  std::sort(corners.begin(), corners.end());
  return static_cast<std::uint32_t>(corners[0]) << 16 |
         static_cast<std::uint32_t>(corners[1]) << 8 | corners[2];
}

/** How much an edge of the Voronoi diagram, around the edge of the triangulation
 * between two samples, adds to twelve times the volume of each one's cell: six times
 * that of the tetrahedron between the sample, the middle of the edge and the Voronoi
 * edge; it is the same for both. */
double
measureAround(const Vector3d& sample,
              const Vector3d& other,
              const Vector3d& begin,
              const Vector3d& end)
{
  return (other - sample).dot((begin - sample).cross(end - sample));
}

} // namespace

bool
DelaunayCavity::measure(const SimpleCell& cell, const double* ratios, double* volumes)
{
  start(cell);
  std::fill_n(volumes, count_, 0.0);
  cell.forEdges([&](std::uint8_t a, std::uint8_t b, std::size_t from, std::size_t to) {
    const double around = measureAround(cell.getFace(a).offset,
                                        cell.getFace(b).offset,
                                        cell.getVertex(from),
                                        cell.getVertex(to));
    volumes[a] += around;
    volumes[b] += around;
  });
  for (std::size_t tetrahedra = 0; !fronts_.empty(); ++tetrahedra) {
    const Front front = fronts_.back();
    fronts_.pop_back();
    std::uint8_t tip;
    Vector3d center;
    if (tetrahedra == mostTetrahedra(count_) || !findTip(front, tip, center))
      return false;
    addVoronoiEdge(front, center, volumes);
    const auto [a, b, c] = front.corners;
    if (!addTriangle(a, b, tip, center, volumes) ||
        !addTriangle(b, c, tip, center, volumes) ||
        !addTriangle(c, a, tip, center, volumes))
      return false;
  }
  // The volumes are those of the cell's parts, and Sibson's coordinates are exact for
  // linear functions (Sibson 1980): a wrong tetrahedron would show here.
  double volume = 0.0, sum = 0.0, farthest = 0.0;
  Vector3d moment = Vector3d::Zero();
  for (std::size_t face = 0; face < count_; ++face) {
    const double sq_length = 2.0 * limits_[face];
    volume += ratios[face] * sq_length / 6.0;
    volumes[face] = volumes[face] / 12.0 - ratios[face] * sq_length / 6.0;
    sum += volumes[face];
    moment += volumes[face] * cell.getFace(face).offset;
    farthest = std::max(farthest, sq_length);
  }
  return std::abs(sum - volume) <= rounding * volume &&
         moment.squaredNorm() <= rounding * rounding * volume * volume * farthest &&
         std::all_of(volumes, volumes + count_, [&](double part) {
           return part >= -rounding * volume;
         });
}

void
DelaunayCavity::start(const SimpleCell& cell)
{
  count_ = cell.getNumFaces();
  for (std::size_t face = 0; face < count_; ++face) {
    const Vector3d& offset = cell.getFace(face).offset;
    x_[face] = offset.x();
    y_[face] = offset.y();
    z_[face] = offset.z();
    limits_[face] = cell.getFace(face).limit;
  }
  fronts_.clear();
  for (std::size_t v = 0; v < cell.getNumVertices(); ++v) {
    const auto& [a, b, c] = cell.getCorner(v);
    // Counterclockwise from the place, which is inside.
    fronts_.push_back({{a, c, b}, keyOf({a, b, c}), cell.getVertex(v)});
  }
}

bool
DelaunayCavity::findTip(const Front& front, std::uint8_t& tip, Vector3d& center)
{
  // The spheres through the corners have their centres on a line; the first one that
  // meets a sample on its way to the front is that of the tetrahedron.
  const auto [a, b, c] = front.corners;
  const Vector3d first(x_[a], y_[a], z_[a]);
  const Vector3d normal = (Vector3d(x_[b], y_[b], z_[b]) - first)
                              .cross(Vector3d(x_[c], y_[c], z_[c]) - first);
  const double height = normal.dot(first), power = limits_[a] - front.center.dot(first);
  for (std::size_t i = 0; i < count_; ++i) {
    const double ahead = normal.x() * x_[i] + normal.y() * y_[i] + normal.z() * z_[i] -
                         height,
                 outside = limits_[i] - front.center.x() * x_[i] -
                           front.center.y() * y_[i] - front.center.z() * z_[i] - power;
    distances_[i] =
        ahead > 0.0 ? outside / ahead : std::numeric_limits<double>::infinity();
  }
  for (const std::uint8_t corner : front.corners)
    distances_[corner] = std::numeric_limits<double>::infinity();
  const auto* const nearest =
      std::min_element(distances_.begin(), distances_.begin() + count_);
  tip = static_cast<std::uint8_t>(nearest - distances_.begin());
  center = front.center + *nearest * normal;
  return std::isfinite(*nearest);
}

bool
DelaunayCavity::addTriangle(std::uint8_t a,
                            std::uint8_t b,
                            std::uint8_t c,
                            const Vector3d& center,
                            double* volumes)
{
  const std::uint32_t key = keyOf({a, b, c});
  const auto other = std::find_if(fronts_.begin(),
                                  fronts_.end(),
                                  [&](const Front& front) { return front.key == key; });
  if (other == fronts_.end()) {
    fronts_.push_back({{a, b, c}, key, center});
    return true;
  }
  addVoronoiEdge(*other, center, volumes);
  // It must look the other way.
  const auto& corners = other->corners;
  const std::size_t k = corners[0] == a ? 0 : corners[1] == a ? 1 : 2;
  const bool is_opposite = corners[(k + 1) % 3] == c;
  *other = fronts_.back();
  fronts_.pop_back();
  return is_opposite;
}

void
DelaunayCavity::addVoronoiEdge(const Front& front,
                               const Vector3d& center,
                               double* volumes)
{
  const auto place = [&](std::uint8_t i) { return Vector3d(x_[i], y_[i], z_[i]); };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint8_t i = front.corners[k], j = front.corners[(k + 1) % 3];
    const double around = measureAround(place(i), place(j), front.center, center);
    volumes[i] += around;
    volumes[j] += around;
  }
}

} // namespace pcl_uvol::detail
