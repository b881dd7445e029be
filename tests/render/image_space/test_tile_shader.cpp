// SPDX-License-Identifier: BSD-3-Clause
// Tiles against the passes over the whole image at once, byte for byte: a halo that is
// too short leaves seams.
#include "pixel_setup.h"
#include "src/render/image_space/shading_setup.h"
#include "src/render/image_space/tile_shader.h"

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <array>
#include <numeric>
#include <utility>
#include <vector>

namespace test_tile_shader {

using namespace pcl_uvol;
using uvol_test::PixelRandom;

/** More than one tile of 256 columns and 32 rows in both directions, and parts of one.
 */
constexpr int width = 300, height = 90;

SurfaceCloud
makeCloud()
{
  PixelRandom random(1);
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (int i = 0; i < 500; ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() = random.direction().cast<float>();
    point.getNormalVector3fMap() = random.direction().cast<float>();
    cloud.push_back(point);
  }
  std::vector<std::uint32_t> all(cloud.size());
  std::iota(all.begin(), all.end(), 0u);
  Report report;
  return {viewOf(cloud), all, 1, report};
}

/** Pixels of random points at random depths, some of them background: no two alike. */
void
fillRandomly(PixelBuffer& buffer, std::uint32_t points)
{
  PixelRandom random(2);
  for (int row = 0; row < buffer.height; ++row)
    for (int column = 0; column < buffer.width; ++column)
      if (random.below(10) > 0)
        buffer.row(row)[column] =
            uvol_test::makeKey(random.between(0.4, 0.6), random.below(points));
  buffer.bounds = {0, 0, buffer.width, buffer.height};
}

/** The passes, each over all rows of the image and of what lies around. */
class WholeImage {
public:
  WholeImage(const Frame& frame, const PixelBuffer& buffer)
      : frame_(frame)
      , buffer_(buffer)
      , shading_(frame)
  {
    for (auto& stage : planes_)
      for (auto& plane : stage)
        plane.resize(static_cast<std::size_t>((height + 2 * around + 2) * stride));
  }

  std::vector<std::uint32_t>
  finish(const FilterWeights& weights)
  {
    const ImageSpaceSettings& s = frame_.settings;
    int reach = around;
    shade();
    for (int i = 0; i < s.smoothing_iterations; ++i) {
      --reach;
      forRows(reach, [&](int row) {
        kernels().smooth(rowOf(0, row), stride, count, weights, rowOf(1, row));
      });
      for (std::size_t k = 0; k < depth_plane; ++k)
        planes_[0][k].swap(planes_[1][k]);
      for (std::size_t k = depth_plane + 1; k < laplace_plane; ++k)
        planes_[0][k].swap(planes_[1][k]);
    }
    drawLines(reach - s.silhouette_thickness);
    if (s.anti_aliasing)
      antiAlias();
    std::vector<std::uint32_t> image(static_cast<std::size_t>(width * height));
    const RowBackground background{
        {s.background.color.r, s.background.color.g, s.background.color.b}, false};
    forRows(0, [&](int row) {
      std::vector<std::uint32_t> pixels(count);
      kernels().output(rowOf(0, row), count, background, pixels.data());
      std::copy_n(
          pixels.begin() + side, width, image.begin() + std::ptrdiff_t(row) * width);
    });
    return image;
  }

private:
  static constexpr int side = 16, around = 16;
  static constexpr int count = (width + 15) / 16 * 16 + 2 * side;
  static constexpr std::ptrdiff_t stride = count + 2 * side;
  static constexpr std::size_t depth_plane = 4, laplace_plane = 8, line_plane = 9,
                               plane_count = 10;

  static const FilterKernels&
  kernels()
  {
    return baseline::filter_kernels;
  }

  template <typename Visit>
  static void
  forRows(int beyond, const Visit& visit)
  {
    for (int row = -beyond; row < height + beyond; ++row)
      visit(row);
  }

  float*
  at(std::size_t stage, std::size_t plane, int row)
  {
    return planes_[stage][plane].data() + (row + around + 1) * stride + side;
  }

  /** Depth, and what lines need, are one for all stages. */
  ShadedRow
  rowOf(std::size_t stage, int row)
  {
    return {{at(stage, 0, row), at(stage, 1, row), at(stage, 2, row)},
            at(stage, 3, row),
            at(0, depth_plane, row),
            {at(stage, 5, row), at(stage, 6, row), at(stage, 7, row)}};
  }

