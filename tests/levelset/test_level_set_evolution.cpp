// SPDX-License-Identifier: BSD-3-Clause
// Level sets on scattered samples (thesis chapter 3): the laws they obey, the noise
// they take away, and what they refuse.
#include "levelset/level_set_setup.h"
#include "levelset/phi_cloud.h"
#include "support/messages.h"
#include "support/noisy_shapes.h"
#include "support/statistics.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_parameters.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>
#include <random>
#include <utility>

namespace test_level_set_evolution {

using pcl_uvol::CurvatureFlow;
using pcl_uvol::FitScheme;
using pcl_uvol::InitialFunction;
using pcl_uvol::Integration;
using pcl_uvol::Interpolation;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Reinitialization;
using uvol_test::computeMean;
using uvol_test::Evolution;
using uvol_test::evolve;
using uvol_test::makeBall;
using uvol_test::withValues;
using Cloud = uvol_test::LevelSetCloud;
using Vector = Eigen::Vector3d;

/** Distances of the isopoints of phi to the origin. */
std::vector<double>
radiiOf(const Cloud& cloud, const std::vector<float>& phi)
{
  std::vector<double> radii;
  for (const pcl_uvol::PointIso& point :
       uvol_test::isopoints(withValues(cloud, phi), Interpolation::Fit))
    radii.push_back(point.getVector3fMap().cast<double>().norm());
  return radii;
}

double
largestDeviation(const std::vector<double>& radii, double expected)
{
  double largest = 0.0;
  for (const double radius : radii)
    largest = std::max(largest, std::abs(radius - expected));
  return largest;
}

/** Mean curvature flow: r(t) = sqrt(r0^2 - 2 t), in squared lengths. */
TEST(LevelSetEvolution, SphereShrinksByItsCurvature_long)
{
  constexpr double start = 10.0;
  const auto cloud = makeBall(start, 15.0);
  for (const Integration integration :
       {Integration::Asynchronous, Integration::Synchronous}) {
    Evolution evolution;
    evolution.setMu(0.0);
    evolution.setCurvatureFlow(CurvatureFlow::Mean);
    evolution.setIntegration(integration);
    evolution.setMaximumSteps(integration == Integration::Asynchronous ? 250 : 800);
    std::size_t checked = 0;
    double last = start;
    evolution.setSnapshotCallback(5, [&](const auto& summary, const auto& phi) {
      const double t = summary.steps.back().time * summary.spacing * summary.spacing;
      const double sq_radius = start * start - 2.0 * t;
      if (sq_radius < 0.25 * start * start)
        return;
      last = std::sqrt(sq_radius);
      EXPECT_NEAR(last, computeMean(radiiOf(*cloud, phi)), 0.02 * last)
          << summary.steps.size();
      ++checked;
    });
    evolve(evolution, cloud);
    EXPECT_GE(checked, 4u);
    EXPECT_LT(last, 0.52 * start);
    EXPECT_GT(evolution.getReport().getCount("band_updates"), 0u);
  }
}

/** Advection alone, from shapes that are not the surface. */
TEST(LevelSetEvolution, DataAttractOtherShapes)
{
  constexpr double radius = 8.0;
  const auto cloud = makeBall(radius, 15.0);
  for (const auto& initial :
       {InitialFunction::sphere(Vector::Zero(), 1.3 * radius),
        InitialFunction::box(Vector(-10, -9, -8), Vector(9, 10, 11))}) {
    Evolution evolution;
    evolution.setMu(1.0);
    evolution.setInitialFunction(initial);
    const auto phi = evolve(evolution, cloud);
    EXPECT_TRUE(evolution.getSummary().converged);
    EXPECT_LT(largestDeviation(radiiOf(*cloud, phi), radius), 0.1);
  }
}

/** A sphere of radius 10 and a start that is twice as steep on one side as on the
 * other, and nowhere a distance. */
struct Reinitialized {
  pcl_uvol::LevelSetSummary summary;
  pcl_uvol::Report report;
  std::vector<double> deviations;

