// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion of cells against its formulas in double precision, and in pictures
// of valleys, edges and planes.
#include "pixel_setup.h"
#include "src/render/image_space/occlusion_grid.h"
#include "src/render/image_space/occlusion_kernel.h"
#include "src/render/surface_cloud.h"
#include "support/simd_levels.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace test_occlusion {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::forLevels;
using uvol_test::makeKey;
using uvol_test::PixelRandom;
using uvol_test::readDepth;
using uvol_test::readPoint;
using uvol_test::TestCamera;

const KernelTable<const OcclusionKernels*> kernels{
    &baseline::occlusion_kernels, &avx2::occlusion_kernels, &avx512::occlusion_kernels};

constexpr int count = 48, rows = 24, border = 16;
constexpr std::ptrdiff_t stride = count + 2 * border;
constexpr double rounding = 1e-5;

/** Planes of random cells, a seventh of them without a surface. */
class Cells {
public:
  Cells()
  {
    const auto size = static_cast<std::size_t>(stride * (rows + 2 * border));
    for (std::size_t k = 0; k < 3; ++k) {
      position_[k].assign(size, beyond_all);
      normal_[k].assign(size, 0.0f);
    }
    depth_.assign(size, no_depth);
    openness_.assign(size, 1.0f);
    PixelRandom random(5);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < count; ++column) {
        const std::size_t i = place(row) + static_cast<std::size_t>(column);
        const Vector3d normal = random.direction();
        if (random.below(7) == 0)
          continue;
        depth_[i] = random.between(0.4, 0.6);
        openness_[i] = random.between(0.0, 1.0);
        const Vector3d there(0.03 * column, 0.03 * row, 4.0 + random.between(0, 0.1));
        for (int k = 0; k < 3; ++k) {
          position_[static_cast<std::size_t>(k)][i] = static_cast<float>(there[k]);
          normal_[static_cast<std::size_t>(k)][i] = static_cast<float>(normal[k]);
        }
      }
  }

  static std::size_t
  place(int row)
  {
    return static_cast<std::size_t>((row + border) * stride + border);
  }

  CellRow
  rowOf(int row)
  {
    CellRow cells{};
    for (std::size_t k = 0; k < 3; ++k) {
      cells.position[k] = position_[k].data() + place(row);
      cells.normal[k] = normal_[k].data() + place(row);
    }
    cells.depth = depth_.data() + place(row);
    return cells;
  }

  Vector3d
  position(std::ptrdiff_t i) const
  {
    return vectorAt(position_, i);
  }

  Vector3d
  normal(std::ptrdiff_t i) const
  {
    return vectorAt(normal_, i);
  }

  std::vector<float> depth_, openness_;

private:
  static Vector3d
  vectorAt(const std::array<std::vector<float>, 3>& planes, std::ptrdiff_t i)
  {
    const auto at = static_cast<std::size_t>(i);
    return {planes[0][at], planes[1][at], planes[2][at]};
  }

  std::array<std::vector<float>, 3> position_, normal_;
};

/** A step leads as far as its square, in parts of the last one, in whole cells. */
TEST(Occlusion, StepsAreCloserTogetherNearTheCell)
{
  pcl::PointCloud<pcl::PointNormal> points;
  for (int i = 0; i < 400; ++i) {
    pcl::PointNormal point;
    point.x = static_cast<float>(i % 20) - 9.5f;
    point.y = static_cast<float>(i / 20) - 9.5f;
    point.normal_z = 1.0f;
    points.push_back(point);
  }
  Report report;
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  const SurfaceCloud cloud(viewOf(points), all, 1, report);
  Camera camera;
  camera.eye = {0.0, 0.0, 40.0};
  camera.at = {0.0, 0.0, 0.0};
  camera.up = {0.0, 1.0, 0.0};
  camera.vertical_fov = 30.0;
  const View view(camera, cloud.getBounds(), 1000, 1000);
  ImageSpaceSettings settings;
  settings.ambient_occlusion = 1.0;
  const OcclusionGrid grid(Frame{cloud, view, settings, {}, 1});
  ASSERT_EQ(static_cast<std::size_t>(OcclusionGrid::directions * OcclusionGrid::steps),
            grid.offsets.size());
  // A fifth of the ball around the points, as large as it is in its middle.
  const double radius = cloud.getBounds().radius * view.unit;
  const double pixels =
      std::min(0.2 * radius / static_cast<double>(view.translation[2]) * view.focal,
               0.125 * 1000.0);
  for (int direction = 0; direction < OcclusionGrid::directions; ++direction)
    for (int step = 1; step <= OcclusionGrid::steps; ++step) {
      const double part = static_cast<double>(step * step) /
                          (OcclusionGrid::steps * OcclusionGrid::steps);
      const double cells = std::max(1.0, part * pixels / grid.cell);
      const double angle = 2.0 * M_PI * (direction + 0.5) / OcclusionGrid::directions;
      const auto& offset = grid.offsets[static_cast<std::size_t>(
          direction * OcclusionGrid::steps + step - 1)];
      EXPECT_NEAR(cells * std::cos(angle), offset.column, 0.5 + 1e-3);
      EXPECT_NEAR(cells * std::sin(angle), offset.row, 0.5 + 1e-3);
    }
}

