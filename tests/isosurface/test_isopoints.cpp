// SPDX-License-Identifier: BSD-3-Clause
// Isopoints on edges, and what becomes of those that fall together.
#include "isopoint_setup.h"
#include "src/isosurface/isopoints.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace test_isopoints {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::FieldSamples;

Vector3d
toVector(const float* v)
{
  return {v[0], v[1], v[2]};
}

TEST(MergeCoincident, KeepsTheFirstWithTheMeanOfTheNormals)
{
  const std::vector<Position> positions{{{1, 2, 3}},
                                        {{4, 5, 6}},
                                        {{1, 2, 3}},
                                        {{-0.0f, 0, 0}},
                                        {{4, 5, 6}},
                                        {{1, 2, 3}},
                                        {{1, 2, 3.0000002f}},
                                        {{0, 0, 0}}};
  std::vector<Position> normals{{{1, 0, 0}},
                                {{0, 0, 1}},
                                {{0, 1, 0}},
                                {{0, 0.6f, 0.8f}},
                                {{0, 0, -1}},
                                {{0, 0, 1}},
                                {{1, 0, 0}},
                                {{0, 0.6f, 0.8f}}};
  const auto stays = mergeCoincident(positions, normals, 2);
  EXPECT_EQ((std::vector<std::uint8_t>{1, 1, 0, 1, 0, 0, 1, 0}), stays);
  const double third = 1.0 / std::sqrt(3.0);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(third, normals[0][axis], 1e-7);
  // Opposite ones have no mean.
  EXPECT_EQ(Vector3d(0, 0, 1), toVector(normals[1].x));
  EXPECT_NEAR(0.0, (toVector(normals[3].x) - Vector3d(0, 0.6, 0.8)).norm(), 1e-6);
  EXPECT_EQ(Vector3d(1, 0, 0), toVector(normals[6].x));
}

TEST(PlaceIsopoint, IsLinearAlongTheEdgeInTheCoordinatesOfTheInput)
{
  const std::vector<Position> places{
      {{1.0f, 2.0f, 3.0f}}, {{2.0f, 0.0f, 5.0f}}, {{0.0f, 1.0f, 0.5f}}};
  for (const Outside outside : {Outside::Lower, Outside::Higher}) {
    const FieldSamples field(
        places, [](const Vector3d& x) { return 4.0 * x[0]; }, {{1.0f, 2.0f, 0.5f}});
    const IsopointInput input = field.input(outside, Interpolation::Linear);
    for (std::uint32_t a = 0; a < 3; ++a)
      for (std::uint32_t b = 0; b < 3; ++b) {
        const double fa = field.values()[a], fb = field.values()[b];
        if (fa == fb)
          continue;
        const double isovalue = 0.75 * fa + 0.25 * fb;
        PointIso point;
        IsoEdge edge{};
        placeIsopoint(
            input, EdgeKey(a) << 32 | b, static_cast<float>(isovalue), point, edge);
        EXPECT_EQ(a, edge.first);
        EXPECT_EQ(b, edge.second);
        EXPECT_NEAR(0.25, edge.t, 1e-7);
        const Vector3d along = field.place(b) - field.place(a);
        EXPECT_NEAR(
            0.0, (field.place(a) + 0.25 * along - toVector(point.data)).norm(), 1e-6);
        const bool forwards = (fb < fa) == (outside == Outside::Lower);
        // A normal is a covector of the stretched space.
        const Vector3d squares(1.0, 4.0, 0.25);
        const Vector3d normal = along.cwiseProduct(squares).normalized();
        EXPECT_NEAR(0.0,
                    ((forwards ? 1.0 : -1.0) * normal - toVector(point.data_n)).norm(),
                    1e-6);
        EXPECT_NEAR(along.norm(), point.edge_length, 1e-6);
        EXPECT_EQ(static_cast<float>(isovalue), point.isovalue);
      }
  }
}

/** On a lattice with samples at the isovalue many edges end in one point. */
TEST(AppendIsopoints, AverageTheOutsideVectorsOfAllEdgesThatMeet)
{
  std::vector<Position> places;
  for (int z = -2; z <= 2; ++z)
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x)
        places.push_back({{static_cast<float>(x) + 0.25f * static_cast<float>(y),
                           static_cast<float>(y),
                           static_cast<float>(z)}});
  const FieldSamples field(places, [](const Vector3d& x) {
    return x[0] - 0.25 * x[1]; // 0 at one layer of the sheared lattice
  });
  const IsopointInput input = field.input(Outside::Lower, Interpolation::Linear);
  Report report;
  SurfaceTally tally;
  const auto crossing = input.candidates.findCrossing(input.ranges, 0.0f, 1);
  std::map<std::array<float, 3>, Vector3d> sums;
  std::size_t edge_count = 0;
  for (const EdgeKey key : findEdges(input, crossing, 0.0f, tally, report)) {
    PointIso point;
    IsoEdge edge{};
    placeIsopoint(input, key, 0.0f, point, edge);
    Vector3d& sum =
        sums.try_emplace({point.x, point.y, point.z}, Vector3d::Zero()).first->second;
    sum += toVector(point.data_n);
    ++edge_count;
  }
  ASSERT_GT(edge_count, sums.size());
  pcl::PointCloud<PointIso> isopoints;
  IsoEdges edges;
  appendIsopoints(input, field.sources(), 0.0f, isopoints, edges, tally, report);
  EXPECT_EQ(edge_count - sums.size(), report.getCount("coincident"));
  ASSERT_EQ(sums.size(), isopoints.size());
  for (const PointIso& point : isopoints) {
    const auto sum = sums.find({point.x, point.y, point.z});
    ASSERT_NE(sums.end(), sum);
    EXPECT_NEAR(0.0, (sum->second.normalized() - toVector(point.data_n)).norm(), 1e-6);
  }
}

} // namespace test_isopoints
