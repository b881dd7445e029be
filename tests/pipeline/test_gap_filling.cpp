// SPDX-License-Identifier: BSD-3-Clause
// Gaps between lines of samples, filled by kriging: the surface there, what is told of
// it, and that nothing else changes.
#include "common/scalar_field.h"
#include "pipeline/gap_filling.h"
#include "pipeline/run_pipeline.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace test_gap_filling {

using namespace pcl_uvol;
using uvol_test::numberOf;
using uvol_test::wordOf;

constexpr double pi = 3.14159265358979323846;

/** A wavy floor, in units of the depth of the profiles. */
double
floorAt(double x, double y)
{
  return 0.5 + 0.1 * std::sin(2.0 * pi * x) * std::cos(pi * y);
}

/** Profiles of 60 samples each at random places of the unit square: the height above
 * the floor, and the number of the profile.
 * \param unit of length */
std::shared_ptr<Dataset>
makeProfiles(std::size_t count, float unit = 1.0f)
{
  uvol_test::Random random(3);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  std::vector<std::int32_t> numbers;
  for (std::size_t profile = 0; profile < count; ++profile) {
    const double x = random.uniform(), y = random.uniform();
    for (int i = 0; i < 60; ++i) {
      const double z = (i + 0.3 * random.uniform()) / 60.0;
      pcl::PointXYZI point;
      point.x = unit * static_cast<float>(x);
      point.y = unit * static_cast<float>(y);
      point.z = unit * static_cast<float>(z);
      point.intensity = static_cast<float>(z - floorAt(x, y));
      cloud.push_back(point);
      numbers.push_back(static_cast<std::int32_t>(profile));
    }
  }
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  setField(*samples, "profile", numbers);
  return samples;
}

IsosurfacePipelineParameters
makeParameters(bool fills)
{
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = "intensity";
  parameters.isosurface.isovalues = {0.0};
  parameters.fill_gaps = fills;
  parameters.automatic_scale = false;
  return parameters;
}

/** What becomes of that many profiles, computed once for all tests. */
const IsosurfaceResult&
fillProfiles(std::size_t count)
{
  static std::map<std::size_t, IsosurfaceResult> results;
  const auto [result, is_new] = results.try_emplace(count);
  if (is_new)
    result->second = uvol_test::runPipeline(makeProfiles(count), makeParameters(true));
  return result->second;
}

bool
isPredicted(const PointIso& point)
{
  return point.support == static_cast<std::uint8_t>(IsoSupport::Predicted);
}

TEST(GapFilling, IsAdvisedAsOtherOptionsThatWereNotGiven)
{
  IsosurfacePipelineParameters parameters = makeParameters(false);
  for (const bool is_scaled : {false, true}) {
    if (is_scaled)
      parameters.isosurface.scale = {1.0f, 1.0f, 2.0f};
    const auto told =
        uvol_test::findWarning(uvol_test::runPipeline(makeProfiles(20), parameters),
                               "unconstrained_isopoints");
    ASSERT_TRUE(told) << is_scaled;
    EXPECT_EQ(1.0, numberOf(*told, "validate"));
    EXPECT_EQ(is_scaled ? 0.0 : 1.0, numberOf(*told, "scale"));
    EXPECT_EQ(1.0, numberOf(*told, "gaps"));
    const std::string text = told->text(ParameterNames::Options),
                      advice = "reliable. Try: -validate, ";
    EXPECT_NE(std::string::npos,
              text.find(advice + (is_scaled ? "-fill-gaps, " : "-scale, -fill-gaps, ")))
        << text;
  }
}

