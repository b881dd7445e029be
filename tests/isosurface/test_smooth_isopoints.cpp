// SPDX-License-Identifier: BSD-3-Clause
// Isopoints on local fits: how near they are to the true surface, whether they know it,
// and that they stay where they belong.
#include "common/random.h"
#include "generation/analytic_fields.h"
#include "support/clouds.h"
#include "support/smooth_fields.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace test_smooth_isopoints {

using pcl_uvol::Interpolation;
using pcl_uvol::IsoSupport;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Surface = pcl::PointCloud<pcl_uvol::PointIso>;
using Extraction = pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI>;
using uvol_test::deviations;
using uvol_test::makeSmoothField;
using uvol_test::mean;
using uvol_test::quantile;
using uvol_test::sampleSmoothField;
using uvol_test::SmoothField;
using Vector = Eigen::Vector3d;

Surface
extract(const Cloud::Ptr& cloud,
        double isovalue,
        Interpolation interpolation = Interpolation::Fit)
{
  Extraction extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(isovalue);
  extraction.setInterpolation(interpolation);
  Surface surface;
  extraction.extract(surface);
  return surface;
}

TEST(SmoothIsopoints, RadialTestWithFourMillionSamples)
{
  const SmoothField field = makeSmoothField("radial", 4000000);
  const Surface surface =
      extract(sampleSmoothField(field, 4000000, 1, false), field.isovalue);
  const auto found = deviations(field, surface);
  EXPECT_LE(mean(found), 2e-6);
  EXPECT_LE(quantile(found, 0.999), 1.5e-5);
  EXPECT_LE(quantile(found, 1.0), 4e-5);
  double degrees = 0.0, curvature = 0.0;
  for (const pcl_uvol::PointIso& point : surface) {
    const Vector x(point.x, point.y, point.z);
    const Vector normal = point.getNormalVector3fMap().cast<double>();
    // values are lower inside: the enclosed side is the outer one, which is hollow
    degrees += std::asin(x.normalized().cross(normal).norm()) * 180 / M_PI;
    curvature += std::abs(point.mean_curvature * field.isovalue + 1.0);
    ASSERT_LT(x.dot(normal), 0.0);
  }
  EXPECT_LE(degrees / static_cast<double>(surface.size()), 0.001);
  EXPECT_LE(curvature / static_cast<double>(surface.size()), 0.001);
}

TEST(SmoothIsopoints, ClusteredSamples)
{
  const SmoothField field = makeSmoothField("radial", 500000);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Surface surface =
        extract(sampleSmoothField(field, 500000, seed, true), field.isovalue);
    const auto found = deviations(field, surface);
    EXPECT_LE(mean(found), 1.2e-5);
    EXPECT_LE(quantile(found, 0.999), 1.5e-4);
    EXPECT_LE(quantile(found, 1.0), 5e-4);
    double degrees = 0.0;
    for (const pcl_uvol::PointIso& point : surface)
      degrees += std::asin(Vector(point.x, point.y, point.z)
                               .normalized()
                               .cross(point.getNormalVector3fMap().cast<double>())
                               .norm()) *
                 180 / M_PI;
    EXPECT_LE(degrees / static_cast<double>(surface.size()), 0.005);
  }
}

TEST(SmoothIsopoints, WavesOfTwentySpacings)
{
  const SmoothField field = makeSmoothField("waves", 500000);
  const auto cloud = sampleSmoothField(field, 500000, 1, false);
  const double smooth = mean(deviations(field, extract(cloud, field.isovalue)));
  const double linear =
      mean(deviations(field, extract(cloud, field.isovalue, Interpolation::Linear)));
  EXPECT_GE(linear / smooth, 15.0);
}