TEST(OcclusionKernel, PlacesTheMiddlesOfCells)
{
  const TestCamera camera;
  const Projection& p = camera.projection;
  PixelRandom random(3);
  std::vector<std::uint32_t> looks;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3f normal = random.direction().cast<float>();
    looks.insert(looks.end(), {packNormal(normal.data()), 0u});
  }
  std::vector<PixelKey> keys;
  for (int i = 0; i < count; ++i)
    keys.push_back(i % 7 == 0 ? background_key
                              : makeKey(random.between(0.2, 0.9), random.below(40)));
  Shading shading{};
  shading.looks = looks.data();
  std::copy_n(p.rotation, 9, shading.rotation);
  shading.center_x = p.center_x;
  shading.center_y = p.center_y;
  shading.per_focal = 1.0f / p.focal;
  shading.far = 8.0f;
  constexpr int cell = 5, column = 2, row = 17;
  forLevels(kernels, [&](const OcclusionKernels* kernel) {
    for (const bool two_sided : {false, true}) {
      shading.two_sided = two_sided;
      Cells cells;
      kernel->place(shading, keys.data(), cell, column, row, count, cells.rowOf(0));
      for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::ptrdiff_t>(Cells::place(0)) + i;
        const PixelKey key = keys[static_cast<std::size_t>(i)];
        if (key == background_key) {
          EXPECT_EQ(no_depth, cells.rowOf(0).depth[i]);
          EXPECT_EQ(beyond_all, cells.position(at).z());
          continue;
        }
        const Vector3d ray((cell * i + column + 0.5 - p.center_x) / p.focal,
                           (row + 0.5 - p.center_y) / p.focal,
                           1.0);
        const Vector3d place = 8.0 * readDepth(key) * ray.normalized();
        Eigen::Vector3f packed;
        unpackNormal(looks[2 * readPoint(key)], packed.data());
        Vector3d normal = camera.rotation * packed.cast<double>();
        if (two_sided && normal.dot(ray) > 0.0)
          normal = -normal;
        EXPECT_EQ(readDepth(key), cells.rowOf(0).depth[i]);
        EXPECT_LT((place - cells.position(at)).norm(), rounding) << i;
        EXPECT_LT((normal - cells.normal(at)).norm(), rounding) << i;
      }
    }
  });
}

TEST(OcclusionKernel, OpensWhatNoWallHides)
{
  Cells cells;
  constexpr int directions = 3, steps = 2;
  const std::array<std::ptrdiff_t, directions * steps> offsets{
      1, 4, stride - 2, 3 * stride - 5, -stride, -2 * stride - 1};
  const OcclusionSearch search{offsets.data(), directions, steps, 0.04f, 0.1f, 0.01f};
  forLevels(kernels, [&](const OcclusionKernels* kernel) {
    double lowest = 1.0;
    for (int row = 0; row < rows; ++row) {
      std::array<float, count> openness{};
      kernel->open(cells.rowOf(row), search, count, openness.data());
      for (int column = 0; column < count; ++column) {
        const auto i = static_cast<std::ptrdiff_t>(Cells::place(row)) + column;
        const float found = openness[static_cast<std::size_t>(column)];
        if (cells.depth_[static_cast<std::size_t>(i)] == no_depth) {
          ASSERT_EQ(1.0f, found);
          continue;
        }
        double closed = 0.0;
        for (int direction = 0; direction < directions; ++direction) {
          double highest = 0.0;
          for (int step = 0; step < steps; ++step) {
            const auto there =
                i + offsets[static_cast<std::size_t>(direction * steps + step)];
            const Vector3d way = cells.position(there) - cells.position(i);
            const double sine =
                (way.dot(cells.normal(i)) - 0.01) / std::max(way.norm(), 1e-15);
            const double reach = 0.04 * cells.position(i).z();
            const double part = 3.0 * (1.0 - way.squaredNorm() / (reach * reach));
            highest =
                std::max(highest, (sine - 0.1) / 0.9 * std::clamp(part, 0.0, 1.0));
          }
          closed += highest;
        }
        ASSERT_NEAR(1.0 - closed / directions, found, 5e-5) << row << ", " << column;
        lowest = std::min<double>(lowest, found);
      }
    }
    EXPECT_LT(lowest, 0.5);
  });
}

