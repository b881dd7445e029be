// SPDX-License-Identifier: BSD-3-Clause
// Samples of several ranks in a box that repeats: what one process finds.
#include "common/records.h"
#include "distributed/merge_reports.h"
#include "distributed/periodic_ranks.h"
#include "neighbors/periodic_box.h"
#include "pipeline/periodic_samples.h"
#include "pipeline/run_pipeline.h"
#include "support/clouds.h"
#include "support/thread_ranks.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

namespace test_periodic_ranks {

using namespace pcl_uvol;
using namespace uvol_test;
using Samples = std::shared_ptr<Dataset>;

/** What ranks and one process are asked for. */
IsosurfacePipelineParameters
askFor(const std::vector<double>& isovalues)
{
  IsosurfacePipelineParameters parameters = makePeriodicParameters(0.0);
  parameters.isosurface.isovalues = isovalues;
  parameters.isosurface.interpolation = Interpolation::Fit; // that of ranks
  parameters.normals = NormalMethod::Edge;
  return parameters;
}

/** The rows of a rank: the second one of several has none. */
Samples
partOf(const Dataset& samples, std::size_t rank, std::size_t ranks)
{
  const auto begin_of = [&](std::size_t i) {
    const std::size_t shares = ranks > 1 ? ranks - 1 : 1;
    return samples.cloud.width * (i > 1 ? i - 1 : i) / shares;
  };
  return std::make_shared<Dataset>(
      rowsOf(samples, begin_of(rank), rank == 1 ? begin_of(1) : begin_of(rank + 1)));
}

/** The gathered surface, with the report of all ranks. */
IsosurfaceResult
runOnRanks(const Samples& samples,
           const IsosurfacePipelineParameters& parameters,
           std::size_t ranks,
           unsigned threads = 1)
{
  IsosurfaceResult result;
  std::size_t isopoints = 0;
  std::mutex mutex;
  runRanks(ranks, [&](Communicator& communicator) {
    DistributedIsosurfacePipeline pipeline(communicator);
    pipeline.setInput(partOf(*samples, communicator.rank(), ranks));
    pipeline.setParameters(parameters);
    pipeline.setNumberOfThreads(threads);
    const auto in_pieces = pipeline.run();
    pipeline.setGathered(true);
    auto gathered = pipeline.run();
    gathered.report = mergeReports(gathered.report, communicator);
    const std::lock_guard lock(mutex);
    isopoints += in_pieces.surface.cloud.width;
    if (communicator.rank() == 0)
      result = std::move(gathered);
    else
      EXPECT_EQ(0u, gathered.surface.cloud.width);
  });
  EXPECT_EQ(result.surface.cloud.width, isopoints); // each in one piece
  return result;
}

/** The bytes of one process, its counts and its warnings, from any number of ranks. */
IsosurfaceResult
expectSurfaceOfOne(const Samples& samples,
                   const IsosurfacePipelineParameters& parameters)
{
  const auto alone = runPipeline(samples, parameters);
  for (const std::size_t ranks : {1u, 2u, 3u, 5u}) {
    const auto found = runOnRanks(samples, parameters, ranks, ranks == 3 ? 2 : 1);
    EXPECT_EQ(alone.surface.cloud.data, found.surface.cloud.data) << ranks;
    EXPECT_EQ(alone.surface.origin, found.surface.origin) << ranks;
    EXPECT_EQ(alone.isopoints, found.isopoints) << ranks;
    EXPECT_EQ(alone.edges.size(), found.edges.size()) << ranks;
    for (const char* const name : {"samples",
                                   "images",
                                   "moved_into_box",
                                   "no_value",
                                   "non_finite",
                                   "duplicates",
                                   "isopoints",
                                   "bridged",
                                   "rim",
                                   "examined",
                                   "examined_bridged",
                                   "examined_rim"})
      EXPECT_EQ(alone.report.getCount(name), found.report.getCount(name))
          << name << ' ' << ranks;
    EXPECT_EQ(alone.report.warnings, found.report.warnings) << ranks;
  }
  return alone;
}

TEST(PeriodicRanks, FindTheSurfaceOfOneProcess)
{
  const auto alone =
      expectSurfaceOfOne(makePeriodicSamples(4000, gyroid), askFor({0.25, -0.5}));
  EXPECT_GT(alone.surface.cloud.width, 2000u);
  EXPECT_GT(alone.report.getCount("images"), 2000u);
}

TEST(PeriodicRanks, SeeAcrossTheFacesOfSomeAxes)
{
  const auto samples = makePeriodicSamples(2000, gyroid);
  for (const Eigen::Array3d& sides :
       {Eigen::Array3d{side, 0.0, 0.0}, Eigen::Array3d{0.0, side, side}}) {
    IsosurfacePipelineParameters parameters = askFor({0.25});
    parameters.periodic = sides;
    parameters.isosurface.scale = {1.0f, 0.7f, 1.5f};
    EXPECT_GT(expectSurfaceOfOne(samples, parameters).surface.cloud.width, 500u);
    parameters.isosurface.interpolation = Interpolation::Linear;
    EXPECT_EQ(1024u,
              expectSurfaceOfOne(samples, parameters).report.getCount("examined"));
  }
}

/** Samples crowd in one corner: the others have neighbours far beyond the faces. */
Samples
makeCrowd(std::size_t count)
{
  std::vector<double> xyz, values;
  for (std::uint64_t i = 0; i < count; ++i) {
    Place place{};
    for (std::uint64_t axis = 0; axis < 3; ++axis)
      place[axis] = side * std::pow(uniformAt(11, i, axis), 2.5);
    xyz.insert(xyz.end(), place.begin(), place.end());
    values.push_back(gyroid(place));
  }
  return makeSamplesAt(xyz, values);
}

/** Most samples lie deep in the box, and are the neighbours of a few at a face. */
Samples
makeHollow(std::size_t count)
{
  std::vector<double> xyz, values;
  for (std::uint64_t i = 0; i < count; ++i) {
    Place place{};
    for (std::uint64_t axis = 0; axis < 3; ++axis)
      place[axis] = side / 2.0 + 1.6 * (uniformAt(13, i, axis) - 0.5);
    if (i < 40)
      place[0] = 0.01 * static_cast<double>(i);
    xyz.insert(xyz.end(), place.begin(), place.end());
    values.push_back(gyroid(place));
  }
  return makeSamplesAt(xyz, values);
}

TEST(PeriodicRanks, ReachAsFarAsUnevenSamplesNeed)
{
  const Samples samples = makeCrowd(1500);
  const auto alone = expectSurfaceOfOne(samples, askFor({0.25}));
  EXPECT_GT(alone.surface.cloud.width, 300u);
  IsosurfacePipelineParameters parameters = askFor({0.25});
  parameters.drop_bridged = true;
  parameters.isosurface.interpolation = Interpolation::Linear; // back on the edges
  expectSurfaceOfOne(samples, parameters);
}

TEST(PeriodicRanks, TakeSamplesThatHaveLeftTheBox)
{
  const Samples samples = makePeriodicSamples(2000, gyroid);
  const auto inside = runOnRanks(samples, askFor({0.25}), 3);
  const auto moved = std::make_shared<Dataset>(*samples);
  for (std::size_t i = 0; i < 2000; i += 3)
    putCoordinate(placeOf(*samples, i)[i % 2] + (i % 4 == 0 ? side : -side),
                  i % 2,
                  &moved->cloud.data[i * moved->cloud.point_step]);
  const auto alone = expectSurfaceOfOne(moved, askFor({0.25}));
  EXPECT_EQ(667u, alone.report.getCount("moved_into_box"));
  EXPECT_EQ(inside.surface.cloud.data, alone.surface.cloud.data);
}

/** A lattice that has both of two opposite faces, whose samples are the same ones; all
 * gaps are equally wide, but for rounding. */
TEST(PeriodicRanks, TakeLatticesAndSamplesThatCoincide)
{
  constexpr int n = 12;
  for (const double size : {side, 0.7}) { // float has 8, and 0.7 not quite
    std::vector<double> xyz, values;
    for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
      const Place place{{side * (i % (n + 1)) / n,
                         side * (i / (n + 1) % (n + 1)) / n,
                         side * (i / (n + 1) / (n + 1)) / n}};
      for (const double x : place)
        xyz.push_back(x * size / side);
      values.push_back(gyroid(place) + 1e-3 * i); // conflicting ones as well
    }
    IsosurfacePipelineParameters parameters = askFor({0.25});
    parameters.periodic = Eigen::Array3d::Constant(size);
    const auto alone = expectSurfaceOfOne(makeSamplesAt(xyz, values), parameters);
    EXPECT_GT(alone.surface.cloud.width, 200u);
    EXPECT_GT(alone.report.getCount("duplicates"), 400u);
  }
}

