// SPDX-License-Identifier: BSD-3-Clause
// The widest cone without neighbours against all pairs of directions and neighbours.
#include "src/neighbors/empty_cone_kernel.h"
#include "support/simd_levels.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace test_empty_cone_kernel {

using namespace pcl_uvol;
using Eigen::Vector3d;

const KernelTable<EmptyConeKernel> kernels{
    baseline::emptiestCone, avx2::emptiestCone, avx512::emptiestCone};

struct Directions {
  alignas(64) float x[3][cone_directions];

  explicit Directions(std::mt19937_64& engine)
  {
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < cone_directions; ++i) {
      const Vector3d v =
          Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
      for (int axis = 0; axis < 3; ++axis)
        x[axis][i] = static_cast<float>(v[axis]);
    }
  }
};

constexpr std::size_t room = 3 * cone_lanes;

struct Neighbors {
  alignas(64) float x[3][room] = {};
  std::vector<Vector3d> seen;

  void
  add(const Vector3d& v)
  {
    for (int axis = 0; axis < 3; ++axis)
      x[axis][seen.size()] = static_cast<float>(v[axis]);
    seen.push_back(v);
  }
};

double
emptiest(const Directions& directions, const Neighbors& neighbors)
{
  double least = 1.0;
  for (std::size_t i = 0; i < cone_directions; ++i) {
    double nearest = -1.0;
    for (const Vector3d& v : neighbors.seen)
      if (v.norm() > 0.0)
        nearest =
            std::max(nearest,
                     v.normalized().dot(Vector3d(
                         directions.x[0][i], directions.x[1][i], directions.x[2][i])));
    least = std::min(least, nearest);
  }
  return least;
}

TEST(EmptyConeKernel, FindsTheDirectionFarthestFromAll)
{
  std::mt19937_64 engine(9);
  std::normal_distribution<double> normal;
  for (const std::size_t count : {0, 1, 5, 17, 40}) {
    const Directions directions(engine);
    Neighbors neighbors;
    for (std::size_t i = 0; i < count; ++i)
      neighbors.add(0.3 * static_cast<double>(i + 1) *
                    Vector3d(normal(engine), normal(engine), normal(engine)));
    neighbors.add(Vector3d::Zero()); // one at the point itself does not count
    uvol_test::forLevels(kernels, [&](EmptyConeKernel kernel) {
      Neighbors scaled = neighbors;
      const float found =
          kernel(directions.x, scaled.x[0], scaled.x[1], scaled.x[2], room);
      EXPECT_NEAR(emptiest(directions, neighbors), found, 1e-6) << count;
    });
  }
}

} // namespace test_empty_cone_kernel