TEST(OcclusionKernel, DarkensPixelsByCellsOfTheirSurface)
{
  Cells cells;
  constexpr int cell = 5, row = 7, pixels = 160, column = 3;
  constexpr double part = 0.3, tolerance = 0.15, strength = 0.7;
  PixelRandom random(9);
  std::array<std::vector<float>, 5> planes;
  for (auto& plane : planes)
    for (int i = 0; i < pixels; ++i)
      plane.push_back(random.between(0.4, 0.6));
  forLevels(kernels, [&](const OcclusionKernels* kernel) {
    std::array<std::vector<float>, 5> dark = planes;
    const ShadedRow shaded{{dark[0].data(), dark[1].data(), dark[2].data()},
                           dark[3].data(),
                           dark[4].data(),
                           {nullptr, nullptr, nullptr}};
    kernel->darken({cells.openness_.data() + Cells::place(row),
                    cells.depth_.data() + Cells::place(row),
                    stride,
                    static_cast<float>(part),
                    cell / 2,
                    1.0f / cell,
                    static_cast<float>(tolerance),
                    static_cast<float>(strength)},
                   column,
                   pixels,
                   shaded);
    for (int i = 0; i < pixels; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double place = (column + i - cell / 2) / static_cast<double>(cell);
      const int before = static_cast<int>(std::floor(place + 1e-9));
      const double along = place - before, depth = planes[4][at];
      double sum = 1e-3, weights = 1e-3;
      for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
          const std::size_t there =
              Cells::place(row + y) + static_cast<std::size_t>(before + x);
          const double apart = std::abs(cells.depth_[there] - depth);
          const double weight = (y == 1 ? part : 1.0 - part) *
                                (x == 1 ? along : 1.0 - along) *
                                std::max(1.0 - apart / (tolerance * depth), 0.0);
          sum += weight * cells.openness_[there];
          weights += weight;
        }
      const double light = 1.0 - strength * (1.0 - sum / weights);
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_NEAR(light * planes[k][at], dark[k][at], 2e-4) << i;
    }
  });
}

/** Two planes that meet at an angle, seen along its bisector. */
class Valley {
public:
  /** \param slope of the planes on both sides; below 0 they make an edge */
  explicit Valley(double slope)
  {
    constexpr int side = 220;
    const double length = std::hypot(1.0, slope);
    for (int i = 0; i <= side; ++i)
      for (int j = 0; j <= side; ++j) {
        const double x = -1.0 + 2.0 * i / side, y = -1.0 + 2.0 * j / side;
        pcl::PointNormal point;
        point.getVector3fMap() = Vector3d(x, y, slope * std::abs(x)).cast<float>();
        point.getNormalVector3fMap() =
            Vector3d((x < 0 ? slope : -slope) / length, 0.0, 1.0 / length)
                .cast<float>();
        cloud_.push_back(point);
      }
  }

  /** Green of the middle row. */
  std::vector<int>
  draw(double occlusion, unsigned threads = 0)
  {
    ImageSpaceRenderer<pcl::PointNormal> renderer;
    renderer.setInputCloud(cloud_.makeShared());
    renderer.setNumberOfThreads(threads);
    renderer.setSize(size, size);
    Camera camera;
    camera.eye = {0.0, 0.0, 6.0};
    camera.at = {0.0, 0.0, 0.0};
    camera.up = {0.0, 1.0, 0.0};
    camera.vertical_fov = 24.0;
    renderer.setCamera(camera);
    renderer.settings().material.specular = 0.0;
    renderer.settings().lights.resize(1);
    renderer.settings().lights[0].position = {0.0, 0.0, 1.0};
    renderer.settings().ambient_occlusion = occlusion;
    Image image;
    renderer.render(image);
    std::vector<int> row;
    for (std::size_t i = 0; i < size; ++i)
      row.push_back(image.color[4 * (size / 2 * size + i) + 1]);
    return row;
  }

  static constexpr std::size_t size = 240;

private:
  pcl::PointCloud<pcl::PointNormal> cloud_;
};

TEST(AmbientOcclusion, DarkensValleysAndNothingElse)
{
  Valley valley(1.0);
  const std::vector<int> lit = valley.draw(0.0), dark = valley.draw(1.0),
                         half = valley.draw(0.5);
  const auto part = [&](const std::vector<int>& row, std::size_t column) {
    return double(row[column]) / lit[column];
  };
  const std::size_t middle = Valley::size / 2;
  // A wall at a right angle hides half of the sky at its foot: a direction at the angle
  // a to the normal of the wall sees it at the elevation atan(cos a), of which
  // least_sine is taken for roughness.
  EXPECT_GT(part(dark, middle - 4), 0.6);
  EXPECT_LT(part(dark, middle - 4), 0.8);
  EXPECT_NEAR(part(half, middle - 4), 0.5 + 0.5 * part(dark, middle - 4), 0.01);
  for (std::size_t column = 35; column < middle; ++column)
    EXPECT_NEAR(part(dark, column), part(dark, Valley::size - 1 - column), 0.03);
  // 0.2 of the radius of the cloud is the farthest that walls are looked for.
  EXPECT_EQ(lit[middle - 60], dark[middle - 60]);
  for (const double slope : {0.0, -1.0}) {
    Valley open(slope);
    EXPECT_EQ(open.draw(0.0), open.draw(1.0)) << slope;
  }
  EXPECT_EQ(dark, valley.draw(1.0, 1));
}

TEST(AmbientOcclusion, RefusesStrengthsThatAreNone)
{
  Valley valley(1.0);
  for (const double strength : {-0.1, 1.1, std::nan("")})
    EXPECT_THROW(valley.draw(strength), InvalidArgument) << strength;
}

} // namespace test_occlusion
