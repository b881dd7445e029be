// SPDX-License-Identifier: BSD-3-Clause
// Rims in opposite faces that get the same vertices.
#include "src/mesh/rim_welding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

namespace test_rim_welding {

using namespace pcl_uvol;
using detail::MatchedRims;
using detail::RimVertex;

/** Strips of triangles that end in the planes x = 0 and x = 4, in rims along y at z = 0
 * with vertices at these places; their other sides lie one off the faces. */
class Strips {
public:
  Strips(const std::vector<double>& low, const std::vector<double>& high)
  {
    add(low, 0.0, 1.0);
    first_high_ = static_cast<std::uint32_t>(vertices_.size());
    add(high, 4.0, -1.0);
  }

  MatchedRims
  match() const
  {
    return detail::matchRims(vertices_, {0, 0.0, 4.0}, triangles_);
  }

  RimVertex&
  lowAt(std::size_t i)
  {
    return vertices_[2 * i];
  }

  RimVertex&
  highAt(std::size_t i)
  {
    return vertices_[first_high_ + 2 * i];
  }

  std::uint32_t
  highIndex(std::size_t i) const
  {
    return first_high_ + 2 * static_cast<std::uint32_t>(i);
  }

  /** Where a vertex of the result lies along y, if images are moved as they should be.
   */
  double
  yOf(const IsoEdge& vertex) const
  {
    const double from = vertices_[vertex.first].place.y(),
                 to = vertices_[vertex.second].place.y();
    return from + static_cast<double>(vertex.t) * (to - from);
  }

  /** Area of a result with images moved. */
  double
  areaOf(const MatchedRims& result) const
  {
    std::vector<Eigen::Vector3d> places;
    for (const IsoEdge& vertex : result.vertices)
      places.emplace_back(vertices_[vertex.first].place.x(), yOf(vertex), 0.0);
    for (const auto& [vertex, image] : result.images)
      places[image].x() = 4.0;
    double area = 0.0;
    for (const auto& [a, b, c] : result.triangles) {
      const double twice = (places[b] - places[a]).cross(places[c] - places[a]).z();
      EXPECT_GT(twice, 0.0);
      area += twice / 2.0;
    }
    return area;
  }

private:
  /** Triangles look to z.
   * \param inward of the face along x */
  void
  add(const std::vector<double>& ys, double x, double inward)
  {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    for (const double y : ys)
      for (const double at : {x, x + inward})
        vertices_.push_back({{at, y, 0.0}, 0.5, 1.0, 0});
    for (std::uint32_t i = 0; i + 1 < ys.size(); ++i) {
      const std::uint32_t a = first + 2 * i, b = a + 1, c = a + 2, d = a + 3;
      if (inward > 0.0) {
        triangles_.push_back({a, b, d});
        triangles_.push_back({a, d, c});
      }
      else {
        triangles_.push_back({b, a, c});
        triangles_.push_back({b, c, d});
      }
    }
  }

  std::vector<RimVertex> vertices_;
  std::vector<Triangle> triangles_;
  std::uint32_t first_high_ = 0;
};

/** Places along y of images, once for each. */
std::vector<double>
listImages(const Strips& strips, const MatchedRims& result)
{
  std::vector<double> places;
  for (const auto& [vertex, image] : result.images) {
    const IsoEdge &a = result.vertices[vertex], &b = result.vertices[image];
    EXPECT_EQ(strips.yOf(a), strips.yOf(b));
    EXPECT_EQ(a.first, b.first); // all fields are the same
    EXPECT_EQ(a.t, b.t);
    places.push_back(strips.yOf(a));
  }
  std::sort(places.begin(), places.end());
  return places;
}

TEST(RimWelding, SplitsEdgesWhereTheOtherRimHasVertices)
{
  const Strips strips({0.0, 1.0, 2.0, 3.0}, {0.0, 0.5, 1.5, 1.75, 3.0});
  const MatchedRims result = strips.match();
  EXPECT_EQ((std::vector<double>{0.0, 0.5, 1.0, 1.5, 1.75, 2.0, 3.0}),
            listImages(strips, result));
  EXPECT_EQ(6u + 8u + 3u + 2u, result.triangles.size());
  EXPECT_NEAR(6.0, strips.areaOf(result), 1e-6);
}

TEST(RimWelding, NearVerticesBecomeOne)
{
  // A fifth of the reach is 0.1; of two near ones the nearer becomes the image.
  const Strips strips({0.0, 1.0, 2.0}, {0.0, 0.91, 1.05, 1.89, 2.0});
  const MatchedRims result = strips.match();
  const std::vector<double> places = listImages(strips, result);
  ASSERT_EQ(5u, places.size());
  EXPECT_DOUBLE_EQ(1.0, places[2]);
  EXPECT_NEAR(0.91, places[1], 1e-6);
  EXPECT_NEAR(1.89, places[3], 1e-6);
  EXPECT_NEAR(4.0, strips.areaOf(result), 1e-6);
}

TEST(RimWelding, VerticesTooDenseAreSpreadAlongTheRim)
{
  Strips strips({0.0, 1.0}, {0.0, 0.5, 0.51, 1.0});
  // Beside one another, and in the wrong order as seen from the other rim.
  strips.highAt(1).place.y() = 0.505;
  strips.highAt(2).place.y() = 0.5;
  const MatchedRims result = strips.match();
  const std::vector<double> places = listImages(strips, result);
  ASSERT_EQ(4u, places.size());
  EXPECT_NEAR(1.0 / 3.0, places[1], 1e-6);
  EXPECT_NEAR(2.0 / 3.0, places[2], 1e-6);
  EXPECT_NEAR(2.0, strips.areaOf(result), 1e-6);
}

TEST(RimWelding, OnlyWhatIsNearRunsAlongAndHasTheSameIsovalueIsAnImage)
{
  const std::vector<double> low = {0.0, 1.0, 2.0}, high = {0.0, 0.5, 2.0};
  Strips far(low, high);
  for (std::size_t i = 0; i < 3; ++i)
    far.highAt(i).place.z() = 0.51; // the reach is 0.5
  EXPECT_TRUE(far.match().images.empty());

  Strips other(low, high);
  for (std::size_t i = 0; i < 3; ++i)
    other.highAt(i).isovalue = 2.0;
  EXPECT_TRUE(other.match().images.empty());

  // A rim that runs the other way belongs to a surface that looks the other way.
  EXPECT_TRUE(Strips(low, {2.0, 0.5, 0.0}).match().images.empty());
}

TEST(RimWelding, CornersAreImagesOfCorners)
{
  Strips strips({0.0, 1.0, 2.0}, {0.3, 1.0, 1.7});
  strips.lowAt(0).corner = strips.highAt(0).corner = 4;
  strips.lowAt(2).corner = strips.highAt(2).corner = 8;
  const std::vector<double> places = listImages(strips, strips.match());
  EXPECT_EQ((std::vector<double>{0.0, 1.0, 2.0}), places);
  strips.highAt(2).corner = 4;
  const MatchedRims result = strips.match();
  for (const auto& [vertex, image] : result.images)
    EXPECT_NE(strips.highIndex(2), image);
}

} // namespace test_rim_welding
