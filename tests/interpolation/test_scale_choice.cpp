// SPDX-License-Identifier: BSD-3-Clause
// Scales found from fields of known anisotropy, and 1 where there is none to be found.
#include "common/stretch_axes.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/interpolation/cross_validation.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace test_scale_choice {

using Eigen::Array3d;
using Eigen::Array3f;
using Eigen::Vector3d;
using pcl_uvol::ScaleChoice;

using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Field = std::function<double(const Vector3d&)>;

constexpr std::size_t many = 6000;

/** Waves in 30 random directions, of 2 to 12 per unit of length. */
class Waves {
public:
  explicit Waves(std::uint64_t seed)
  {
    uvol_test::Random random(seed);
    for (int i = 0; i < 30; ++i) {
      Vector3d direction;
      do
        direction = Vector3d::NullaryExpr([&] { return 2.0 * random.uniform() - 1.0; });
      while (!(direction.norm() <= 1.0));
      waves_.push_back((2.0 + 10.0 * random.uniform()) * direction.normalized());
      phases_.push_back(6.28 * random.uniform());
    }
  }

  double
  operator()(const Vector3d& x) const
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < waves_.size(); ++i)
      sum += std::cos(waves_[i].dot(x) + phases_[i]) / waves_[i].norm();
    return sum;
  }

private:
  std::vector<Vector3d> waves_;
  std::vector<double> phases_;
};

pcl::PointXYZI
sampleAt(const Vector3d& place, const Field& field)
{
  pcl::PointXYZI point;
  point.getVector3fMap() = place.cast<float>();
  point.intensity = static_cast<float>(field(point.getVector3fMap().cast<double>()));
  return point;
}

/** Uniform samples of a cube of side 2 about the origin. */
Cloud
sample(const Field& field, std::size_t count = many, std::uint64_t seed = 1)
{
  uvol_test::Random random(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i)
    cloud.push_back(sampleAt(
        Vector3d::NullaryExpr([&] { return 2.0 * random.uniform() - 1.0; }), field));
  return cloud;
}

/** Vertical lines of 60 samples each at random places of a region a hundred times as
 * wide as it is deep. */
Cloud
sampleProfiles(const Field& field, std::size_t profiles)
{
  uvol_test::Random random(3);
  Cloud cloud;
  for (std::size_t i = 0; i < profiles; ++i) {
    const double x = 100.0 * random.uniform(), y = 100.0 * random.uniform();
    for (int j = 0; j < 60; ++j)
      cloud.push_back(sampleAt({x, y, -(j + 0.3 * random.uniform()) / 60.0}, field));
  }
  return cloud;
}

ScaleChoice
choose(const Cloud& cloud,
       const Array3d& rotation = Array3d::Zero(),
       unsigned threads = 0)
{
  pcl::Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  pcl_uvol::Report report;
  return pcl_uvol::chooseScale(
      pcl_uvol::viewOf(cloud), all, "intensity", rotation, threads, report);
}

void
expectSame(const ScaleChoice& a, const ScaleChoice& b)
{
  EXPECT_TRUE((a.scale == b.scale).all()) << a.scale << " and " << b.scale;
  EXPECT_EQ(a.explained, b.explained);
  EXPECT_EQ(a.error_ratio, b.error_ratio);
  EXPECT_EQ(a.tested, b.tested);
}

TEST(ChooseScale, FindsFactorsOfWavesThatAreFlat)
{
  for (const double factor : {4.0, 10.0}) {
    const Waves waves(7);
    const ScaleChoice choice = choose(sample([&](const Vector3d& x) {
      return waves({x[0], x[1], factor * x[2]});
    }));
    EXPECT_GT(choice.scale[2], 0.5 * factor);
    EXPECT_LT(choice.scale[2], 2.0 * factor);
    EXPECT_LT(choice.scale[0], 2.0f);
    EXPECT_LT(choice.scale[1], 2.0f);
    EXPECT_EQ(1.0f, choice.scale.minCoeff());
    EXPECT_LT(choice.error_ratio, 0.9);
    EXPECT_GT(choice.explained, choice.explained_before);
    EXPECT_EQ(375u, choice.tested);
  }
}

TEST(ChooseScale, FindsFactorsBetweenLines)
{
  // A floor that rises by a tenth of the depth over a distance of 25 depths.
  const ScaleChoice choice = choose(sampleProfiles(
      [](const Vector3d& x) {
        return std::tanh(
            8.0 * (x[2] + 0.5 + 0.1 * std::sin(x[0] / 10.0) * std::cos(x[1] / 12.0)));
      },
      60));
  EXPECT_GT(choice.scale[2], 30.0f);
  EXPECT_LT(choice.scale[2], 3000.0f);
  EXPECT_LT(choice.scale[0], 3.0f);
  EXPECT_LT(choice.scale[1], 3.0f);
  EXPECT_LT(choice.error_ratio, 0.85);
}

