// SPDX-License-Identifier: BSD-3-Clause
// Bends against those of surfaces that are known.
#include "src/surface/surface_bend.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace test_surface_bend {

using namespace pcl_uvol;
using Eigen::Vector2f;
using Eigen::Vector3f;

Vector3f
unpacked(PackedNormal packed)
{
  Vector3f normal;
  unpackNormal(packed, normal.data());
  return normal;
}

TEST(SurfaceBend, AxesStandOnNormalsOfEveryDirection)
{
  std::mt19937 engine(3);
  std::normal_distribution<float> component;
  for (int i = 0; i < 20000; ++i) {
    Vector3f normal(component(engine), component(engine), component(engine));
    if (i % 3 == 0)
      normal[2] = 0.0f; // between the two halves of the axes
    if (i < 6)
      normal = (i % 2 == 0 ? 1.0f : -1.0f) * Vector3f::Unit(i / 2);
    const PackedNormal packed = packNormal(normal.data());
    Eigen::Matrix3f frame;
    frame << tangentAxes(packed), unpacked(packed);
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3f::Identity()).norm(), 2e-6f);
    EXPECT_GT(frame.determinant(), 0.0f);
  }
}

/** The bend that points of a height over the plane show, whose normals are exact. */
SurfaceBend
fitTo(const std::function<float(const Vector2f&)>& height,
      const std::function<Vector2f(const Vector2f&)>& slope,
      float size)
{
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> place(-size, size);
  BendFit fit(0.5f * size);
  for (int i = 0; i < 16; ++i) {
    const Vector2f offset(place(engine), place(engine));
    const Vector3f normal =
        Vector3f(-slope(offset)[0], -slope(offset)[1], 1.0f).normalized();
    fit.add(offset, normal.head<2>(), height(offset));
  }
  return fit.solve();
}

TEST(SurfaceBend, OfASphereIsTheInverseOfItsRadius)
{
  constexpr float radius = 2.0f;
  const auto depth = [](const Vector2f& x) {
    return std::sqrt(radius * radius - x.squaredNorm());
  };
  const SurfaceBend bend =
      fitTo([&](const Vector2f& x) { return depth(x) - radius; },
            [&](const Vector2f& x) -> Vector2f { return -x / depth(x); },
            0.2f);
  EXPECT_LT((bend - SurfaceBend(0.5f, 0.0f, 0.5f)).norm(), 2e-3f);
}

TEST(SurfaceBend, OfASaddleHasBothSigns)
{
  const auto slope = [](const Vector2f& x) { return Vector2f(-x[1], -x[0]); };
  const SurfaceBend bend =
      fitTo([](const Vector2f& x) { return -x[0] * x[1]; }, slope, 0.01f);
  EXPECT_LT((bend - SurfaceBend(0.0f, 1.0f, 0.0f)).norm(), 1e-3f);
}

TEST(SurfaceBend, OfAPlaneIsNoneNorThatOfNormalsThatPlacesContradict)
{
  const auto level = [](const Vector2f&) { return 0.0f; };
  const auto flat = [](const Vector2f&) { return Vector2f(0.0f, 0.0f); };
  EXPECT_EQ(SurfaceBend(SurfaceBend::Zero()), fitTo(level, flat, 1.0f));
  // As about the vertices of an edge, whose normals are means.
  const auto turned = [](const Vector2f& x) {
    return Vector2f(x[0] > 0.5f ? 1.0f : 0.0f, 0.0f);
  };
  EXPECT_EQ(SurfaceBend(SurfaceBend::Zero()), fitTo(level, turned, 1.0f));
  EXPECT_EQ(SurfaceBend(SurfaceBend::Zero()), BendFit(1.0f).solve());
}

/** What kernels unpack. */
SurfaceBend
unpackBend(PackedBend packed)
{
  SurfaceBend bend;
  for (int i = 0; i < 3; ++i)
    bend[i] =
        static_cast<float>(static_cast<std::int32_t>(packed << (22 - 10 * i)) >> 22) /
        packed_bend_scale;
  return bend;
}

TEST(SurfaceBend, IsPackedToAThousandthOrReducedAsAWhole)
{
  EXPECT_EQ(0u, packBend(SurfaceBend::Zero(), 3.0f));
  EXPECT_EQ(0u, packBend({1.0f, 2.0f, 3.0f}, 0.0f));
  const SurfaceBend bend(-0.2f, 0.1f, 0.24f);
  EXPECT_LT((unpackBend(packBend(bend, 2.0f)) - 2.0f * bend).cwiseAbs().maxCoeff(),
            0.6f / packed_bend_scale);
  const SurfaceBend reduced = unpackBend(packBend(bend, 20.0f));
  EXPECT_EQ(most_bend, reduced.cwiseAbs().maxCoeff());
  EXPECT_LT((reduced / most_bend - bend / 0.24f).cwiseAbs().maxCoeff(), 2e-3f);
}

} // namespace test_surface_bend