  Reinitialized(Reinitialization way, float slope, std::size_t steps)
  {
    constexpr double radius = 10.0;
    const auto ball = makeBall(radius, 16.0);
    pcl::PointCloud<pcl::PointXYZINormal> cloud;
    pcl::Indices all;
    for (const auto& point : *ball) {
      pcl::PointXYZINormal other;
      other.getVector3fMap() = point.getVector3fMap();
      other.intensity = point.intensity;
      other.curvature = point.intensity * (point.x > 0.0f ? 2.0f * slope : slope);
      all.push_back(static_cast<int>(cloud.size()));
      cloud.push_back(other);
    }
    pcl_uvol::LevelSetParameters parameters;
    parameters.mu = 0.0;
    parameters.initial = InitialFunction::field("curvature");
    parameters.reinitialization = way;
    parameters.max_steps = steps;
    parameters.isovalue = 0.0;
    const pcl_uvol::LevelSet found = pcl_uvol::detail::evolveLevelSet(
        pcl_uvol::viewOf(cloud), all, parameters, 0, nullptr, false, 0, report);
    summary = found.summary;
    for (const double distance : radiiOf(*ball, found.phi))
      deviations.push_back(std::abs(distance - radius));
  }
};

TEST(LevelSetEvolution, ReinitializationRestoresTheSlopeAndKeepsTheSurface)
{
  for (const Reinitialization way :
       {Reinitialization::Distance, Reinitialization::Eikonal}) {
    const Reinitialized run(way, 1.5f, 12);
    EXPECT_LT(run.summary.steps.front().slope_error, 0.1);
    EXPECT_LT(run.summary.steps.back().slope_error, 0.05);
    EXPECT_EQ(1u, run.report.getCount("reinitializations"));
    EXPECT_LT(computeMean(run.deviations), 0.1);
    if (way == Reinitialization::Distance) {
      EXPECT_LT(largestDeviation(run.deviations, 0.0), 0.1);
    }
  }
  EXPECT_EQ(0u,
            Reinitialized(Reinitialization::None, 1.5f, 12)
                .report.getCount("reinitializations"));
}

/** It flattens what is too steep, slowly. */
TEST(LevelSetEvolution, DiffusionTermPullsTheSlopeTowardsOne_long)
{
  const Reinitialized without(Reinitialization::None, 1.1f, 60);
  const Reinitialized run(Reinitialization::Diffusion, 1.1f, 60);
  EXPECT_LT(run.summary.steps.back().slope_error,
            0.95 * without.summary.steps.back().slope_error);
}

Cloud::Ptr
makeNoisyBall()
{
  auto cloud = makeBall(8.0, 13.0);
  uvol_test::Random random(7);
  for (auto& point : *cloud)
    point.intensity += static_cast<float>(random.uniform() - 0.5);
  return cloud;
}

TEST(LevelSetEvolution, SameBytesForAnyNumberOfThreads)
{
  const auto cloud = makeNoisyBall();
  for (const FitScheme scheme : {FitScheme::Quadratic, FitScheme::Linear}) {
    std::vector<float> one;
    for (const unsigned threads : {1u, 2u, 3u, 7u}) {
      Evolution evolution;
      evolution.setScheme(scheme);
      evolution.setMaximumSteps(15);
      evolution.setNumberOfThreads(threads);
      const auto phi = evolve(evolution, cloud);
      if (threads == 1u)
        one = phi;
      EXPECT_EQ(0, std::memcmp(one.data(), phi.data(), sizeof(float) * one.size()))
          << threads;
    }
  }
}

TEST(LevelSetEvolution, SameValuesInAnyOrderOfTheInput)
{
  const auto cloud = makeNoisyBall();
  std::vector<std::uint32_t> order(cloud->size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(5)); // NOLINT: the same always
  const Cloud::Ptr shuffled(new Cloud);
  for (const std::uint32_t i : order)
    shuffled->push_back((*cloud)[i]);
  Evolution evolution;
  evolution.setMaximumSteps(15);
  const auto expected = evolve(evolution, cloud);
  const auto phi = evolve(evolution, shuffled);
  for (std::size_t i = 0; i < order.size(); ++i)
    ASSERT_EQ(expected[order[i]], phi[i]);
}

/** Fields are seldom distances: densities fall exponentially, and most are flat but for
 * the surroundings of the surface. The surface must not move for that, band or no band.
 */
TEST(LevelSetEvolution, AnyProfileOfTheFieldKeepsTheSurface_long)
{
  const std::pair<const char*, std::function<float(float)>> profiles[] = {
      {"flat", [](float d) { return std::clamp(d, -3.0f, 3.0f); }},
      {"saturating", [](float d) { return 2.0f * std::tanh(0.5f * d); }},
      {"exponential", [](float d) { return 3.0f * (std::exp(d / 3.0f) - 1.0f); }}};
  for (const auto& [name, profile] : profiles) {
    auto cloud = makeBall(10.0, 16.0);
    uvol_test::Random random(7);
    for (auto& point : *cloud)
      point.intensity =
          profile(point.intensity) + static_cast<float>(random.uniform() - 0.5);
    double noise = 0.0;
    for (const double band : {5.0, 0.0}) {
      Evolution evolution;
      evolution.setBandWidth(band);
      const auto radii = radiiOf(*cloud, evolve(evolution, cloud));
      EXPECT_TRUE(evolution.getSummary().converged) << name << ' ' << band;
      EXPECT_NEAR(10.0, computeMean(radii), 0.05) << name << ' ' << band;
      EXPECT_LT(largestDeviation(radii, 10.0), 0.3) << name << ' ' << band;
      if (band > 0.0)
        noise = evolution.getSummary().noise;
      EXPECT_FLOAT_EQ(noise, evolution.getSummary().noise);
    }
  }
}

TEST(LevelSetEvolution, BandAndIntegrationDoNotChangeTheSurface)
{
  const auto cloud = makeNoisyBall();
  const auto deviation = [&](double band, Integration integration) {
    Evolution evolution;
    evolution.setMu(0.05);
    evolution.setBandWidth(band);
    evolution.setIntegration(integration);
    const auto phi = evolve(evolution, cloud);
    EXPECT_TRUE(evolution.getSummary().converged);
    return withValues(*cloud, phi);
  };
  const auto reference = deviation(5.0, Integration::Asynchronous);
  for (const auto& other : {deviation(0.0, Integration::Asynchronous),
                            deviation(5.0, Integration::Synchronous)}) {
    double squares = 0.0;
    std::size_t near = 0;
    for (std::size_t i = 0; i < reference->size(); ++i)
      if (std::abs((*reference)[i].intensity) < 1.0f) {
        squares += std::pow((*reference)[i].intensity - (*other)[i].intensity, 2);
        ++near;
      }
    EXPECT_GT(near, 1000u);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(near)), 0.02);
  }
}