/** Layers are not lines with gaps between, and fits to them know a plane. */
TEST(GapFilling, SaysWhereItMakesTheSurfaceWorse)
{
  EXPECT_FALSE(uvol_test::findWarning(fillProfiles(40), "worse_in_gaps"));
  uvol_test::Random random(4);
  pcl::PointCloud<pcl::PointXYZI> cells;
  for (int i = 0; i < 12 * 12 * 60; ++i) {
    pcl::PointXYZI point;
    point.x = static_cast<float>(i % 12 + 0.3 * random.uniform());
    point.y = static_cast<float>(i / 12 % 12 + 0.3 * random.uniform());
    point.z = 0.02f * static_cast<float>(i / 144 + 0.3 * random.uniform());
    point.intensity = point.x + 0.2f * point.y - 5.0f + point.z;
    cells.push_back(point);
  }
  const auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cells, samples->cloud);
  const auto worse = uvol_test::findWarning(
      uvol_test::runPipeline(samples, makeParameters(true)), "worse_in_gaps");
  ASSERT_TRUE(worse);
  EXPECT_GT(numberOf(*worse, "predicted"), numberOf(*worse, "measured"));
}

/** Half a gap is what nobody can tell more of; on a profile the samples are near. */
TEST(GapFilling, KeepsWhatIsKnownOnProfilesAndBetweenThem)
{
  IsosurfacePipelineParameters parameters = makeParameters(true);
  const IsosurfaceResult& all = fillProfiles(40);
  parameters.automatic_max_error = true;
  const IsosurfaceResult known = uvol_test::runPipeline(makeProfiles(40), parameters);
  const auto count = [&](const IsosurfaceResult& result, bool predicted) {
    const auto points = uvol_test::toIsopoints(result);
    return std::count_if(points.begin(), points.end(), [&](const PointIso& point) {
      return isPredicted(point) == predicted &&
             (!predicted ||
              point.error <= 2.0f * static_cast<float>(result.gaps->spacing));
    });
  };
  EXPECT_GE(count(all, false), 40);
  EXPECT_EQ(count(all, false), count(known, false));
  EXPECT_GT(count(all, true), 0);
  EXPECT_EQ(count(all, true), count(known, true));
  EXPECT_EQ(static_cast<std::size_t>(count(known, true)),
            known.report.getCount("predicted"));
}

TEST(GapFilling, LinearIsopointsHaveErrorsAndSupport)
{
  IsosurfacePipelineParameters parameters = makeParameters(true);
  parameters.isosurface.interpolation = Interpolation::Linear;
  for (const PointIso& point :
       uvol_test::toIsopoints(uvol_test::runPipeline(makeProfiles(20), parameters))) {
    EXPECT_FALSE(std::isnan(point.error));
    EXPECT_NE(static_cast<std::uint8_t>(IsoSupport::Unknown), point.support);
  }
}

/** What is said where no gap was filled: in the report's warnings, and as a fact. */
std::pair<std::optional<Message>, std::string>
reportUnfilled(const std::shared_ptr<Dataset>& samples)
{
  const auto result = uvol_test::runPipeline(samples, makeParameters(true));
  EXPECT_EQ(0u, result.gaps->predicted);
  const auto warning = uvol_test::findWarning(result, "unfilled_gaps");
  if (warning) {
    EXPECT_EQ(result.gaps->unfilled, wordOf(*warning, "reason"));
  }
  return {warning, result.gaps->unfilled};
}

TEST(GapFilling, SaysWhyItFillsNone)
{
  // Nothing lies beside a profile.
  const auto [few_warning, few] = reportUnfilled(makeProfiles(1));
  EXPECT_EQ("there are too few samples to estimate their width", few);
  EXPECT_TRUE(few_warning);
  // Samples all around have no gaps, and there is nothing to warn of.
  uvol_test::Random random(5);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int i = 0; i < 3000; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(random.uniform());
    point.intensity = (point.getArray3fMap() - 0.5f).matrix().norm() - 0.3f;
    cloud.push_back(point);
  }
  const auto dense = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, dense->cloud);
  const auto [dense_warning, around] = reportUnfilled(dense);
  EXPECT_EQ("samples surround the surface", around);
  EXPECT_FALSE(dense_warning);
}

/** Adds noise to the field.
 * \param part of the field itself that stays */