/** In lengths of the spacing, of a surface that stays the same. */
TEST(SmoothIsopoints, DeviationFallsWithTheFourthPowerOfTheSpacing_long)
{
  const auto relative = [](std::size_t n, Interpolation interpolation) {
    const SmoothField field = makeSmoothField("gyroid", n);
    return mean(deviations(field,
                           extract(sampleSmoothField(field, n, 3, false),
                                   field.isovalue,
                                   interpolation))) /
           field.side;
  };
  const auto order = [&](Interpolation interpolation) {
    return std::log2(relative(60000, interpolation) / relative(480000, interpolation));
  };
  EXPECT_NEAR(2.0, order(Interpolation::Linear), 0.2);
  EXPECT_GE(order(Interpolation::Fit), 3.7);
}

TEST(SmoothIsopoints, CurvatureOfAGyroid)
{
  const SmoothField field = makeSmoothField("gyroid", 500000);
  const Surface surface =
      extract(sampleSmoothField(field, 500000, 1, false), field.isovalue);
  std::vector<double> truth;
  for (const pcl_uvol::PointIso& point : surface) // outside is where values are lower
    truth.push_back(
        -uvol_test::meanCurvatureOf(field, Vector(point.x, point.y, point.z)));
  double highest = 0.0;
  for (const double curvature : truth)
    highest = std::max(highest, std::abs(curvature));
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.size(); ++i)
    // the border of the cube has neighbours on one side only
    if (std::abs(truth[i]) > 0.1 * highest &&
        surface[i].support == static_cast<std::uint8_t>(IsoSupport::Measured))
      errors.push_back(std::abs(surface[i].mean_curvature / truth[i] - 1.0));
  EXPECT_GT(errors.size(), 10000u);
  EXPECT_LE(mean(errors), 0.02);
}

/** True and estimated deviations of many surfaces. */
struct Trust {
  std::vector<double> truth, estimate;

  Trust() = default;

  Trust(const SmoothField& field, const Surface& surface)
  {
    truth = deviations(field, surface);
    for (const pcl_uvol::PointIso& point : surface)
      estimate.push_back(point.error);
  }

  void
  add(const Trust& other)
  {
    truth.insert(truth.end(), other.truth.begin(), other.truth.end());
    estimate.insert(estimate.end(), other.estimate.begin(), other.estimate.end());
  }

  double
  covered(std::size_t begin,
          std::size_t end,
          const std::vector<std::size_t>& order) const
  {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i)
      count += truth[order[i]] <= estimate[order[i]];
    return static_cast<double>(count) / static_cast<double>(end - begin);
  }

  static std::vector<std::size_t>
  orderOf(const std::vector<double>& values)
  {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](auto a, auto b) {
      return values[a] < values[b];
    });
    return order;
  }

  /** Spearman's. */
  double
  rankCorrelation() const
  {
    std::vector<double> ranks[2] = {std::vector<double>(truth.size()),
                                    std::vector<double>(truth.size())};
    const std::vector<std::size_t> orders[2] = {orderOf(truth), orderOf(estimate)};
    for (std::size_t i = 0; i < truth.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k)
        ranks[k][orders[k][i]] = static_cast<double>(i);
    const double middle = 0.5 * static_cast<double>(truth.size() - 1);
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      product += (ranks[0][i] - middle) * (ranks[1][i] - middle);
      square += (ranks[0][i] - middle) * (ranks[0][i] - middle);
    }
    return product / square;
  }
};

TEST(SmoothIsopoints, ErrorsAreAsLargeAsTheySay_long)
{
  Trust all;
  for (const char* name : {"radial", "waves", "decay", "gyroid", "torus"})
    for (const std::size_t n : {30000, 100000, 300000})
      for (const bool clustered : {false, true}) {
        const SmoothField field = makeSmoothField(name, n);
        const Trust one(
            field, extract(sampleSmoothField(field, n, 1, clustered), field.isovalue));
        const auto order = Trust::orderOf(one.estimate);
        EXPECT_GE(one.covered(0, order.size(), order), 0.85) << name << ' ' << n;
        all.add(one);
      }
  const auto order = Trust::orderOf(all.estimate);
  EXPECT_GE(all.covered(0, order.size(), order), 0.95);
  for (std::size_t decile = 0; decile < 10; ++decile)
    EXPECT_GE(all.covered(
                  decile * order.size() / 10, (decile + 1) * order.size() / 10, order),
              0.85)
        << decile;
  EXPECT_LE(quantile(all.estimate, 0.5), 6.0 * quantile(all.truth, 0.5));
  EXPECT_GE(all.rankCorrelation(), 0.5);
}

