// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/simple_cell.h"

#include "common/dispatch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

namespace {

const KernelTable<const CellKernels*> cell_kernel_table{
    &baseline::cell_kernels, &avx2::cell_kernels, &avx512::cell_kernels};

/** Share of the size of a cell: vertices that close to a plane may lie on either side
 * of it. Rounding is some 1e-15; of random samples one cell in 10^8 comes that near. */
constexpr double rounding_height = 1e-11;

/** Share of the product of three lengths: the volume that three normals span. Where it
 * is less, rounding moves the vertex by more than rounding_height. */
constexpr double least_volume = 1e-4;

/** Less than all squared lengths: of vertices that are final. */
constexpr double final_length = -1.0;

/** Twice the distance of the farthest vertex, and some: samples farther away cut
 * nothing off. */
constexpr double most_reaches = 2.0 + 1e-9;

/** Share of its surface that a closed cell's faces, as vectors, sum up to by rounding.
 */
constexpr double closing_error = 1e-11;

} // namespace

SimpleCell::SimpleCell()
    : kernels_(cell_kernel_table.get())
{
  grow();
}

void
SimpleCell::grow()
{
  words_ = words_ == 0 ? 1 : 2 * words_;
  const std::size_t faces = 64 * words_, vertices = 2 * faces; // Euler: 2 f - 4
  face_.resize(faces);
  uses_.resize(faces);
  removed_edges_.assign(faces * words_, 0);
  next_on_rim_.resize(faces);
  chains_.resize(faces);
  if (vertices > corners_.size())
    growVertices(vertices);
}

void
SimpleCell::growVertices(std::size_t room)
{
  for (auto* const row : {&x_, &y_, &z_, &heights_, &sq_lengths_, &open_})
    row->resize(room + cell_padding);
  corners_.resize(room);
  next_.resize(4 * room);
  removed_.resize(room);
  removed_numbers_.resize(room);
  removed_corners_.resize(room);
  rim_.resize(3 * room);
}

void
SimpleCell::start(double half_side, Ties ties)
{
  ties_ = ties;
  faces_ = 0;
  vertices_ = 0;
  sq_reach_ = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      uses_[faces_] = 0;
      face_[faces_++] = {
          side * Vector3d::Unit(axis), half_side, 1.0, CellSearch::no_sample};
    }
  final_place_.setConstant(std::numeric_limits<double>::infinity());
  for (const std::uint16_t x : {0, 1})
    for (const std::uint16_t y : {2, 3})
      for (const std::uint16_t z : {4, 5})
        if ((x + y + z) % 2 == 1) // an even number of them looks down its axis
          addVertex(x, y, z);
        else
          addVertex(y, x, z);
}

SimpleCell::Cut
SimpleCell::cut(const Vector3d& offset, std::uint32_t sample)
{
  const double sq_length = offset.squaredNorm();
  if (sq_length > most_reaches * most_reaches * sq_reach_)
    return Cut::Nothing;
  return cut(offset, 0.5 * sq_length, sq_length, sample);
}

SimpleCell::Cut
SimpleCell::cut(const Vector3d& offset, double limit, std::uint32_t sample)
{
  return cut(offset, limit, offset.squaredNorm(), sample);
}

SimpleCell::Cut
SimpleCell::cut(const Vector3d& offset,
                double limit,
                double sq_length,
                std::uint32_t sample)
{
  const double margin = rounding_height * std::sqrt(sq_length * sq_reach_);
  for (auto* const row : {&x_, &y_, &z_})
    std::fill_n(
        row->begin() + static_cast<std::ptrdiff_t>(vertices_), cell_padding, 0.0);
  const double* const points[] = {x_.data(), y_.data(), z_.data()};
  const double plane[] = {offset.x(), offset.y(), offset.z(), limit};
  const unsigned heights =
      kernels_->measureHeights(points, vertices_, plane, margin, heights_.data());
  if (heights == 0)
    return Cut::Nothing;
  if ((heights & 2) && ties_ == Ties::Refuse)
    return Cut::Undecided;
  const double length = std::sqrt(sq_length);
  if ((heights & 2) && !keepTies(length, margin))
    return Cut::Nothing;
  const std::size_t own = findEmptyFace();
  if (own == most_faces)
    return Cut::Undecided;
  Face& face = face_[own];
  face.offset = offset;
  face.limit = limit;
  face.length = length;
  face.sample = sample;
  return replaceVertices(static_cast<std::uint16_t>(own)) ? Cut::Part : Cut::Undecided;
}

