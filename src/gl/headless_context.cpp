// SPDX-License-Identifier: BSD-3-Clause
#include "gl/headless_context.h"

#include <utility>

namespace pcl_uvol {

HeadlessContext::HeadlessContext(const std::string& name)
    : GlContext(name)
    , thread_([this] { work(); })
{
}

HeadlessContext::~HeadlessContext()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void
HeadlessContext::run(const std::function<void()>& task)
{
  if (std::this_thread::get_id() == thread_.get_id())
    return task();
  std::packaged_task<void()> packaged(task);
  std::future<void> result = packaged.get_future();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks_.push(std::move(packaged));
  }
  changed_.notify_one();
  result.get();
}

void
HeadlessContext::work()
{
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
    if (tasks_.empty())
      return;
    std::packaged_task<void()> task = std::move(tasks_.front());
    tasks_.pop();
    lock.unlock();
    task();
    lock.lock();
  }
}

} // namespace pcl_uvol