/** Residuals of fits to lines tell next to nothing of what is between: alone they
 * covered 32 to 75 %. */
TEST(SmoothIsopoints, ErrorsCoverWhatIsBetweenLines)
{
  const SmoothField field = makeSmoothField("gyroid", 20000);
  for (const auto lines : {pcl_uvol::Scatter::Tracks,
                           pcl_uvol::Scatter::Casts,
                           pcl_uvol::Scatter::Holes}) {
    const Surface surface =
        extract(uvol_test::sampleOnLines(field, lines, 20000, 1), field.isovalue);
    const auto deviation = deviations(field, surface);
    std::size_t fits = 0, covered = 0;
    for (std::size_t i = 0; i < surface.size(); ++i)
      if (!std::isnan(surface[i].mean_curvature)) {
        ++fits;
        covered += deviation[i] <= surface[i].error;
      }
    EXPECT_LT(1000u, fits);
    EXPECT_LT(0.9 * static_cast<double>(fits), static_cast<double>(covered))
        << "lines " << static_cast<int>(lines);
  }
}

TEST(SmoothIsopoints, ErrorsCoverNoise)
{
  for (const char* name : {"radial", "waves", "decay", "gyroid", "torus"}) {
    const SmoothField field = makeSmoothField(name, 100000);
    const Trust trust(
        field,
        extract(sampleSmoothField(field, 100000, 2, false, 0.01), field.isovalue));
    const auto order = Trust::orderOf(trust.estimate);
    EXPECT_GE(trust.covered(0, order.size(), order), 0.9) << name;
    EXPECT_LE(quantile(trust.estimate, 0.5), 6.0 * quantile(trust.truth, 0.5)) << name;
  }
}

TEST(SmoothIsopoints, HolesInTheSamplingAreFlagged)
{
  const SmoothField field = makeSmoothField("radial", 300000);
  for (const bool clustered : {false, true}) {
    const auto whole = sampleSmoothField(field, 300000, 4, clustered);
    constexpr double hole_radius = 4.0;
    std::vector<Vector> holes;
    for (std::uint64_t i = 0; i < 12; ++i) {
      const double z = 2 * pcl_uvol::uniformAt(9, i, 0) - 1;
      const double angle = 2 * M_PI * pcl_uvol::uniformAt(9, i, 1);
      const double flat = std::sqrt(1 - z * z);
      holes.push_back(field.isovalue *
                      Vector(flat * std::cos(angle), flat * std::sin(angle), z));
    }
    const auto depth = [&](const Vector& x) {
      double deepest = -field.side;
      for (const Vector& hole : holes)
        deepest = std::max(deepest, hole_radius - (x - hole).norm());
      return deepest;
    };
    Cloud::Ptr punched(new Cloud);
    for (const auto& point : *whole)
      if (depth(point.getVector3fMap().cast<double>()) < 0)
        punched->push_back(point);
    std::size_t inside = 0, unflagged = 0, elsewhere = 0, flagged = 0;
    for (const pcl_uvol::PointIso& point : extract(punched, field.isovalue)) {
      const double d = depth(Vector(point.x, point.y, point.z));
      const bool is_flagged =
          point.support != static_cast<std::uint8_t>(IsoSupport::Measured);
      inside += d > 0;
      unflagged += d > 0 && !is_flagged;
      // beside a hole an isopoint lies at a rim indeed
      elsewhere += d < -2;
      flagged += d < -2 && is_flagged;
    }
    EXPECT_GT(inside, 100u);
    EXPECT_EQ(0u, unflagged);
    EXPECT_LT(static_cast<double>(flagged), 0.01 * static_cast<double>(elsewhere));
  }
}