bool
SimpleCell::keepTies(double length, double most)
{
  bool is_part = false;
  for (std::size_t v = 0; v < vertices_; ++v) {
    if (heights_[v] > 0.0 && heights_[v] <= most &&
        heights_[v] <= rounding_height * length * std::sqrt(sq_lengths_[v]))
      heights_[v] = 0.0;
    is_part = is_part || heights_[v] > 0.0;
  }
  return is_part;
}

bool
SimpleCell::replaceVertices(std::uint16_t face)
{
  takeVertices();
  if (ties_ == Ties::Keep && !isRimSimple()) {
    // Rounding has torn the vertices over the plane apart.
    returnVertices();
    joinVertices();
    takeVertices();
  }
  dropVertices();
  // Room for more vertices is room for a longer rim as well.
  for (std::size_t i = 0; i < rim_size_; ++i) {
    const RimEdge edge = rim_[i];
    if (!addVertex(edge.a, edge.b, face)) {
      if (ties_ == Ties::Refuse)
        return false;
      addCrossing(edge, face);
    }
  }
  return true;
}

void
SimpleCell::dropVertices()
{
  double *const x = x_.data(), *const y = y_.data(), *const z = z_.data(),
                *const sq_lengths = sq_lengths_.data(), *const open = open_.data();
  Corner* const corners = corners_.data();
  bool is_reach_known = true;
  std::size_t kept = removed_numbers_[0];
  for (std::size_t i = 0; i < num_removed_; ++i) {
    const std::size_t begin = removed_numbers_[i] + 1,
                      end = i + 1 < num_removed_ ? removed_numbers_[i + 1] : vertices_;
    is_reach_known = is_reach_known && sq_lengths[begin - 1] < sq_reach_;
    for (std::size_t v = begin; v < end; ++v, ++kept) {
      x[kept] = x[v];
      y[kept] = y[v];
      z[kept] = z[v];
      sq_lengths[kept] = sq_lengths[v];
      open[kept] = open[v];
      corners[kept] = corners[v];
    }
  }
  vertices_ = kept;
  if (is_reach_known)
    return;
  double sq_reach = 0.0;
  for (std::size_t v = 0; v < kept; ++v)
    sq_reach = std::max(sq_reach, sq_lengths[v]);
  sq_reach_ = sq_reach;
}

void
SimpleCell::takeVertices()
{
  const double* const heights = heights_.data();
  const Corner* const corners = corners_.data();
  Corner* const removed = removed_corners_.data();
  std::uint64_t* const edges = removed_edges_.data();
  std::uint32_t* const uses = uses_.data();
  const std::size_t words = words_;
  std::size_t count = 0;
  for (std::size_t v = 0; v < vertices_; ++v)
    if (heights[v] > 0.0) {
      const Corner corner = removed[count] = corners[v];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint16_t next = corner[(k + 1) % 3];
        edges[corner[k] * words + next / 64] |= std::uint64_t{1} << (next % 64);
        --uses[corner[k]];
      }
      if (ties_ == Ties::Keep)
        removed_[count] = {getVertex(v), heights[v]};
      removed_numbers_[count++] = static_cast<std::uint32_t>(v);
    }
  num_removed_ = count;
  // Edges of one removed triangle alone are the rim that the new face's triangles
  // close.
  std::size_t rim_size = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint16_t a = removed[i][k], b = removed[i][(k + 1) % 3];
      if ((edges[b * words + a / 64] >> (a % 64) & 1u) == 0)
        rim_[rim_size++] = {a, b, static_cast<std::uint32_t>(i)};
    }
  rim_size_ = rim_size;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      edges[removed[i][k] * words + removed[i][(k + 1) % 3] / 64] = 0;
}

void
SimpleCell::returnVertices()
{
  for (std::size_t i = 0; i < num_removed_; ++i)
    for (const std::uint16_t face : removed_corners_[i])
      ++uses_[face];
}

bool
SimpleCell::isRimSimple()
{
  if (rim_size_ == 0)
    return false;
  for (std::size_t i = 0; i < rim_size_; ++i)
    next_on_rim_[rim_[i].a] = rim_[i].b;
  std::size_t steps = 1;
  for (std::uint16_t at = rim_.front().b; at != rim_.front().a && steps <= rim_size_;
       at = next_on_rim_[at])
    ++steps;
  return steps == rim_size_;
}

