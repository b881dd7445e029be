// SPDX-License-Identifier: BSD-3-Clause
// Inside and outside of closed pieces by columns through them.
#include "measured_shapes.h"
#include "mesh/mesh_columns.h"
#include "mesh/surface_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace test_mesh_columns {

using namespace pcl_uvol;
using namespace uvol_test;

TEST(MeshColumns, DistinguishInsideFromOutsideOnGridPlanes)
{
  // A box whose corners and edges lie above and below the places that are asked for.
  MeasuredShape box = makeBox({4.0, 4.0, 4.0});
  MeasuredShape ball = makeEllipsoid({6.0, 6.0, 6.0}, 3);
  ball.transform(Eigen::Matrix3d::Identity(), {2.0, 2.0, 2.0});
  box.append(ball);
  const detail::PieceList list = detail::findPieces(box.triangles, box.places.size());
  const detail::MeshColumns columns(box.places, box.triangles, list.of_vertex);
  std::vector<detail::Winding> found;
  const std::int32_t of_box = list.of_vertex[0], of_ball = list.of_vertex.back();
  for (int x = -5; x <= 9; ++x)
    for (int y = -5; y <= 9; ++y)
      for (double z : {-5.0, -0.5, 0.5, 2.0, 3.5, 4.5, 8.0}) {
        const Eigen::Vector3d place(x, y, z);
        columns.findAround(place, found);
        const double away = (place - Eigen::Vector3d(2.0, 2.0, 2.0)).norm();
        const auto turns = [&](std::int32_t piece) {
          for (const detail::Winding& winding : found)
            if (winding.piece == piece)
              return winding.turns;
          return 0;
        };
        if (std::abs(away - 6.0) > 0.2) {
          EXPECT_EQ(away < 6.0 ? 1 : 0, turns(of_ball)) << place.transpose();
        }
        if (x != 0 && x != 4 && y != 0 && y != 4) {
          const bool is_inside = x > 0 && x < 4 && y > 0 && y < 4 && z > 0 && z < 4;
          EXPECT_EQ(is_inside ? 1 : 0, turns(of_box)) << place.transpose();
        }
      }
}

/** As the outermost samples of a lattice lie on caps. */
TEST(MeshColumns, PlacesOnTheFacesOfTheBoxAreInside)
{
  MeasuredShape box = makeBox({4.0, 4.0, 4.0});
  MeasuredShape hole = makeBox({2.0, 2.0, 2.0});
  hole.transform(Eigen::Matrix3d::Identity(), {1.0, 1.0, 1.0});
  for (Triangle& triangle : hole.triangles)
    std::swap(triangle[0], triangle[1]);
  box.append(hole);
  const detail::PieceList list = detail::findPieces(box.triangles, box.places.size());
  const detail::MeshColumns columns(box.places, box.triangles, list.of_vertex);
  std::vector<detail::Winding> found;
  for (int x = 0; x <= 4; ++x)
    for (int y = 0; y <= 4; ++y)
      for (int z = 0; z <= 4; ++z) {
        columns.findAround(Eigen::Vector3d(x, y, z), found);
        int turns = 0;
        for (const detail::Winding& winding : found)
          turns += winding.turns;
        const auto is_between = [](int at) { return at > 0 && at < 4; };
        if (is_between(x) && is_between(y) && is_between(z)) {
          EXPECT_TRUE(turns == 0 || turns == 1); // on the hole, or in it
          if (x == 2 && y == 2 && z == 2) {
            EXPECT_EQ(0, turns);
          }
        }
        else {
          EXPECT_EQ(1, turns) << x << ' ' << y << ' ' << z;
        }
      }
}

} // namespace test_mesh_columns
