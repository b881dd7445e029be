// SPDX-License-Identifier: BSD-3-Clause
// Points in pixels against projection in double precision.
#include "pixel_setup.h"
#include "src/render/image_space/disc_kernel.h"
#include "src/render/image_space/projection_kernel.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace test_projection_kernel {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::PixelRandom;
using uvol_test::PixelRows;
using uvol_test::PointArrays;
using uvol_test::readDepth;
using uvol_test::readPoint;
using uvol_test::TestCamera;

const KernelTable<ProjectionKernel> kernels{
    baseline::projectPoints, avx2::projectPoints, avx512::projectPoints};

/** Farther from any decision than single precision blurs it. */
constexpr double clear = 5e-3;

/** A point as the camera sees it. */
struct SeenPoint {
  Vector3d place; ///< in camera space
  double column, row, facing;

  SeenPoint(const TestCamera& camera, const Vector3d& x, const Vector3d& normal)
      : place(camera.toCamera(x))
      , column(camera.projection.center_x +
               camera.projection.focal * place.x() / place.z())
      , row(camera.projection.center_y +
            camera.projection.focal * place.y() / place.z())
      , facing(normal.dot(camera.eye - x))
  {
  }

  bool
  isClear(const TestCamera& camera) const
  {
    return std::abs(column - std::round(column)) > clear &&
           std::abs(row - std::round(row)) > clear && std::abs(facing) > clear &&
           std::abs(place.z() - camera.projection.near) > clear;
  }
};

constexpr std::uint32_t point_count = 250;

/** Some in front of the eye, some behind it; every other one hides the one before. */
PointArrays
randomPoints(const TestCamera& camera)
{
  PixelRandom random(1);
  PointArrays points;
  const auto isClear = [&](const Vector3d& x, const Vector3d& normal) {
    return SeenPoint(camera, x, normal).isClear(camera);
  };
  while (points.size() < point_count) {
    const Vector3d x(
        random.between(-2, 2), random.between(-2, 2), random.between(-4, 6)),
        hiding = camera.eye + 0.8 * (x - camera.eye), normal = random.direction();
    if (!isClear(x, normal) || !isClear(hiding, normal))
      continue;
    for (const Vector3d& place : {x, hiding}) {
      points.add(place, normal, random.between(0.001, 0.15));
      points.footprints.back() += random.between(0.0, 0.05);
    }
  }
  return points;
}

TEST(ProjectionKernel, PixelsHoldTheNearestPointThatIsSeen)
{
  TestCamera camera;
  const PointArrays points = randomPoints(camera);
  for (const bool culls : {false, true})
    uvol_test::forLevels(kernels, [&](ProjectionKernel kernel) {
      camera.projection.cull_back_faces = culls;
      PixelRows rows, expected;
      ProjectedPoints view = points.view(1.0f);
      view.radii = nullptr;
      constexpr int first_row = 10, last_row = 60;
      std::vector<std::uint32_t> discs(projected_points);
      EXPECT_EQ(0u,
                kernel(camera.projection,
                       view,
                       3,
                       point_count - 2,
                       rows.band(first_row, last_row),
                       nullptr,
                       discs.data()));
      std::size_t drawn = 0;
      for (std::uint32_t i = 3; i < point_count - 2; ++i) {
        const SeenPoint seen(camera, points.place(i), points.normal(i));
        const double column = std::floor(seen.column), row = std::floor(seen.row);
        if (seen.place.z() < camera.projection.near || (culls && seen.facing < 0.0) ||
            !(column >= 0 && column < PixelRows::width && row >= first_row &&
              row < last_row))
          continue;
        PixelKey& pixel = expected.first()[static_cast<int>(row) * PixelRows::stride +
                                           static_cast<int>(column)];
        const double depth = seen.place.norm() / 8.0;
        pixel = std::min(pixel, uvol_test::makeKey(static_cast<float>(depth), i));
        ++drawn;
      }
      EXPECT_GT(drawn, 10u);
      for (std::size_t i = 0; i < rows.keys.size(); ++i) {
        EXPECT_EQ(readPoint(expected.keys[i]), readPoint(rows.keys[i]));
        if (expected.keys[i] != background_key) {
          EXPECT_NEAR(readDepth(expected.keys[i]), readDepth(rows.keys[i]), 1e-6);
        }
      }
    });
}

