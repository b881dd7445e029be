// SPDX-License-Identifier: BSD-3-Clause
// Where isopoints lie and how they are oriented, chosen one by one.
#include "common/scalar_field.h"
#include "pipeline/run_pipeline.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace test_isopoint_choice {

using namespace pcl_uvol;

/** Profiles of 100 samples each at random places of the unit square, and the height
 * above a tilted plane.
 * \param depth of the profiles
 * \param noise range of what is added to the values */
std::shared_ptr<Dataset>
makeProfiles(std::size_t count,
             float depth = 1.0f,
             float tilt = 0.3f,
             float noise = 0.0f)
{
  uvol_test::Random random(11);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (std::size_t profile = 0; profile < count; ++profile) {
    const auto x = static_cast<float>(random.uniform());
    const auto y = static_cast<float>(random.uniform());
    for (int i = 0; i < 100; ++i) {
      pcl::PointXYZI point;
      point.x = x;
      point.y = y;
      point.z = depth *
                (static_cast<float>(i) + 0.3f * static_cast<float>(random.uniform())) /
                100.0f;
      point.intensity = point.z / depth - 0.4f - tilt * x +
                        noise * static_cast<float>(random.uniform() - 0.5);
      cloud.push_back(point);
    }
  }
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  return samples;
}

/** A sphere of radius 0.6 in a cube of samples. */
std::shared_ptr<Dataset>
makeSphere(std::size_t n)
{
  uvol_test::Random random(5);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (std::size_t i = 0; i < n; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.intensity = 0.6f - point.getVector3fMap().norm();
    cloud.push_back(point);
  }
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  return samples;
}

IsosurfacePipelineParameters
makeParameters(Interpolation interpolation)
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.isovalues = {0.0};
  parameters.isosurface.interpolation = interpolation;
  return parameters;
}

std::size_t
countValue(const IsosurfaceResult& result, const std::string& field, double value)
{
  const CloudView view = viewOf(result.surface.cloud);
  const ScalarField scalar(view.fields, field);
  std::size_t count = 0;
  for (std::size_t i = 0; i < view.count; ++i)
    count += scalar.read(view.point(i)) == value;
  return count;
}

/** Mean cosine between normals and a direction. */
double
meanCosine(const pcl::PointCloud<PointIso>& points, const Eigen::Vector3f& direction)
{
  double sum = 0.0;
  for (const PointIso& point : points)
    sum += point.getNormalVector3fMap().dot(direction.normalized());
  return sum / static_cast<double>(points.size());
}

IsosurfaceResult
extractAt(const std::shared_ptr<Dataset>& samples, double isovalue)
{
  IsosurfacePipelineParameters parameters = makeParameters(Interpolation::Auto);
  parameters.isosurface.isovalues = {isovalue};
  return uvol_test::runPipeline(samples, parameters);
}

/** What is said of most of the isopoints. */
std::vector<Message>
findWeakSupport(const IsosurfaceResult& result)
{
  std::vector<Message> found;
  for (const Message& warning : result.report.warnings)
    for (const char* const code : {"isopoints_at_border",
                                   "isopoints_beside_samples",
                                   "unconstrained_isopoints",
                                   "unconstrained_level_set",
                                   "unconstrained_border"})
      if (warning.code == code)
        found.push_back(warning);
  return found;
}

/** That most of the isopoints lie between lines of samples, and nothing else. */
void
expectLinesAreReported(const IsosurfaceResult& result)
{
  const std::vector<Message> found = findWeakSupport(result);
  ASSERT_EQ(std::vector<std::string>{"unconstrained_isopoints"},
            uvol_test::listCodes(found));
  EXPECT_GE(uvol_test::numberOf(found[0], "percent"), 50.0);
}

/** Isopoints on rims, and in gaps those that lie on good fits, by the fields. */
std::size_t
countAtBorder(const IsosurfaceResult& result)
{
  const CloudView view = viewOf(result.surface.cloud);
  const ScalarField method(view.fields, "method"),
      orientation(view.fields, "orientation");
  const auto isopoints = uvol_test::toIsopoints(result);
  std::size_t count = 0;
  for (std::size_t i = 0; i < isopoints.size(); ++i)
    count += isopoints[i].support == 3 ||
             (isopoints[i].support == 2 && method.read(view.point(i)) == 2.0 &&
              orientation.read(view.point(i)) != 4.0 &&
              isopoints[i].error <= 0.5f * isopoints[i].edge_length);
  return count;
}

/** A surface that only cuts corners off a cube of samples lies on good fits, beside
 * which there is no line. */
