// SPDX-License-Identifier: BSD-3-Clause
// Isopoints of samples that lie on a plane: curves there, by polynomials of the plane.
#include "fitted_roots.h"
#include "src/isosurface/smooth_roots.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace test_planar_isopoints {

using namespace pcl_uvol;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using uvol_test::FieldSamples;
using uvol_test::positionOf;
using uvol_test::Roots;

using PlaneFunction = std::function<double(const Vector2d&)>;

/** Samples of the square from -1.5 to 1.5 in a plane, which is then turned.
 * \param along samples along a side
 * \param jitter in spacings, within the plane
 * \param off in spacings, across it */
struct Sheet {
  Matrix3d turn;
  std::vector<Position> places;
  double spacing;

  Sheet(int along, const Matrix3d& turned, double jitter, double off)
      : turn(turned)
      , spacing(3.0 / (along - 1))
  {
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> scatter(-1.0, 1.0);
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < along; ++j) {
        const Vector3d flat(i + jitter * scatter(engine),
                            j + jitter * scatter(engine),
                            off * scatter(engine));
        const Vector3d place = turn * (spacing * flat - Vector3d(1.5, 1.5, 0.0));
        places.push_back({{static_cast<float>(place[0]),
                           static_cast<float>(place[1]),
                           static_cast<float>(place[2])}});
      }
  }

  Vector2d
  inPlane(const Vector3d& x) const
  {
    return (turn.transpose() * x).head<2>();
  }

  FieldSamples
  sample(const PlaneFunction& function) const
  {
    return {places, [&](const Vector3d& x) { return function(inPlane(x)); }};
  }
};

/** Boxes of the tree around an oblique sheet touch far away: a few edges reach past
 * samples. */
bool
isBridged(const PointIso& point)
{
  return point.support == static_cast<std::uint8_t>(IsoSupport::Bridged);
}

/** An axis that is oblique to all coordinates. */
Matrix3d
tilted()
{
  return Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 0.5).normalized())
      .toRotationMatrix();
}

double
circle(const Vector2d& x)
{
  return x.squaredNorm();
}

/** Quadratics follow a circle exactly; the surface over it is a cylinder, whose mean
 * curvature is half of the circle's. */
TEST(PlanarIsopoints, OfACircleLieOnIt)
{
  for (const Matrix3d& turn : {Matrix3d(Matrix3d::Identity()), tilted()})
    for (const double jitter : {0.0, 0.4}) {
      const Sheet sheet(41, turn, jitter, 0.0);
      const Roots curve(sheet.sample(circle), 1.0f);
      ASSERT_GT(curve.points.size(), 80u);
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const PointIso& point = curve.points[i];
        if (isBridged(point))
          continue;
        ASSERT_LE(curve.fits[i].outcome, RootOutcome::Quadratic);
        const Vector3d x = positionOf(point);
        EXPECT_NEAR(1.0, x.norm(), 2e-6);
        EXPECT_NEAR(0.0, (turn.transpose() * x)[2], 1e-6);
        // Values are lower in the middle, where the outside is.
        EXPECT_NEAR(
            0.0, (x + point.getNormalVector3fMap().cast<double>()).norm(), 2e-4);
        EXPECT_NEAR(-0.5, point.mean_curvature, 2e-3);
        EXPECT_LE(point.error, 1e-4f);
        EXPECT_EQ(IsoSupport::Measured, static_cast<IsoSupport>(point.support));
      }
    }
}

/** What lies a little off the plane, as a scanner's noise does, says nothing of what is
 * across it. */
TEST(PlanarIsopoints, DoNotFollowNoiseAcrossThePlane)
{
  for (const double off : {1e-6, 1e-4, 1e-2, 0.02}) {
    const Sheet sheet(41, tilted(), 0.4, off);
    const Roots curve(
        sheet.sample([](const Vector2d& x) { return std::exp(x.squaredNorm()); }),
        2.718281828f);
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const PointIso& point = curve.points[i];
      if (isBridged(point))
        continue;
      ASSERT_LE(curve.fits[i].outcome, RootOutcome::Quadratic) << off;
      const double deviation = std::abs(sheet.inPlane(positionOf(point)).norm() - 1.0);
      EXPECT_LE(deviation, 0.01 * sheet.spacing) << off;
      EXPECT_LE(std::abs((sheet.turn.transpose() *
                          point.getNormalVector3fMap().cast<double>())[2]),
                0.1)
          << off;
      EXPECT_NEAR(-0.5, point.mean_curvature, 0.05) << off;
    }
  }
}

