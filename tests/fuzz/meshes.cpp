// SPDX-License-Identifier: BSD-3-Clause
#include "meshes.h"

#include <map>
#include <utility>

namespace uvol_fuzz {

namespace {

using pcl_uvol::Triangle;
using Side = std::pair<std::uint32_t, std::uint32_t>;

/** The torus of fewest vertices, each of which is a neighbour of all others (Moebius
 * 1886). */
ClosedMesh
makeTorus()
{
  constexpr std::uint32_t vertices = 7;
  ClosedMesh torus{{}, vertices, 1};
  for (std::uint32_t i = 0; i < vertices; ++i) {
    torus.triangles.push_back({i, (i + 1) % vertices, (i + 3) % vertices});
    torus.triangles.push_back({i, (i + 3) % vertices, (i + 2) % vertices});
  }
  return torus;
}

ClosedMesh
makeTetrahedron()
{
  return {{{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{0, 3, 2}}}, 4, 0};
}

std::map<Side, std::size_t>
countSides(const std::vector<Triangle>& triangles, std::size_t vertices)
{
  std::map<Side, std::size_t> sides;
  for (const Triangle& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      require(triangle[i] < vertices, "triangles have vertices");
      ++sides[{triangle[i], triangle[(i + 1) % 3]}];
    }
  return sides;
}

} // namespace

ClosedMesh
takeMesh(Bytes& bytes)
{
  constexpr std::size_t most_divisions = 24;
  ClosedMesh mesh = bytes.flip() ? makeTorus() : makeTetrahedron();
  for (std::size_t left = bytes.choose(most_divisions); left > 0; --left) {
    Triangle& divided = mesh.triangles[bytes.choose(mesh.triangles.size())];
    const auto [a, b, c] = divided;
    const std::uint32_t middle = mesh.vertices++;
    divided = {a, b, middle};
    mesh.triangles.push_back({b, c, middle});
    mesh.triangles.push_back({c, a, middle});
  }
  return mesh;
}

void
requireNoRim(const std::vector<Triangle>& triangles, std::size_t vertices)
{
  const auto sides = countSides(triangles, vertices);
  for (const auto& [side, count] : sides) {
    const auto other = sides.find({side.second, side.first});
    require(other != sides.end() && other->second == count, "a mesh has no rim");
  }
}

void
requireClosed(const std::vector<Triangle>& triangles, std::size_t vertices)
{
  requireNoRim(triangles, vertices);
  for (const auto& [side, count] : countSides(triangles, vertices))
    require(count == 1, "no side is run through twice");
}

} // namespace uvol_fuzz
