// SPDX-License-Identifier: BSD-3-Clause
// Discs in pixels against rays that meet their planes, in double precision.
#include "pixel_setup.h"
#include "src/render/image_space/disc_kernel.h"
#include "src/render/image_space/side_kernel.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace test_disc_kernel {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::PixelRandom;
using uvol_test::PixelRows;
using uvol_test::PointArrays;
using uvol_test::readDepth;
using uvol_test::readPoint;
using uvol_test::TestCamera;

const KernelTable<const DiscKernels*> kernels{
    &baseline::disc_kernels, &avx2::disc_kernels, &avx512::disc_kernels};

constexpr int first_row = 8, last_row = 60;

/** Where the ray through the middle of a pixel meets a disc. */
struct Meeting {
  double depth;
  double part; ///< distance from the centre in radii
  double facing;

  Meeting(const TestCamera& camera,
          const Vector3d& center,
          const Vector3d& normal,
          double radius,
          int column,
          int row)
  {
    const Projection& p = camera.projection;
    const Vector3d c = camera.toCamera(center), n = camera.rotation * normal;
    const Vector3d ray(
        (column + 0.5 - p.center_x) / p.focal, (row + 0.5 - p.center_y) / p.focal, 1.0);
    const double t = n.dot(c) / n.dot(ray);
    const Vector3d place = t * ray;
    facing = n.dot(c);
    depth = place.norm() * p.per_far;
    part = t > 0.0 && depth < 1.0 ? (place - c).norm() / radius : 1e6;
  }
};

/** The rows with some discs in them. */
PixelRows
drawDiscs(const DiscKernels& kernel,
          const TestCamera& camera,
          const PointArrays& points,
          const std::vector<std::uint32_t>& discs,
          float back = 0.0f)
{
  PixelRows rows;
  kernel.draw(camera.projection,
              points.view(1.0f),
              discs.data(),
              discs.size(),
              back,
              rows.band(first_row, last_row));
  return rows;
}

/** All discs at once, as one after another makes them. */
void
expectTogether(const DiscKernels& kernel,
               const TestCamera& camera,
               const PointArrays& points,
               const PixelRows& expected,
               float back = 0.0f)
{
  std::vector<std::uint32_t> discs(points.size());
  std::iota(discs.begin(), discs.end(), 0u);
  EXPECT_EQ(expected.keys, drawDiscs(kernel, camera, points, discs, back).keys);
}

/** A place in view and a direction there.
 * \param steepest least cosine between that and the way to the eye */
std::pair<Vector3d, Vector3d>
drawPlace(const TestCamera& camera, PixelRandom& random, double steepest)
{
  while (true) {
    // In braces, so that numbers are drawn in this order whatever the compiler.
    const Vector3d x{
        random.between(-1.2, 1.2), random.between(-1.2, 1.2), random.between(-1, 1)};
    const Vector3d normal = random.direction();
    if (std::abs(normal.dot((camera.eye - x).normalized())) >= steepest)
      return {x, normal};
  }
}

/** Discs of a few to some twenty pixels, none of them seen nearly edge-on. */
PointArrays
randomDiscs(const TestCamera& camera, std::size_t count)
{
  PixelRandom random(2);
  PointArrays points;
  while (points.size() < count) {
    const auto [x, normal] = drawPlace(camera, random, 0.3);
    const double size = random.between(0.0, 1.0);
    points.add(x, normal, static_cast<float>(0.04 + 0.4 * size * size * size));
  }
  return points;
}

TEST(DiscKernel, DrawsThePixelsWhoseRaysMeetTheDisc)
{
  const TestCamera camera;
  const PointArrays points = randomDiscs(camera, 60);
  for (const float back : {0.0f, 0.5f})
    uvol_test::forLevels(kernels, [&](const DiscKernels* kernel) {
      std::size_t covered = 0;
      PixelRows all;
      for (std::uint32_t i = 0; i < points.size(); ++i) {
        const PixelRows rows = drawDiscs(*kernel, camera, points, {i}, back);
        for (int row = -1; row <= PixelRows::height; ++row)
          for (int column = -1; column <= PixelRows::width; ++column) {
            const PixelKey key = rows.at(column, row);
            const Meeting meeting(camera,
                                  points.place(i),
                                  points.normal(i),
                                  points.radii[i],
                                  column,
                                  row);
            const bool in_band = row >= first_row && row < last_row && column >= 0 &&
                                 column < PixelRows::width;
            // On its border rounding decides.
            if (in_band && std::abs(meeting.part - 1.0) < 2e-3)
              continue;
            ASSERT_EQ(in_band && meeting.part < 1.0, key != background_key)
                << i << ": " << column << ", " << row;
            if (key == background_key)
              continue;
            ++covered;
            EXPECT_EQ(i, readPoint(key));
            EXPECT_NEAR(
                meeting.depth + back * points.radii[i] / 8.0, readDepth(key), 2e-6);
          }
        for (std::size_t k = 0; k < rows.keys.size(); ++k)
          all.keys[k] = std::min(all.keys[k], rows.keys[k]);
      }
      EXPECT_GT(covered, 1000u);
      // Side by side they are the same, and the nearer one stays.
      expectTogether(*kernel, camera, points, all, back);
    });
}

