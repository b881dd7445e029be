// SPDX-License-Identifier: BSD-3-Clause
// Projection and pixel filling against brute force (thesis 4.3.1, 4.3.2).
#include "render/image_space/frame.h"
#include "render/renderer_setup.h"

#include <vector>

namespace test_projection {

using namespace uvol_test;
using pcl_uvol::Camera;
using pcl_uvol::Image;
using pcl_uvol::View;

/** Depth and point per pixel of the image with a border around it, by brute force. */
struct Oracle {
  int width, height, border;
  std::vector<double> depth;
  std::vector<std::uint32_t> id;

  Oracle(const View& view, int image_border)
      : width(view.width + 2 * image_border)
      , height(view.height + 2 * image_border)
      , border(image_border)
      , depth(static_cast<std::size_t>(width * height), 1.0)
      , id(depth.size(), Image::background)
  {
  }

  std::size_t
  at(int row, int column) const
  {
    return static_cast<std::size_t>(row * width + column);
  }

  void
  project(const pcl::PointCloud<pcl::PointNormal>& cloud,
          const Camera& camera,
          const View& view)
  {
    const Eigen::Matrix3d rows = camera.rotation();
    for (std::uint32_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d x = cloud[i].getVector3fMap().cast<double>();
      const Eigen::Vector3d c = rows * (x - camera.eye);
      if (cloud[i].getNormalVector3fMap().cast<double>().dot(camera.eye - x) < 0.0)
        continue;
      const int column = static_cast<int>(
          std::floor(border + 0.5 * view.width + view.focal * c.x() / c.z()));
      const int row = static_cast<int>(
          std::floor(border + 0.5 * view.height + view.focal * c.y() / c.z()));
      if (column < 0 || row < 0 || column >= width || row >= height)
        continue;
      const double d = c.norm() / view.far;
      if (d < depth[at(row, column)]) {
        depth[at(row, column)] = d;
        id[at(row, column)] = i;
      }
    }
  }

  /** One iteration of Figure 4.8; white tells which cells a mask wants white. */
  void
  fill(bool occluded, double layer_distance)
  {
    static constexpr int ring[8][2] = {
        {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}};
    const Oracle before = *this;
    for (int row = 1; row + 1 < height; ++row)
      for (int column = 1; column + 1 < width; ++column) {
        const std::size_t here = at(row, column);
        if ((before.id[here] == Image::background) == occluded)
          continue;
        bool is_white[8], is_beyond = false;
        std::size_t nearest = here;
        for (int k = 0; k < 8; ++k) {
          const std::size_t there = at(row + ring[k][0], column + ring[k][1]);
          const bool is_background = before.id[there] == Image::background;
          is_white[k] = occluded
                            ? is_background || before.depth[there] >=
                                                   before.depth[here] - layer_distance
                            : is_background;
          if (!is_background &&
              (nearest == here || before.depth[there] < before.depth[nearest]))
            nearest = there;
        }
        for (int k = 0; k < 8; ++k)
          is_beyond |= is_white[k] && is_white[(k + 1) % 8] && is_white[(k + 2) % 8] &&
                       is_white[(k + 3) % 8];
        if (!is_beyond) {
          depth[here] = before.depth[nearest];
          id[here] = before.id[nearest];
        }
      }
  }

  /** Pixels of the image in which it differs. */
  std::size_t
  differences(const Image& image) const
  {
    std::size_t count = 0;
    for (int row = 0; row < static_cast<int>(image.height); ++row)
      for (int column = 0; column < static_cast<int>(image.width); ++column)
        count += image.id[static_cast<std::size_t>(row) * image.width +
                          static_cast<std::size_t>(column)] !=
                         id[at(row + border, column + border)]
                     ? 1
                     : 0;
    return count;
  }
};

TEST(Projection, EqualsBruteForce)
{
  const auto cloud = uvol_test::makeTorusKnot(30000, 1);
  Renderer renderer;
  prepare(renderer, cloud, 210, 160);
  onlyProject(renderer.settings());
  Image image;
  renderer.render(image);
  const Camera camera = cameraOf(renderer, 210, 160);
  const View view(camera, renderer.getBounds(), 210, 160);
  Oracle oracle(view, View::guard);
  oracle.project(*cloud, camera, view);
  EXPECT_GT(seenPixels(image), 4000u);
  // Points on the border between two pixels round to either.
  EXPECT_LE(oracle.differences(image), 8u);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (image.id[i] == Image::background) {
      EXPECT_EQ(image.depth[i], 1.0f);
      continue;
    }
    const Eigen::Vector3d x = (*cloud)[image.id[i]].getVector3fMap().cast<double>();
    EXPECT_NEAR(image.depth[i], (x - camera.eye).norm() / view.far, 1e-6);
  }
}

TEST(PixelFilling, EqualsTheMasksOfTheThesis)
{
  const auto cloud = uvol_test::makeTorusKnot(10000, 1);
  for (const int iterations : {1, 2, 5, 40}) {
    Renderer renderer;
    prepare(renderer, cloud, 210, 160);
    onlyProject(renderer.settings());
    renderer.settings().background_fill = iterations;
    renderer.settings().occluded_fill = iterations;
    Image image;
    renderer.render(image);
    const Camera camera = cameraOf(renderer, 210, 160);
    const View view(camera, renderer.getBounds(), 210, 160);
    Oracle oracle(view, View::guard);
    oracle.project(*cloud, camera, view);
    EXPECT_GT(oracle.differences(image), 500u); // there is something to be filled
    for (int i = 0; i < iterations; ++i)
      oracle.fill(false, 0.0);
    for (int i = 0; i < iterations; ++i)
      oracle.fill(true, renderer.settings().layer_distance);
    EXPECT_LE(oracle.differences(image), 40u) << iterations;
  }
}

} // namespace test_projection