/** Thesis 3.5.2: a few samples that lie close bound the steps of all, unless every
 * sample takes its own. */
TEST(LevelSetEvolution, AsynchronousStepsSpareThoseOfAFewSamples_long)
{
  const auto cloud = makeBall(6.0, 9.0);
  uvol_test::Random random(3);
  for (int i = 0; i < 300; ++i) {
    const double distance = 0.2 * std::pow(10.0, random.uniform());
    Vector x;
    for (int axis = 0; axis < 3; ++axis)
      x[axis] = 2.0 * random.uniform() - 1.0;
    x = 6.0 * Vector::UnitX() + distance * x.normalized();
    pcl::PointXYZI point;
    point.getVector3fMap() = x.cast<float>();
    point.intensity = static_cast<float>(6.0 - x.norm());
    cloud->push_back(point);
  }
  std::uint64_t updates[2];
  double radius[2];
  for (const Integration integration :
       {Integration::Synchronous, Integration::Asynchronous}) {
    Evolution evolution;
    evolution.setMu(0.5);
    evolution.setCurvatureFlow(CurvatureFlow::Mean);
    evolution.setIntegration(integration);
    evolution.setMaximumSteps(100000);
    const auto phi = evolve(evolution, cloud);
    EXPECT_TRUE(evolution.getSummary().converged);
    updates[static_cast<int>(integration)] = evolution.getReport().getCount("updates");
    radius[static_cast<int>(integration)] = computeMean(radiiOf(*cloud, phi));
  }
  constexpr auto synchronous = static_cast<int>(Integration::Synchronous),
                 asynchronous = static_cast<int>(Integration::Asynchronous);
  EXPECT_GT(updates[synchronous], 5 * updates[asynchronous]);
  EXPECT_NEAR(radius[synchronous], radius[asynchronous], 0.02);
}

