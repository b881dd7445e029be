// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/report.h>

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

} // namespace

void
Report::count(const std::string& name, std::uint64_t value)
{
  addTo(counts, name, value);
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
Report::merge(const Report& other)
{
  for (const auto& [name, value] : other.counts)
    count(name, value);
  for (const auto& [step, value] : other.milliseconds)
    time(step, value);
  warnings.insert(warnings.end(), other.warnings.begin(), other.warnings.end());
}

StepTimer::~StepTimer()
{
  report_.time(step_,
               std::chrono::duration<double, std::milli>(
                   std::chrono::steady_clock::now() - start_)
                   .count());
}

} // namespace pcl_uvol