std::shared_ptr<Dataset>
makeNoisyProfiles(std::size_t count, float part)
{
  uvol_test::Random random(6);
  auto samples = makeProfiles(count);
  for (std::size_t i = 0; i < samples->cloud.width; ++i) {
    auto* const value =
        &samples->cloud
             .data[i * samples->cloud.point_step + samples->cloud.fields[3].offset];
    float noisy;
    std::memcpy(&noisy, value, sizeof noisy);
    noisy = part * noisy + static_cast<float>(random.uniform() - 0.5);
    std::memcpy(value, &noisy, sizeof noisy);
  }
  return samples;
}

TEST(GapFilling, LeavesOutWhatItExplainsNothingOf)
{
  // Values at random tell nothing of others.
  const auto [warning, unfilled] = reportUnfilled(makeNoisyProfiles(30, 0.0f));
  ASSERT_TRUE(warning);
  EXPECT_NE(std::string::npos, wordOf(*warning, "reason").find("variogram"));
  // Far from a profile the noise leaves nothing to tell.
  const auto result =
      uvol_test::runPipeline(makeNoisyProfiles(12, 0.5f), makeParameters(true));
  EXPECT_GT(result.gaps->predicted, 500u);
  const CloudView view = viewOf(result.surface.cloud);
  const ScalarField confidence(view.fields, "confidence");
  std::size_t predicted = 0;
  double least = 1.0;
  const auto points = uvol_test::toIsopoints(result);
  for (std::size_t i = 0; i < view.count; ++i) {
    predicted += isPredicted(points[i]);
    least = std::min(least, confidence.read(view.point(i)));
  }
  EXPECT_GT(predicted, 100u);
  EXPECT_GT(least, 0.0);
  EXPECT_LT(least, 0.2);
}

TEST(GapFilling, CountsWhatWentWhereNothingIsLeft)
{
  const auto result =
      uvol_test::runPipeline(makeNoisyProfiles(20, 0.1f), makeParameters(true));
  ASSERT_GT(result.gaps->predicted, 0u);
  const auto points = uvol_test::toIsopoints(result);
  ASSERT_FALSE(std::any_of(points.begin(), points.end(), isPredicted));
  const auto told = uvol_test::findWarning(result, "no_isopoints_in_gaps");
  ASSERT_TRUE(told);
  EXPECT_GT(numberOf(*told, "found"), 0.0);
  EXPECT_EQ(numberOf(*told, "found"), numberOf(*told, "unexplained"));
  EXPECT_EQ(0.0, numberOf(*told, "off_surface"));
}

TEST(GapFilling, FollowsTheFloorBetweenProfiles)
{
  const IsosurfaceResult& result = fillProfiles(80);
  ASSERT_TRUE(result.gaps);
  EXPECT_GT(result.gaps->predicted, 500u);
  EXPECT_EQ(result.gaps->predicted, result.report.getCount("predicted_samples"));
  std::vector<double> deviations, inside;
  double cosines = 0.0;
  std::size_t within = 0;
  for (const PointIso& point : uvol_test::toIsopoints(result))
    if (isPredicted(point)) {
      const double x = static_cast<double>(point.x), y = static_cast<double>(point.y);
      deviations.push_back(std::abs(static_cast<double>(point.z) - floorAt(x, y)));
      if (std::max(std::abs(x - 0.5), std::abs(y - 0.5)) < 0.4)
        inside.push_back(deviations.back());
      within += deviations.back() <= static_cast<double>(point.error);
      cosines -= static_cast<double>(point.normal_z);
    }
  ASSERT_GT(deviations.size(), 200u);
  const auto count = static_cast<double>(deviations.size());
  std::sort(deviations.begin(), deviations.end());
  EXPECT_LT(deviations[deviations.size() / 2], 0.02);
  EXPECT_LT(deviations[deviations.size() * 9 / 10], 0.03);
  std::sort(inside.begin(), inside.end());
  EXPECT_LT(inside[inside.size() / 2], 0.005);
  EXPECT_LT(inside[inside.size() * 9 / 10], 0.03);
  EXPECT_GT(static_cast<double>(within) / count, 0.9);
  EXPECT_GT(cosines / count, 0.85); // to lower values, downwards
}