/** Cubics of the plane miss the fourth power of the distance, by their bias. */
TEST(PlanarIsopoints, ErrorsCoverFieldsThatGrowAlikeInAllDirections)
{
  const Sheet sheet(41, tilted(), 0.4, 0.0);
  const Roots curve(
      sheet.sample([](const Vector2d& x) { return x.squaredNorm() * x.squaredNorm(); }),
      1.0f);
  std::size_t biased = 0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const double deviation =
        std::abs(sheet.inPlane(positionOf(curve.points[i])).norm() - 1.0);
    if (curve.fits[i].outcome != RootOutcome::Cubic || deviation < 2e-6)
      continue;
    ++biased;
    EXPECT_GE(curve.points[i].error, 1.8 * deviation);
  }
  EXPECT_GT(4 * biased, curve.points.size());
}

double
largestDeviation(int along, const PlaneFunction& function, double radius)
{
  const Sheet sheet(along, tilted(), 0.4, 0.0);
  const auto isovalue = static_cast<float>(function({radius, 0.0}));
  double largest = 0.0;
  std::size_t bridged = 0;
  const Roots curve(sheet.sample(function), isovalue);
  for (const PointIso& point : curve.points) {
    bridged += isBridged(point);
    if (!isBridged(point))
      largest =
          std::max(largest, std::abs(sheet.inPlane(positionOf(point)).norm() - radius));
  }
  EXPECT_LE(50 * bridged, curve.points.size());
  return largest;
}

TEST(PlanarIsopoints, ConvergeByMoreThanTheSecondOrder)
{
  const auto wave = [](const Vector2d& x) { return std::cos(2.0 * x.norm()); };
  const double coarse = largestDeviation(21, wave, 0.8),
               fine = largestDeviation(81, wave, 0.8);
  EXPECT_GE(std::log(coarse / fine) / std::log(4.0), 2.0);
  EXPECT_LE(fine, 1e-4);
}

/** Where the square ends, so do the samples around isopoints. */
TEST(PlanarIsopoints, KnowTheRimOfThePlane)
{
  const Sheet sheet(41, tilted(), 0.4, 0.0);
  const Roots curve(sheet.sample([](const Vector2d& x) { return x[0]; }), 0.02f);
  std::size_t rim = 0;
  for (const PointIso& point : curve.points) {
    const double to_end = 1.5 - std::abs(sheet.inPlane(positionOf(point))[1]);
    const auto support = static_cast<IsoSupport>(point.support);
    rim += support == IsoSupport::Rim;
    EXPECT_TRUE(to_end < 2.0 * sheet.spacing || support == IsoSupport::Measured);
  }
  EXPECT_GE(rim, 2u);
}

/** A line determines nothing but its own crossings, and a few samples no quadratic. */
TEST(PlanarIsopoints, AreNotMadeUpOfLinesAndFewSamples)
{
  std::vector<Position> line;
  line.reserve(200);
  for (int i = 0; i < 200; ++i)
    line.push_back({{0.01f * static_cast<float>(i), 0.0f, 0.0f}});
  const auto height = [](const Vector3d& x) { return x[0]; };
  const Sheet few(3, tilted(), 0.4, 0.0);
  for (const Roots& curve :
       {Roots(FieldSamples(line, height), 1.003f),
        Roots(few.sample([](const Vector2d& x) { return x[0]; }), 0.1f)}) {
    ASSERT_GT(curve.points.size(), 0u);
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      EXPECT_EQ(RootOutcome::Singular, curve.fits[i].outcome);
      EXPECT_TRUE(std::isnan(curve.points[i].mean_curvature));
    }
  }
}

} // namespace test_planar_isopoints
