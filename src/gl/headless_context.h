// SPDX-License-Identifier: BSD-3-Clause
// What contexts of our own share: a thread that the context is current on for all of
// its life.
#pragma once

#include "gl/context.h"

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <queue>
#include <thread>

namespace pcl_uvol {

/** \brief Executes tasks one after the other on a thread of its own. */
class HeadlessContext : public GlContext {
public:
  /** \brief On the thread itself the task is executed at once. */
  void
  run(const std::function<void()>& task) final;

protected:
  explicit HeadlessContext(const std::string& name);

  /** \brief Lets tasks that wait finish. What is current on the thread has to be
   * released before. */
  ~HeadlessContext() override;

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