TEST(IsopointChoice, BordersOfSamplesAreNoGapsBetweenLines)
{
  const IsosurfaceResult corners = extractAt(makeSphere(20000), 0.6 - 1.62);
  const std::vector<Message> told = findWeakSupport(corners);
  ASSERT_EQ(std::vector<std::string>{"isopoints_at_border"},
            uvol_test::listCodes(told));
  const std::size_t percent =
      100 * countAtBorder(corners) / corners.surface.cloud.width;
  EXPECT_EQ(static_cast<double>(percent), uvol_test::numberOf(told[0], "percent"));
  expectLinesAreReported(extractAt(makeProfiles(20), 0.0));
  EXPECT_TRUE(findWeakSupport(extractAt(makeSphere(20000), 0.0)).empty());
}

/** Linear isopoints and vertices of meshes rest on no more, and of the former a share
 * is looked at. */
TEST(IsopointChoice, AllSurfacesOnLinesOfSamplesAreReported)
{
  IsosurfacePipelineParameters parameters = makeParameters(Interpolation::Linear);
  const IsosurfaceResult linear = uvol_test::runPipeline(makeProfiles(20), parameters);
  expectLinesAreReported(linear);
  EXPECT_EQ(std::min<std::size_t>(1024, linear.surface.cloud.width),
            linear.report.getCount("examined"));
  for (const PointIso& point : uvol_test::toIsopoints(linear))
    EXPECT_EQ(0, point.support);
  EXPECT_TRUE(
      findWeakSupport(uvol_test::runPipeline(makeSphere(20000), parameters)).empty());

  parameters = makeParameters(Interpolation::Auto);
  parameters.mesh.emplace();
  const IsosurfaceResult mesh = uvol_test::runPipeline(makeProfiles(20), parameters);
  expectLinesAreReported(mesh);
  EXPECT_TRUE(
      findWeakSupport(uvol_test::runPipeline(makeSphere(20000), parameters)).empty());
  // Caps, of which most vertices are, rest on nothing.
  parameters.isosurface.isovalues = {0.6 - 1.25};
  EXPECT_TRUE(
      findWeakSupport(uvol_test::runPipeline(makeSphere(20000), parameters)).empty());
}

/** There is no line in a slab two spacings thick, nor in a lattice of 3 by 3 by 3. */
TEST(IsopointChoice, FewSamplesAllAroundHaveABorder)
{
  uvol_test::Random random(1);
  pcl::PointCloud<pcl::PointXYZI> slab, lattice;
  for (int i = 0; i < 4000; ++i) {
    pcl::PointXYZI point;
    point.x = static_cast<float>(20.0 * random.uniform());
    point.y = static_cast<float>(20.0 * random.uniform());
    point.z = static_cast<float>(random.uniform());
    point.intensity = point.x + 0.3f * point.z - 10.0f;
    slab.push_back(point);
  }
  for (int i = 0; i < 27; ++i) {
    pcl::PointXYZI point;
    point.x = static_cast<float>(i % 3);
    point.y = static_cast<float>(i / 3 % 3);
    point.z = static_cast<float>(i / 9);
    point.intensity = point.x + 0.4f * point.y - 1.3f + 0.1f * point.z * point.z;
    lattice.push_back(point);
  }
  for (const auto* const cloud : {&slab, &lattice}) {
    const auto samples = std::make_shared<Dataset>();
    pcl::toPCLPointCloud2(*cloud, samples->cloud);
    const std::vector<Message> told = findWeakSupport(extractAt(samples, 0.0));
    ASSERT_EQ(1u, told.size());
    EXPECT_TRUE(told[0].code == "isopoints_at_border" ||
                told[0].code == "isopoints_beside_samples")
        << told[0];
  }
}

TEST(IsopointChoice, LeavesDenseSurfacesOnTheirFits)
{
  const auto samples = makeSphere(20000);
  const auto fit = uvol_test::runPipeline(samples, makeParameters(Interpolation::Fit));
  const auto chosen =
      uvol_test::runPipeline(samples, makeParameters(Interpolation::Auto));
  EXPECT_EQ(chosen.surface.cloud.width, countValue(chosen, "method", 2));
  EXPECT_EQ(chosen.surface.cloud.width, countValue(chosen, "orientation", 2));
  const auto a = uvol_test::toIsopoints(fit), b = uvol_test::toIsopoints(chosen);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].getVector3fMap(), b[i].getVector3fMap());
    EXPECT_EQ(a[i].getNormalVector3fMap(), b[i].getNormalVector3fMap());
    EXPECT_EQ(a[i].error, b[i].error);
  }
  EXPECT_TRUE(chosen.report.warnings.empty());
  ASSERT_TRUE(chosen.sampling);
  EXPECT_EQ(LocalDimension::Volume, chosen.sampling->most);
}