/** Which points are discs is exact; which of them reach the band, on the safe side. */
TEST(ProjectionKernel, DiscsAreThoseLargerThanAPixelThatMayReachTheBand)
{
  const TestCamera camera;
  const Projection& p = camera.projection;
  const PointArrays points = randomPoints(camera);
  constexpr float stretch = 1.5f;
  constexpr int first_row = 20, last_row = 40;
  uvol_test::forLevels(kernels, [&](ProjectionKernel kernel) {
    PixelRows rows;
    std::vector<std::uint32_t> discs(projected_points);
    discs.resize(kernel(p,
                        points.view(stretch),
                        0,
                        point_count,
                        rows.band(first_row, last_row),
                        nullptr,
                        discs.data()));
    ASSERT_TRUE(std::is_sorted(discs.begin(), discs.end()));
    const std::set<std::uint32_t> found(discs.begin(), discs.end());
    std::size_t all = 0;
    for (std::uint32_t i = 0; i < point_count; ++i) {
      const SeenPoint seen(camera, points.place(i), points.normal(i));
      const double per_length = p.focal / seen.place.z();
      const double radius = points.footprints[i] * per_length > p.largest_filler
                                ? points.footprints[i]
                                : points.radii[i];
      const double pixels = radius * per_length;
      if (seen.place.z() < p.near || pixels < p.smallest_footprint - clear) {
        EXPECT_EQ(0u, found.count(i)) << i;
        continue;
      }
      ++all;
      // A ball around the disc, seen from the side that makes it larger.
      const double nearest = seen.place.z() - stretch * radius;
      if (nearest > p.near && pixels > p.smallest_footprint + clear) {
        const double reach = p.focal * stretch * radius / nearest;
        const bool is_inside = seen.column > 0 && seen.column < PixelRows::width &&
                               seen.row > first_row && seen.row < last_row;
        const double slope_x = seen.place.x() / seen.place.z(),
                     slope_y = seen.place.y() / seen.place.z();
        const double beyond_x = std::max(-seen.column, seen.column - PixelRows::width),
                     beyond_y = std::max(first_row - seen.row, seen.row - last_row);
        if (is_inside || (beyond_x < 0.9 * reach && beyond_y < 0.9 * reach)) {
          EXPECT_EQ(1u, found.count(i)) << i;
        }
        if (beyond_x > reach * (1.0 + slope_x * slope_x) + clear ||
            beyond_y > reach * (1.0 + slope_y * slope_y) + clear) {
          EXPECT_EQ(0u, found.count(i)) << i;
        }
      }
    }
    EXPECT_GT(found.size(), 5u);
    EXPECT_LT(found.size(), all);
  });
}

TEST(ProjectionKernel, LargeDiscsReplaceThePixelsOfTheirPoints)
{
  const TestCamera camera;
  const Projection& p = camera.projection;
  const PointArrays points = randomPoints(camera);
  uvol_test::forLevels(kernels, [&](ProjectionKernel kernel) {
    const auto draw = [&](const ProjectedPoints& view) {
      PixelRows rows;
      std::vector<std::uint32_t> discs(projected_points);
      kernel(p,
             view,
             0,
             point_count,
             rows.band(0, PixelRows::height),
             nullptr,
             discs.data());
      return rows;
    };
    ProjectedPoints view = points.view(1.0f);
    const PixelRows all = draw(view);
    view.smallest_cover = 3.0f;
    const PixelRows others = draw(view);
    std::size_t replaced = 0, kept = 0;
    for (std::size_t i = 0; i < all.keys.size(); ++i) {
      if (all.keys[i] == background_key) {
        EXPECT_EQ(background_key, others.keys[i]);
        continue;
      }
      const std::uint32_t point = readPoint(all.keys[i]);
      const SeenPoint seen(camera, points.place(point), points.normal(point));
      const double per_length = p.focal / seen.place.z();
      const double radius = points.footprints[point] * per_length > p.largest_filler
                                ? points.footprints[point]
                                : points.radii[point];
      const bool is_replaced = radius * per_length > view.smallest_cover;
      (is_replaced ? replaced : kept) += 1;
      EXPECT_EQ(!is_replaced, all.keys[i] == others.keys[i]) << point;
    }
    EXPECT_GT(replaced, 3u);
    EXPECT_GT(kept, 3u);
  });
}

