// SPDX-License-Identifier: BSD-3-Clause
// Bands of samples around a surface, and distances to it: continued from centre to
// centre, and found anew from isopoints.
#include "band_setup.h"
#include "src/levelset/reinitialization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace test_band {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::PlaneBand;

TEST(Band, DistancesGoOnFromTheNearestCentreThatKnowsASample)
{
  const PlaneBand block({6.0, 6.0, 6.0}, 2.0, FitScheme::Quadratic);
  const Band& band = block.band;
  ASSERT_GT(band.others.size(), 100u);
  // Values as on either side of the plane, not as a distance there.
  std::vector<float> phi = block.byPlace(
      [](const Vector3d& x) { return std::copysign(0.3 + std::abs(x[0]), x[2]); });
  const std::vector<float> before = phi;
  band.extrapolate(phi);
  std::vector<double> nearest(band.others.size(), 1e30);
  std::vector<std::size_t> beside(band.others.size(), 0);
  const StencilView stencils = band.stencils.view();
  for (std::size_t i = 0; i < band.centers.size(); ++i)
    for (std::size_t j = 0; j < stencils.neighbors; ++j) {
      const std::uint32_t place =
          stencils.indicesOf(i / stencil_lanes)[i % stencil_lanes + j * stencil_lanes];
      if (place < band.centerPlaces())
        continue;
      const std::size_t other = place - band.centerPlaces();
      const double distance =
          block.unit * (block.center(i) - block.place(band.others[other])).norm();
      if (distance < nearest[other]) {
        nearest[other] = distance;
        beside[other] = i;
      }
    }
  for (std::size_t i = 0; i < band.centerPlaces(); ++i)
    EXPECT_EQ(before[i], phi[i]);
  for (std::size_t i = 0; i < band.others.size(); ++i) {
    const float of_centre = before[beside[i]];
    EXPECT_NEAR(std::copysign(std::abs(of_centre) + nearest[i], of_centre),
                phi[band.centerPlaces() + i],
                1e-5 * block.unit);
  }
}

/** Errors of distances to a sphere, in spacings, of the samples near it. */
std::vector<double>
findErrors(const PlaneBand& block, double radius, double near)
{
  Report report;
  // Its slope is far from 1.
  const std::vector<float> distance =
      distanceToZeroLevel(block.band,
                          *block.samples,
                          block.bySample([&](const Vector3d& x) {
                            return 4.0 * (x.squaredNorm() - radius * radius) / radius;
                          }),
                          block.spacing,
                          1,
                          report);
  std::vector<double> errors;
  block.band.forPlaces([&](std::size_t place, std::uint32_t sample) {
    const double expected = block.place(sample).norm() - radius;
    if (std::abs(expected) > 0.1) {
      EXPECT_EQ(expected < 0.0, distance[place] < 0.0f) << expected;
    }
    if (std::abs(expected) < near)
      errors.push_back(std::abs(distance[place] / block.unit - expected));
  });
  std::sort(errors.begin(), errors.end());
  return errors;
}

/** The nearest isopoint lies up to a spacing beside a sample's foot, where the sphere
 * is a tenth of a spacing off the tangent plane. */
TEST(Reinitialization, DistancesFollowTheBendingOfASphere)
{
  const PlaneBand block({7.0, 7.0, 7.0}, 0.0, FitScheme::Quadratic);
  const std::vector<double> errors = findErrors(block, 4.0, 1.0);
  ASSERT_GT(errors.size(), 300u);
  EXPECT_LT(errors[errors.size() / 2], 0.004);
  EXPECT_LT(errors[errors.size() * 9 / 10], 0.02);
}

/** Planes in a stretched space have a normal that is stretched the other way. */
TEST(Reinitialization, DistancesAreThoseOfTheStretchedSpace)
{
  const PlaneBand block(
      {7.0, 7.0, 7.0}, 0.0, FitScheme::Quadratic, Position{{1.0f, 4.0f, 0.5f}});
  const Vector3d normal = Vector3d(1.0, -2.0, 2.0).normalized();
  Report report;
  const std::vector<float> distance = distanceToZeroLevel(
      block.band,
      *block.samples,
      block.bySample([&](const Vector3d& x) { return 3.0 * normal.dot(x); }),
      block.spacing,
      1,
      report);
  std::size_t near = 0;
  block.band.forPlaces([&](std::size_t place, std::uint32_t sample) {
    const Vector3d x = block.place(sample);
    const double expected = normal.dot(x);
    if (std::abs(expected) > 1.0 || x.cwiseAbs().maxCoeff() > 5.5)
      return; // at the block's border fits are linear
    ++near;
    EXPECT_NEAR(expected, distance[place] / block.unit, 1e-3);
  });
  EXPECT_GT(near, 300u);
}

} // namespace test_band
