// SPDX-License-Identifier: BSD-3-Clause
// Triangles that bend with the normals of their corners: areas and volumes of arcs.
#include "mesh/curved_triangle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace test_curved_triangle {

using namespace pcl_uvol;

TEST(CurvedTriangle, EdgesPassThroughTheMiddleOfTheArc)
{
  // An edge of half a right angle of a unit circle, and a tip whose edges are straight.
  // Beyond the chord the bent edge cuts off two thirds of length times height.
  const auto on_circle = [](double angle) {
    const Eigen::Vector3d place(std::sin(angle), std::cos(angle), 0.0);
    return detail::SurfaceCorner{place, place};
  };
  const detail::SurfaceCorner tip{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const double half = M_PI / 8.0;
  const detail::CurvedTriangle triangle({on_circle(half), on_circle(-half), tip},
                                        Eigen::Vector3d::Zero());
  std::array<double, 3> shares;
  const double added =
      triangle.integrate(shares).area - triangle.integrateFlat(shares).area;
  EXPECT_NEAR(4.0 / 3.0 * std::sin(half) * (1.0 - std::cos(half)), added, 1e-14);
}

/** Triangles of caps are flat, whatever normals they have, but for the edge that stays
 * in a plane with the surface. */
TEST(CurvedTriangle, OfACapIsFlat)
{
  const auto tilted = [](double x, double y) {
    const Eigen::Vector3d normal(0.3 * x, 0.3 * y, 1.0);
    return detail::SurfaceCorner{{x, y, 0.0}, normal.normalized()};
  };
  std::array<detail::SurfaceCorner, 3> corners{
      tilted(1.0, 0.0), tilted(0.0, 1.0), tilted(-1.0, -1.0)};
  const Eigen::Vector3d center(0.0, 0.0, -1.0);
  std::array<double, 3> shares;
  EXPECT_LT(1.51, detail::CurvedTriangle(corners, center).integrate(shares).area);
  for (detail::SurfaceCorner& corner : corners) {
    corner.is_on_cap = true;
    const detail::SurfaceIntegrals flat =
        detail::CurvedTriangle(corners, center).integrate(shares);
    EXPECT_NEAR(1.5, flat.area, 1e-14);
    EXPECT_NEAR(0.5, flat.volume, 1e-14);
    EXPECT_EQ(0.0, flat.area_error);
    EXPECT_EQ(0.0, flat.volume_error);
    corner.is_on_cap = false;
  }
  // The edge opposite of the first corner bends in the plane of the cap alone.
  corners[0].is_on_cap = true;
  corners[1].normal = Eigen::Vector3d(-0.6, 0.8, 0.0);
  corners[2].normal = Eigen::Vector3d(-0.8, 0.6, 0.0);
  detail::EdgePlanes planes = detail::freeEdges();
  planes[0] = Eigen::Vector3d::UnitZ();
  const detail::SurfaceIntegrals bound =
      detail::CurvedTriangle(corners, center, planes).integrate(shares);
  EXPECT_LT(1.5 + 1e-3, bound.area);
  EXPECT_NEAR(bound.area / 3.0, bound.volume, 1e-14);
}

TEST(CurvedTriangle, IntegralsMoveWithTheCentre)
{
  const detail::CurvedTriangle here({detail::SurfaceCorner{{1.0, 0.0, 0.5}, {1, 0, 0}},
                                     detail::SurfaceCorner{{0.0, 1.0, 0.0}, {0, 1, 0}},
                                     detail::SurfaceCorner{{0.0, 0.0, 1.0}, {0, 0, 1}}},
                                    Eigen::Vector3d::Zero());
  std::array<double, 3> shares;
  const detail::SurfaceIntegrals integrals = here.integrate(shares);
  EXPECT_NEAR(integrals.area, shares[0] + shares[1] + shares[2], 1e-15);
  const Eigen::Vector3d offset(2.0, -3.0, 5.0);
  const detail::SurfaceIntegrals moved = integrals.shifted(offset),
                                 back = moved.shifted(-offset);
  EXPECT_NEAR(0.0, (back.products - integrals.products).norm(), 1e-12);
  EXPECT_NEAR(0.0, (back.area_products - integrals.area_products).norm(), 1e-12);
  EXPECT_NEAR(
      0.0, (moved.moment - integrals.moment - integrals.volume * offset).norm(), 1e-14);
}

} // namespace test_curved_triangle
