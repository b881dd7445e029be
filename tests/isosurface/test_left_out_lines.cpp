// SPDX-License-Identifier: BSD-3-Clause
// Lines of samples that are left out, against fits to clouds that never had them.
#include "src/isosurface/left_out_lines.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace test_left_out_lines {

using namespace pcl_uvol;
using Eigen::Vector3d;

const KernelTable<FitKernel> kernels{
    baseline::fitZeroLevel, avx2::fitZeroLevel, avx512::fitZeroLevel};

/** Between neighbouring samples of a line and between lines, in radii. */
constexpr double spacing = 0.4;

/** Samples of parallel lines through an uneven lattice, nearest line first. */
std::vector<std::vector<Vector3d>>
makeLines(const Vector3d& along)
{
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> shift(-0.08, 0.08);
  const Vector3d first = along.unitOrthogonal(), second = along.cross(first);
  std::vector<Vector3d> feet;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      feet.push_back(first * (spacing * (i + 0.3) + shift(engine)) +
                     second * (spacing * (j + 0.2) + shift(engine)));
  std::sort(feet.begin(), feet.end(), [](const Vector3d& a, const Vector3d& b) {
    return a.norm() < b.norm();
  });
  std::vector<std::vector<Vector3d>> lines;
  for (const Vector3d& foot : feet) {
    std::vector<Vector3d> line;
    for (int k = -3; k <= 3; ++k) {
      const Vector3d x = foot + spacing * (k + shift(engine)) * along;
      if (x.norm() < 1.0)
        line.push_back(x);
    }
    if (!line.empty())
      lines.push_back(line);
  }
  return lines;
}

using Field = double (*)(const Vector3d&);

/** Goes through the centre, and no cubic follows it. */
double
wave(const Vector3d& x)
{
  return std::sin(2.0 * x[0] + 1.0 * x[1]) + 0.5 * std::sin(3.0 * x[2] + x[1]);
}

double
cubic(const Vector3d& x)
{
  return 0.1 + x[0] + 0.4 * x[1] * x[1] - x[0] * x[1] * x[2] + 0.2 * std::pow(x[2], 3);
}

/** The samples of all lines but one in a lane, in no order. */
std::vector<FitSample>
makeSamples(const std::vector<std::vector<Vector3d>>& lines,
            std::size_t left_out,
            Field field,
            std::size_t lane,
            int& weighted)
{
  std::vector<Vector3d> all;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (i != left_out)
      all.insert(all.end(), lines[i].begin(), lines[i].end());
  std::shuffle(all.begin(), all.end(), std::mt19937(5));
  weighted = static_cast<int>(all.size());
  std::vector<FitSample> samples((all.size() + 2) / 2 * 2);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vector3d x = i < all.size() ? all[i] : Vector3d(2.0, 0.0, 0.0);
    for (std::size_t other = 0; other < fit_lanes; ++other) {
      samples[i].x[other] = 2.0f;
      samples[i].y[other] = samples[i].z[other] = samples[i].value[other] = 0.0f;
    }
    samples[i].x[lane] = static_cast<float>(x[0]);
    samples[i].y[lane] = static_cast<float>(x[1]);
    samples[i].z[lane] = static_cast<float>(x[2]);
    samples[i].value[lane] = static_cast<float>(field(x));
  }
  return samples;
}

FitResult
fit(const std::vector<FitSample>& samples, std::size_t lane, int weighted)
{
  int counts[fit_lanes] = {};
  counts[lane] = weighted;
  FitResult result;
  kernels.get()(samples.data(), samples.size(), counts, result);
  return result;
}

Vector3d
rootOf(const FitResult& result, std::size_t lane)
{
  return {result.offset[0][lane], result.offset[1][lane], result.offset[2][lane]};
}

Vector3d
normalOf(const FitResult& result, std::size_t lane)
{
  return Vector3d(result.gradient[0][lane],
                  result.gradient[1][lane],
                  result.gradient[2][lane])
      .normalized();
}

constexpr std::size_t none = ~std::size_t(0);

TEST(LeftOutLines, AreThoseOfCloudsThatNeverHadThem)
{
  const Vector3d along = Vector3d(1.0, -2.0, 0.5).normalized();
  const auto lines = makeLines(along);
  ASSERT_LT(fit_lanes, lines.size());
  for (const std::size_t lane : {std::size_t(0), std::size_t(5)}) {
    int weighted = 0;
    const auto samples = makeSamples(lines, none, wave, lane, weighted);
    const FitResult result = fit(samples, lane, weighted);
    double squares = 0.0;
    for (std::size_t line = 0; line < fit_lanes; ++line) {
      const auto rest = makeSamples(lines, line, wave, 0, weighted);
      const FitResult moved = fit(rest, 0, weighted);
      ASSERT_NE(fit_failed, moved.order[0]);
      squares += std::pow(
          (rootOf(moved, 0) - rootOf(result, lane)).dot(normalOf(result, lane)), 2);
    }
    ASSERT_LT(1e-3, std::sqrt(squares));
    EXPECT_NEAR(1.0 / 7.0 * std::sqrt(squares),
                LeftOutLines(kernels.get())
                    .measureError(samples, lane, {along, spacing}, result),
                1e-7);
  }
}

TEST(LeftOutLines, AddNothingWhereAFitIsRight)
{
  const Vector3d along = Vector3d::UnitZ();
  int weighted = 0;
  const auto samples = makeSamples(makeLines(along), none, cubic, 0, weighted);
  const FitResult result = fit(samples, 0, weighted);
  EXPECT_GT(
      1e-5,
      LeftOutLines(kernels.get()).measureError(samples, 0, {along, spacing}, result));
}

/** Three lines determine no fit: without one of them there is none either. */
TEST(LeftOutLines, WithoutWhichNoFitIsLeftMayBeAnywhere)
{
  auto lines = makeLines(Vector3d::UnitX());
  lines.resize(3);
  int weighted = 0;
  const auto samples = makeSamples(lines, none, wave, 0, weighted);
  FitResult result{};
  result.gradient[1][0] = 1.0;
  EXPECT_DOUBLE_EQ(1.0 / 7.0 * std::sqrt(3.0),
                   LeftOutLines(kernels.get())
                       .measureError(samples, 0, {Vector3d::UnitX(), spacing}, result));
}

TEST(SampleLines, AreThereWhereTwoSpacingsAreTwiceTheThird)
{
  const Vector3d axis = Vector3d(2.0, 1.0, -1.0).normalized();
  const auto spacingsOf = [&](double along, double across, double third) {
    const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
    return Eigen::Matrix3d(along * along * axis * axis.transpose() +
                           across * across * u * u.transpose() +
                           third * third * v * v.transpose());
  };
  const SampleLines lines = findLines(spacingsOf(0.1, 0.21, 0.3));
  EXPECT_NEAR(0.1, lines.spacing, 1e-12);
  EXPECT_NEAR(1.0, std::abs(lines.along.dot(axis)), 1e-12);
  EXPECT_EQ(0.0, findLines(spacingsOf(0.1, 0.19, 5.0)).spacing);  // layers
  EXPECT_EQ(0.0, findLines(spacingsOf(0.1, 0.19, 0.15)).spacing); // all around
}

} // namespace test_left_out_lines