void
SimpleCell::joinVertices()
{
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  forEdges([&](std::uint16_t, std::uint16_t, std::size_t from, std::size_t to) {
    edges.emplace_back(from, to);
  });
  std::vector<char> is_joined(vertices_, false);
  const auto join = [&](std::size_t first) {
    const bool is_over = heights_[first] > 0.0;
    is_joined[first] = true;
    for (bool is_larger = true; is_larger;) {
      is_larger = false;
      for (const auto& [from, to] : edges)
        if (is_joined[from] != is_joined[to] && (heights_[from] > 0.0) == is_over &&
            (heights_[to] > 0.0) == is_over)
          is_joined[from] = is_joined[to] = is_larger = true;
    }
  };
  const auto end = heights_.begin() + static_cast<std::ptrdiff_t>(vertices_);
  const auto [lowest, highest] = std::minmax_element(heights_.begin(), end);
  const auto first = static_cast<std::size_t>(lowest - heights_.begin());
  join(static_cast<std::size_t>(highest - heights_.begin()));
  for (std::size_t v = 0; v < vertices_; ++v)
    if (heights_[v] > 0.0 && !is_joined[v])
      heights_[v] = 0.0;
  join(first);
  for (std::size_t v = 0; v < vertices_; ++v)
    if (!is_joined[v])
      heights_[v] = std::numeric_limits<double>::min();
}

inline void
SimpleCell::addVertex(const Vector3d& place, const Corner& corner)
{
  if (vertices_ == corners_.size()) // not of a cell without confusion
    growVertices(2 * vertices_);
  const double x = place.x(), y = place.y(), z = place.z(),
               sq_length = x * x + y * y + z * z;
  x_[vertices_] = x;
  y_[vertices_] = y;
  z_[vertices_] = z;
  sq_lengths_[vertices_] = open_[vertices_] = sq_length;
  corners_[vertices_++] = corner;
  for (const std::uint16_t face : corner)
    ++uses_[face];
  sq_reach_ = std::max(sq_reach_, sq_length);
}

bool
SimpleCell::addVertex(std::uint16_t a, std::uint16_t b, std::uint16_t c)
{
  const Face &first = face_[a], &second = face_[b], &third = face_[c];
  const Vector3d across = second.offset.cross(third.offset);
  const double volume = first.offset.dot(across);
  if (!(volume > least_volume * first.length * second.length * third.length))
    return false;
  addVertex((first.limit * across + first.offset.cross(third.limit * second.offset -
                                                       second.limit * third.offset)) /
                volume,
            {a, b, c});
  return true;
}

void
SimpleCell::addCrossing(const RimEdge& edge, std::uint16_t face)
{
  // The kept end of the edge has both faces the other way round.
  const Removed removed = removed_[edge.removed];
  Vector3d place = removed.place;
  for (std::size_t v = 0; v < vertices_; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      if (corners_[v][k] == edge.b && corners_[v][(k + 1) % 3] == edge.a) {
        const Face& plane = face_[face];
        const Vector3d end = getVertex(v);
        const double height = std::min(0.0, plane.offset.dot(end) - plane.limit);
        place = end + height / (height - removed.height) * (removed.place - end);
      }
  addVertex(place, {edge.a, edge.b, face});
}

std::size_t
SimpleCell::findEmptyFace()
{
  const auto end = uses_.begin() + static_cast<std::ptrdiff_t>(faces_);
  const auto face =
      static_cast<std::size_t>(std::find(uses_.begin(), end, 0u) - uses_.begin());
  if (face < faces_ || face == most_faces)
    return face;
  if (face == face_.size())
    grow();
  uses_[faces_++] = 0;
  return face;
}

void
SimpleCell::dropEmptyFaces()
{
  std::vector<std::uint16_t> number(faces_);
  std::size_t kept = 0;
  for (std::size_t face = 0; face < faces_; ++face)
    if (uses_[face] > 0) {
      number[face] = static_cast<std::uint16_t>(kept);
      uses_[kept] = uses_[face];
      face_[kept++] = face_[face];
    }
  faces_ = kept;
  for (std::size_t v = 0; v < vertices_; ++v)
    for (std::uint16_t& face : corners_[v])
      face = number[face];
}

bool
SimpleCell::findOpenVertex(double sq_limit, std::size_t& found)
{
  for (;;) {
    double sq_most = sq_limit;
    found = vertices_;
    for (std::size_t v = 0; v < vertices_; ++v)
      if (open_[v] > sq_most) {
        sq_most = open_[v];
        found = v;
      }
    if (found == vertices_)
      return false;
    if (ties_ == Ties::Refuse || (getVertex(found) - final_place_).squaredNorm() >
                                     rounding_height * rounding_height * sq_most)
      return true;
    open_[found] = final_length;
  }
}

void
SimpleCell::setFinal(std::size_t vertex)
{
  open_[vertex] = final_length;
  final_place_ = getVertex(vertex);
}

bool
SimpleCell::isOnFaceOf(std::size_t vertex, std::uint32_t sample) const
{
  const auto& corner = corners_[vertex];
  return std::any_of(corner.begin(), corner.end(), [&](std::uint16_t face) {
    return face_[face].sample == sample;
  });
}

bool
SimpleCell::measureFaces(double* ratios, Vector3d* moments) const
{
  std::fill_n(ratios, faces_, 0.0);
  std::fill_n(moments, faces_, Vector3d::Zero());
  // A face is the sum of the triangles between its foot and its edges.
  forEdges([&](std::uint16_t a, std::uint16_t b, std::size_t from, std::size_t to) {
    const Vector3d begin = getVertex(from), end = getVertex(to);
    const Vector3d across = end.cross(begin), ends = begin + end;
    const auto addTriangle = [&](std::size_t face, double twice) {
      ratios[face] += twice; // the area times the distance of the sample
      moments[face] += twice * (0.5 * face_[face].offset + ends);
    };
    addTriangle(a, face_[a].offset.dot(across));
    addTriangle(b, -face_[b].offset.dot(across));
  });
  double area = 0.0;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t face = 0; face < faces_; ++face) {
    const double per_sq_length = 0.25 / face_[face].limit;
    ratios[face] *= per_sq_length;
    moments[face] *= per_sq_length / 3.0;
    area += ratios[face] * face_[face].length;
    sum += ratios[face] * face_[face].offset;
  }
  return sum.squaredNorm() <= closing_error * closing_error * area * area;
}

