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
#include <vector>

namespace {

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
  SurfaceWorker worker([&](const SurfaceRequest& request, const ProgressCallback&) {
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
  SurfaceWorker worker([&](const SurfaceRequest& request, const ProgressCallback&) {
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
  pcl::toPCLPointCloud2(*uvol_test::makeTorusKnot(20000, 1), *cloud);
  result.whole = result.cloud = cloud;
  result.prepared = std::make_shared<pcl_uvol::PreparedSurface>(*cloud);
  return result;
}

/** Not waiting for footprints. */
std::vector<std::uint8_t>
draw(const ExtractedSurface& surface)
{
  pcl_uvol::ImageSpaceRenderer<pcl::PCLPointCloud2> renderer;
  renderer.setInputCloud(surface.cloud);
  renderer.setPreparedSurface(surface.prepared);
  renderer.setHasty(surface.prepared != nullptr);
  renderer.setSize(300, 200);
  pcl_uvol::Image image;
  renderer.render(image);
  return image.color;
}

TEST(SurfaceWorker, FindsFootprintsOfWhatIsNotOvertaken)
{
  SurfaceWorker worker([](const SurfaceRequest& request, const ProgressCallback&) {
    return makeDrawn(request);
  });
  worker.ask({{1.0}, false});
  std::optional<SurfaceWorker::Result> result;
  while (!(result = worker.take()))
    std::this_thread::yield();
  const auto early = draw(result->surface); // with footprints or without
  EXPECT_FALSE(worker.finish());
  EXPECT_FALSE(worker.isBusy());
  ExtractedSurface unprepared = result->surface;
  unprepared.prepared = nullptr;
  const auto expected = draw(unprepared);
  EXPECT_EQ(expected, draw(result->surface));
  EXPECT_EQ(expected.size(), early.size());

  // Whatever came before, the last one has them.
  for (int isovalue = 2; isovalue < 8; ++isovalue) {
    worker.ask({{static_cast<double>(isovalue)}, false});
    while (!(result = worker.take()))
      std::this_thread::yield();
  }
  EXPECT_EQ(7u, result->surface.report.getCount("isovalue"));
  EXPECT_FALSE(worker.finish());
  EXPECT_EQ(expected, draw(result->surface));
}

TEST(SurfaceWorker, ThrowsWhatExtractionsThrowAndGoesOn)
{
  SurfaceWorker worker([](const SurfaceRequest& request, const ProgressCallback&) {
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

} // namespace
