// SPDX-License-Identifier: BSD-3-Clause
#include "shared/interruptible.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace pcl_uvol::python {

namespace py = pybind11;

namespace {

/** How long Ctrl-C and progress may wait: below what people notice. */
constexpr std::chrono::milliseconds patience(30);

/** Ends work whose caller does not wait for the result. */
class Cancelled {};

/** What the working and the waiting thread tell each other. */
class Exchange {
public:
  void
  advance(const std::string& step, double done)
  {
    if (is_cancelled_)
      throw Cancelled();
    const std::lock_guard<std::mutex> lock(mutex_);
    step_ = step;
    done_ = done;
    is_news_ = true;
  }

  void
  cancel()
  {
    is_cancelled_ = true;
  }

  void
  finish()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_finished_ = true;
    changed_.notify_one();
  }

  /** \return whether the work has ended */
  bool
  wait()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, patience, [&] { return is_finished_; });
  }

  /** Tell the latest progress, if there was any since the last call. */
  void
  report(const py::object& progress)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!is_news_ || progress.is_none())
      return;
    is_news_ = false;
    const std::string step = step_;
    const double done = done_;
    lock.unlock(); // the work goes on while Python runs
    progress(step, done);
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> is_cancelled_{false};
  bool is_finished_ = false, is_news_ = false;
  std::string step_;
  double done_ = 0.0;
};

/** Run what only the caller's thread may run.
 * \return what it threw, or null */
std::exception_ptr
attendToPython(Exchange& exchange, const py::object& progress)
{
  const py::gil_scoped_acquire lock;
  try {
    exchange.report(progress);
    if (PyErr_CheckSignals() != 0)
      throw py::error_already_set();
  }
  catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

} // namespace

void
runInterruptibly(const py::object& progress,
                 const std::function<void(const ProgressCallback&)>& work)
{
  Exchange exchange;
  std::exception_ptr failure, interruption;
  {
    const py::gil_scoped_release unlocked;
    std::thread worker([&] {
      try {
        work([&](const std::string& step, double done) {
          exchange.advance(step, done);
        });
      }
      catch (...) {
        failure = std::current_exception();
      }
      exchange.finish();
    });
    while (!exchange.wait())
      if (!interruption && (interruption = attendToPython(exchange, progress)))
        exchange.cancel();
    worker.join();
  }
  if (interruption)
    std::rethrow_exception(interruption);
  if (failure)
    std::rethrow_exception(failure);
  exchange.report(progress);
}

} // namespace pcl_uvol::python