/** Units of length and value do not matter, nor does the orientation. */
TEST(LevelSetEvolution, SameSurfaceInOtherUnits)
{
  const auto cloud = makeNoisyBall();
  Evolution evolution;
  const auto phi = evolve(evolution, cloud);
  const auto expectSame = [&](double length,
                              double value,
                              double offset,
                              const Eigen::Matrix3d& turn,
                              double tolerance) {
    const Cloud::Ptr other(new Cloud(*cloud));
    for (auto& point : *other) {
      point.getVector3fMap() =
          (length * (turn * point.getVector3fMap().cast<double>())).cast<float>();
      point.intensity = static_cast<float>(value * point.intensity + offset);
    }
    Evolution again;
    again.setInputCloud(other);
    again.setIsoValue(offset);
    std::vector<float> scaled;
    again.evolve(scaled);
    double squares = 0.0;
    std::size_t near = 0;
    for (std::size_t i = 0; i < phi.size(); ++i)
      if (std::abs(phi[i]) < 1.0f) {
        squares += std::pow(scaled[i] / length - phi[i], 2);
        ++near;
      }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(near)), tolerance)
        << length << ' ' << value;
  };
  const Eigen::Matrix3d none = Eigen::Matrix3d::Identity();
  expectSame(1e-6, 1.0, 0.0, none, 1e-3);
  expectSame(1e6, 1.0, 0.0, none, 1e-3);
  expectSame(1.0, 1000.0, 7.0, none, 1e-3);
  expectSame(1.0,
             1.0,
             0.0,
             Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()).toRotationMatrix(),
             0.01);
}

TEST(LevelSetEvolution, PointsWithoutAValueGetNone)
{
  const auto cloud = makeNoisyBall();
  (*cloud)[3].x = std::numeric_limits<float>::quiet_NaN();
  (*cloud)[5].intensity = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 100; i < 150; ++i)
    (*cloud)[i] = (*cloud)[99];
  Evolution evolution;
  const auto phi = evolve(evolution, cloud);
  EXPECT_TRUE(std::isnan(phi[3]) && std::isnan(phi[5]));
  EXPECT_EQ(phi[99], phi[149]);
  EXPECT_TRUE(std::isfinite(phi[99]));
}

/** Along lines of samples it counts what an extraction of linear isopoints does, and
 * evolves the same function. */
TEST(LevelSetEvolution, LooksAtHowSamplesLieWhereThatIsAskedFor)
{
  uvol_test::Random random(4);
  const auto lines = std::make_shared<Cloud>();
  for (int line = 0; line < 80; ++line) {
    const auto x = static_cast<float>(20.0 * random.uniform() - 10.0),
               y = static_cast<float>(20.0 * random.uniform() - 10.0);
    for (int i = 0; i < 100; ++i) {
      pcl::PointXYZI point;
      point.getVector3fMap() << x, y, 0.2f * static_cast<float>(i) - 10.0f;
      point.intensity = 6.0f - point.getVector3fMap().norm();
      lines->push_back(point);
    }
  }
  Evolution evolution;
  evolution.setMaximumSteps(3);
  const auto phi = evolve(evolution, lines);
  EXPECT_TRUE(evolution.getSampling());
  EXPECT_EQ(0u, evolution.getReport().getCount("examined"));
  evolution.setExamined(true);
  EXPECT_EQ(phi, evolve(evolution, lines));
  ASSERT_TRUE(evolution.getSampling());
  EXPECT_EQ(pcl_uvol::LocalDimension::Line, evolution.getSampling()->most);

  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(lines);
  extraction.setIsoValue(0.0);
  extraction.setInterpolation(pcl_uvol::Interpolation::Linear);
  pcl::PointCloud<pcl_uvol::PointIso> isopoints;
  extraction.extract(isopoints);
  EXPECT_LT(0u, extraction.getReport().getCount("examined_bridged"));
  for (const char* const name : {"examined", "examined_bridged", "examined_rim"})
    EXPECT_EQ(extraction.getReport().getCount(name),
              evolution.getReport().getCount(name))
        << name;

  evolve(evolution, makeBall(6.0, 10.0));
  EXPECT_EQ(pcl_uvol::LocalDimension::Volume, evolution.getSampling()->most);
  EXPECT_EQ(0u, evolution.getReport().getCount("examined"));
}

