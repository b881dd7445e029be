// SPDX-License-Identifier: BSD-3-Clause
// Membership of clusters as a field, and its smoothing by the kernel of particles.
#include "common/random.h"
#include "multivariate/membership.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace test_membership {

using namespace pcl_uvol;

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

pcl::Indices
allOf(const Cloud& cloud)
{
  pcl::Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<float>
smooth(const Cloud& cloud,
       const std::vector<float>& values,
       const std::vector<float>& lengths,
       unsigned threads = 0)
{
  Report report;
  return smoothMembership(
      viewOf(cloud), allOf(cloud), values, lengths, threads, report);
}

/** Particles whose smoothing lengths vary by four orders of magnitude. */
struct Particles {
  Cloud cloud;
  std::vector<float> lengths, values;
};

Particles
makeParticles(std::uint64_t count)
{
  Particles particles;
  for (std::uint64_t i = 0; i < count; ++i) {
    // Dense around the origin, as where stars form.
    const double radius = std::pow(10.0, -4.0 * uniformAt(1, i, 0));
    particles.cloud.push_back({static_cast<float>(radius * normalAt(2, i, 0)),
                               static_cast<float>(radius * normalAt(2, i, 1)),
                               static_cast<float>(radius * normalAt(2, i, 2))});
    particles.lengths.push_back(static_cast<float>(radius * uniformAt(3, i, 0)));
    particles.values.push_back(uniformAt(4, i, 0) < 0.5 ? 1.0f : 0.0f);
  }
  return particles;
}

/** The cubic spline with its norm, in three dimensions. */
double
kernel(double distance, double h)
{
  const double q = distance / h;
  const double norm = 1.0 / (3.14159265358979323846 * h * h * h);
  if (q < 1.0)
    return norm * (1.0 - 1.5 * q * q + 0.75 * q * q * q);
  return q < 2.0 ? norm * 0.25 * std::pow(2.0 - q, 3.0) : 0.0;
}

double
smoothOne(const Particles& particles, std::size_t i)
{
  double sum = 0.0, weights = 0.0;
  for (std::size_t j = 0; j < particles.cloud.size(); ++j) {
    const double h = particles.lengths[j];
    const Eigen::Vector3d offset = particles.cloud[i].getVector3fMap().cast<double>() -
                                   particles.cloud[j].getVector3fMap().cast<double>();
    const double weight = h * h * h * kernel(offset.norm(), h);
    sum += weight * particles.values[j];
    weights += weight;
  }
  return sum / weights;
}

TEST(Membership, IsOneForMembersOnly)
{
  EXPECT_EQ(membership({3, -1, 0, 3}, 3), (std::vector<float>{1.0f, 0.0f, 0.0f, 1.0f}));
  EXPECT_EQ(membership({3, -1, 0, 3}, -1),
            (std::vector<float>{0.0f, 1.0f, 0.0f, 0.0f}));
}

TEST(Membership, UnknownLabelsAreRefusedByName)
{
  EXPECT_THROW(membership({}, 0), InvalidArgument);
  EXPECT_EQ(
      pcl_uvol::Message("no_such_cluster", {{"cluster", 5}, {"labels", "-1, 0, 7"}}),
      uvol_test::thrownBy<InvalidArgument>([] {
        membership({7, -1, 0, 7}, 5);
      }));
}

TEST(SmoothMembership, IsTheSumOverAllParticles)
{
  for (const std::uint64_t count : {1u, 2u, 16u, 17u, 500u}) {
    const Particles particles = makeParticles(count);
    const auto values = smooth(particles.cloud, particles.values, particles.lengths);
    std::size_t mixed = 0;
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(values[i], smoothOne(particles, i), 1e-6);
      mixed += values[i] > 0.0f && values[i] < 1.0f ? 1 : 0;
    }
    const std::size_t least_mixed = count == 500 ? 300 : 0;
    EXPECT_GE(mixed, least_mixed);
  }
}