TEST(IsopointChoice, GoesBackToEdgesBetweenLines)
{
  const auto samples = makeProfiles(60, 1.0f, 0.3f, 0.1f);
  const auto fit = uvol_test::runPipeline(samples, makeParameters(Interpolation::Fit));
  const auto chosen =
      uvol_test::runPipeline(samples, makeParameters(Interpolation::Auto));
  EXPECT_GT(countValue(chosen, "method", 1), 0u);
  EXPECT_GT(countValue(chosen, "orientation", 4), 0u);
  const Eigen::Vector3f truth(0.3f, 0.0f, -1.0f); // to lower values
  EXPECT_GE(meanCosine(uvol_test::toIsopoints(chosen), truth),
            meanCosine(uvol_test::toIsopoints(fit), truth));
  EXPECT_EQ(LocalDimension::Line, chosen.sampling->most);
  ASSERT_EQ(3u, chosen.report.warnings.size());
  EXPECT_EQ("unlocated_isopoints", chosen.report.warnings[2].code);
  EXPECT_EQ("contradicted_isopoints", chosen.report.warnings[1].code);
  EXPECT_EQ("unconstrained_isopoints", chosen.report.warnings[0].code);
  EXPECT_EQ(1.0, uvol_test::numberOf(chosen.report.warnings[0], "validate"));
}

/** None goes back to its edge there: fields tell what it is on instead. */
TEST(IsopointChoice, IsReportedAfterLevelSetsAndInMeshes)
{
  auto smoothed = makeParameters(Interpolation::Auto);
  smoothed.smooth = true;
  auto meshed = makeParameters(Interpolation::Auto);
  meshed.mesh.emplace();
  for (const auto& parameters : {smoothed, meshed}) {
    const auto result = uvol_test::runPipeline(makeProfiles(60), parameters);
    auto fitted = parameters;
    fitted.isosurface.interpolation = Interpolation::Fit;
    const auto same = uvol_test::runPipeline(makeProfiles(60), fitted);
    EXPECT_EQ(nullptr, findField(same.surface.cloud.fields, "method"));
    const auto points = uvol_test::toIsopoints(result),
               others = uvol_test::toIsopoints(same);
    ASSERT_EQ(points.size(), others.size());
    std::size_t fits = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(points[i].getVector3fMap(), others[i].getVector3fMap());
      fits += !std::isnan(points[i].mean_curvature);
    }
    EXPECT_GT(fits, 0u);
    EXPECT_EQ(fits, countValue(result, "method", 2));
    EXPECT_EQ(points.size(), fits + countValue(result, "method", 1));
    EXPECT_EQ(fits, countValue(result, "orientation", 2));
    EXPECT_EQ(points.size() - fits,
              countValue(result, "orientation", parameters.mesh ? 1 : 3));
  }
}

/** No error of an isopoint in a gap holds that of the nearest isopoint in none. */
TEST(IsopointChoice, RemovesIsopointsInGapsThatNothingLocates)
{
  auto parameters = makeParameters(Interpolation::Auto);
  parameters.isosurface.isovalues = {-0.1, 0.0, 0.1};
  const auto result = uvol_test::runPipeline(makeProfiles(30), parameters);
  const auto points = uvol_test::toIsopoints(result);
  const auto is_bridged = [](const PointIso& point) {
    return point.support == static_cast<std::uint8_t>(IsoSupport::Bridged);
  };
  for (const PointIso& point : points) {
    if (!is_bridged(point))
      continue;
    const PointIso* nearest = nullptr;
    float distance = std::numeric_limits<float>::infinity();
    for (const PointIso& other : points)
      if (const float length = (other.getVector3fMap() - point.getVector3fMap()).norm();
          !is_bridged(other) && other.isovalue == point.isovalue && length < distance) {
        nearest = &other;
        distance = length;
      }
    ASSERT_NE(nullptr, nearest);
    EXPECT_LE(point.error, 1.0001f * (distance + nearest->error));
  }
  const auto removed = result.report.getCount("unlocated");
  EXPECT_GT(removed, 5u);
  EXPECT_EQ(result.report.getCount("edges"),
            points.size() + removed + result.report.getCount("contradicted") +
                result.report.getCount("coincident"));
  const auto told = uvol_test::findWarning(result, "unlocated_isopoints");
  ASSERT_TRUE(told);
  EXPECT_EQ(static_cast<double>(removed), uvol_test::numberOf(*told, "removed"));
  EXPECT_EQ(1.0, uvol_test::numberOf(*told, "gaps"));
  parameters.isosurface.interpolation = Interpolation::Fit;
  const auto fits = uvol_test::runPipeline(makeProfiles(30), parameters);
  EXPECT_EQ(0u, fits.report.getCount("unlocated"));
  const auto dense = extractAt(makeSphere(20000), 0.0);
  EXPECT_EQ(0u, dense.report.getCount("unlocated"));
  EXPECT_FALSE(uvol_test::findWarning(dense, "unlocated_isopoints"));
}