/** Where a ray meets the paraboloid about a disc on the side that its centre shows, in
 * the axes of the disc: the quadratic equation of the way along the ray. */
struct BentMeeting {
  double depth = 0.0, part = 1e6; ///< as of a Meeting
  Eigen::Vector2d on_disc;        ///< in the axes of the disc
  Eigen::Vector2d turn;           ///< of the normal
  double fold = 0.0;              ///< how near the outline is: 0 on it

  BentMeeting(const TestCamera& camera,
              const PointArrays& points,
              std::uint32_t point,
              double radius,
              int column,
              int row)
  {
    const Projection& p = camera.projection;
    const Vector3d c = camera.toCamera(points.place(point));
    const Vector3d ray(
        (column + 0.5 - p.center_x) / p.focal, (row + 0.5 - p.center_y) / p.focal, 1.0);
    const Eigen::Matrix<double, 3, 2> axes =
        camera.rotation * tangentAxes(points.normals[point]).cast<double>();
    const Vector3d n = camera.rotation * points.normal(point);
    const auto part_of = [&](int i) {
      const auto bits = static_cast<std::int32_t>(points.bends[point] << (22 - 10 * i));
      return (bits >> 22) / double{packed_bend_scale} / points.footprints[point];
    };
    Eigen::Matrix2d bend;
    bend << part_of(0), part_of(1), part_of(1), part_of(2);
    // Of t ray - c: height over the plane, and place in it.
    const Eigen::Vector2d from = -(axes.transpose() * c),
                          along = axes.transpose() * ray;
    const double a = 0.5 * along.dot(bend * along),
                 b = n.dot(ray) + along.dot(bend * from),
                 constant = -n.dot(c) + 0.5 * from.dot(bend * from);
    const double square = b * b - 4.0 * a * constant;
    fold = square / (n.dot(ray) * n.dot(ray));
    if (square < 0.0)
      return;
    // Beyond the outline of a saddle there is another part of it, far away.
    const Eigen::Vector2d in_plane =
        axes.transpose() * (n.dot(c) / n.dot(ray) * ray - c);
    if (1.0 + along.dot(bend * in_plane) / n.dot(ray) + std::sqrt(fold) < 0.0)
      return;
    // The derivative of the height over the paraboloid is the cosine there.
    const double root = n.dot(c) > 0.0 ? std::sqrt(square) : -std::sqrt(square);
    const double t = -2.0 * constant / (b + root);
    const Vector3d place = t * ray;
    depth = place.norm() * p.per_far;
    on_disc = axes.transpose() * (place - c);
    turn = bend * on_disc;
    part = t > 0.0 && depth < 1.0 ? (place - c).norm() / radius : 1e6;
  }
};

/** Discs of bent surfaces, some nearly edge-on. */
PointArrays
bentDiscs(const TestCamera& camera, std::size_t count)
{
  PixelRandom random(4);
  PointArrays points;
  while (points.size() < count) {
    const auto [x, normal] = drawPlace(camera, random, 0.1);
    const double radius = random.between(0.04, 0.4);
    const auto part = [&] {
      return static_cast<float>(random.between(-0.5, 0.5) / radius);
    };
    const float aa = part(), ab = 0.5f * part(), bb = part();
    points.add(x, normal, static_cast<float>(radius), {aa, ab, bb});
  }
  return points;
}

