// SPDX-License-Identifier: BSD-3-Clause
// How far isopoints on edges lie from the surface, by those around.
#include "src/pipeline/edge_errors.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numeric>

namespace test_edge_errors {

using namespace pcl_uvol;
using Eigen::Vector3d;

/** Isopoints over 8 x 5 places of a plane, in the middle of edges along z. */
class Roots {
public:
  /** \param height of the isopoint over a place */
  explicit Roots(const std::function<double(double, double)>& height,
                 int columns = 8,
                 int rows = 5)
  {
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const double x = column, y = 1.3 * row;
        add(Vector3d(x, y, height(x, y)), Vector3d(0.0, 0.0, 1.0));
      }
  }

  void
  add(const Vector3d& place, const Vector3d& half_edge)
  {
    PointIso point;
    point.getVector3fMap() = place.cast<float>();
    isopoints.push_back(point);
    const auto first = static_cast<std::uint32_t>(samples.size());
    for (const double side : {-1.0, 1.0}) {
      pcl::PointXYZI sample;
      sample.getVector3fMap() = (place + side * half_edge).cast<float>();
      // Values of neighbouring edges differ as those of a smooth field do.
      sample.intensity = static_cast<float>(side * (1.0 + isopoints.size() % 3));
      samples.push_back(sample);
    }
    edges.push_back({first, first + 1, 0.5f});
  }

  float
  findError(std::size_t isopoint,
            const Eigen::Array3f& scale = {1.0f, 1.0f, 1.0f}) const
  {
    IsosurfaceParameters parameters;
    parameters.field = "intensity";
    parameters.scale = scale;
    pcl::PCLPointCloud2 cloud;
    pcl::toPCLPointCloud2(samples, cloud);
    const CloudView view = viewOf(cloud);
    const StretchedEdges stretched(view, edges, parameters);
    std::vector<std::uint32_t> all(isopoints.size());
    std::iota(all.begin(), all.end(), 0u);
    Report report;
    const CloudView places = viewOf(isopoints);
    const auto set = SampleSet::build(
        places.xyz(0), places.stride(), all, toPosition(scale), 1, report);
    return EdgeErrorFinder(*set, isopoints, stretched).find(isopoint);
  }

  pcl::PointCloud<PointIso> isopoints;
  pcl::PointCloud<pcl::PointXYZI> samples;
  IsoEdges edges;
};

double
bend(double x, double y)
{
  return 0.02 * x * x - 0.03 * x * y + 0.01 * y * y + 0.1 * y;
}

/** Places are those of the formula, which nothing deviates from. */
TEST(EdgeErrors, AreRoundingOnAPlaneAndSmallOnAParaboloid)
{
  const Roots plane([](double x, double y) { return 0.25 * x - 0.5 * y; });
  EXPECT_LT(plane.findError(17), 1e-5f);
  EXPECT_GT(plane.findError(17), 1e-8f);
  // Over its own plane the paraboloid is nearly one.
  EXPECT_LT(Roots(bend).findError(17), 0.05f);
}

/** Residuals that no paraboloid follows, as they alternate along x, y and both. */
TEST(EdgeErrors, AreFiveTimesTheResiduals)
{
  constexpr double d = 1e-3;
  const auto alternate = [](double x, double y) {
    const auto sign = [](double of) { return std::lround(of) % 2 == 0 ? 1.0 : -1.0; };
    return d * sign(x) * sign(y / 1.3);
  };
  // 40 equations for 6 numbers, with an own residual that is no larger.
  EXPECT_NEAR(5.0 * d * std::sqrt(40.0 / 34.0), Roots(alternate).findError(17), 3e-4);
  EXPECT_NEAR(Roots(alternate).findError(17),
              Roots([&](double x, double y) {
                return alternate(x, y) + 0.01 * (x * x + y * y);
              }).findError(17),
              1e-3);
}

TEST(EdgeErrors, ThatStandOutAreLarger)
{
  Roots roots([](double, double) { return 0.0; });
  roots.isopoints[20].z = 0.1f;
  EXPECT_GT(roots.findError(20), 5.0f * 0.08f);
  EXPECT_LT(roots.findError(20), 5.0f * 0.1f);
  EXPECT_LT(roots.findError(39), 5.0f * 0.03f);
}

TEST(EdgeErrors, AreOfTheUnstretchedSpace)
{
  const auto wave = [](double x, double y) { return 1e-3 * std::sin(9.0 * x * y); };
  const Roots roots(wave);
  const float error = roots.findError(17);
  EXPECT_NEAR(error, roots.findError(17, {1.0f, 1.0f, 10.0f}), 1e-3f * error);
  EXPECT_NEAR(error, roots.findError(17, {1e9f, 1e9f, 1e9f}), 1e-3f * error);
}

TEST(EdgeErrors, AreNotReportedWhereTheyDoNotShow)
{
  const auto flat = [](double, double) { return 0.0; };
  EXPECT_TRUE(std::isinf(Roots(flat, 6, 3).findError(7)));  // too few
  EXPECT_TRUE(std::isinf(Roots(flat, 40, 1).findError(7))); // on a line
  Roots jump(flat);
  for (pcl::PointXYZI& sample : jump.samples)
    sample.intensity = sample.intensity > 0.0f ? 1.0f : 0.0f;
  EXPECT_TRUE(std::isinf(jump.findError(17)));
  Roots along(flat);
  for (std::size_t i = 0; i < along.samples.size(); ++i) {
    along.samples[i].z = 0.0f;
    along.samples[i].x += i % 2 == 0 ? -0.5f : 0.5f;
  }
  EXPECT_TRUE(std::isinf(along.findError(17)));
}

} // namespace test_edge_errors
