// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/stage.h>

#include <algorithm>
#include <new>

namespace pcl_uvol {

namespace {

template <typename T>
void
addTo(std::vector<std::pair<std::string, T>>& entries, const std::string& name, T value)
{
  for (auto& [entry_name, entry_value] : entries)
    if (entry_name == name) {
      entry_value += value;
      return;
    }
  entries.emplace_back(name, value);
}

template <typename T>
bool
contains(const std::vector<T>& items, const T& item)
{
  return std::find(items.begin(), items.end(), item) != items.end();
}

} // namespace

void
Report::count(const std::string& name, std::uint64_t value)
{
  addTo(counts, name, value);
}

void
Report::countSamples(const std::string& name, std::uint64_t value)
{
  count(name, value);
  if (!contains(of_samples_, name))
    of_samples_.push_back(name);
}

void
Report::setCount(const std::string& name, std::uint64_t value)
{
  count(name, 0);
  for (auto& [entry_name, entry_value] : counts)
    if (entry_name == name)
      entry_value = value;
}

std::uint64_t
Report::getCount(const std::string& name) const
{
  for (const auto& [entry_name, entry_value] : counts)
    if (entry_name == name)
      return entry_value;
  return 0;
}

void
Report::time(const std::string& step, double milliseconds_spent)
{
  addTo(milliseconds, step, milliseconds_spent);
}

void
Report::warn(std::string code, std::vector<MessageValue> values)
{
  warnings.emplace_back(std::move(code), std::move(values));
}

void
Report::warn(const std::vector<Message>& messages)
{
  for (const Message& message : messages)
    if (!contains(warnings, message))
      warnings.push_back(message);
}

void
Report::merge(const Report& other)
{
  const std::vector<std::string> reported = of_samples_;
  for (const auto& [name, value] : other.counts)
    if (!contains(other.of_samples_, name))
      count(name, value);
    else if (!contains(reported, name))
      countSamples(name, value);
  for (const auto& [step, value] : other.milliseconds)
    time(step, value);
  warn(other.warnings);
}

StepTimer::StepTimer(Report& report, std::string step, std::uint64_t total)
    : report_(report)
    , step_(std::move(step))
    , total_(total)
    , start_(std::chrono::steady_clock::now())
{
  if (report_.progress && total_ > 0)
    report_.progress(step_, 0.0);
}

void
StepTimer::advance(std::uint64_t work)
{
  if (!report_.progress || total_ == 0)
    return;
  constexpr double smallest_step = 0.005;
  done_ += work;
  const std::lock_guard<std::mutex> lock(progress_mutex_);
  const std::uint64_t done = std::min<std::uint64_t>(done_, total_); // work done twice
  if (done == reported_ ||
      (done < total_ && static_cast<double>(done - reported_) <
                            smallest_step * static_cast<double>(total_)))
    return;
  reported_ = done;
  report_.progress(step_, static_cast<double>(done) / static_cast<double>(total_));
}

StepTimer::~StepTimer()
{
  const std::chrono::duration<double, std::milli> spent =
      std::chrono::steady_clock::now() - start_;
  try {
    report_.time(step_, spent.count());
  }
  catch (const std::bad_alloc&) {
    // A time is no reason to end a program: what runs on meets the lack of memory too.
  }
}

} // namespace pcl_uvol