TEST(DiscKernel, DrawsThePixelsWhoseRaysMeetTheBentSurface)
{
  const TestCamera camera;
  const PointArrays points = bentDiscs(camera, 200);
  uvol_test::forLevels(kernels, [&](const DiscKernels* kernel) {
    std::size_t covered = 0, behind_outline = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const PixelRows rows = drawDiscs(*kernel, camera, points, {i});
      for (int row = first_row; row < last_row; ++row)
        for (int column = 0; column < PixelRows::width; ++column) {
          const PixelKey key = rows.at(column, row);
          const double radius = points.radii[i];
          const BentMeeting meeting(camera, points, i, radius, column, row);
          const Meeting flat(
              camera, points.place(i), points.normal(i), radius, column, row);
          behind_outline += flat.part < 1.0 && meeting.fold < 0.0;
          // On its border rounding decides.
          if (std::abs(meeting.part - 1.0) < 5e-3 || std::abs(meeting.fold) < 5e-3)
            continue;
          ASSERT_EQ(meeting.part < 1.0, key != background_key)
              << i << ": " << column << ", " << row;
          if (key == background_key)
            continue;
          ++covered;
          EXPECT_NEAR(meeting.depth, readDepth(key), 1e-5);
        }
    }
    EXPECT_GT(covered, 5000u);
    EXPECT_GT(behind_outline, 200u);
  });
}

/** How far in radii a place lies beyond the nearer end of a disc at its lines. */
double
beyondLines(const RimLines& lines, const Eigen::Vector2d& on_disc, double radius)
{
  double most = -1e6;
  for (const RimLine& line : lines)
    most = std::max(
        most, (line.outwards.cast<double>().dot(on_disc) - line.distance) / radius);
  return most;
}

TEST(DiscKernel, DrawsDiscsUpToTheirLines)
{
  const TestCamera camera;
  PointArrays points = bentDiscs(camera, 200);
  PixelRandom random(6);
  std::vector<RimLines> lines(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float radius = points.radii[i];
    for (RimLine& line : lines[i]) {
      line.outwards = random.direction().head<2>().normalized().cast<float>();
      line.distance = static_cast<float>(random.between(0.05, 1.0)) * radius;
    }
    if (i % 3 == 0)
      lines[i][1] = {};
    points.rims[i] = packRim(lines[i], radius);
  }
  // Directions and distances of packed lines are rounded.
  constexpr double rounding = 0.025;
  uvol_test::forLevels(kernels, [&](const DiscKernels* kernel) {
    std::size_t covered = 0, beyond = 0;
    PixelRows all;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const PixelRows rows = drawDiscs(*kernel, camera, points, {i});
      const double radius = points.radii[i];
      for (int row = first_row; row < last_row; ++row)
        for (int column = 0; column < PixelRows::width; ++column) {
          const PixelKey key = rows.at(column, row);
          const BentMeeting meeting(camera, points, i, radius, column, row);
          const double after = beyondLines(lines[i], meeting.on_disc, radius);
          if (std::abs(meeting.part - 1.0) < 5e-3 || std::abs(meeting.fold) < 5e-3 ||
              std::abs(after) < rounding)
            continue;
          ASSERT_EQ(meeting.part < 1.0 && after < 0.0, key != background_key)
              << i << ": " << column << ", " << row;
          covered += key != background_key ? 1 : 0;
          beyond += meeting.part < 1.0 && after > 0.0 ? 1 : 0;
        }
      for (std::size_t k = 0; k < rows.keys.size(); ++k)
        all.keys[k] = std::min(all.keys[k], rows.keys[k]);
    }
    EXPECT_GT(covered, 3000u);
    EXPECT_GT(beyond, 1000u);
    expectTogether(*kernel, camera, points, all);
  });
}

/** Sums of a pixel: normal, colour, weight. */
struct Sums {
  double values[7] = {};
  bool is_clear = true;
};

/** Depths of the cells of the rows from first_row to last_row. */
std::vector<float>
findDeepest(const DiscKernels& kernel,
            PixelRows& rows,
            PixelKey beyond = background_key)
{
  std::vector<float> deepest(static_cast<std::size_t>(
      cellsInRow(PixelRows::width) * ((last_row - first_row) / cell_rows + 1)));
  kernel.findDeepest(rows.band(first_row, last_row), beyond, deepest.data());
  return deepest;
}

