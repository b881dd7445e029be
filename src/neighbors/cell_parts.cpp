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
  for (std::size_t i = 0; i < count; ++i) {
    const SimpleCell::Face& face = cell.getFace(i);
    if (face.sample == CellSearch::no_sample)
      continue;
    x_[i] = face.offset.x();
    y_[i] = face.offset.y();
    z_[i] = face.offset.z();
    limits_[i] = face.limit;
  }
  beside_.resize(std::max(count, beside_.size()));
  for (std::size_t i = 0; i < count; ++i)
    beside_[i].clear();
  cell.forEdges([&](std::uint16_t a, std::uint16_t b, std::size_t, std::size_t) {
    beside_[a].push_back(b);
    beside_[b].push_back(a);
  });
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
  const auto cutBy = [&](std::uint16_t other) {
    const SimpleCell::Face& plane = cell.getFace(other);
    return part_.cut(plane.offset - own.offset, plane.limit - own.limit, other);
  };
  part_.start(std::sqrt(cell.getSqReach()), SimpleCell::Ties::Keep);
  part_.cut(own.offset, own.limit, face);
  for (std::size_t i = 0; i < cell.getNumFaces(); ++i)
    if (cell.getFace(i).sample == CellSearch::no_sample)
      part_.cut(cell.getFace(i).offset, cell.getFace(i).limit, CellSearch::no_sample);
  for (const std::uint16_t other : beside_[face])
    if (cell.getFace(other).sample != CellSearch::no_sample)
      cutBy(other);
  std::vector<std::uint16_t>& tried = beside_[face];
  tried.push_back(face);
  for (std::size_t vertex; part_.findOpenVertex(-1.0, vertex);) {
    // Those on the face are vertices of the cell.
    const std::uint16_t nearest =
        part_.isOnFaceOf(vertex, face) ? face : findNearest(vertex);
    bool is_cut = false;
    if (std::find(tried.begin(), tried.end(), nearest) == tried.end()) {
      tried.push_back(nearest);
      is_cut = cutBy(nearest) == SimpleCell::Cut::Part;
    }
    if (!is_cut)
      part_.setFinal(vertex);
  }
}

std::uint16_t
CellParts::findNearest(std::size_t vertex)
{
  const Vector3d place = part_.getVertex(vertex);
  const double* const points[] = {x_.data(), y_.data(), z_.data(), limits_.data()};
  return static_cast<std::uint16_t>(
      part_.getKernels().findNearest(points, x_.size() - cell_padding, place.data()));
}

} // namespace pcl_uvol::detail