/** The convex hull of some places, from all pairs of them. */
class BruteForceHull {
public:
  explicit BruteForceHull(const std::vector<Eigen::Vector2d>& all)
  {
    for (const Eigen::Vector2d& a : all)
      for (const Eigen::Vector2d& b : all) {
        if (a == b)
          continue;
        const Eigen::Vector2d out = Eigen::Vector2d(b - a).unitOrthogonal();
        const bool is_side =
            std::all_of(all.begin(), all.end(), [&](const Eigen::Vector2d& other) {
              return out.dot(other - a) <= 1e-12;
            });
        if (is_side)
          sides_.emplace_back(a, out);
      }
  }

  /** How far a place lies outside, at least; below 0 inside. */
  double
  distanceOutside(const Eigen::Vector2d& place) const
  {
    double distance = -1.0;
    for (const auto& [start, out] : sides_)
      distance = std::max(distance, out.dot(place - start));
    return distance;
  }

private:
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> sides_;
};

TEST(GapFilling, FillsWhatLiesBetweenProfilesAndNothingAroundThem)
{
  const std::size_t count = 80;
  const auto samples = makeProfiles(count);
  std::vector<Eigen::Vector2d> profiles;
  for (std::size_t profile = 0; profile < count; ++profile)
    profiles.push_back(
        Eigen::Map<const Eigen::Vector2f>(viewOf(samples->cloud).xyz(60 * profile))
            .cast<double>());
  const BruteForceHull hull(profiles);
  auto parameters = makeParameters(true);
  parameters.isosurface.isovalues = {0.0, 0.48}; // the other one leaves by the top
  const auto result = uvol_test::runPipeline(samples, parameters);
  const double spacing = result.gaps->spacing;
  std::size_t at_top = 0;
  std::vector<Eigen::Vector2d> surface;
  for (const PointIso& point : uvol_test::toIsopoints(result)) {
    const Eigen::Vector2d place = Eigen::Vector2f(point.x, point.y).cast<double>();
    if (point.isovalue == 0.0f)
      surface.push_back(place);
    if (!isPredicted(point))
      continue;
    at_top += point.z > 0.98f;
    EXPECT_LE(static_cast<double>(point.z), 1.0 + 2.0 * spacing);
    EXPECT_LE(hull.distanceOutside(place), 2.0 * spacing);
  }
  EXPECT_GT(at_top, 100u);
  std::size_t inside = 0, covered = 0;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) {
      const Eigen::Vector2d place(i / 39.0, j / 39.0);
      if (hull.distanceOutside(place) > 0.0)
        continue;
      ++inside;
      covered += std::any_of(
          surface.begin(), surface.end(), [&](const Eigen::Vector2d& point) {
            return (point - place).norm() < spacing;
          });
    }
  EXPECT_GT(inside, 1000u);
  EXPECT_EQ(inside, covered);
}

/** Tracks of a glider that turns once: dives are a third of a leg long. */
TEST(GapFilling, StaysWithinHalfAGapOfTracks)
{
  const Eigen::Vector2d start(0.0, 0.0), turn(1.0, 0.0), end(1.0, 0.8);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  uvol_test::Random random(6);
  for (int i = 0; i < 960; ++i) {
    const double way = (i + 0.3 * random.uniform()) / 480.0, part = way - (i / 480);
    const Eigen::Vector2d place =
        i < 480 ? start + part * (turn - start) : turn + part * (end - turn);
    const double phase = 3.0 * way - std::floor(3.0 * way),
                 z = 1.0 - std::abs(2.0 * phase - 1.0);
    pcl::PointXYZI point;
    point.x = static_cast<float>(place.x());
    point.y = static_cast<float>(place.y());
    point.z = static_cast<float>(z);
    point.intensity = static_cast<float>(z - floorAt(place.x(), place.y()));
    cloud.push_back(point);
  }
  const auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  const auto result = uvol_test::runPipeline(samples, makeParameters(true));
  const double width = result.gaps->width;
  EXPECT_GT(width, 0.1);
  EXPECT_LT(width, 0.5);
  EXPECT_EQ(width, 4.0 * result.gaps->spacing);
  const BruteForceHull hull({start, turn, end});
  std::size_t predicted = 0;
  for (const PointIso& point : uvol_test::toIsopoints(result)) {
    predicted += isPredicted(point);
    EXPECT_LE(hull.distanceOutside({point.x, point.y}), 0.5 * width);
  }
  EXPECT_GT(predicted, 50u);
}

