// SPDX-License-Identifier: BSD-3-Clause
#include "gl/cone_mesh.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

constexpr double pi = 3.14159265358979323846;

/** With more of them, what is wrong between corners is far less than between circles.
 */
constexpr std::uint32_t most_corners = 512;

} // namespace

ConeMesh::ConeMesh(const ConeRings& rings,
                   const std::array<double, 3>& spacing,
                   double radius,
                   std::uint32_t layers)
{
  addTriangles(coverDisc(rings, radius)); // no section has more circles
  for (std::uint32_t t = 0; t < layers && t * spacing[2] < radius; ++t) {
    const double height = t * spacing[2];
    const double disc_radius = std::sqrt(radius * radius - height * height);
    addSection(coverDisc(rings, disc_radius), spacing, height);
  }
  float largest = 0.0f;
  for (const Vertex& vertex : vertices_)
    largest = std::max(largest, vertex.depth);
  for (Vertex& vertex : vertices_)
    vertex.depth /= largest;
  radius_depth_ = static_cast<float>(radius) / largest;
}

std::vector<ConeMesh::Circle>
ConeMesh::coverDisc(const ConeRings& rings, double disc_radius)
{
  std::vector<Circle> circles;
  Circle circle{rings.inner_radius, rings.corners};
  const auto outerRadius = [&] { return disc_radius / std::cos(pi / circle.corners); };
  while (circle.radius < outerRadius()) {
    circles.push_back(circle);
    circle.radius *= 2.0;
    circle.corners *= 2 * circle.corners <= most_corners ? 2 : 1;
  }
  circles.push_back({outerRadius(), circle.corners});
  return circles;
}

void
ConeMesh::addTriangles(const std::vector<Circle>& circles)
{
  std::uint32_t inner = 0, inner_corners = 1; // first vertex, the centre
  for (const Circle& circle : circles) {
    const std::uint32_t outer = inner + inner_corners;
    for (std::uint32_t i = 0; i < circle.corners; ++i) {
      const std::uint32_t next = (i + 1) % circle.corners;
      const std::uint32_t a = inner + i * inner_corners / circle.corners;
      const std::uint32_t b = inner + next * inner_corners / circle.corners;
      if (a != b) // the corner between two inner ones belongs to both
        indices_.insert(indices_.end(), {a, outer + i, b});
      indices_.insert(indices_.end(), {b, outer + i, outer + next});
    }
    indices_within_.push_back(static_cast<std::int32_t>(indices_.size()));
    inner = outer;
    inner_corners = circle.corners;
  }
}

void
ConeMesh::addSection(const std::vector<Circle>& circles,
                     const std::array<double, 3>& spacing,
                     double height)
{
  sections_.push_back({static_cast<std::int32_t>(vertices_.size()),
                       indices_within_[circles.size() - 1]});
  vertices_.push_back({0.0f, 0.0f, static_cast<float>(height)});
  for (const Circle& circle : circles) {
    const auto distance = static_cast<float>(std::hypot(circle.radius, height));
    for (std::uint32_t i = 0; i < circle.corners; ++i) {
      const double angle = 2.0 * pi * i / circle.corners;
      vertices_.push_back(
          {static_cast<float>(circle.radius * std::cos(angle) / spacing[0]),
           static_cast<float>(circle.radius * std::sin(angle) / spacing[1]),
           distance});
    }
  }
}

} // namespace pcl_uvol
