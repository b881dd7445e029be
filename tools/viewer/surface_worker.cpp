// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/surface_worker.h"

#include <chrono>
#include <utility>

namespace uvol_tools {

namespace {

/** Thrown through what is under way to end it. */
struct Ended {};

/** How long a slider that rests between two moves of a hand keeps its draft. */
constexpr std::chrono::milliseconds pause(100);

} // namespace

SurfaceWorker::SurfaceWorker(Extract extract, double milliseconds)
    : extract_(std::move(extract))
    , choice_(milliseconds)
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
    is_awaited_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return !waiting_ && !is_working_; });
    is_awaited_ = false;
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
    answer(request);
    lock.lock();
    is_working_ = false;
    changed_.notify_all();
  }
}

void
SurfaceWorker::answer(const SurfaceRequest& request)
{
  const unsigned thinning = is_awaited_ ? 1 : choice_.choose();
  const bool is_drafted = thinning > 1 && draft(request, thinning);
  if (!is_drafted || rests())
    complete(request, is_drafted);
}

bool
SurfaceWorker::draft(const SurfaceRequest& request, unsigned thinning)
{
  try {
    std::optional<Result> result =
        extract(request, thinning, [this] { return is_awaited_.load(); });
    if (!result->surface.cloud)
      return false;
    give(std::move(result), nullptr);
    return true;
  }
  catch (...) { // what is wrong is told by the surface of all samples
    return false;
  }
}

void
SurfaceWorker::complete(const SurfaceRequest& request, bool is_drafted)
{
  try {
    give(extract(request, 1, [&] { return is_drafted && is_overtaken_; }), nullptr);
  }
  catch (const Ended&) {
  }
  catch (...) {
    give(std::nullopt, std::current_exception());
  }
}

SurfaceWorker::Result
SurfaceWorker::extract(const SurfaceRequest& request,
                       unsigned thinning,
                       const std::function<bool()>& is_unwanted)
{
  const auto end_if_unwanted = [&](const std::string&, double) {
    if (is_ending_ || is_unwanted())
      throw Ended();
  };
  const auto start = std::chrono::steady_clock::now();
  Result result{request, extract_(request, thinning, end_if_unwanted)};
  if (result.surface.prepared)
    result.surface.prepared->findFootprints(end_if_unwanted);
  choice_.addTime(thinning,
                  std::chrono::duration<double, std::milli>(
                      std::chrono::steady_clock::now() - start)
                      .count());
  return result;
}

void
SurfaceWorker::give(std::optional<Result>&& result, std::exception_ptr error)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  result_ = std::move(result);
  error_ = std::move(error);
}

bool
SurfaceWorker::rests()
{
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(
      lock, pause, [this] { return is_ending_ || is_awaited_ || is_overtaken_; });
  return !is_ending_ && !is_overtaken_;
}

} // namespace uvol_tools