/** Isopoints next to each other lie on each other's tangent planes, as on a surface
 * that bends over several of their distances: one that is put to the wrong side of the
 * root of its edge does not. */
TEST(GapFilling, IsopointsLieOnOneSurface)
{
  const IsosurfaceResult& result = fillProfiles(30);
  std::vector<PointIso> predicted;
  for (const PointIso& point : uvol_test::toIsopoints(result))
    if (isPredicted(point))
      predicted.push_back(point);
  ASSERT_GT(predicted.size(), 1000u);
  const auto least = static_cast<float>(0.2 * result.gaps->spacing);
  std::vector<float> slopes;
  for (const PointIso& point : predicted) {
    float nearest = 1e9f, slope = 0.0f;
    for (const PointIso& other : predicted) {
      const Eigen::Vector3f offset = other.getVector3fMap() - point.getVector3fMap();
      if (offset.norm() < least || offset.norm() >= nearest)
        continue;
      nearest = offset.norm();
      slope = std::abs(point.getNormalVector3fMap().dot(offset)) / nearest;
    }
    slopes.push_back(slope);
  }
  std::sort(slopes.begin(), slopes.end());
  EXPECT_LT(slopes[slopes.size() / 2], 0.09f);
  EXPECT_LT(slopes[slopes.size() * 9 / 10], 0.33f);
}

/** Where values scatter, roots of edges near the hull lie up to a spacing from the
 * kriged surface, and that is then outside of it. */
TEST(GapFilling, LeavesOutIsopointsThatAreMovedOutOfTheHull)
{
  const std::size_t count = 30;
  const auto samples = makeProfiles(count);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  pcl::fromPCLPointCloud2(samples->cloud, cloud);
  uvol_test::Random random(9);
  std::vector<Eigen::Vector2d> profiles;
  float top = 0.0f;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud[i].intensity += static_cast<float>(random.uniform() - 0.5);
    top = std::max(top, cloud[i].z);
    if (i % 60 == 0)
      profiles.emplace_back(Eigen::Vector2f(cloud[i].x, cloud[i].y).cast<double>());
  }
  const BruteForceHull hull(profiles);
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  auto parameters = makeParameters(true);
  parameters.isosurface.isovalues = {-0.3, 0.0, 0.3};
  const auto result = uvol_test::runPipeline(samples, parameters);
  const double most = 0.5 * result.gaps->width;
  std::size_t predicted = 0;
  for (const PointIso& point : uvol_test::toIsopoints(result)) {
    if (!isPredicted(point))
      continue;
    ++predicted;
    const Eigen::Vector2d place = Eigen::Vector2f(point.x, point.y).cast<double>();
    EXPECT_LE(hull.distanceOutside(place), most);
    EXPECT_LE(static_cast<double>(point.z - top), most);
    EXPECT_LE(-static_cast<double>(point.z), most);
  }
  EXPECT_GT(predicted, 5000u);
}

TEST(GapFilling, PredictsHeldOutProfiles)
{
  const auto samples = makeProfiles(80);
  auto parameters = makeParameters(true);
  parameters.validation.folds = 3;
  parameters.validation.by = ValidateBy::Field;
  parameters.validation.field = "profile";
  const auto filled = uvol_test::runPipeline(samples, parameters);
  parameters.fill_gaps = false;
  const auto as_it_is = uvol_test::runPipeline(samples, parameters);
  ASSERT_EQ(1u, filled.validation.size());
  const ValidationScore &a = filled.validation[0], &b = as_it_is.validation[0];
  EXPECT_GE(a.side.predicted, b.side.predicted - 0.02);
  EXPECT_GE(a.side.predicted, a.side.nearest);
  EXPECT_GE(10 * a.covered, 9 * b.covered);
}