TEST(DiscKernel, FindsTheDeepestOfEachCell)
{
  PixelRows rows;
  PixelRandom random(7);
  for (int row = 0; row < PixelRows::height; ++row)
    for (int column = 0; column < PixelRows::width; ++column)
      if ((row / 20 + column / 30) % 2 == 0 && (row > 24 || random.below(3) == 0))
        rows.first()[row * PixelRows::stride + column] =
            uvol_test::makeKey(random.between(0.1, 0.9), random.below(1u << 30));
  uvol_test::forLevels(kernels, [&](const DiscKernels* kernel) {
    const std::vector<float> deepest = findDeepest(*kernel, rows);
    const int cells = cellsInRow(PixelRows::width);
    std::vector<float> expected(deepest.size()), of_all(deepest.size());
    for (int row = first_row; row < last_row; ++row)
      for (int column = 0; column < cells * cell_columns; ++column) {
        const auto cell = static_cast<std::size_t>(
            (row - first_row) / cell_rows * cells + column / cell_columns);
        const PixelKey key = rows.at(column, row);
        of_all[cell] = std::max(of_all[cell], readDepth(key));
        if (key != background_key)
          expected[cell] = std::max(expected[cell], readDepth(key));
      }
    EXPECT_EQ(expected, deepest);
    EXPECT_NE(0, std::count(expected.begin(), expected.end(), 0.0f));
    EXPECT_EQ(of_all, findDeepest(*kernel, rows, all_keys));
    EXPECT_NE(0, std::count_if(of_all.begin(), of_all.end(), [](float depth) {
                return depth > 0.0f && depth < 1.0f;
              }));
  });
}

TEST(DiscKernel, BlendsWithSmoothWeightsWhatLiesInTheLayer)
{
  TestCamera camera;
  camera.projection.two_sided = true;
  const PointArrays points = randomDiscs(camera, 40);
  constexpr float stretch = 1.5f;
  std::vector<std::uint32_t> looks, discs;
  PixelRandom random(5);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    looks.push_back(points.normals[i]);
    looks.push_back(random.below(1u << 24) | 0xff000000);
    discs.push_back(i);
  }
  PixelRows rows;
  for (int row = 0; row < PixelRows::height; ++row)
    for (int column = 0; column < PixelRows::width; ++column)
      rows.first()[row * PixelRows::stride + column] =
          uvol_test::makeKey(random.between(0.4, 0.6), 0);
  uvol_test::forLevels(kernels, [&](const DiscKernels* kernel) {
    std::vector<float> values(blended_values * rows.keys.size(), -7.0f);
    std::vector<std::uint8_t> marks(rows.keys.size() / blend_segment);
    constexpr std::ptrdiff_t first = PixelRows::stride + PixelRows::margin;
    static_assert(first % blend_segment == 0);
    const auto blend = [&](const std::vector<float>& deepest) {
      kernel->blend(camera.projection,
                    points.view(stretch),
                    looks.data(),
                    discs.data(),
                    discs.size(),
                    rows.band(first_row, last_row),
                    deepest.data(),
                    {values.data() + blended_values * first,
                     marks.data() + first / blend_segment});
    };
    // Hidden discs would add nothing if they were not passed over.
    const std::vector<float> deepest = findDeepest(*kernel, rows);
    blend(std::vector<float>(deepest.size(), -1.0f));
    EXPECT_EQ(std::vector<std::uint8_t>(marks.size()), marks);
    blend(std::vector<float>(deepest.size(), 1.0f));
    const std::vector<float> unhidden = values;
    std::fill(marks.begin(), marks.end(), std::uint8_t(0));
    std::fill(values.begin(), values.end(), -7.0f);
    blend(deepest);
    EXPECT_EQ(unhidden, values);
    std::size_t blended = 0;
    for (int row = first_row; row < last_row; ++row)
      for (int column = 0; column < PixelRows::width; ++column) {
        Sums sums;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
          const double radius = stretch * points.radii[i], room = radius / 8.0;
          const Meeting meeting(
              camera, points.place(i), points.normal(i), radius, column, row);
          const double behind =
              std::abs(meeting.depth - readDepth(rows.at(column, row)));
          if (meeting.part >= 1.0)
            continue;
          sums.is_clear = sums.is_clear && std::abs(behind - room) > 1e-5;
          if (behind > room)
            continue;
          const double rest = 1.0 - meeting.part * meeting.part, weight = rest * rest;
          const Vector3d normal =
              (meeting.facing > 0.0 ? -1.0 : 1.0) * points.normal(i);
          for (int k = 0; k < 3; ++k) {
            sums.values[k] += weight * normal[k];
            sums.values[3 + k] += weight * (looks[2 * i + 1] >> (8 * k) & 0xff);
          }
          sums.values[6] += weight;
        }
        const std::ptrdiff_t pixel = row * PixelRows::stride + column;
        const bool is_marked =
            marks[static_cast<std::size_t>(first / blend_segment +
                                           BlendSums::segmentOf(pixel))] != 0;
        if (!sums.is_clear || (!is_marked && sums.values[6] < 1e-4))
          continue;
        ASSERT_TRUE(is_marked);
        blended += sums.values[6] > 0.0 ? 1 : 0;
        for (int k = 0; k < 7; ++k)
          EXPECT_NEAR(
              sums.values[k],
              values[static_cast<std::size_t>(blended_values * (first + pixel) + k)],
              k < 3 || k == 6 ? 1e-4 : 2e-2);
      }
    EXPECT_GT(blended, 500u);
  });
}

