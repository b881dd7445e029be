// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/surface_worker.h"

#include <utility>

namespace uvol_tools {

namespace {

/** Thrown through an extraction to end it. */
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
    lock.unlock();
    extract(request);
    lock.lock();
    is_working_ = false;
    changed_.notify_all();
  }
}

void
SurfaceWorker::extract(const SurfaceRequest& request)
{
  std::optional<Result> result;
  std::exception_ptr error;
  try {
    result = Result{request, extract_(request, [this](const std::string&, double) {
                      if (is_ending_)
                        throw Ended();
                    })};
  }
  catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  result_ = std::move(result);
  error_ = std::move(error);
}

} // namespace uvol_tools