TEST(PeriodicRanks, LeaveOutWhatHasNoValueOrNoPlace)
{
  const Samples samples = makePeriodicSamples(2000, gyroid);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values;
  for (std::size_t i = 0; i < 2000; ++i) {
    values.push_back(i % 7 == 0 ? none : gyroid(placeOf(*samples, i)));
    if (i % 11 == 0)
      putCoordinate(none, i % 3, &samples->cloud.data[i * samples->cloud.point_step]);
  }
  setField(*samples, "f", values);
  EXPECT_GT(expectSurfaceOfOne(samples, askFor({0.25})).surface.cloud.width, 500u);
}

TEST(PeriodicRanks, TakeFewSamples)
{
  expectSurfaceOfOne(makePeriodicSamples(40, gyroid), askFor({0.25}));
  expectSurfaceOfOne(makePeriodicSamples(4, gyroid), askFor({0.25}));
}

TEST(PeriodicRanks, ShiftingTheSamplesShiftsTheSurface)
{
  const auto reference =
      runOnRanks(makePeriodicSamples(2000, gyroid), askFor({0.25}), 3);
  const Place shift{{1.25, 3.5, -2.0}};
  const auto moved =
      runOnRanks(makePeriodicSamples(2000, gyroid, shift), askFor({0.25}), 2);
  ASSERT_EQ(reference.surface.cloud.width, moved.surface.cloud.width);
  const std::size_t step = moved.surface.cloud.point_step;
  for (std::size_t i = 0; i < moved.surface.cloud.width; ++i) {
    const Place from = placeOf(reference.surface, i), to = placeOf(moved.surface, i);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(0.0, std::remainder(to[axis] - from[axis] - shift[axis], side), 4e-6);
    // What follows the coordinates is the same to the last bit.
    EXPECT_TRUE(std::equal(&moved.surface.cloud.data[i * step + 12],
                           &moved.surface.cloud.data[(i + 1) * step - 1],
                           &reference.surface.cloud.data[i * step + 12]));
  }
}