TEST(DiscKernel, BlendsNormalsThatTurnAsTheSurfaceDoes)
{
  const TestCamera camera;
  const PointArrays points = bentDiscs(camera, 90);
  constexpr float stretch = 1.5f;
  uvol_test::forLevels(kernels, [&](const DiscKernels* kernel) {
    std::size_t blended = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      std::vector<std::uint32_t> looks(2 * points.size(), 0x00ffffff);
      looks[2 * i] = points.normals[i];
      const double radius = stretch * points.radii[i];
      PixelRows rows;
      for (int row = first_row; row < last_row; ++row)
        for (int column = 0; column < PixelRows::width; ++column) {
          const BentMeeting meeting(camera, points, i, radius, column, row);
          if (meeting.part < 1.0)
            rows.first()[row * PixelRows::stride + column] =
                uvol_test::makeKey(static_cast<float>(meeting.depth), i);
        }
      std::vector<float> values(blended_values * rows.keys.size());
      std::vector<std::uint8_t> marks(rows.keys.size() / blend_segment);
      constexpr std::ptrdiff_t first = PixelRows::stride + PixelRows::margin;
      const std::vector<float> deepest = findDeepest(*kernel, rows);
      kernel->blend(camera.projection,
                    points.view(stretch),
                    looks.data(),
                    &i,
                    1,
                    rows.band(first_row, last_row),
                    deepest.data(),
                    {values.data() + blended_values * first,
                     marks.data() + first / blend_segment});
      const Eigen::Matrix<double, 3, 2> axes =
          tangentAxes(points.normals[i]).cast<double>();
      for (int row = first_row; row < last_row; ++row)
        for (int column = 0; column < PixelRows::width; ++column) {
          const BentMeeting meeting(camera, points, i, radius, column, row);
          if (meeting.part > 0.9 || meeting.fold < 1e-2)
            continue;
          ++blended;
          const float* const sums =
              values.data() +
              blended_values * (first + row * PixelRows::stride + column);
          const double rest = 1.0 - meeting.part * meeting.part;
          ASSERT_NEAR(rest * rest, sums[6], 1e-3);
          const Vector3d normal = points.normal(i) + axes * meeting.turn;
          const Vector3d sum(sums[0], sums[1], sums[2]);
          EXPECT_LT((sum / sums[6] - normal).norm(), 1e-3);
        }
    }
    EXPECT_GT(blended, 2000u);
  });
}

const KernelTable<SideKernel> side_kernels{
    &baseline::findSides, &avx2::findSides, &avx512::findSides};

TEST(SideKernel, FindsTheSideOfTheSurfaceThatPixelsShow)
{
  TestCamera camera;
  Projection& p = camera.projection;
  p.has_sides = true;
  p.edge_on_cosine = 0.5f;
  const PointArrays points = randomDiscs(camera, 200);
  std::vector<std::uint32_t> looks;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    looks.insert(looks.end(), {points.normals[i], i % 7 << 24 | 0x00abcdef});
  PixelRows rows;
  PixelRandom random(3);
  for (int row = first_row; row < last_row; ++row)
    for (int column = 0; column < PixelRows::width; ++column)
      rows.first()[row * PixelRows::stride + column] =
          uvol_test::makeKey(0.5f, random.below(200));
  constexpr std::ptrdiff_t first = PixelRows::stride + PixelRows::margin;
  for (const float outward : {1.0f, -1.0f})
    uvol_test::forLevels(side_kernels, [&](const SideKernel kernel) {
      p.outward = outward;
      std::vector<std::uint8_t> sides(rows.keys.size());
      kernel(p, looks.data(), rows.band(first_row, last_row), sides.data() + first);
      for (int row = first_row; row < last_row; ++row)
        for (int column = 0; column < PixelRows::width; ++column) {
          const std::uint32_t point = readPoint(rows.at(column, row));
          const Vector3d ray((column + 0.5 - p.center_x) / p.focal,
                             (row + 0.5 - p.center_y) / p.focal,
                             1.0);
          const double cosine =
              outward * (camera.rotation * points.normal(point)).dot(ray.normalized());
          if (std::abs(cosine) < 1e-4 || std::abs(cosine - 0.5) < 1e-4)
            continue;
          const unsigned expected = point % 7 << 2 | (cosine > 0.0 ? 1u : 0u) |
                                    (cosine > 0.0 && cosine < 0.5 ? 2u : 0u);
          EXPECT_EQ(expected,
                    sides[static_cast<std::size_t>(first + row * PixelRows::stride +
                                                   column)]);
        }
    });
}

