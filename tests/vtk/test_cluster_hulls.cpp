// SPDX-License-Identifier: BSD-3-Clause
// Hulls of clusters: closed surfaces of the genus of the cluster, through its points.
#include "vtk/cluster_shapes.h"

namespace test_cluster_hulls {

using namespace uvol_test;

/** A cluster of a shape whose surface is known. */
struct Shape {
  std::string name;
  Points (*make)(std::size_t number, std::uint64_t seed);
  double distance; ///< bridges the gaps between points, and nothing else
  std::vector<long> genera;
  bool is_solid;
};

void
PrintTo(const Shape& shape, std::ostream* stream)
{
  *stream << shape.name;
}

class HullsOfShapes : public testing::TestWithParam<Shape> {
protected:
  static constexpr std::size_t number = 4000;
  const Cluster cluster_{Cluster(GetParam().make(number, 1))};
  const double voxel_ = cluster_.voxel(GetParam().distance);
  const ClusterSurface hull_ =
      cluster_.enclose(ClusterSurfaceKind::Hull, GetParam().distance);
};

TEST_P(HullsOfShapes, AreClosedAndOfTheirGenus)
{
  for (std::uint64_t seed = 1; seed < 4; ++seed)
    for (const std::uint32_t along : {64u, cells, 150u}) {
      const Cluster cluster(GetParam().make(number, seed));
      const Mesh mesh =
          cluster.enclose(ClusterSurfaceKind::Hull, GetParam().distance, along).mesh;
      EXPECT_GT(expectClosed(mesh), 0.9); // small pieces may have two neighbours only
      EXPECT_EQ(GetParam().genera, generaOf(mesh)) << seed << ", " << along;
      if (GetParam().is_solid) {
        EXPECT_GT(signedVolume(mesh), 0.0);
      }
    }
}

TEST_P(HullsOfShapes, HaveTheirPointsAsVertices)
{
  ASSERT_EQ(hull_.mesh.vertices.size(), hull_.points.size());
  for (std::uint32_t i = 0; i < hull_.points.size(); ++i)
    EXPECT_EQ(cluster_[hull_.points[i]], vertexOf(hull_.mesh, i));
}

/** Nearly all regions of a solid are of one piece; a sheet shows most of its points to
 * both sides. */
TEST_P(HullsOfShapes, HaveAVertexPerPieceOfARegion)
{
  const ClusterSurface fine =
      cluster_.enclose(ClusterSurfaceKind::Hull, GetParam().distance, 384);
  std::map<std::uint32_t, std::size_t> times;
  for (const std::uint32_t point : fine.points)
    ++times[point];
  const auto several = static_cast<std::size_t>(std::count_if(
      times.begin(), times.end(), [](const auto& entry) { return entry.second > 1; }));
  if (GetParam().is_solid) {
    EXPECT_LT(several, times.size() / 10);
  }
  else {
    EXPECT_GT(several, times.size() / 2);
  }
}

/** The points that the surface at the distance is nearest to, and no others. */
TEST_P(HullsOfShapes, TakeThePointsThatTheSurfaceIsNearestTo)
{
  const Mesh around =
      cluster_.enclose(ClusterSurfaceKind::Distance, GetParam().distance).mesh;
  // Points count as at the centres of their cells.
  const double rounding = 1.7321 * voxel_;
  std::vector<bool> is_vertex(number, false), is_nearest(number, false);
  for (const std::uint32_t point : hull_.points)
    is_vertex[point] = true;
  Points points;
  for (std::size_t i = 0; i < number; ++i)
    points.push_back(cluster_[i]);
  double worst = 0.0;
  for (std::uint32_t i = 0; i < around.vertices.size(); i += 3) {
    const Vector3d place = vertexOf(around, i);
    double least = 1e30, least_of_hull = 1e30;
    for (std::size_t j = 0; j < number; ++j) {
      const double distance = (points[j] - place).norm();
      least = std::min(least, distance);
      if (is_vertex[j])
        least_of_hull = std::min(least_of_hull, distance);
    }
    worst = std::max(worst, least_of_hull - least);
    for (std::size_t j = 0; j < number; ++j)
      if (is_vertex[j] && !is_nearest[j])
        is_nearest[j] = (points[j] - place).norm() < least + rounding;
  }
  EXPECT_LT(worst, rounding);
  EXPECT_EQ(is_vertex, is_nearest);
}

TEST_P(HullsOfShapes, LeaveNoPointOutside)
{
  double farthest = 0.0;
  for (std::size_t i = 0; i < number; ++i) {
    const Vector3d place = cluster_[i];
    // Vertices are on the hull: there is no winding number.
    const double distance = distanceToTriangles(hull_.mesh, place);
    if (distance <= farthest ||
        (GetParam().is_solid && windingNumber(hull_.mesh, place) > 0.5))
      continue;
    farthest = distance;
  }
  EXPECT_LT(farthest, voxel_);
}

/** Every 29th vertex of the surface at a distance from the hull. */
TEST_P(HullsOfShapes, AreWhatHullDistancesAreMeasuredFrom)
{
  const Mesh around =
      cluster_.enclose(ClusterSurfaceKind::HullDistance, GetParam().distance).mesh;
  expectClosed(around);
  EXPECT_EQ(GetParam().genera, generaOf(around));
  EXPECT_GT(signedVolume(around), 0.0);
  double largest_error = 0.0;
  for (std::uint32_t i = 0; i < around.vertices.size(); i += 29)
    largest_error =
        std::max(largest_error,
                 std::abs(distanceToTriangles(hull_.mesh, vertexOf(around, i)) -
                          GetParam().distance));
  EXPECT_LT(largest_error, voxel_);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes,
    HullsOfShapes,
    testing::Values(Shape{"Ball", ballOf, 0.22, {0}, true},
                    Shape{"Torus", torusOf, 0.2, {1}, true},
                    Shape{"LinkedTubes", linkedTubesOf, 0.17, {1, 1}, true},
                    Shape{"BentSheet", bentSheetOf, 0.12, {0}, false}),
    [](const auto& shape) { return shape.param.name; });

/** Finds the nearest by brute force; of equally near places the first one. */
template <typename Candidates>
std::uint32_t
nearestOf(const Points& points, const Candidates& candidates, const Vector3d& place)
{
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = 0;
  for (const std::uint32_t i : candidates) {
    const double sq_dist = (points[i] - place).squaredNorm();
    if (sq_dist < least) {
      least = sq_dist;
      nearest = i;
    }
  }
  return nearest;
}

/** Points at the centres of cells of side 1, so that nothing is rounded. The region of
 * a vertex is that of one of the eight centres around it. */
TEST(ClusterSurfaces, ShrinkTheRegionsOfBruteForce)
{
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Points points;
    for (int z = -20; z <= 20; ++z)
      for (int y = -20; y <= 20; ++y)
        for (int x = -20; x <= 20; ++x) {
          const Vector3d place(x, y, z);
          const auto index = static_cast<std::uint64_t>((z * 41 + y) * 41 + x);
          // The whole sphere spans the grid.
          if (place.norm() == 20.0 ||
              (place.norm() < 20.0 && uniformAt(seed, index, 0) < 0.04))
            points.push_back(place);
        }
    const Cluster cluster(points);
    const Mesh around = cluster.enclose(ClusterSurfaceKind::Distance, 4.5, 49).mesh;
    std::vector<std::uint32_t> regions;
    for (std::uint32_t i = 0; i < around.vertices.size(); ++i) {
      const Vector3d place = vertexOf(around, i);
      std::set<std::uint32_t> candidates;
      for (int corner = 0; corner < 8; ++corner)
        candidates.insert(
            nearestOf(points,
                      cluster.members(),
                      place.array().floor().matrix() +
                          Vector3d(corner & 1, corner >> 1 & 1, corner >> 2)));
      regions.push_back(nearestOf(points, candidates, place));
    }
    const auto expected = pcl_uvol::makeClusterHull(around.triangles, regions);
    const ClusterSurface hull = cluster.enclose(ClusterSurfaceKind::Hull, 4.5, 49);
    EXPECT_EQ(expected.regions, hull.points);
    EXPECT_EQ(expected.triangles, hull.mesh.triangles);
  }
}

} // namespace test_cluster_hulls