double
SimpleCell::computeVolume() const
{
  // Tetrahedra between the origin, the foot of a face and an edge of it.
  double sum = 0.0;
  forEdges([&](std::uint16_t a, std::uint16_t b, std::size_t from, std::size_t to) {
    const Vector3d across = getVertex(to).cross(getVertex(from));
    const auto measureFoot = [&](const Face& face) {
      return face.limit / (face.length * face.length) * face.offset.dot(across);
    };
    sum += measureFoot(face_[a]) - measureFoot(face_[b]);
  });
  return sum / 6.0;
}

bool
SimpleCellFinder::find(const CellSearch& around)
{
  cell_.start(around.getHalfSide());
  for (const std::uint32_t sample : around.getNear())
    if (cell_.cut(around.offsetOf(sample), sample) == SimpleCell::Cut::Undecided)
      return false;
  // Only samples farther out than those are left to cut off a vertex: not the near
  // ones.
  for (std::size_t vertex; cell_.findOpenVertex(0.25 * around.getSqKnown(), vertex);) {
    std::uint32_t sample;
    if (!around.findInBall(cell_.getVertex(vertex), sample)) {
      if (cell_.isOnFaceOf(vertex, CellSearch::no_sample))
        return false;
      cell_.setFinal(vertex);
    }
    else if (cell_.cut(around.offsetOf(sample), sample) != SimpleCell::Cut::Part)
      return false;
  }
  cell_.dropEmptyFaces();
  return true;
}

bool
SimpleCellFinder::findAny(const CellSearch& around)
{
  cell_.start(around.getHalfSide(), SimpleCell::Ties::Keep);
  tried_ = around.getNear();
  for (const std::uint32_t sample : tried_)
    cell_.cut(around.offsetOf(sample), sample);
  bool is_bounded = true;
  for (std::size_t vertex;
       is_bounded && cell_.findOpenVertex(0.25 * around.getSqKnown(), vertex);) {
    std::uint32_t sample;
    // By rounding alone, a sample that was tried can be found again.
    if (around.findInBall(cell_.getVertex(vertex), sample) &&
        std::find(tried_.begin(), tried_.end(), sample) == tried_.end()) {
      tried_.push_back(sample);
      if (cell_.cut(around.offsetOf(sample), sample) == SimpleCell::Cut::Part)
        continue;
    }
    is_bounded = !cell_.isOnFaceOf(vertex, CellSearch::no_sample);
    cell_.setFinal(vertex);
  }
  cell_.dropEmptyFaces();
  for (std::size_t face = 0; face < cell_.getNumFaces(); ++face)
    is_bounded = is_bounded && cell_.getFace(face).sample != CellSearch::no_sample;
  return is_bounded;
}

} // namespace pcl_uvol::detail
