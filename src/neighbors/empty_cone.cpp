// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/empty_cone.h"

#include "common/dispatch.h"

#include <cmath>

namespace pcl_uvol {

namespace {

/** Cosine of 57 degrees: half the opening of the widest cone without neighbours.
 * Uniform samples leave no such cone at 99.8 % of the isopoints. */
constexpr float empty_cone = 0.5446f;

const KernelTable<EmptyConeKernel> cone_kernels{
    baseline::emptiestCone, avx2::emptiestCone, avx512::emptiestCone};

/** The 74 directions of small whole numbers, about 15 degrees apart, and six of them
 * once more to fill the table. */
struct ConeDirections {
  alignas(64) float x[3][cone_directions];

  ConeDirections()
  {
    std::size_t count = 0;
    for (int a = -2; a <= 2; ++a)
      for (int b = -2; b <= 2; ++b)
        for (int c = -2; c <= 2; ++c) {
          const int sq_length = a * a + b * b + c * c;
          const bool primitive = a % 2 != 0 || b % 2 != 0 || c % 2 != 0;
          if (!primitive || sq_length == 9)
            continue;
          const float length = std::sqrt(static_cast<float>(sq_length));
          x[0][count] = static_cast<float>(a) / length;
          x[1][count] = static_cast<float>(b) / length;
          x[2][count++] = static_cast<float>(c) / length;
        }
    for (std::size_t i = 0; count < cone_directions; ++i, ++count)
      for (auto& coordinate : x)
        coordinate[count] = coordinate[i];
  }
};

} // namespace

EmptyCone::EmptyCone()
    : kernel_(cone_kernels.get())
{
}

bool
EmptyCone::isEmpty(float* x, float* y, float* z, std::size_t count) const
{
  static const ConeDirections directions;
  return kernel_(directions.x, x, y, z, count) < empty_cone;
}

} // namespace pcl_uvol
