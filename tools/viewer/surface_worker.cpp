// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/surface_worker.h"

#include <utility>

namespace uvol_tools {

namespace {

/** Thrown through what is under way to end it. */
struct Ended {};

} // namespace

SurfaceWorker::SurfaceWorker(Extract extract)
    : extract_(std::move(extract))
    , thread_([this] { work(); })
{
}

SurfaceWorker::~SurfaceWorker()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void
SurfaceWorker::ask(const SurfaceRequest& request)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_ = request;
    is_overtaken_ = true;
  }
  changed_.notify_all();
}

bool
SurfaceWorker::isBusy() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return waiting_ || is_working_ || result_ || error_;
}

std::optional<SurfaceWorker::Result>
SurfaceWorker::take()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const std::exception_ptr error = std::exchange(error_, nullptr))
    std::rethrow_exception(error);
  return std::exchange(result_, std::nullopt);
}

std::optional<SurfaceWorker::Result>
SurfaceWorker::finish()
{
  {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return !waiting_ && !is_working_; });
  }
  return take();
}

void
SurfaceWorker::work()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ending_ || waiting_; });
    if (is_ending_)
      return;
    const SurfaceRequest request = *std::exchange(waiting_, std::nullopt);
    is_working_ = true;
    is_overtaken_ = false;
    lock.unlock();
    if (const auto prepared = extract(request))
      findFootprints(*prepared);
    lock.lock();
    is_working_ = false;
    changed_.notify_all();
  }
}

std::shared_ptr<pcl_uvol::PreparedSurface>
SurfaceWorker::extract(const SurfaceRequest& request)
{
  std::shared_ptr<pcl_uvol::PreparedSurface> prepared;
  std::optional<Result> result;
  std::exception_ptr error;
  try {
    result = Result{request, extract_(request, [this](const std::string&, double) {
                      if (is_ending_)
                        throw Ended();
                    })};
    prepared = result->surface.prepared;
  }
  catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  result_ = std::move(result);
  error_ = std::move(error);
  return prepared;
}

void
SurfaceWorker::findFootprints(pcl_uvol::PreparedSurface& prepared)
{
  const auto end_if_overtaken = [this](const std::string&, double) {
    if (is_ending_ || is_overtaken_)
      throw Ended();
  };
  try {
    end_if_overtaken("", 0.0);
    prepared.findFootprints(end_if_overtaken);
  }
  catch (...) { // it is drawn without them, and tells why when it is drawn with them
  }
}

} // namespace uvol_tools
