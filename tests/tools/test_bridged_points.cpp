// SPDX-License-Identifier: BSD-3-Clause
// Isopoints in gaps of the sampling are single pixels in pictures, paler than the
// others, whatever draws them; what lies where samples are is drawn as without them.
#include "support/environment.h"
#include "support/png.h"
#include "tools/json_warnings.h"
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>
#include <nlohmann/json.hpp>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_bridged_points {

constexpr std::size_t points = 60; // in gaps

/** A sphere of isopoints, and beside it a row of points of a gap that look to the top.
 */
Dataset
makeSurface()
{
  pcl::PointCloud<PointIso> cloud;
  constexpr int of_sphere = 6000;
  for (int i = 0; i < of_sphere; ++i) { // a spiral of even density
    const double z = 1.0 - (2.0 * i + 1.0) / of_sphere, angle = 2.399963 * i;
    const double flat = std::sqrt(1.0 - z * z);
    PointIso point;
    point.getVector3fMap() << static_cast<float>(flat * std::cos(angle)),
        static_cast<float>(flat * std::sin(angle)), static_cast<float>(z);
    point.getNormalVector3fMap() = point.getVector3fMap();
    point.edge_length = 0.1f;
    point.support = static_cast<std::uint8_t>(IsoSupport::Measured);
    cloud.push_back(point);
  }
  for (std::size_t i = 0; i < points; ++i) {
    PointIso point;
    point.getVector3fMap() << -1.5f + 3.0f * static_cast<float>(i) / points, 1.3f, 0.0f;
    point.getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
    point.edge_length = 5.0f;
    point.support = static_cast<std::uint8_t>(IsoSupport::Bridged);
    cloud.push_back(point);
  }
  Dataset dataset;
  pcl::toPCLPointCloud2(cloud, dataset.cloud);
  return dataset;
}

class BridgedPoints
    : public testing::TestWithParam<std::pair<const char*, const char*>> {
protected:
  BridgedPoints()
  {
    saveDataset(folder_ / "s.ply", makeSurface());
  }

  TemporaryFolder folder_;
};

/** Pixels that differ from a white background in the rows above the sphere. */
struct Dots {
  std::size_t count = 0;
  int darkest = 255;
};

Dots
findDots(const Image& image)
{
  // The sphere ends at y = 1; the rows about y = 1.3 are seen above it.
  Dots dots;
  std::size_t first = image.pixels(), last = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i)
    if (image.color[4 * i] < 250) {
      first = std::min(first, i / image.width);
      last = std::max(last, i / image.width);
    }
  const std::size_t above = first + (last - first) / 20;
  for (std::size_t i = 0; i < above * image.width; ++i)
    if (image.color[4 * i] < 250) {
      ++dots.count;
      dots.darkest = std::min<int>(dots.darkest, image.color[4 * i]);
    }
  return dots;
}

TEST_P(BridgedPoints, AreSinglePalePixels)
{
  const auto [tool, drawn] = GetParam();
  runWell("uvol_splats " + (folder_ / "s.ply") + " " + (folder_ / "splats.ply"));
  const std::string command =
      std::string(tool) + " '" + (folder_ / drawn) + "' '" + (folder_ / "s.png") +
      "' -size 200x200 -view top -zoom 0.6 -surface-color 0.2,0.2,0.2 ";
  const CommandResult result = runWell(command + "-json");
  EXPECT_EQ(points,
            nlohmann::json::parse(result.out)["counts"]["bridged"].get<std::size_t>());
  int channels = 0;
  const Dots dots = findDots(readPng(folder_ / "s.png", channels));
  EXPECT_GE(dots.count, points / 2);
  EXPECT_LE(dots.count, 4 * points); // a dot that rays meet may lie between four pixels
  // The surface is dark; mixed with white by half no channel is below 255 / 2.
  EXPECT_GT(dots.darkest, 100);
}

INSTANTIATE_TEST_SUITE_P(
    ,
    BridgedPoints,
    testing::Values(std::pair("uvol_render -backend cpu", "s.ply"),
                    std::pair("uvol_render -backend osmesa", "s.ply"),
                    std::pair("uvol_raytrace -no-shadows", "s.ply"),
                    std::pair("uvol_raytrace -no-shadows", "splats.ply")));

} // namespace test_bridged_points