TEST(GapFilling, LeavesDenseSamplesAsTheyAre)
{
  uvol_test::Random random(5);
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (std::size_t i = 0; i < 8000; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(2.0 * random.uniform() - 1.0);
    point.intensity = 0.6f - point.getVector3fMap().norm();
    cloud.push_back(point);
  }
  auto samples = std::make_shared<Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  const auto filled = uvol_test::runPipeline(samples, makeParameters(true));
  const auto as_it_is = uvol_test::runPipeline(samples, makeParameters(false));
  ASSERT_TRUE(filled.gaps);
  EXPECT_EQ(0u, filled.gaps->predicted);
  const auto a = uvol_test::toIsopoints(filled), b = uvol_test::toIsopoints(as_it_is);
  ASSERT_EQ(b.size(), a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(b[i].getVector3fMap(), a[i].getVector3fMap());
    EXPECT_EQ(b[i].getNormalVector3fMap(), a[i].getNormalVector3fMap());
    EXPECT_EQ(b[i].error, a[i].error);
  }
}

TEST(GapFilling, PredictsNothingBeyondTheRange)
{
  const auto samples = makeProfiles(12);
  const std::size_t measured = samples->cloud.width;
  PipelineInput input{samples, nullptr, makeParameters(true)};
  Report report;
  const detail::FilledGaps gaps(input, 0, report);
  const CloudView cloud = viewOf(input.samples->cloud);
  ASSERT_EQ(measured + gaps.getSummary().predicted, cloud.count);
  ASSERT_GT(gaps.getSummary().predicted, 0u);
  for (std::size_t i = measured; i < cloud.count; ++i) {
    float nearest = INFINITY;
    for (std::size_t j = 0; j < measured; ++j)
      nearest = std::min(nearest,
                         (Eigen::Map<const Eigen::Vector3f>(cloud.xyz(i)) -
                          Eigen::Map<const Eigen::Vector3f>(cloud.xyz(j)))
                             .norm());
    EXPECT_LE(static_cast<double>(nearest), 1.000001 * gaps.getSummary().range);
    EXPECT_GT(nearest, 0.0f); // no measured one is replaced
  }
}

TEST(GapFilling, ReportsConfidenceOfAllIsopoints)
{
  const IsosurfaceResult& result = fillProfiles(30);
  const auto points = uvol_test::toIsopoints(result);
  const CloudView view = viewOf(result.surface.cloud);
  const ScalarField confidence(view.fields, "confidence"),
      method(view.fields, "method"), profile(view.fields, "profile");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double value = confidence.read(view.point(i));
    EXPECT_TRUE(isPredicted(points[i]) ? value >= 0.0 && value < 1.0 : value == 1.0);
    EXPECT_EQ(isPredicted(points[i]) ? 3.0 : 1.0, method.read(view.point(i)));
    const double number = profile.read(view.point(i));
    EXPECT_TRUE(number >= 0.0 && number < 30.0);
  }
}

std::shared_ptr<Dataset>
turnAround(const Dataset& samples)
{
  auto turned = std::make_shared<Dataset>(samples);
  const std::size_t step = samples.cloud.point_step, count = samples.cloud.width;
  for (std::size_t i = 0; i < count; ++i)
    std::copy_n(&samples.cloud.data[i * step],
                step,
                &turned->cloud.data[(count - 1 - i) * step]);
  return turned;
}

TEST(GapFilling, DependsNotOnTheOrderOfSamples)
{
  const auto a = uvol_test::toIsopoints(fillProfiles(30));
  const auto b = uvol_test::toIsopoints(
      uvol_test::runPipeline(turnAround(*makeProfiles(30)), makeParameters(true)));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    if (isPredicted(a[i])) {
      EXPECT_EQ(a[i].getVector3fMap(), b[i].getVector3fMap());
      EXPECT_EQ(a[i].error, b[i].error);
    }
}