  void
  shade()
  {
    const std::vector<PixelKey> background(count, background_key);
    forRows(around, [&](int row) {
      const int there = row + View::guard;
      const bool is_inside = there >= 0 && there < buffer_.height;
      baseline::shadeRow(shading_.get(),
                         is_inside ? buffer_.row(there) + View::guard - side
                                   : background.data(),
                         View::guard - side,
                         there,
                         count,
                         {nullptr, nullptr},
                         rowOf(0, row));
    });
  }

  void
  drawLines(int reach)
  {
    const ImageSpaceSettings& s = frame_.settings;
    const float color[3] = {s.line_color.r, s.line_color.g, s.line_color.b};
    const auto depth_threshold = static_cast<float>(s.silhouette_threshold);
    forRows(around - 1, [&](int row) {
      kernels().laplace(
          at(0, depth_plane, row), stride, count, at(0, laplace_plane, row));
    });
    forRows(reach, [&](int row) {
      if (s.silhouettes)
        kernels().silhouettes(at(0, laplace_plane, row),
                              stride,
                              count,
                              depth_threshold,
                              s.silhouette_thickness,
                              at(0, line_plane, row));
      if (s.feature_lines)
        kernels().features(rowOf(0, row),
                           stride,
                           count,
                           static_cast<float>(s.feature_threshold),
                           depth_threshold,
                           at(0, line_plane, row));
    });
    forRows(reach, [&](int row) {
      kernels().drawLines(rowOf(0, row), at(0, line_plane, row), count, color);
    });
  }

  void
  antiAlias()
  {
    forRows(0, [&](int row) {
      kernels().antiAlias(rowOf(0, row),
                          stride,
                          at(0, laplace_plane, row),
                          count,
                          static_cast<float>(frame_.settings.anti_aliasing_threshold),
                          rowOf(1, row));
    });
    for (std::size_t k = 0; k < depth_plane; ++k)
      planes_[0][k].swap(planes_[1][k]);
  }

  const Frame& frame_;
  const PixelBuffer& buffer_;
  ShadingSetup shading_;
  std::array<std::array<std::vector<float>, plane_count>, 2> planes_;
};

TEST(TileShader, TilesAreTheWholeImage)
{
  const SurfaceCloud cloud = makeCloud();
  const View view(Camera::fit(cloud.getBounds(), "iso", 30.0, 3.0),
                  cloud.getBounds(),
                  width,
                  height);
  PixelBuffer buffer;
  buffer.resize(view);
  fillRandomly(buffer, static_cast<std::uint32_t>(cloud.size()));
  struct Passes {
    int smoothings, thickness; // 0: no silhouettes
    bool has_features, anti_aliases;
  };
  for (const Passes& passes : {Passes{0, 0, false, false},
                               {1, 0, false, true},
                               {2, 0, true, true},
                               {0, 1, true, true},
                               {6, 0, true, true},
                               {0, 3, false, true},
                               {1, 7, true, true},
                               {3, 2, true, false}}) {
    SCOPED_TRACE(std::to_string(passes.smoothings) + " smoothings, thickness " +
                 std::to_string(passes.thickness));
    ImageSpaceSettings settings;
    settings.smoothing = passes.smoothings > 0 ? SmoothingFilter::AlleviatedGaussian
                                               : SmoothingFilter::None;
    settings.smoothing_iterations = passes.smoothings;
    settings.silhouettes = passes.thickness > 0;
    settings.silhouette_threshold = 1.0; // so that lines are faint among such depths
    settings.silhouette_thickness = std::max(passes.thickness, 1);
    settings.feature_lines = passes.has_features;
    settings.anti_aliasing = passes.anti_aliases;
    const Frame frame{cloud, view, settings, {}, 2};
    TileScratchPool pool;
    Image image;
    image.width = width;
    image.height = height;
    image.color.resize(4 * image.pixels());
    PassClock clock;
    Report report;
    shadeTiles(frame, buffer, pool, image, clock, report);
    const auto expected = WholeImage(frame, buffer).finish({2.0f, 12.0f});
    std::size_t different = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      std::uint32_t pixel;
      std::memcpy(&pixel, &image.color[4 * i], sizeof pixel);
      if (pixel == expected[i])
        continue;
      if (different++ == 0)
        ADD_FAILURE() << "row " << i / width << ", column " << i % width;
    }
    EXPECT_EQ(0u, different);
  }
}

} // namespace test_tile_shader
