// SPDX-License-Identifier: BSD-3-Clause
#include "charts/seen_box.h"

#include "charts/drawing.h"

#include <algorithm>
#include <cmath>

namespace uvol_tools {

using Eigen::Vector3d;

namespace {

/** The first and second axis after that of an edge. */
int
following(const BoxEdge& edge, int k)
{
  return (edge.axis + 1 + k) % 3;
}

} // namespace

double
DataBox::coordinateOf(int axis, double value) const
{
  return std::clamp(
      value * factors[axis] - origin[axis], box.min()[axis], box.max()[axis]);
}

std::vector<double>
DataBox::listRoundValues(int axis) const
{
  return roundValues(valueAt(axis, box.min()[axis]), valueAt(axis, box.max()[axis]));
}

std::vector<BoxEdge>
SeenBox::edges(int facing) const
{
  std::vector<BoxEdge> found;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool first : {false, true})
      for (const bool second : {false, true}) {
        const BoxEdge edge{axis, {first, second}};
        const int count =
            facesEye(following(edge, 0), first) + facesEye(following(edge, 1), second);
        if (count == facing && data_.hasLength(axis))
          found.push_back(edge);
      }
  return found;
}

std::optional<BoxEdge>
SeenBox::findTickEdge(int axis) const
{
  constexpr double steep = 2.0;
  std::optional<BoxEdge> best;
  double most = 0.0;
  for (const BoxEdge& edge : edges(1)) {
    if (edge.axis != axis || !isInFront(edge))
      continue;
    const auto [from, to] = endsOf(edge);
    const bool is_upright =
        std::abs(to[1] - from[1]) > steep * std::abs(to[0] - from[0]);
    const double merit = is_upright ? -from[0] - to[0] : from[1] + to[1];
    if (!best || merit > most) {
      best = edge;
      most = merit;
    }
  }
  return best;
}

bool
SeenBox::facesEye(int axis, bool high) const
{
  const double eye = perspective_.getEye()[axis];
  return high ? eye > box_.max()[axis] : eye < box_.min()[axis];
}

Vector3d
SeenBox::placeOn(const BoxEdge& edge, double coordinate) const
{
  Vector3d place;
  place[edge.axis] = coordinate;
  for (int k = 0; k < 2; ++k)
    place[following(edge, k)] =
        endOf(following(edge, k), edge.at_high[static_cast<std::size_t>(k)]);
  return place;
}

std::array<Pixel, 2>
SeenBox::endsOf(const BoxEdge& edge) const
{
  return {pixelAt(placeOn(edge, box_.min()[edge.axis])),
          pixelAt(placeOn(edge, box_.max()[edge.axis]))};
}

double
SeenBox::nearest() const
{
  constexpr double part = 1e-3;
  return part * box_.diagonal().norm();
}

Pixel
SeenBox::outwards(const std::array<Pixel, 2>& ends) const
{
  const auto& [from, to] = ends;
  const Pixel center = pixelAt(box_.center());
  const double dx = to[0] - from[0], dy = to[1] - from[1],
               length = std::max(std::hypot(dx, dy), 1e-9);
  const Pixel normal{dy / length, -dx / length};
  const double side = normal[0] * (0.5 * (from[0] + to[0]) - center[0]) +
                      normal[1] * (0.5 * (from[1] + to[1]) - center[1]);
  return side >= 0.0 ? normal : Pixel{-normal[0], -normal[1]};
}

bool
SeenBox::isInFront(const BoxEdge& edge) const
{
  const auto depthAt = [&](double coordinate) {
    return perspective_.seenFromEye(placeOn(edge, coordinate)).z();
  };
  return std::min(depthAt(box_.min()[edge.axis]), depthAt(box_.max()[edge.axis])) >
         nearest();
}

} // namespace uvol_tools
