// SPDX-License-Identifier: BSD-3-Clause
// The convex hull of samples: turned boxes and balls, whose hulls are known, and
// samples without a volume.
#include "pipeline/sample_hull.h"
#include "support/environment.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace test_sample_hull {

using namespace pcl_uvol;
using Eigen::Vector3f;

constexpr float reach = 0.01f;

/** In units of the places that are asked for, which the samples have a power of two of.
 */
class Hull {
public:
  explicit Hull(const std::vector<Vector3f>& places)
  {
    std::vector<float> xyz;
    for (const Vector3f& place : places)
      xyz.insert(xyz.end(), place.data(), place.data() + 3);
    std::vector<std::uint32_t> all(places.size());
    std::iota(all.begin(), all.end(), 0);
    Report report;
    samples_ = SampleSet::build(xyz.data(), 3, all, {{1.0f, 1.0f, 1.0f}}, 1, report);
    hull_ = std::make_unique<detail::SampleHull>(
        *samples_, static_cast<double>(reach * samples_->getUnit().factor));
  }

  bool
  contains(const Vector3f& place) const
  {
    return hull_->contains(samples_->getUnit().apply({{place[0], place[1], place[2]}}));
  }

private:
  SampleSet::ConstPtr samples_;
  std::unique_ptr<detail::SampleHull> hull_;
};

class Places {
public:
  /** In a cube about the origin. */
  Vector3f
  next(float half_side)
  {
    Vector3f place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = half_side * static_cast<float>(2.0 * random_.uniform() - 1.0);
    return place;
  }

private:
  uvol_test::Random random_{7};
};

TEST(SampleHull, IsThatOfABoxTurnedAnyHow)
{
  const Vector3f sides(1.0f, 0.7f, 0.2f), middle(40.0f, -3.0f, 5.0f);
  Places places;
  for (int turn = 0; turn < 6; ++turn) {
    const Vector3f axis = places.next(1.0f).normalized();
    const Eigen::AngleAxisf turned(0.16f * static_cast<float>(turn), axis);
    const auto place = [&](const Vector3f& in_box) -> Vector3f {
      return turned * in_box.cwiseProduct(sides) + middle;
    };
    std::vector<Vector3f> samples;
    for (int x = -4; x <= 4; ++x) // a lattice: many on lines and planes
      for (int y = -4; y <= 4; ++y)
        for (int z = -4; z <= 4; ++z)
          samples.push_back(place(0.25f * Vector3f(static_cast<float>(x),
                                                   static_cast<float>(y),
                                                   static_cast<float>(z))));
    const Hull hull(samples);
    for (const Vector3f& sample : samples)
      EXPECT_TRUE(hull.contains(sample));
    for (int i = 0; i < 4000; ++i) {
      const Vector3f asked = places.next(1.3f);
      const float beyond = (asked.cwiseAbs() - Vector3f::Ones())
                               .cwiseMax(0.0f)
                               .cwiseProduct(sides)
                               .norm();
      const bool is_contained = hull.contains(place(asked));
      if (beyond > reach + 1e-4f) { // rounding of coordinates about 40
        EXPECT_FALSE(is_contained) << beyond;
      }
      if (beyond == 0.0f) {
        EXPECT_TRUE(is_contained) << beyond;
      }
    }
  }
}

TEST(SampleHull, OfABallIsWithinTheReachOfIt)
{
  Places places;
  std::vector<Vector3f> samples;
  while (samples.size() < 20000) {
    samples.push_back(places.next(1.0f));
    samples.back() /= std::max(1.0f, samples.back().norm());
  }
  const Hull hull(samples);
  for (const Vector3f& sample : samples)
    EXPECT_TRUE(hull.contains(sample));
  for (int i = 0; i < 4000; ++i) {
    const Vector3f asked = places.next(1.2f);
    if (asked.norm() > 1.0f + reach) {
      EXPECT_FALSE(hull.contains(asked)) << asked.norm();
    }
  }
}

/** Faces beside a sharp edge turn when a corner is added: a sample that was close to
 * the old ones may be far from the new ones. */
TEST(SampleHull, HoldsSamplesThatAreCloseToItsFirstFaces)
{
  Places places;
  for (int ball = 0; ball < 200; ++ball) {
    std::vector<Vector3f> samples;
    samples.reserve(40);
    for (int i = 0; i < 40; ++i)
      samples.push_back(10.0f * reach * places.next(1.0f).normalized());
    const Hull hull(samples);
    for (const Vector3f& sample : samples)
      EXPECT_TRUE(hull.contains(sample)) << ball;
  }
}

TEST(SampleHull, OfSamplesOnAPlaneOrALineOrAloneIsThin)
{
  Places places;
  for (int dimension = 0; dimension < 3; ++dimension) {
    std::vector<Vector3f> samples;
    for (int i = 0; i < 500; ++i) {
      samples.push_back(places.next(1.0f));
      for (int axis = dimension; axis < 3; ++axis)
        samples.back()[axis] = 0.5f;
    }
    const Hull hull(samples);
    for (const Vector3f& sample : samples) {
      EXPECT_TRUE(hull.contains(sample));
      EXPECT_FALSE(hull.contains(sample + 1.01f * reach * Vector3f::UnitZ()));
    }
  }
}

/** The planes of the faces meet far outside where the hull has a sharp edge. */
TEST(SampleHull, EndsNextToItsSharpEdges)
{
  std::vector<Vector3f> samples; // a lens a hundredth as high as it is wide
  for (int i = 0; i < 200; ++i) {
    const float angle = 0.01f * static_cast<float>(M_PI) * static_cast<float>(i);
    samples.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
  }
  samples.emplace_back(0.0f, 0.0f, reach);
  samples.emplace_back(0.0f, 0.0f, -reach);
  const Hull hull(samples);
  for (int i = 0; i < 200; ++i) {
    EXPECT_TRUE(hull.contains(samples[static_cast<std::size_t>(i)]));
    const Vector3f out = samples[static_cast<std::size_t>(i)];
    EXPECT_FALSE(hull.contains((1.0f + 1.01f * reach) * out));
  }
}

} // namespace test_sample_hull
