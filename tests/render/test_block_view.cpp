// SPDX-License-Identifier: BSD-3-Clause
// What is left out before drawing must not be seen: block by block against brute force.
#include "render/image_space/block_view.h"
#include "render/image_space/pixel_box.h"
#include "render/renderer_setup.h"
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/image_space/backend.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace test_block_view {

using namespace uvol_test;
using pcl_uvol::BlockView;
using pcl_uvol::Camera;
using pcl_uvol::Frame;
using pcl_uvol::PixelBox;
using pcl_uvol::SurfaceCloud;
using pcl_uvol::View;

TEST(PixelBox, UnitesClipsAndContains)
{
  const PixelBox none{5, 5, 5, 9}, a{0, 0, 4, 3}, b{2, 1, 8, 9};
  EXPECT_TRUE(none.isEmpty());
  EXPECT_TRUE(a.contains(none));
  EXPECT_FALSE(a.contains(b));
  const PixelBox both = a.unitedWith(b), common = a.clippedTo(b);
  EXPECT_TRUE(both.contains(a) && both.contains(b));
  EXPECT_EQ(both.width(), 8);
  EXPECT_EQ(common.width(), 2);
  EXPECT_EQ(common.height(), 2);
  EXPECT_TRUE(none.unitedWith(a).contains(a));
  EXPECT_EQ(none.unitedWith(a).width(), a.width());
}

/** Seen by brute force. */
struct SeenPoint {
  double x, y, z; ///< pixels of the buffers, distance along the line of sight
  bool looks_away;
  double extent; ///< of its disc, pixels
};

SeenPoint
see(const SurfaceCloud& cloud, std::uint32_t point, const View& view)
{
  Eigen::Vector3f position, normal;
  for (int axis = 0; axis < 3; ++axis)
    position[axis] = cloud.getCoordinates(axis)[point];
  pcl_uvol::unpackNormal(cloud.getNormals()[point], normal.data());
  const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> turn(
      view.rotation);
  const Eigen::Map<const Eigen::Vector3f> shift(view.translation);
  const Eigen::Vector3d c = (turn * position + shift).cast<double>();
  const double facing = (turn * normal).cast<double>().dot(c) / c.norm();
  return {view.center_x + view.focal * c.x() / c.z(),
          view.center_y + view.focal * c.y() / c.z(),
          c.z(),
          facing > 0.0,
          view.focal * cloud.getFootprints()[point] / c.z()};
}

/** Pixels of the buffers that the disc of a point in front of the eye touches at most.
 */
PixelBox
boxOf(const SeenPoint& point, const View& view)
{
  const auto pixel = [](double at) {
    return static_cast<int>(std::floor(std::clamp(at, -1e6, 1e6)));
  };
  return PixelBox{pixel(point.x - point.extent),
                  pixel(point.y - point.extent),
                  pixel(point.x + point.extent) + 1,
                  pixel(point.y + point.extent) + 1}
      .clippedTo({0, 0, view.bufferWidth(), view.bufferHeight()});
}

/** How many blocks the view leaves out, and why: a test of which nothing is left out
 * could not fail. */
struct LeftOut {
  std::size_t away = 0, behind = 0, elsewhere = 0;
};

void
expectNothingSeenLeftOut(const Frame& frame,
                         const pcl_uvol::SurfaceBlock& block,
                         LeftOut& left_out)
{
  const BlockView view(frame, block);
  const PixelBox box = view.box();
  const bool away = view.looksAway(), behind = view.isBehindEye();
  left_out.away += away;
  left_out.behind += behind;
  left_out.elsewhere += box.isEmpty();
  double largest = 0.0;
  for (std::uint32_t i = block.begin; i < block.end; ++i) {
    const SeenPoint point = see(frame.cloud, i, frame.view);
    EXPECT_TRUE(!away || point.looks_away);
    EXPECT_TRUE(!behind || point.z < frame.view.near);
    if (point.z < frame.view.near)
      continue;
    EXPECT_TRUE(box.contains(boxOf(point, frame.view)));
    largest = std::max(largest, point.extent);
  }
  EXPECT_TRUE(largest == 0.0 || view.mayHoldDiscs(static_cast<float>(largest)));
}

SurfaceCloud
makeSearchCloud(const pcl::PointCloud<pcl::PointNormal>& points)
{
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  pcl_uvol::Report report;
  SurfaceCloud cloud(pcl_uvol::viewOf(points), all, 0, report);
  cloud.computeFootprints(0, report);
  return cloud;
}

TEST(BlockView, LeavesNothingOutThatIsSeen)
{
  const SurfaceCloud cloud = makeSearchCloud(*makeTorusKnot(60000, 1));
  const pcl_uvol::ImageSpaceSettings settings;
  LeftOut left_out;
  for (int i = 0; i < 24; ++i) {
    Camera camera;
    camera.eye = (0.5 + 2.0 * (i % 3)) * from_above.normalized();
    camera.at = Eigen::Vector3d::Zero();
    camera.up = upwards;
    camera.vertical_fov = 30.0;
    const View view(camera.orbited(15.0 * i), cloud.getBounds(), 3000, 2000);
    const Frame frame{cloud, view, settings, {}, 0};
    for (const auto& block : cloud.getBlocks())
      expectNothingSeenLeftOut(frame, block, left_out);
  }
  EXPECT_GT(left_out.away, 100u);
  EXPECT_GT(left_out.behind, 100u);
  EXPECT_GT(left_out.elsewhere, 100u);
}

TEST(BlockView, IsSparseByPixels)
{
  const SurfaceCloud cloud = makeSearchCloud(*makeTorusKnot(60000, 1));
  const pcl_uvol::ImageSpaceSettings settings;
  const auto countSparse = [&](int size) {
    const Camera camera =
        Camera::fit(cloud.getBounds(), from_above, upwards, 30.0, 1.0, 0.72);
    const View view(camera, cloud.getBounds(), size, size);
    const Frame frame{cloud, view, settings, {}, 0};
    std::size_t count = 0;
    for (const auto& block : cloud.getBlocks())
      count += BlockView(frame, block).isSparse();
    return count;
  };
  EXPECT_EQ(countSparse(64), 0u);
  EXPECT_EQ(countSparse(8192), cloud.getBlocks().size());
}

TEST(BlockView, LightsAreSeenFromTheEye)
{
  const SurfaceCloud cloud = makeSearchCloud(*makeSphere(100, 1));
  Camera camera;
  camera.eye = Eigen::Vector3d(0.0, 0.0, 5.0);
  camera.at = Eigen::Vector3d::Zero();
  camera.up = upwards;
  const View view(camera, cloud.getBounds(), 10, 10);
  const pcl_uvol::ImageSpaceSettings settings;
  const Frame frame{cloud, view, settings, {}, 0};
  pcl_uvol::Light light;
  light.kind = pcl_uvol::Light::Kind::Point;
  light.follows_camera = false;
  light.position = Eigen::Vector3d(1.0, 2.0, 3.0);
  EXPECT_LT((frame.lightVector(light) - Eigen::Vector3d(1.0, 2.0, -2.0)).norm(), 1e-5);
  light.kind = pcl_uvol::Light::Kind::Directional;
  EXPECT_EQ(frame.lightVector(light), light.position);
}

} // namespace test_block_view