TEST(PeriodicRanks, ASphereOnACornerIsWhole)
{
  constexpr double radius = 2.0;
  IsosurfacePipelineParameters parameters = askFor({radius});
  const auto found =
      runOnRanks(makePeriodicSamples(6000, distanceToCorner), parameters, 5);
  std::array<std::size_t, 8> octants{};
  for (std::size_t i = 0; i < found.surface.cloud.width; ++i) {
    const Place place = placeOf(found.surface, i);
    EXPECT_NEAR(radius, distanceToCorner(place), 0.05);
    ++octants.at((place[0] > radius ? 1u : 0u) + (place[1] > radius ? 2u : 0u) +
                 (place[2] > radius ? 4u : 0u));
  }
  const std::size_t least = *std::min_element(octants.begin(), octants.end());
  EXPECT_GT(5 * least, 4 * found.surface.cloud.width / 8);
}

TEST(PeriodicRanks, RefuseABoxThatIsNone)
{
  const Samples samples = makePeriodicSamples(200, gyroid);
  for (const double bad : {-1.0,
                           std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    IsosurfacePipelineParameters parameters = askFor({0.0});
    parameters.periodic[1] = bad;
    EXPECT_THROW(runOnRanks(samples, parameters, 2), InvalidArgument) << bad;
  }
}

/** The cut of one process, from any number of ranks. */
void
expectCutOfOne(const Samples& samples, const std::array<double, 3>& low)
{
  Report report;
  const Place sides{{side, side, side}};
  const PeriodicBox box = findPeriodicBox(*samples, sides, report);
  EXPECT_EQ(low, box.low);
  const PeriodicBox alone = cutAtWidestGap(*samples, box, 1);
  for (const std::size_t ranks : {1u, 2u, 7u})
    runRanks(ranks, [&](Communicator& communicator) {
      Report own;
      const Samples part = partOf(*samples, communicator.rank(), ranks);
      EXPECT_EQ(box.low, findPeriodicBox(*part, sides, communicator, own).low);
      EXPECT_EQ(alone.low, cutAtWidestGap(*part, box, communicator, 1).low);
      EXPECT_EQ(report.warnings, own.warnings);
    });
}

TEST(PeriodicRanks, CutTheBoxWhereOneProcessDoes)
{
  expectCutOfOne(makePeriodicSamples(3000, gyroid), {});
  expectCutOfOne(makePeriodicSamples(30, gyroid), {});
  std::vector<double> xyz;
  const std::vector<double> values(900, 1.0);
  for (int i = 0; i < 900; ++i) // one plane is not where it should be, one is fuller
    for (const int place : {i % 30, i / 30 % 30, i / 40})
      xyz.push_back(place == 17 ? 17.125 * side / 32 : place * side / 32);
  expectCutOfOne(makeSamplesAt(xyz, values), {});
  for (double& x : xyz)
    x -= side / 2.0;
  expectCutOfOne(makeSamplesAt(xyz, values), {-side / 2.0, -side / 2.0, -side / 2.0});
}

/** The images of one process, sample by sample. */
TEST(PeriodicRanks, ReachAsFarAsOneProcess)
{
  for (const Samples& samples :
       {makePeriodicSamples(1500, gyroid), makeCrowd(1500), makeHollow(30000)}) {
    Report report;
    const PeriodicBox box = findPeriodicBox(*samples, {{side, side, side}}, report);
    std::vector<std::uint32_t> all(samples->cloud.width);
    std::iota(all.begin(), all.end(), 0u);
    PeriodicReach reach;
    reach.scale = {{1.0f, 0.8f, 1.3f}};
    const double alone = addPeriodicImages(*samples, all, box, reach, 1, report).reach;
    for (const std::size_t ranks : {1u, 2u, 4u, 6u})
      runRanks(ranks, [&](Communicator& communicator) {
        const Samples part = partOf(*samples, communicator.rank(), ranks);
        std::vector<std::uint32_t> own(part->cloud.width);
        std::iota(own.begin(), own.end(), 0u);
        Report ignored;
        EXPECT_EQ(
            alone,
            addPeriodicImages(*part, own, box, reach, communicator, 1, ignored).reach);
      });
  }
}

} // namespace test_periodic_ranks
