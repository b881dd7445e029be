// SPDX-License-Identifier: BSD-3-Clause
// Which pixels are filled, and with what, against the masks of Figure 4.8 one by one.
#include "pixel_setup.h"
#include "src/render/image_space/fill_kernel.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace test_fill_kernel {

using namespace pcl_uvol;
using uvol_test::makeKey;
using uvol_test::PixelRandom;
using uvol_test::PixelRows;
using uvol_test::readDepth;

const KernelTable<const FillKernels*> kernels{
    &baseline::fill_kernels, &avx2::fill_kernels, &avx512::fill_kernels};

using Fill = std::pair<const PixelKey*, PixelKey>;

/** The cells around a pixel, in circular order. */
std::array<PixelKey, 8>
ringAround(const PixelRows& rows, int column, int row)
{
  constexpr int dx[8] = {-1, 0, 1, 1, 1, 0, -1, -1},
                dy[8] = {-1, -1, -1, 0, 1, 1, 1, 0};
  std::array<PixelKey, 8> ring{};
  for (std::size_t i = 0; i < 8; ++i)
    ring[i] = rows.at(column + dx[i], row + dy[i]);
  return ring;
}

/** Whether four white cells lie side by side. */
bool
isBeyondSilhouette(const std::array<bool, 8>& is_white)
{
  for (std::size_t first = 0; first < 8; ++first)
    if (is_white[first] && is_white[(first + 1) % 8] && is_white[(first + 2) % 8] &&
        is_white[(first + 3) % 8])
      return true;
  return false;
}

/** Random pixels of four depths; that part of them is background. */
PixelRows
randomPixels(std::uint64_t seed, double background)
{
  PixelRandom random(seed);
  PixelRows rows;
  for (int row = 0; row < PixelRows::height; ++row)
    for (int column = 0; column < PixelRows::width; ++column)
      if (random.between(0.0, 1.0) >= background)
        rows.first()[row * PixelRows::stride + column] =
            makeKey(0.25f * static_cast<float>(1 + random.below(4)), random.below(50));
  return rows;
}

/** All fills of a row. */
template <typename IsWhite>
std::vector<Fill>
expectedFills(PixelRows& rows,
              int row,
              int first,
              int last,
              bool of_background,
              const IsWhite& is_white_beside)
{
  std::vector<Fill> fills;
  for (int column = first; column < last; ++column) {
    const PixelKey key = rows.at(column, row);
    if ((key == background_key) != of_background)
      continue;
    const auto ring = ringAround(rows, column, row);
    std::array<bool, 8> is_white{};
    for (std::size_t i = 0; i < 8; ++i)
      is_white[i] = is_white_beside(key, ring[i]);
    // Somebody has to be in front.
    if (std::find(is_white.begin(), is_white.end(), false) != is_white.end() &&
        !isBeyondSilhouette(is_white))
      fills.emplace_back(rows.first() + row * PixelRows::stride + column,
                         *std::min_element(ring.begin(), ring.end()));
  }
  return fills;
}

template <typename Find, typename IsWhite>
void
compareRows(PixelRows& rows,
            bool of_background,
            const IsWhite& is_white,
            const Find& find)
{
  std::size_t filled = 0;
  for (int row = 1; row + 1 < PixelRows::height; ++row)
    for (const auto& [first, last] : {std::pair(1, PixelRows::width - 1), {5, 9}}) {
      const auto expected =
          expectedFills(rows, row, first, last, of_background, is_white);
      filled += expected.size();
      uvol_test::forLevels(kernels, [&](const FillKernels* kernel) {
        std::vector<PixelFill> fills(PixelRows::width + 16);
        const std::size_t count = find(
            *kernel, rows.first() + row * PixelRows::stride, first, last, fills.data());
        ASSERT_EQ(expected.size(), count);
        for (std::size_t i = 0; i < count; ++i) {
          EXPECT_EQ(expected[i].first, fills[i].pixel);
          EXPECT_EQ(expected[i].second, fills[i].key);
        }
      });
    }
  EXPECT_GT(filled, 100u);
}

TEST(FillKernel, BackgroundIsFilledUnlessItLiesBeyondTheSilhouette)
{
  for (const double background : {0.3, 0.6, 0.8}) {
    PixelRows rows = randomPixels(4, background);
    compareRows(
        rows,
        true,
        [](PixelKey, PixelKey beside) { return beside == background_key; },
        [](const FillKernels& kernel,
           PixelKey* row,
           int first,
           int last,
           PixelFill* to) {
          return kernel.findBackground(row, PixelRows::stride, first, last, to);
        });
  }
}

TEST(FillKernel, SurfacesBehindAreFilledByWhatIsALayerInFront)
{
  // Depths are quarters: neighbours are one, two or three steps apart.
  for (const float layer_distance : {0.25f, 0.26f, 0.6f}) {
    PixelRows rows = randomPixels(6, 0.2);
    compareRows(
        rows,
        false,
        [&](PixelKey key, PixelKey beside) {
          return readDepth(beside) >= readDepth(key) - layer_distance;
        },
        [&](const FillKernels& kernel, PixelKey* row, int first, int last, auto* to) {
          return kernel.findOccluded(
              row, PixelRows::stride, first, last, layer_distance, to);
        });
  }
}

} // namespace test_fill_kernel
