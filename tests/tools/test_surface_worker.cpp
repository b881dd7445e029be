// SPDX-License-Identifier: BSD-3-Clause
// The thread of the viewer's isosurfaces, with extractions that the tests hold.
#include "support/surfaces.h"
#include "viewer/surface_worker.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <future>
#include <thread>
#include <utility>
#include <vector>

namespace test_surface_worker {

using pcl_uvol::ProgressCallback;
using uvol_tools::ExtractedSurface;
using uvol_tools::SurfaceRequest;
using uvol_tools::SurfaceWorker;

/** A surface whose report tells what it is of. */
ExtractedSurface
makeResult(const SurfaceRequest& request)
{
  ExtractedSurface result;
  result.report.count("isovalue", static_cast<std::uint64_t>(request.isovalues.back()));
  return result;
}

/** An extraction that is begun, and waits for the test. */
struct Gate {
  std::promise<void> begun, open;
};

TEST(SurfaceWorker, DropsWhatIsOvertakenAndFinishesWhatIsBegun)
{
  Gate first;
  std::vector<double> extracted;
  SurfaceWorker worker(
      [&](const SurfaceRequest& request, unsigned, const ProgressCallback&) {
        extracted.push_back(request.isovalues.back());
        if (extracted.size() == 1) {
          first.begun.set_value();
          first.open.get_future().wait();
        }
        return makeResult(request);
      });
  EXPECT_FALSE(worker.isBusy());
  EXPECT_FALSE(worker.take());
  EXPECT_FALSE(worker.finish());
  worker.ask({{1.0}, false});
  first.begun.get_future().wait();
  worker.ask({{2.0}, false});
  worker.ask({{3.0}, true});
  EXPECT_TRUE(worker.isBusy());
  EXPECT_FALSE(worker.take());
  first.open.set_value();
  const auto result = worker.finish();
  ASSERT_TRUE(result);
  EXPECT_EQ(3.0, result->request.isovalues.back());
  EXPECT_TRUE(result->request.is_meshed);
  EXPECT_EQ(3u, result->surface.report.getCount("isovalue"));
  EXPECT_EQ((std::vector<double>{1.0, 3.0}), extracted);
  EXPECT_FALSE(worker.isBusy());
  EXPECT_FALSE(worker.take());
}

TEST(SurfaceWorker, GivesWhatIsReadyWhileMoreIsUnderWay)
{
  Gate second;
  SurfaceWorker worker(
      [&](const SurfaceRequest& request, unsigned, const ProgressCallback&) {
        if (request.isovalues.back() == 2.0) {
          second.begun.set_value();
          second.open.get_future().wait();
        }
        return makeResult(request);
      });
  worker.ask({{1.0}, false});
  auto result = worker.finish();
  ASSERT_TRUE(result);
  worker.ask({{1.5}, false});
  while (!(result = worker.take()))
    EXPECT_TRUE(worker.isBusy());
  EXPECT_EQ(1.5, result->request.isovalues.back());
  worker.ask({{2.0}, false});
  second.begun.get_future().wait();
  EXPECT_FALSE(worker.take());
  second.open.set_value();
  EXPECT_EQ(2.0, worker.finish()->request.isovalues.back());
}

/** A surface that is drawn. */
ExtractedSurface
makeDrawn(const SurfaceRequest& request)
{
  ExtractedSurface result = makeResult(request);
  const auto cloud = pcl::make_shared<pcl::PCLPointCloud2>();
  pcl::toPCLPointCloud2(*uvol_test::makeTorusKnot(4000, 1), *cloud);
  result.whole = result.cloud = cloud;
  result.prepared = std::make_shared<pcl_uvol::PreparedSurface>(*cloud);
  return result;
}

std::vector<std::uint8_t>
draw(const ExtractedSurface& surface, bool is_hasty)
{
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(surface.cloud);
  renderer.setPreparedSurface(surface.prepared);
  renderer.setHasty(is_hasty);
  renderer.setSize(300, 200);
  pcl_uvol::Image image;
  renderer.render(image);
  return image.color;
}

TEST(SurfaceWorker, GivesSurfacesWithTheirFootprints)
{
  SurfaceWorker worker([](const SurfaceRequest& request,
                          unsigned,
                          const ProgressCallback&) { return makeDrawn(request); });
  worker.ask({{1.0}, false});
  std::optional<SurfaceWorker::Result> result;
  while (!(result = worker.take()))
    std::this_thread::yield();
  ExtractedSurface unprepared = result->surface;
  unprepared.prepared = nullptr;
  EXPECT_NE(draw(unprepared, true), draw(unprepared, false));
  EXPECT_EQ(draw(unprepared, false), draw(result->surface, true));
}

/** What is extracted for requests in turn: isovalue, and one of how many samples. */
using Log = std::vector<std::pair<double, unsigned>>;

/** Drafts come before all but the first surface, of which nobody knows how long they
 * take. */
constexpr double in_no_time = 1e-9;

constexpr unsigned thinnest = uvol_tools::DraftChoice::largest;

SurfaceWorker::Result
waitFor(SurfaceWorker& worker)
{
  while (true)
    if (auto result = worker.take())
      return *result;
    else
      std::this_thread::yield();
}

TEST(SurfaceWorker, GivesADraftAndThenTheSurface)
{
  Log log;
  SurfaceWorker worker(
      [&](const SurfaceRequest& request, unsigned thinning, const ProgressCallback&) {
        log.emplace_back(request.isovalues.back(), thinning);
        ExtractedSurface result = makeDrawn(request);
        result.report.count("thinning", thinning);
        return result;
      },
      in_no_time);
  worker.ask({{1.0}, false});
  EXPECT_EQ(1u, waitFor(worker).surface.report.getCount("thinning"));
  worker.ask({{2.0}, false});
  EXPECT_EQ(thinnest, waitFor(worker).surface.report.getCount("thinning"));
  EXPECT_TRUE(worker.isBusy());
  EXPECT_EQ(1u, waitFor(worker).surface.report.getCount("thinning"));
  EXPECT_FALSE(worker.finish());
  EXPECT_EQ((Log{{1.0, 1}, {2.0, thinnest}, {2.0, 1}}), log);
}

TEST(SurfaceWorker, EndsASurfaceAfterItsDraftWhenItIsOvertaken)
{
  Gate whole;
  SurfaceWorker worker(
      [&](const SurfaceRequest& request,
          unsigned thinning,
          const ProgressCallback& progress) {
        if (request.isovalues.back() == 2.0 && thinning == 1) {
          whole.begun.set_value();
          while (true)
            progress("extract", 0.5);
        }
        return makeDrawn(request);
      },
      in_no_time);
  worker.ask({{1.0}, false});
  waitFor(worker);
  worker.ask({{2.0}, false});
  EXPECT_EQ(2.0, waitFor(worker).request.isovalues.back());
  whole.begun.get_future().wait();
  worker.ask({{3.0}, false}); // else it went on for ever
  EXPECT_EQ(3.0, waitFor(worker).request.isovalues.back());
  EXPECT_EQ(3.0, worker.finish()->request.isovalues.back());
}

TEST(SurfaceWorker, WhoWaitsForASurfaceWaitsForNoDraft)
{
  Gate draft;
  Log log;
  SurfaceWorker worker(
      [&](const SurfaceRequest& request,
          unsigned thinning,
          const ProgressCallback& progress) {
        log.emplace_back(request.isovalues.back(), thinning);
        if (thinning > 1) {
          draft.begun.set_value();
          while (true)
            progress("extract", 0.5);
        }
        return makeDrawn(request);
      },
      in_no_time);
  worker.ask({{1.0}, false});
  worker.finish();
  worker.ask({{2.0}, false});
  draft.begun.get_future().wait();
  EXPECT_EQ(2.0, worker.finish()->request.isovalues.back());
  EXPECT_EQ((Log{{1.0, 1}, {2.0, thinnest}, {2.0, 1}}), log);
}

TEST(SurfaceWorker, DraftsThatShowNothingOrFailAreNotGiven)
{
  Log log;
  SurfaceWorker worker(
      [&](const SurfaceRequest& request, unsigned thinning, const ProgressCallback&) {
        log.emplace_back(request.isovalues.back(), thinning);
        if (thinning > 1 && request.isovalues.back() == 3.0)
          throw pcl_uvol::InvalidArgument("There are no samples.");
        ExtractedSurface result = makeDrawn(request);
        result.report.count("thinning", thinning);
        if (thinning > 1)
          result.cloud = nullptr;
        return result;
      },
      in_no_time);
  worker.ask({{1.0}, false});
  waitFor(worker);
  for (const double isovalue : {2.0, 3.0}) {
    worker.ask({{isovalue}, false});
    EXPECT_EQ(1u, waitFor(worker).surface.report.getCount("thinning"));
  }
  EXPECT_FALSE(worker.finish());
  EXPECT_EQ((Log{{1.0, 1}, {2.0, thinnest}, {2.0, 1}, {3.0, thinnest}, {3.0, 1}}), log);
}

TEST(SurfaceWorker, ThrowsWhatExtractionsThrowAndGoesOn)
{
  SurfaceWorker worker(
      [](const SurfaceRequest& request, unsigned, const ProgressCallback&) {
        if (request.isovalues.back() < 0.0)
          throw pcl_uvol::InvalidArgument("It is negative.");
        return makeResult(request);
      });
  worker.ask({{-1.0}, false});
  EXPECT_THROW(worker.finish(), pcl_uvol::InvalidArgument);
  EXPECT_FALSE(worker.isBusy());
  EXPECT_FALSE(worker.finish());
  worker.ask({{1.0}, false});
  EXPECT_EQ(1.0, worker.finish()->request.isovalues.back());
  worker.ask({{-1.0}, false}); // nobody asks what became of it
}

TEST(SurfaceWorker, EndsWhatIsUnderWay)
{
  Gate gate;
  {
    SurfaceWorker worker([&](const SurfaceRequest& request,
                             unsigned,
                             const ProgressCallback& progress) -> ExtractedSurface {
      gate.begun.set_value();
      while (true)
        progress("extract", request.isovalues.back());
    });
    worker.ask({{1.0}, false});
    gate.begun.get_future().wait();
    worker.ask({{2.0}, false});
  }
  SUCCEED() << "its thread has ended";
}

} // namespace test_surface_worker
