// SPDX-License-Identifier: BSD-3-Clause
// uvol_cluster from the outside: clusters are enclosed.
#include "tools/cluster_tool.h"

#include <array>

namespace test_uvol_cluster_surfaces {

using namespace uvol_test;

TEST_F(ClusterTool, HullsArePointsOfTheClusterWithTheirFields)
{
  const auto mesh = meshOf(attributes_ + "-cluster 1 -surface hull");
  EXPECT_GT(mesh.triangles.size(), 50u);
  EXPECT_LT(uvol_test::signedVolume(mesh), 4.2); // the ball's
  EXPECT_GT(uvol_test::signedVolume(mesh), 1.0);
  const Dataset vertices = pcl_uvol::loadDataset(out_);
  const auto ids = fieldOf(vertices, "id"), label = fieldOf(vertices, "label");
  const auto a = fieldOf(vertices, "a"), normal = fieldOf(vertices, "normal_x");
  const auto samples = makeSamples();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Sample& sample = samples[static_cast<std::size_t>(ids[i])];
    EXPECT_EQ(1, sample.cluster);
    EXPECT_EQ(1.0, label[i]);
    EXPECT_NEAR(sample.attributes[0], a[i], 1e-4);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(sample.place[axis], mesh.vertices[i][axis] + mesh.origin[axis], 1e-5);
    EXPECT_LE(std::abs(normal[i]), 1.0);
  }
}

TEST_F(ClusterTool, SurfacesAtADistanceAreAtThatDistance)
{
  constexpr double distance = 0.6, cell = (2.0 + 2.0 * distance) / 48.0;
  const auto mesh =
      meshOf(attributes_ + "-cluster 1 -surface distance -distance 0.6 -grid 48");
  for (const auto& vertex : mesh.vertices) // between centres of cells
    ASSERT_NEAR(distance, distanceTo(1, vertex), 2.0 * cell);
  const auto result = run(attributes_ + "-cluster 1 -surface distance -json");
  EXPECT_NE(std::string::npos, result.out.find("\"distance\": 0")) << result.out;
}

TEST_F(ClusterTool, SurfacesAroundHullsAreBeyondTheirPoints)
{
  constexpr double distance = 0.6, cell = (2.0 + 2.0 * distance) / 48.0;
  const std::string options = attributes_ + "-cluster 1 -distance 0.6 -grid 48 ";
  const double of_points =
      uvol_test::signedVolume(meshOf(options + "-surface distance"));
  const auto mesh = meshOf(options + "-surface hull-distance");
  EXPECT_GT(uvol_test::signedVolume(mesh), of_points);
  for (const auto& vertex : mesh.vertices)
    ASSERT_GT(distanceTo(1, vertex), distance - 2.0 * cell);
}

TEST_F(ClusterTool, TooSmallDistancesAreReported)
{
  const auto result =
      succeeded(run(attributes_ + "-cluster 1 -surface distance -distance 0.05 "
                                  "-grid 300 -json"));
  EXPECT_TRUE(hasMessage(result, "short_distance")) << result.out;
  std::remove(out_.c_str());
  expectError(attributes_ + "-cluster 1 -surface distance -distance 1e-9",
              "small_cluster_distance",
              "1e-09");
}

TEST_F(ClusterTool, DistancesMayBeStretched)
{
  uvol_test::writeFile(in_, "x,y,z,label\n1,2,3,0\n9,9,9,1\n");
  const auto mesh =
      meshOf("-cluster 0 -surface distance -distance 0.5 -scale 1,1,4 -grid 64");
  const double ball = 4.0 / 3.0 * M_PI * 0.125;
  EXPECT_NEAR(ball / 4.0, uvol_test::signedVolume(mesh), 0.05 * ball / 4.0);
  for (const auto& vertex : mesh.vertices)
    ASSERT_LT(std::abs(vertex[2] - 3.0f), 0.14f);
}

TEST_F(ClusterTool, MembershipPartsSamplesOfTheClusterFromOthers)
{
  const Dataset border = resultOf(attributes_ + "-cluster 1 -surface membership");
  EXPECT_GT(border.cloud.width, 10u);
  // Midpoints of edges between balls of radius 1.
  for (const double x : fieldOf(border, "x"))
    EXPECT_NEAR(0.5 * apart, std::abs(x + border.origin[0] - apart), 1.0);
  for (const char* field : {"a", "truth", "normal_x"})
    EXPECT_NE(nullptr, pcl_uvol::findField(border.cloud.fields, field)) << field;
}