/** Labels, a jump, clipped integers: the linear root stays, or one within the box of
 * the edge widened by half its length. */
TEST(SmoothIsopoints, NoOvershootAtSteps)
{
  const SmoothField field = makeSmoothField("radial", 100000);
  const auto smooth = sampleSmoothField(field, 100000, 5, false);
  const std::function<float(float)> steps[] = {
      [](float f) { return f < 14.0f ? 0.0f : 1.0f; },
      [](float f) { return f < 14.0f ? 0.1f * f : 100.0f + f; },
      [](float f) { return std::clamp(std::floor(f), 12.0f, 15.0f); }};
  const double isovalues[] = {0.5, 50.0, 13.5};
  for (std::size_t i = 0; i < 3; ++i) {
    Cloud::Ptr cloud(new Cloud(*smooth));
    for (auto& point : *cloud)
      point.intensity = steps[i](point.intensity);
    Extraction extraction;
    extraction.setInputCloud(cloud);
    extraction.setIsoValue(isovalues[i]);
    Surface surface;
    extraction.extract(surface);
    EXPECT_GT(surface.size(), 1000u);
    for (std::size_t k = 0; k < surface.size(); ++k) {
      const auto& edge = extraction.getEdges()[k];
      const Eigen::Array3f a = (*cloud)[edge.first].getArray3fMap();
      const Eigen::Array3f b = (*cloud)[edge.second].getArray3fMap();
      const Eigen::Array3f x = surface[k].getArray3fMap();
      const float room = 0.5f * surface[k].edge_length;
      EXPECT_TRUE((x >= a.min(b) - room).all() && (x <= a.max(b) + room).all());
      EXPECT_GT(surface[k].error, 0.0f);
    }
    if (i < 2) {
      EXPECT_GE(extraction.getReport().getCount("linear_step"),
                surface.size() * 95 / 100);
    }
  }
}

TEST(SmoothIsopoints, FewSamplesAndLinesStayLinear)
{
  for (const bool is_line : {false, true}) {
    Cloud::Ptr cloud = uvol_test::makeCloud("uniform", is_line ? 500 : 14, 1);
    for (auto& point : *cloud) {
      if (is_line)
        point.y = point.z = 0.5f;
      point.intensity = point.x;
    }
    Extraction extraction;
    extraction.setInputCloud(cloud);
    extraction.setIsoValue(0.5);
    Surface surface;
    extraction.extract(surface);
    EXPECT_GT(surface.size(), 0u);
    EXPECT_EQ(surface.size(), extraction.getReport().getCount("linear_singular"));
    for (const pcl_uvol::PointIso& point : surface) {
      EXPECT_NEAR(0.5f, point.x, 1e-6f);
      EXPECT_TRUE(std::isnan(point.mean_curvature));
      EXPECT_GT(point.error, 0.0f);
      EXPECT_LE(point.error, point.edge_length);
    }
  }
}

TEST(SmoothIsopoints, ALatticeIsFittedToo)
{
  const SmoothField field = makeSmoothField("radial", 64000);
  Cloud::Ptr cloud(new Cloud);
  for (std::uint64_t i = 0; i < 64000; ++i) {
    const auto x =
        pcl_uvol::scatterAt(pcl_uvol::Scatter::Lattice, 1, i, 64000, -20, 20);
    pcl::PointXYZI point;
    point.getVector3fMap() = Eigen::Vector3d(x.data()).cast<float>();
    point.intensity = static_cast<float>(field.value(Eigen::Vector3d(x.data())));
    cloud->push_back(point);
  }
  const double smooth = mean(deviations(field, extract(cloud, field.isovalue)));
  const double linear =
      mean(deviations(field, extract(cloud, field.isovalue, Interpolation::Linear)));
  EXPECT_LE(smooth, 0.05 * linear);
}

} // namespace test_smooth_isopoints