TEST(SmoothMembership, ConstantsStayConstant)
{
  const Particles particles = makeParticles(3000);
  for (const float constant : {0.0f, 0.3f, 1.0f}) {
    const std::vector<float> values(3000, constant);
    EXPECT_EQ(smooth(particles.cloud, values, particles.lengths), values);
  }
}

TEST(SmoothMembership, IsHalfAtAnInterface)
{
  // A lattice of spacing 1; planes below 8 are members, plane 8 lies midway.
  Particles particles;
  for (int x = 0; x <= 16; ++x)
    for (int y = 0; y < 9; ++y)
      for (int z = 0; z < 9; ++z) {
        particles.cloud.push_back({x * 1.0f, y * 1.0f, z * 1.0f});
        particles.lengths.push_back(1.7f);
        particles.values.push_back(x < 8 ? 1.0f : x == 8 ? 0.5f : 0.0f);
      }
  const auto values = smooth(particles.cloud, particles.values, particles.lengths);
  const auto at = [&](std::size_t x) { return values[(x * 9 + 4) * 9 + 4]; };
  EXPECT_NEAR(at(8), 0.5f, 1e-6f);
  for (std::size_t x = 0; x < 16; ++x)
    EXPECT_GE(at(x), at(x + 1));
  for (std::size_t x = 5; x < 11; ++x)
    EXPECT_GT(at(x), at(x + 1));
  EXPECT_EQ(at(4), 1.0f); // the support ends at 3.4
  EXPECT_EQ(at(12), 0.0f);
  EXPECT_NEAR(at(7) + at(9), 1.0f, 1e-6f);
}

TEST(SmoothMembership, BadParticlesKeepTheirsAndDoNotCount)
{
  Particles particles = makeParticles(400);
  const auto before = smooth(particles.cloud, particles.values, particles.lengths);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float x : {nan, infinite}) {
    particles.cloud.push_back({x, 0.0f, 0.0f});
    particles.lengths.push_back(1.0f);
  }
  for (const float h : {0.0f, -1.0f, nan, infinite}) {
    particles.cloud.push_back({0.0f, 0.0f, 0.0f});
    particles.lengths.push_back(h);
  }
  particles.values.resize(particles.cloud.size(), 0.25f);
  Report report;
  const auto after = smoothMembership(viewOf(particles.cloud),
                                      allOf(particles.cloud),
                                      particles.values,
                                      particles.lengths,
                                      0,
                                      report);
  EXPECT_EQ(report.getCount("not_smoothed"), 6u);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
  for (std::size_t i = before.size(); i < after.size(); ++i)
    EXPECT_EQ(after[i], 0.25f);
  EXPECT_TRUE(smooth(Cloud(), {}, {}).empty());
}

TEST(SmoothMembership, ManyParticlesAtOnePlaceShareTheMean)
{
  Particles particles;
  for (int i = 0; i < 1000; ++i) {
    particles.cloud.push_back({1.0f, 2.0f, 3.0f});
    particles.lengths.push_back(0.5f);
    particles.values.push_back(i < 250 ? 1.0f : 0.0f);
  }
  for (const float value : smooth(particles.cloud, particles.values, particles.lengths))
    EXPECT_EQ(value, 0.25f);
}

TEST(SmoothMembership, AnyNumberOfThreadsGivesTheSameBytes)
{
  const Particles particles = makeParticles(6000);
  const auto one = smooth(particles.cloud, particles.values, particles.lengths, 1);
  for (const unsigned threads : {2u, 3u, 8u})
    EXPECT_EQ(smooth(particles.cloud, particles.values, particles.lengths, threads),
              one);
}

TEST(SmoothMembership, BadInputIsRefused)
{
  const Particles particles = makeParticles(10);
  const std::vector<float> few(9, 0.5f);
  EXPECT_THROW(smooth(particles.cloud, few, particles.lengths), InvalidArgument);
  EXPECT_THROW(smooth(particles.cloud, particles.values, few), InvalidArgument);
  for (const float bad : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
    std::vector<float> values = particles.values;
    values[3] = bad;
    EXPECT_THROW(smooth(particles.cloud, values, particles.lengths), InvalidArgument);
  }
}

} // namespace test_membership