/** Isopoints at crossings of a line that the next line does not know are no surface. */
TEST(GapFilling, FollowsNothingFinerThanGapsAlongLines)
{
  const auto samples = makeProfiles(30);
  const CloudView view = viewOf(samples->cloud);
  const ScalarField height(view.fields, "intensity");
  std::vector<float> wrinkled;
  for (std::size_t i = 0; i < view.count; ++i) // about 0.4 above the floor: +, -, +
    wrinkled.push_back(
        static_cast<float>(height.read(view.point(i)) - (i % 60 == 50 ? 0.7 : 0.0)));
  setField(*samples, "intensity", wrinkled);
  auto parameters = makeParameters(false);
  parameters.isosurface.interpolation = Interpolation::Fit; // removes none of them
  std::size_t off = 0, off_filled = 0;
  const auto isOff = [](const PointIso& point) {
    return std::abs(static_cast<double>(point.z) -
                    floorAt(static_cast<double>(point.x),
                            static_cast<double>(point.y))) > 0.2;
  };
  for (const PointIso& point :
       uvol_test::toIsopoints(uvol_test::runPipeline(samples, parameters)))
    off += isOff(point);
  for (const PointIso& point :
       uvol_test::toIsopoints(uvol_test::runPipeline(samples, makeParameters(true))))
    off_filled += !isPredicted(point) && isOff(point);
  EXPECT_GE(off, 60u);
  EXPECT_LE(8 * off_filled, off); // where the kriged field nearly reaches the floor
}

TEST(GapFilling, DependsNeitherOnThreadsNorOnUnits)
{
  const auto one = uvol_test::runPipeline(makeProfiles(30), makeParameters(true), 1);
  const auto several =
      uvol_test::runPipeline(makeProfiles(30), makeParameters(true), 3);
  EXPECT_EQ(one.surface.cloud.data, several.surface.cloud.data);
  const float unit = 0x1p20f;
  const auto large =
      uvol_test::runPipeline(makeProfiles(30, unit), makeParameters(true));
  const auto a = uvol_test::toIsopoints(one), b = uvol_test::toIsopoints(large);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LE((b[i].getVector3fMap() / unit - a[i].getVector3fMap()).norm(), 1e-5f);
    EXPECT_EQ(a[i].support, b[i].support);
  }
}

TEST(GapFilling, WarnsWhereKrigingExplainsLittle)
{
  const auto samples = makeProfiles(30);
  EXPECT_TRUE(fillProfiles(30).report.warnings.empty());
  uvol_test::Random random(9);
  std::vector<float> noise;
  const CloudView view = viewOf(samples->cloud);
  const ScalarField height(view.fields, "intensity");
  for (std::size_t i = 0; i < view.count; ++i)
    noise.push_back(static_cast<float>(height.read(view.point(i)) +
                                       4.0 * (random.uniform() - 0.5)));
  setField(*samples, "intensity", noise);
  const auto result = uvol_test::runPipeline(samples, makeParameters(true));
  const auto told = uvol_test::findWarning(result, "unconstrained_gaps");
  ASSERT_TRUE(told);
  EXPECT_LT(numberOf(*told, "percent"), 50.0);
}

/** As grades of ore have: the mean square of differences is that of the spikes. */
TEST(GapFilling, FindsTheRangeOfAFieldWithSpikes)
{
  const auto samples = makeProfiles(80);
  const IsosurfaceResult& clean = fillProfiles(80);
  uvol_test::Random random(11);
  std::vector<float> spiked;
  const CloudView view = viewOf(samples->cloud);
  const ScalarField height(view.fields, "intensity");
  for (std::size_t i = 0; i < view.count; ++i)
    spiked.push_back(static_cast<float>(height.read(view.point(i)) *
                                        (random.uniform() < 0.02 ? 40.0 : 1.0)));
  setField(*samples, "intensity", spiked);
  const auto result = uvol_test::runPipeline(samples, makeParameters(true));
  EXPECT_LT(clean.gaps->nugget, 0.1 * clean.gaps->psill);
  EXPECT_LT(result.gaps->nugget, 0.1 * result.gaps->psill);
}

TEST(GapFilling, RefusesWhatItCannotFill)
{
  auto parameters = makeParameters(true);
  parameters.isosurface.field = "|x,y,z|";
  EXPECT_THROW(uvol_test::runPipeline(makeProfiles(12), parameters), InvalidArgument);
}

} // namespace test_gap_filling
