// SPDX-License-Identifier: BSD-3-Clause
// A thread that one context is current on for all of its life.
#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <queue>
#include <thread>

namespace pcl_uvol {

/** \brief Executes tasks one after the other. The destructor lets those that wait
 * finish. */
class ContextThread {
public:
  ContextThread();
  ContextThread(const ContextThread&) = delete;
  ContextThread&
  operator=(const ContextThread&) = delete;
  ~ContextThread();

  /** \brief Execute a task on the thread, wait for its end and rethrow its exception.
   * On the thread itself the task is executed at once. */
  void
  run(const std::function<void()>& task);

private:
  void
  work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::queue<std::packaged_task<void()>> tasks_; // guarded by mutex_
  bool ends_ = false;                            // guarded by mutex_
  std::thread thread_;                           // last: it uses the others
};

} // namespace pcl_uvol