TEST_F(ClusterTool, BordersThatRunThroughGapsAreReported)
{
  for (const char* smoothing : {"", "-smoothing-length h"}) {
    const auto result =
        run(attributes_ + "-cluster 1 -surface membership -json " + smoothing);
    EXPECT_TRUE(hasMessage(result, "unconstrained_border")) << result.out;
    EXPECT_FALSE(hasMessage(result, "unconstrained_isopoints")) << result.out;
    for (const char* option : {"-validate", "-fill-gaps", "-drop-bridged"})
      EXPECT_EQ(std::string::npos, result.out.find(option)) << result.out;
  }
}

TEST_F(ClusterTool, BordersAmongSamplesAreNotReported)
{
  uvol_test::Random random(5);
  std::string csv = "x,y,z,label\n";
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    csv += joined(std::array<double, 3>{x, y, z}) + (x + y < 1.0 ? ",0\n" : ",1\n");
  }
  uvol_test::writeFile(in_, csv);
  EXPECT_EQ("", run("-cluster 1 -surface membership").err);
}

TEST_F(ClusterTool, MembershipMayBeSmoothOrUncertain)
{
  const std::string options = attributes_ + "-cluster 1 -surface membership ";
  const auto plain = fieldOf(resultOf(options), "x");
  for (const char* option : {"-probability probability",
                             "-smoothing-length h",
                             "-probability probability -smoothing-length h"}) {
    const Dataset border = resultOf(options + option);
    EXPECT_GT(border.cloud.width, 10u) << option;
    EXPECT_NE(plain, fieldOf(border, "x")) << option;
    for (const double x : fieldOf(border, "x"))
      EXPECT_LT(std::abs(x + border.origin[0] - apart), apart) << option;
  }
}

TEST_F(ClusterTool, SurfacesKeepThePlaceOfFarPoints)
{
  std::ostringstream csv;
  csv.precision(12);
  csv << "x,y,z,label\n";
  for (const Sample& s : makeSamples())
    csv << s.place[0] + 5e6 << ',' << s.place[1] - 3e6 << ',' << s.place[2] << ','
        << s.cluster << '\n';
  uvol_test::writeFile(in_, csv.str());
  for (const char* surface : {"distance", "hull", "hull-distance"}) {
    const auto mesh = meshOf(std::string("-cluster 0 -surface ") + surface);
    double low = 1e9, high = -1e9;
    for (const auto& vertex : mesh.vertices) {
      low = std::min(low, vertex[0] + mesh.origin[0]);
      high = std::max(high, vertex[0] + mesh.origin[0]);
    }
    EXPECT_NEAR(5e6, 0.5 * (low + high), 0.5) << surface;
  }
}

TEST_F(ClusterTool, SurfacesNeedCoordinates)
{
  uvol_test::writeFile(in_, attributeTable());
  for (const char* surface : {"membership", "distance", "hull", "hull-distance"})
    expectError(attributes_ + "-cluster 1 -surface " + surface,
                "no_coordinates_to_draw");
}

TEST_F(ClusterTool, TinyClustersGetASurfaceOrAClearAnswer)
{
  uvol_test::writeFile(in_,
                       "x,y,z,label\n0,0,0,0\n1,0,0,1\n1,1,0,1\n0,0,1,2\n3,3,3,2\n"
                       "5,0,0,2\n0,5,0,2\n2,6,5,2\n1,1,1,2\n2,0,0,2\n");
  // One point.
  expectError("-cluster 0 -surface distance", "cluster_at_one_place");
  expectError("-cluster 0 -surface hull", "few_points_for_hull");
  expectError("-cluster 0 -surface hull-distance", "few_points_for_hull");
  for (const char* surface : {"hull", "hull-distance"}) {
    const std::string option = std::string(" -surface ") + surface;
    expectError("-cluster 0 -distance 0.5" + option, "few_points_for_hull");
    expectError("-cluster 1" + option, "few_points_for_hull"); // two points
    expectError("-cluster 1 -distance 2" + option, "few_points_for_hull");
  }
  const double ball = 4.0 / 3.0 * M_PI * 0.125;
  EXPECT_NEAR(
      ball,
      uvol_test::signedVolume(meshOf("-cluster 0 -surface distance -distance 0.5")),
      0.05 * ball);
  EXPECT_GT(uvol_test::signedVolume(meshOf("-cluster 1 -surface distance")), ball);
  for (const char* cluster : {"0", "1"})
    EXPECT_GT(
        resultOf(std::string("-surface membership -cluster ") + cluster).cloud.width,
        0u);
}

} // namespace test_uvol_cluster_surfaces