TEST(LevelSetEvolution, SaysWhenItHasNotConverged)
{
  Evolution evolution;
  evolution.setMaximumSteps(3);
  evolve(evolution, makeNoisyBall());
  EXPECT_FALSE(evolution.getSummary().converged);
  EXPECT_EQ(3u, evolution.getSummary().steps.size());
  ASSERT_EQ(1u, evolution.getReport().warnings.size());
  const pcl_uvol::Message& told = evolution.getReport().warnings[0];
  EXPECT_EQ("not_converged", told.code);
  EXPECT_EQ(3.0, uvol_test::numberOf(told, "steps"));
  EXPECT_EQ(0.0, uvol_test::numberOf(told, "is_last_stage"));
  EXPECT_NEAR(0.7, uvol_test::numberOf(told, "mu"), 0.005);
  EXPECT_GT(uvol_test::numberOf(told, "chosen_mu"), 0.0);
  EXPECT_LT(uvol_test::numberOf(told, "chosen_mu"), 1.0);
}

TEST(LevelSetEvolution, PlanarCloudsAreEvolvedInTheirPlane)
{
  const auto cloud = makeNoisyBall();
  for (auto& point : *cloud)
    point.z = 1.0f;
  Evolution evolution;
  evolution.setMaximumSteps(20);
  for (const float value : evolve(evolution, cloud))
    EXPECT_TRUE(std::isfinite(value));
  EXPECT_GT(evolution.getReport().getCount("isotropic_fits"), 0u);
}

TEST(LevelSetEvolution, RejectsBadInput)
{
  const auto cloud = makeNoisyBall();
  std::vector<float> phi = {1.0f};
  const auto expectRejected = [&](const auto& spoil) {
    Evolution evolution;
    evolution.setInputCloud(cloud);
    evolution.setIsoValue(0.0);
    spoil(evolution);
    EXPECT_THROW(evolution.evolve(phi), InvalidArgument);
  };
  expectRejected([](auto& e) { e.setInputCloud(Cloud::Ptr()); });
  expectRejected([](auto& e) { e.setInputCloud(Cloud::Ptr(new Cloud)); });
  expectRejected([](auto& e) { e.setScalarField("density"); });
  expectRejected([](auto& e) { e.setIsoValue(1000.0); });
  expectRejected([](auto& e) { e.setIsoValue(std::nan("")); });
  expectRejected([](auto& e) { e.setMu(-0.1); });
  expectRejected([](auto& e) { e.setMu(1.1); });
  expectRejected([](auto& e) { e.setMu(std::nan("")); });
  expectRejected([](auto& e) { e.setKSearch(8); });
  expectRejected([&](auto& e) { e.setKSearch(cloud->size()); });
  expectRejected([](auto& e) { e.setMaximumSteps(0); });
  expectRejected([](auto& e) { e.setTolerance(0.0); });
  expectRejected([](auto& e) { e.setBandWidth(1.0); });
  expectRejected([](auto& e) { e.setScale(Eigen::Array3f(1.0f, 0.0f, 1.0f)); });
  expectRejected([](auto& e) { e.setInitialFunction(InitialFunction::field("phi")); });
  expectRejected([](auto& e) {
    e.setInitialFunction(InitialFunction::sphere(Vector(500.0, 0.0, 0.0), 1.0));
  });
  EXPECT_THROW(InitialFunction::sphere(Vector::Zero(), 0.0), InvalidArgument);
  EXPECT_THROW(InitialFunction::box(Vector::Ones(), Vector::Zero()), InvalidArgument);
  EXPECT_THROW(InitialFunction::plane(Vector::Ones(), Vector::Zero()), InvalidArgument);
  const Cloud::Ptr constant(new Cloud(*cloud));
  for (auto& point : *constant)
    point.intensity = 3.0f;
  expectRejected([&](auto& e) {
    e.setInputCloud(constant);
    e.setIsoValue(3.0);
  });
  EXPECT_EQ(std::vector<float>{1.0f}, phi);
}

TEST(LevelSetEvolution, CloudOfPhi)
{
  Cloud points;
  for (const float x : {1.0f, 2.0f})
    points.emplace_back(x, 5.0f, -x, 0.0f);
  const auto cloud = pcl_uvol::makePhiCloud(pcl_uvol::viewOf(points), {0.25f, -4.0f});
  const auto view = pcl_uvol::viewOf(cloud);
  ASSERT_EQ(2u, view.count);
  EXPECT_EQ(-2.0f, view.xyz(1)[2]);
  EXPECT_EQ(-4.0f, view.xyz(1)[3]); // phi follows
  EXPECT_EQ("phi", view.fields.back().name);
  EXPECT_THROW(pcl_uvol::makePhiCloud(view, {1.0f}), InvalidArgument);
}

} // namespace test_level_set_evolution
