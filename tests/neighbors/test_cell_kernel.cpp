// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of Voronoi cells against the plainest ones.
#include "common/random.h"
#include "src/neighbors/cell_kernel.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace test_cell_kernel {

using namespace pcl_uvol;

constexpr double infinity = std::numeric_limits<double>::infinity();

const KernelTable<const CellKernels*> kernels{
    &baseline::cell_kernels, &avx2::cell_kernels, &avx512::cell_kernels};

/** Rows of x, y, z and half the squared length, with room behind them. */
struct Points {
  std::vector<double> rows[4];
  const double* pointers[4];

  explicit Points(std::size_t count)
  {
    for (auto& row : rows)
      row.assign(count + cell_padding, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      double sum = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        rows[axis][i] = 2.0 * uniformAt(4, i, axis) - 1.0;
        sum += rows[axis][i] * rows[axis][i];
      }
      rows[3][i] = 0.5 * sum;
    }
    std::fill(
        rows[3].begin() + static_cast<std::ptrdiff_t>(count), rows[3].end(), infinity);
    for (std::size_t row = 0; row < 4; ++row)
      pointers[row] = rows[row].data();
  }

  double
  along(const double* normal, std::size_t i) const
  {
    return normal[0] * rows[0][i] + normal[1] * rows[1][i] + normal[2] * rows[2][i];
  }
};

TEST(CellKernel, MeasuresHeightsOverAPlane)
{
  for (const std::size_t count : {1u, 4u, 7u, 8u, 26u}) {
    const Points points(count);
    double plane[] = {0.3, -0.7, 0.4, 0.0};
    for (const double limit : {0.05, 0.4, 5.0}) {
      plane[3] = limit;
      std::vector<double> expected;
      bool is_over = false;
      for (std::size_t i = 0; i < count; ++i) {
        expected.push_back(points.along(plane, i) - limit);
        is_over = is_over || expected.back() > 1e-9;
      }
      uvol_test::forLevels(kernels, [&](const CellKernels* kernel) {
        std::vector<double> heights(count + cell_padding);
        EXPECT_EQ(is_over ? 1u : 0u,
                  kernel->measureHeights(
                      points.pointers, count, plane, 1e-9, heights.data()));
        heights.resize(count);
        EXPECT_EQ(expected, heights);
      });
    }
  }
}

/** A point on the plane, and one over it. */
TEST(CellKernel, KnowsWhatLiesWithinTheMargin)
{
  Points points(11);
  for (std::size_t i = 0; i < 11; ++i)
    points.rows[0][i] = points.rows[1][i] = points.rows[2][i] = -1.0;
  const double plane[] = {0.0, 2.0, 0.0, 1.0};
  const auto expectBits = [&](unsigned bits) {
    uvol_test::forLevels(kernels, [&](const CellKernels* kernel) {
      std::vector<double> heights(11 + cell_padding);
      EXPECT_EQ(
          bits,
          kernel->measureHeights(points.pointers, 11, plane, 1e-3, heights.data()));
    });
  };
  expectBits(0);
  for (const double height : {0.0, 0.0009, -0.0009}) {
    points.rows[1][10] = 0.5 * (1.0 + height);
    expectBits(2);
  }
  points.rows[1][3] = 0.51;
  expectBits(3);
  points.rows[1][10] = 0.5 * (1.0 - 0.0011);
  expectBits(1);
}

/** The first sphere through three points that meets another one, by its definition. */
TEST(CellKernel, FindsTheFirstPointOfAGrowingSphere)
{
  for (const std::size_t count : {4u, 9u, 16u, 23u}) {
    const Points points(count);
    const std::uint16_t corners[] = {2, 0, 3};
    const double sphere[] = {0.1, -0.2, 0.15, 0.7};
    for (const double side : {-1.0, 1.0}) {
      const double plane[] = {0.5 * side, 0.2 * side, -0.6 * side, 0.1 * side};
      double nearest = infinity;
      std::size_t first = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const double ahead = points.along(plane, i) - plane[3];
        if (i == 0 || i == 2 || i == 3 || !(ahead > 0.0))
          continue;
        const double distance = (points.rows[3][i] - sphere[0] * points.rows[0][i] -
                                 sphere[1] * points.rows[1][i] -
                                 sphere[2] * points.rows[2][i] - sphere[3]) /
                                ahead;
        if (distance < nearest) {
          nearest = distance;
          first = i;
        }
      }
      uvol_test::forLevels(kernels, [&](const CellKernels* kernel) {
        std::vector<double> distances(count + cell_padding);
        std::size_t found = count;
        EXPECT_EQ(nearest,
                  kernel->findFirst(points.pointers,
                                    count,
                                    plane,
                                    sphere,
                                    corners,
                                    distances.data(),
                                    &found));
        EXPECT_TRUE(found == first || nearest == infinity);
      });
    }
  }
}

/** By squared distances, and the first one of two at one place. */
TEST(CellKernel, FindsTheNearestPoint)
{
  for (const std::size_t count : {1u, 4u, 9u, 16u, 23u}) {
    Points points(count);
    for (auto& row : points.rows)
      row[count - 1] = row[count / 2];
    for (std::size_t q = 0; q < 20; ++q) {
      const double place[] = {
          uniformAt(6, q, 0), uniformAt(6, q, 1) - 1.0, uniformAt(6, q, 2)};
      double least = infinity;
      std::size_t nearest = 0;
      for (std::size_t i = 0; i < count; ++i) {
        double sum = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
          sum += std::pow(points.rows[axis][i] - place[axis], 2);
        if (sum < least) {
          least = sum;
          nearest = i;
        }
      }
      uvol_test::forLevels(kernels, [&](const CellKernels* kernel) {
        EXPECT_EQ(nearest, kernel->findNearest(points.pointers, count, place));
      });
    }
  }
}

} // namespace test_cell_kernel
