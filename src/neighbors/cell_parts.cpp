// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/cell_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol::detail {

using Eigen::Vector3d;

void
CellParts::measure(const SimpleCell& cell, double* volumes)
{
  const std::size_t count = cell.getNumFaces();
  for (auto* const row : {&x_, &y_, &z_})
    row->assign(count + cell_padding, 0.0);
  limits_.assign(count + cell_padding, std::numeric_limits<double>::infinity());
  distances_.resize(count + cell_padding);
  for (std::size_t i = 0; i < count; ++i) {
    const SimpleCell::Face& face = cell.getFace(i);
    if (face.sample == CellSearch::no_sample)
      continue;
    x_[i] = face.offset.x();
    y_[i] = face.offset.y();
    z_[i] = face.offset.z();
    limits_[i] = face.limit;
  }
  for (std::size_t i = 0; i < count; ++i) {
    volumes[i] = 0.0;
    if (cell.getFace(i).sample == CellSearch::no_sample)
      continue;
    findPart(cell, static_cast<std::uint16_t>(i));
    volumes[i] = std::max(0.0, part_.computeVolume());
  }
}

void
CellParts::findPart(const SimpleCell& cell, std::uint16_t face)
{
  const SimpleCell::Face& own = cell.getFace(face);
  part_.start(std::sqrt(cell.getSqReach()), SimpleCell::Ties::Keep);
  part_.cut(own.offset, own.limit, face);
  for (std::size_t i = 0; i < cell.getNumFaces(); ++i)
    if (cell.getFace(i).sample == CellSearch::no_sample)
      part_.cut(cell.getFace(i).offset, cell.getFace(i).limit, CellSearch::no_sample);
  for (std::size_t vertex; part_.findOpenVertex(-1.0, vertex);) {
    const std::uint16_t nearest = findNearest(vertex);
    const SimpleCell::Face& other = cell.getFace(nearest);
    if (nearest == face || part_.hasFaceOf(nearest) ||
        part_.cut(other.offset - own.offset, other.limit - own.limit, nearest) !=
            SimpleCell::Cut::Part)
      part_.setFinal(vertex);
  }
}

std::uint16_t
CellParts::findNearest(std::size_t vertex)
{
  // Squared distances, but for what all have in common, are ahead of a plane by 1.
  const Vector3d place = part_.getVertex(vertex);
  const double* const points[] = {x_.data(), y_.data(), z_.data(), limits_.data()};
  const double plane[] = {0.0, 0.0, 0.0, -1.0};
  const double sphere[] = {place.x(), place.y(), place.z(), 0.0};
  const std::size_t count = x_.size() - cell_padding;
  const auto none = static_cast<std::uint16_t>(count);
  const std::uint16_t corners[] = {none, none, none}; // in the padding
  std::size_t nearest;
  part_.getKernels().findFirst(
      points, count, plane, sphere, corners, distances_.data(), &nearest);
  return static_cast<std::uint16_t>(nearest);
}

} // namespace pcl_uvol::detail