TEST(IsopointChoice, EdgeNormalsAreCovectorsOfTheStretchedSpace)
{
  auto parameters = makeParameters(Interpolation::Linear);
  parameters.normals = NormalMethod::Edge;
  parameters.isosurface.scale = {1.0f, 1.0f, 100.0f};
  // In the stretched space profiles are as deep as they are apart: level isotherms
  // have upright normals but for those of edges along them.
  const auto points = uvol_test::toIsopoints(
      uvol_test::runPipeline(makeProfiles(200, 0.01f, 0.05f), parameters));
  std::size_t level = 0;
  for (const PointIso& point : points)
    level += std::abs(point.normal_z) < 0.7f;
  EXPECT_LT(static_cast<double>(level), 0.1 * static_cast<double>(points.size()));
}

TEST(IsopointChoice, BoundsServeLinearInterpolationAsWell)
{
  const auto samples = makeProfiles(60);
  auto parameters = makeParameters(Interpolation::Linear);
  const auto all = uvol_test::toIsopoints(uvol_test::runPipeline(samples, parameters));
  parameters.drop_bridged = true;
  const auto result = uvol_test::runPipeline(samples, parameters);
  const auto measured = uvol_test::toIsopoints(result);
  EXPECT_GT(result.report.getCount("removed_bridged"), 0u);
  ASSERT_EQ(all.size(), measured.size() + result.report.getCount("removed_bridged"));
  std::size_t found = 0;
  for (const PointIso& point : all)
    found += found < measured.size() &&
             (point.getVector3fMap() - measured[found].getVector3fMap()).norm() < 1e-5f;
  EXPECT_EQ(measured.size(), found);
  parameters.drop_bridged = false;
  parameters.max_error = 0.01;
  for (const PointIso& point :
       uvol_test::toIsopoints(uvol_test::runPipeline(samples, parameters)))
    EXPECT_LE(point.error, 0.01f);
}

TEST(IsopointChoice, SaysSoWhereBoundsLeaveNothing)
{
  const auto samples = makeSphere(8000);
  auto parameters = makeParameters(Interpolation::Auto);
  parameters.max_error = 1e-12;
  const auto none = uvol_test::runPipeline(samples, parameters);
  EXPECT_EQ(0u, none.surface.cloud.width);
  ASSERT_EQ(1u, none.report.warnings.size());
  EXPECT_EQ("no_isopoints_left", none.report.warnings[0].code);
  EXPECT_EQ(1.0, uvol_test::numberOf(none.report.warnings[0], "by_error"));
  EXPECT_EQ(0.0, uvol_test::numberOf(none.report.warnings[0], "by_support"));
  parameters.max_error = 0.01;
  EXPECT_TRUE(uvol_test::runPipeline(samples, parameters).report.warnings.empty());
}

TEST(IsopointChoice, ErrorsOfLinearIsopointsCoverTheirDeviations)
{
  auto parameters = makeParameters(Interpolation::Linear);
  parameters.max_error = 1.0;
  const auto points =
      uvol_test::toIsopoints(uvol_test::runPipeline(makeSphere(8000), parameters));
  std::size_t covered = 0;
  for (const PointIso& point : points)
    covered += std::abs(point.getVector3fMap().norm() - 0.6f) <= point.error;
  EXPECT_GT(static_cast<double>(covered), 0.95 * static_cast<double>(points.size()));
}

TEST(IsopointChoice, DoesNotDependOnThreads)
{
  const auto samples = makeProfiles(60);
  const auto parameters = makeParameters(Interpolation::Auto);
  EXPECT_EQ(uvol_test::runPipeline(samples, parameters, 1).surface.cloud.data,
            uvol_test::runPipeline(samples, parameters, 4).surface.cloud.data);
}

TEST(IsopointChoice, IsTheSameInOtherUnits)
{
  const auto samples = makeProfiles(60);
  auto larger = std::make_shared<Dataset>(*samples);
  for (std::size_t i = 0; i < larger->cloud.width; ++i) {
    auto* const xyz =
        reinterpret_cast<float*>(&larger->cloud.data[i * larger->cloud.point_step]);
    for (int axis = 0; axis < 3; ++axis)
      xyz[axis] *= 0x1p30f;
  }
  const auto parameters = makeParameters(Interpolation::Auto);
  const auto a = uvol_test::toIsopoints(uvol_test::runPipeline(samples, parameters));
  const auto b = uvol_test::toIsopoints(uvol_test::runPipeline(larger, parameters));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(0x1p30f * a[i].getVector3fMap(), b[i].getVector3fMap());
    EXPECT_EQ(a[i].getNormalVector3fMap(), b[i].getNormalVector3fMap());
  }
}

} // namespace test_isopoint_choice
