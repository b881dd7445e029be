// SPDX-License-Identifier: BSD-3-Clause
// The thread of the viewer's isosurfaces, with extractions that the tests hold.
#include "viewer/surface_worker.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <future>
#include <vector>

namespace {

using pcl_uvol::IsosurfaceResult;
using pcl_uvol::ProgressCallback;
using uvol_tools::SurfaceRequest;
using uvol_tools::SurfaceWorker;

/** A surface whose field tells what it is of. */
IsosurfaceResult
makeResult(const SurfaceRequest& request)
{
  IsosurfaceResult result;
  result.field = std::to_string(request.isovalues.back());
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
  EXPECT_EQ(std::to_string(3.0), result->surface.field);
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
                             const ProgressCallback& progress) -> IsosurfaceResult {
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