/** What discs make of rows: pixels, and sums that are blended. */
struct DiscsInRows {
  PixelRows rows;
  std::vector<float> values;
  std::vector<std::uint8_t> marks;

  DiscsInRows(const DiscKernels& kernel,
              const Projection& projection,
              const ProjectedPoints& points,
              const std::vector<std::uint32_t>& looks,
              const std::vector<std::uint32_t>& discs,
              const PixelRows& before)
      : rows(before)
      , values(blended_values * rows.keys.size())
      , marks(rows.keys.size() / blend_segment)
  {
    const PixelBand band = rows.band(0, PixelRows::height);
    kernel.draw(projection, points, discs.data(), discs.size(), 0.0f, band);
    constexpr std::ptrdiff_t first = PixelRows::stride + PixelRows::margin;
    const std::vector<float> everywhere(values.size(), 1.0f);
    kernel.blend(
        projection,
        points,
        looks.data(),
        discs.data(),
        discs.size(),
        band,
        everywhere.data(),
        {values.data() + blended_values * first, marks.data() + first / blend_segment});
  }
};

/** In view, at depths of about 0.35 to 0.65. */
PointArrays
pointsInView()
{
  PixelRandom random(9);
  PointArrays points;
  while (points.size() < point_count) {
    const Vector3d x{random.between(-1.2, 1.2),
                     random.between(-1.2, 1.2),
                     random.between(-1.2, 1.2)};
    points.add(x, random.direction(), random.between(0.05, 0.1));
  }
  return points;
}

TEST(ProjectionKernel, DiscsThatAreLeftOutWouldChangeNothing)
{
  const TestCamera camera;
  const Projection& p = camera.projection;
  const PointArrays points = pointsInView();
  const KernelTable<const DiscKernels*> disc_kernels{
      &baseline::disc_kernels, &avx2::disc_kernels, &avx512::disc_kernels};
  std::vector<std::uint32_t> looks;
  for (const std::uint32_t normal : points.normals)
    looks.insert(looks.end(), {normal, 0xffffff});
  PixelRandom random(8);
  PixelRows before; // a layer with a hole
  for (int row = 0; row < PixelRows::height; ++row)
    for (int column = 0; column < PixelRows::width; ++column)
      if (row / 32 != 1 || column / 48 != 1)
        before.first()[row * PixelRows::stride + column] =
            uvol_test::makeKey(random.between(0.4, 0.42), 0);
  uvol_test::forLevels(kernels, [&](ProjectionKernel kernel) {
    const DiscKernels& disc_kernel = *disc_kernels.get();
    const ProjectedPoints view = points.view(1.5f);
    const auto find = [&](const float* deepest) {
      PixelRows rows = before;
      std::vector<std::uint32_t> discs(projected_points);
      discs.resize(kernel(p,
                          view,
                          0,
                          point_count,
                          rows.band(0, PixelRows::height),
                          deepest,
                          discs.data()));
      return discs;
    };
    std::vector<float> deepest(static_cast<std::size_t>(
        cellsInRow(PixelRows::width) * (PixelRows::height / cell_rows + 1)));
    PixelRows rows = before;
    disc_kernel.findDeepest(rows.band(0, PixelRows::height), all_keys, deepest.data());
    const std::vector<std::uint32_t> all = find(nullptr), seen = find(deepest.data());
    EXPECT_LT(seen.size() + 30, all.size());
    EXPECT_TRUE(std::includes(all.begin(), all.end(), seen.begin(), seen.end()));
    const DiscsInRows of_all(disc_kernel, p, view, looks, all, before),
        of_seen(disc_kernel, p, view, looks, seen, before);
    EXPECT_EQ(of_all.rows.keys, of_seen.rows.keys);
    EXPECT_NE(before.keys, of_seen.rows.keys);
    EXPECT_EQ(of_all.values, of_seen.values);
    EXPECT_EQ(of_all.marks, of_seen.marks);
  });
}

} // namespace test_projection_kernel