/** What looks away, nearly edge-on, is behind discs that look to the eye and have
 * nearer centres: these have all of the weight. */
TEST(DiscKernel, DiscsThatLookToTheEyeAreBlendedOverSuchAsLookAway)
{
  TestCamera camera;
  Projection& p = camera.projection;
  p.has_sides = p.two_sided = true;
  p.away_depth = 1.0f;
  p.facing_weight = 1000.0f;
  p.facing_reach = 3.0f;
  PointArrays points = randomDiscs(camera, 100);
  const auto away = static_cast<std::uint32_t>(points.size());
  points.add(Vector3d::Zero(), Vector3d::UnitZ(), 0.1f);
  std::vector<std::uint32_t> looks, discs;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    looks.insert(looks.end(), {points.normals[i], 0x00ffffff});
    if (i != away)
      discs.push_back(i);
  }
  constexpr double seen = 0.55;
  PixelRows rows;
  for (int row = 0; row < PixelRows::height; ++row)
    for (int column = 0; column < PixelRows::width; ++column)
      rows.first()[row * PixelRows::stride + column] = uvol_test::makeKey(seen, away);
  const std::vector<std::uint8_t> sides(rows.keys.size(), looks_away_bit | edge_on_bit);
  uvol_test::forLevels(kernels, [&](const DiscKernels* kernel) {
    std::vector<float> values(blended_values * rows.keys.size());
    std::vector<std::uint8_t> marks(rows.keys.size() / blend_segment);
    constexpr std::ptrdiff_t first = PixelRows::stride + PixelRows::margin;
    kernel->blend(p,
                  points.view(1.5f),
                  looks.data(),
                  discs.data(),
                  discs.size(),
                  rows.band(first_row, last_row),
                  std::vector<float>(rows.keys.size(), 1.0f).data(),
                  {values.data() + blended_values * first,
                   marks.data() + first / blend_segment,
                   sides.data() + first});
    std::size_t facing = 0;
    for (int row = first_row; row < last_row; ++row)
      for (int column = 0; column < PixelRows::width; ++column) {
        double weight = 0.0;
        bool is_clear = true;
        for (const std::uint32_t i : discs) {
          const double radius = 1.5 * points.radii[i];
          const Meeting meeting(
              camera, points.place(i), points.normal(i), radius, column, row);
          if (meeting.part >= 1.0)
            continue;
          const double room = (meeting.facing > 0.0 ? 1.0 : 3.0) * radius / 8.0,
                       behind = std::abs(meeting.depth - seen),
                       center = camera.toCamera(points.place(i)).norm() / 8.0,
                       shifted = seen - 0.1 / 8.0;
          is_clear = is_clear && std::abs(behind - room) > 1e-5 &&
                     std::abs(center - shifted) > 1e-5;
          if (behind > room || (meeting.facing <= 0.0 && center >= shifted))
            continue;
          const double rest = 1.0 - meeting.part * meeting.part;
          weight += (meeting.facing > 0.0 ? 1.0 : 1000.0) * rest * rest;
          facing += meeting.facing > 0.0 ? 0 : 1;
        }
        const std::ptrdiff_t pixel = row * PixelRows::stride + column;
        const auto mark = static_cast<std::size_t>(first / blend_segment +
                                                   BlendSums::segmentOf(pixel));
        if (!is_clear || marks[mark] == 0)
          continue;
        EXPECT_NEAR(
            weight,
            values[static_cast<std::size_t>(blended_values * (first + pixel) + 6)],
            1e-4 * std::max(weight, 1.0));
      }
    EXPECT_GT(facing, 100u);
  });
}

} // namespace test_disc_kernel
