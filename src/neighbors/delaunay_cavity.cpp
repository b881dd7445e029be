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
constexpr double sum_error = 1e-11;

/** Tetrahedra of a hole with that many corners; those of random samples have about
 * three for two corners. More than a few for each are a sign of confusion. */
constexpr std::size_t
mostTetrahedra(std::size_t corners)
{
  return 4 * corners;
}

std::uint64_t
keyOf(std::uint64_t a, std::uint64_t b, std::uint64_t c)
{
  const std::uint64_t low = std::min({a, b, c}), high = std::max({a, b, c});
  return low << 32 | (a + b + c - low - high) << 16 | high;
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
  cell.forEdges(
      [&](std::uint16_t a, std::uint16_t b, std::size_t from, std::size_t to) {
        const double around = measureAround(cell.getFace(a).offset,
                                            cell.getFace(b).offset,
                                            cell.getVertex(from),
                                            cell.getVertex(to));
        volumes[a] += around;
        volumes[b] += around;
      });
  for (std::size_t tetrahedra = 0; !fronts_.empty(); ++tetrahedra) {
    const Front front = remove(fronts_.size() - 1);
    std::uint16_t tip;
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
  return std::abs(sum - volume) <= sum_error * volume &&
         moment.squaredNorm() <= sum_error * sum_error * volume * volume * farthest &&
         std::all_of(volumes, volumes + count_, [&](double part) {
           return part >= -sum_error * volume;
         });
}

void
DelaunayCavity::start(const SimpleCell& cell)
{
  kernels_ = &cell.getKernels();
  count_ = cell.getNumFaces();
  for (auto* const row : {&x_, &y_, &z_, &limits_, &distances_})
    row->resize(count_ + cell_padding);
  for (std::size_t face = 0; face < count_; ++face) {
    const Vector3d& offset = cell.getFace(face).offset;
    x_[face] = offset.x();
    y_[face] = offset.y();
    z_[face] = offset.z();
    limits_[face] = cell.getFace(face).limit;
  }
  for (auto* const row : {&x_, &y_, &z_})
    std::fill(row->end() - cell_padding, row->end(), 0.0);
  std::fill(limits_.end() - cell_padding,
            limits_.end(),
            std::numeric_limits<double>::infinity());
  fronts_.clear();
  keys_.clear();
  for (std::size_t v = 0; v < cell.getNumVertices(); ++v) {
    const auto& [a, b, c] = cell.getCorner(v);
    // Counterclockwise from the place, which is inside.
    push({{a, c, b}, cell.getVertex(v)}, keyOf(a, b, c));
  }
}

void
DelaunayCavity::push(const Front& front, std::uint64_t key)
{
  fronts_.push_back(front);
  keys_.push_back(key);
}

DelaunayCavity::Front
DelaunayCavity::remove(std::size_t front)
{
  const Front removed = fronts_[front];
  fronts_[front] = fronts_.back();
  keys_[front] = keys_.back();
  fronts_.pop_back();
  keys_.pop_back();
  return removed;
}

bool
DelaunayCavity::findTip(const Front& front, std::uint16_t& tip, Vector3d& center)
{
  // The spheres through the corners have their centres on a line; the first one that
  // meets a sample on its way to the front is that of the tetrahedron.
  const auto [a, b, c] = front.corners;
  const Vector3d first(x_[a], y_[a], z_[a]);
  const Vector3d normal = (Vector3d(x_[b], y_[b], z_[b]) - first)
                              .cross(Vector3d(x_[c], y_[c], z_[c]) - first);
  const double* const points[] = {x_.data(), y_.data(), z_.data(), limits_.data()};
  const double plane[] = {normal.x(), normal.y(), normal.z(), normal.dot(first)};
  const double sphere[] = {front.center.x(),
                           front.center.y(),
                           front.center.z(),
                           limits_[a] - front.center.dot(first)};
  std::size_t met;
  const double distance = kernels_->findFirst(
      points, count_, plane, sphere, front.corners.data(), distances_.data(), &met);
  tip = static_cast<std::uint16_t>(met);
  center = front.center + distance * normal;
  return std::isfinite(distance);
}

bool
DelaunayCavity::addTriangle(std::uint16_t a,
                            std::uint16_t b,
                            std::uint16_t c,
                            const Vector3d& center,
                            double* volumes)
{
  const std::uint64_t key = keyOf(a, b, c);
  const auto known = std::find(keys_.begin(), keys_.end(), key);
  if (known == keys_.end()) {
    push({{a, b, c}, center}, key);
    return true;
  }
  const Front other = remove(static_cast<std::size_t>(known - keys_.begin()));
  addVoronoiEdge(other, center, volumes);
  // It must look the other way.
  const std::size_t k = other.corners[0] == a ? 0 : other.corners[1] == a ? 1 : 2;
  return other.corners[(k + 1) % 3] == c;
}

void
DelaunayCavity::addVoronoiEdge(const Front& front,
                               const Vector3d& center,
                               double* volumes)
{
  const auto place = [&](std::uint16_t i) { return Vector3d(x_[i], y_[i], z_[i]); };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint16_t i = front.corners[k], j = front.corners[(k + 1) % 3];
    const double around = measureAround(place(i), place(j), front.center, center);
    volumes[i] += around;
    volumes[j] += around;
  }
}

} // namespace pcl_uvol::detail
