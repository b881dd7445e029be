// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the neighbour search against the plainest ones.
#include "src/neighbors/nearest_kernel.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace test_nearest_kernel {

using namespace pcl_uvol;

const KernelTable<const NearestKernels*> kernels{
    &baseline::nearest_kernels, &avx2::nearest_kernels, &avx512::nearest_kernels};

/** Eighths between 0 and 1: many of them are equal, and lie on the faces of boxes. */
std::vector<float>
eighths(std::size_t count, std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  std::vector<float> values(count);
  for (float& value : values)
    value = static_cast<float>(engine() % 9) / 8.0f;
  return values;
}

/** Squared distance of a position to a box; eighths are not rounded. */
float
sqGap(const float* position, const float* low, const float* high)
{
  float sum = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float gap =
        std::max({low[axis] - position[axis], position[axis] - high[axis], 0.0f});
    sum += gap * gap;
  }
  return sum;
}

TEST(NearestKernel, KeepsWhatLiesNearABoxItsFacesAndTheLimitIncluded)
{
  constexpr std::uint32_t count = 103;
  const auto positions = eighths(3 * count, 1);
  const float low[3] = {0.125f, 0.25f, 0.0f}, high[3] = {0.75f, 0.875f, 0.625f};
  for (const float sq_limit : {0.0f, 2.0f / 64.0f, 0.05f})
    for (const std::uint32_t begin : {0u, 5u, 90u})
      for (const std::uint32_t end : {begin, begin + 1, begin + 13, count}) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = begin; i < end; ++i)
          if (sqGap(&positions[3 * i], low, high) <= sq_limit)
            expected.push_back(i);
        uvol_test::forLevels(kernels, [&](const NearestKernels* kernel) {
          std::vector<float> x[3];
          for (auto& coordinate : x)
            coordinate.resize(count + kernel_room);
          std::vector<std::uint32_t> indices(count + kernel_room);
          const std::size_t kept =
              kernel->keepNear(positions.data(),
                               begin,
                               end,
                               low,
                               high,
                               sq_limit,
                               {x[0].data(), x[1].data(), x[2].data(), indices.data()});
          ASSERT_EQ(expected.size(), kept);
          for (std::size_t i = 0; i < kept; ++i) {
            EXPECT_EQ(expected[i], indices[i]);
            for (std::size_t axis = 0; axis < 3; ++axis)
              EXPECT_EQ(positions[3 * expected[i] + axis], x[axis][i]);
          }
        });
      }
}

TEST(NearestKernel, MeasuresSquaredDistances)
{
  const auto x = eighths(50, 2), y = eighths(50, 3), z = eighths(50, 4);
  const float point[3] = {0.25f, -1.0f, 3.5f};
  std::vector<float> positions;
  for (std::size_t i = 0; i < x.size(); ++i)
    positions.insert(positions.end(), {x[i], y[i], z[i]});
  uvol_test::forLevels(kernels, [&](const NearestKernels* kernel) {
    std::vector<float> sq_dist(x.size() + kernel_room);
    kernel->measure(x.data(), y.data(), z.data(), x.size(), point, sq_dist.data());
    for (std::size_t i = 0; i < x.size(); ++i) {
      // Eighths: nothing is rounded.
      const double dx = x[i] - 0.25, dy = y[i] + 1.0, dz = z[i] - 3.5;
      EXPECT_EQ(dx * dx + dy * dy + dz * dz, sq_dist[i]);
    }
    constexpr std::uint32_t begin = 3, end = 41;
    std::vector<float> of_run(x.size() + kernel_room);
    kernel->measureRun(positions.data(), begin, end, point, of_run.data());
    for (std::uint32_t i = begin; i < end; ++i)
      EXPECT_EQ(sq_dist[i], of_run[i - begin]);
  });
}

TEST(NearestKernel, MeasuresARunOfPositions)
{
  const auto positions = eighths(3 * 50, 6);
  const float point[3] = {0.25f, -1.0f, 3.5f};
  for (const std::uint32_t begin : {0u, 3u, 49u})
    uvol_test::forLevels(kernels, [&](const NearestKernels* kernel) {
      std::vector<float> sq_dist(50 + kernel_room);
      kernel->measureRun(positions.data(), begin, 50, point, sq_dist.data());
      for (std::uint32_t i = begin; i < 50; ++i) {
        const double dx = positions[3 * i] - 0.25, dy = positions[3 * i + 1] + 1.0,
                     dz = positions[3 * i + 2] - 3.5;
        EXPECT_EQ(dx * dx + dy * dy + dz * dz, sq_dist[i - begin]);
      }
    });
}

TEST(NearestKernel, CountsAndKeepsValuesUpToALimit)
{
  for (const std::size_t count : {0, 1, 15, 16, 17, 100}) {
    const auto values = eighths(count, 5);
    std::vector<std::uint32_t> indices(count);
    for (std::size_t i = 0; i < count; ++i)
      indices[i] = static_cast<std::uint32_t>(1000 - 7 * i);
    for (const float limit : {-1.0f, 0.0f, 0.375f, 0.4f, 2.0f}) {
      uvol_test::forLevels(kernels, [&](const NearestKernels* kernel) {
        std::vector<float> kept_values(count + kernel_room);
        std::vector<std::uint32_t> kept(count + kernel_room);
        const std::size_t number = kernel->keepWithin(values.data(),
                                                      indices.data(),
                                                      count,
                                                      limit,
                                                      kept_values.data(),
                                                      kept.data());
        EXPECT_EQ(number, kernel->countWithin(values.data(), count, limit));
        std::size_t next = 0;
        for (std::size_t i = 0; i < count; ++i)
          if (values[i] <= limit) {
            ASSERT_LT(next, number);
            EXPECT_EQ(values[i], kept_values[next]);
            EXPECT_EQ(indices[i], kept[next++]);
          }
        EXPECT_EQ(next, number);
      });
    }
  }
}

} // namespace test_nearest_kernel