TEST(ChooseScale, IsOneWhereDirectionsAreAlike)
{
  uvol_test::Random random(11);
  const Waves waves(8);
  const Field fields[] = {waves,
                          [](const Vector3d& x) { return x.norm(); },
                          [](const Vector3d& x) { return x[0] + 0.3 * x[1]; },
                          [](const Vector3d&) { return 3.0; },
                          [&](const Vector3d&) { return random.uniform(); }};
  for (const Field& field : fields) {
    const ScaleChoice choice = choose(sample(field));
    EXPECT_TRUE((choice.scale == 1.0f).all()) << choice.scale;
    EXPECT_EQ(1.0, choice.error_ratio);
  }
}

TEST(ChooseScale, IsOneWhereSamplesDoNotDetermineIt)
{
  const Field flat = [](const Vector3d& x) { return std::sin(40.0 * x[2]); };
  EXPECT_TRUE((choose(sample(flat, 99)).scale == 1.0f).all());
  EXPECT_EQ(0u, choose(sample(flat, 99)).tested);
  Cloud same = sample(flat, 200);
  for (auto& point : same)
    point.getVector3fMap().setConstant(2.0f);
  EXPECT_TRUE((choose(same).scale == 1.0f).all());
}

TEST(ChooseScale, AnAxisWithoutSpreadKeepsItsLength)
{
  const Waves waves(9);
  Cloud planar = sample([&](const Vector3d& x) {
    return waves({x[0], 10.0 * x[1], 0.0});
  });
  for (auto& point : planar)
    point.z = 5.0f;
  const ScaleChoice choice = choose(planar);
  EXPECT_EQ(1.0f, choice.scale[2]);
  EXPECT_EQ(1.0f, choice.scale[0]);
  EXPECT_GT(choice.scale[1], 4.0f);
  Cloud line = sample([](const Vector3d& x) { return x[0]; });
  for (auto& point : line)
    point.y = point.z = 0.0f;
  EXPECT_TRUE((choose(line).scale == 1.0f).all());
}

TEST(ChooseScale, DependsOnTheSamplesAlone)
{
  const Waves waves(7);
  const Cloud cloud = sample(
      [&](const Vector3d& x) {
        return waves({x[0], x[1], 6.0 * x[2]});
      },
      3000);
  const ScaleChoice expected = choose(cloud, Array3d::Zero(), 1);
  EXPECT_GT(expected.scale[2], 2.0f);
  expectSame(expected, choose(cloud, Array3d::Zero(), 3));
  Cloud other = cloud; // in another order
  std::reverse(other.begin(), other.end());
  expectSame(expected, choose(other));
  other = cloud; // in other units, and with points that have no value or no place
  for (auto& point : other) {
    point.getArray3fMap() *= 0x1p20f;
    point.intensity *= 0x1p-31f;
  }
  other.push_back(other[0]);
  other.back().x = std::nanf("");
  other.push_back(other[1]);
  other.back().intensity = std::nanf("");
  expectSame(expected, choose(other));
  // Axes in units of their own: the factors make up for them.
  other = cloud;
  for (auto& point : other)
    point.z *= 0x1p-10f;
  const ScaleChoice deep = choose(other);
  EXPECT_GT(deep.scale[2], 512.0f * expected.scale[2]);
  EXPECT_LT(deep.scale[2], 2048.0f * expected.scale[2]);
}

TEST(ChooseScale, FollowsAxesThatAreTurned)
{
  const Waves waves(7);
  const Array3d angles(30.0, 50.0, 20.0);
  const Eigen::Matrix3d rows = pcl_uvol::detail::StretchAxes(angles).getRows();
  const ScaleChoice choice = choose(sample([&](const Vector3d& x) {
                                      const Vector3d seen = rows * x;
                                      return waves({seen[0], seen[1], 10.0 * seen[2]});
                                    }),
                                    angles);
  EXPECT_GT(choice.scale[2], 5.0f);
  EXPECT_LT(choice.scale[2], 20.0f);
  EXPECT_LT(choice.scale.head<2>().maxCoeff(), 2.0f);
}

TEST(ChooseScale, NeedsAFieldWithValues)
{
  Cloud cloud = sample([](const Vector3d&) { return std::nan(""); }, 200);
  EXPECT_THROW(choose(cloud), pcl_uvol::InvalidArgument);
  pcl_uvol::Report report;
  EXPECT_THROW(pcl_uvol::chooseScale(
                   pcl_uvol::viewOf(cloud), {0}, "no", Array3d::Zero(), 0, report),
               pcl_uvol::InvalidArgument);
}

} // namespace test_scale_choice
