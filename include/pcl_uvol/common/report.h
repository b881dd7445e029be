// SPDX-License-Identifier: BSD-3-Clause
// What a stage did: counts and milliseconds per step, in the order in which they came.
#pragma once

#include <pcl_uvol/common/export.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Counts (samples used, non-finite, duplicates, ...), wall-clock times and
 * notes of one run of a stage. Names are lower-case words joined by underscores. */
struct PCL_UVOL_EXPORTS Report {
  std::vector<std::pair<std::string, std::uint64_t>> counts;
  std::vector<std::pair<std::string, double>> milliseconds;
  /** One sentence each: what the user should know although the run succeeded. */
  std::vector<std::string> warnings;

  /** \brief Add to the count of that name; a new name starts at 0. */
  void
  count(const std::string& name, std::uint64_t value);

  /** \brief The count of that name, 0 if there is none. */
  std::uint64_t
  getCount(const std::string& name) const;

  /** \brief Add to the time of that step. */
  void
  time(const std::string& step, double milliseconds_spent);

  /** \brief Append the counts, times and warnings of another stage. */
  void
  merge(const Report& other);
};

/** \brief Measures one step: the time from construction to destruction goes to the
 * report.
 */
class PCL_UVOL_EXPORTS StepTimer {
public:
  StepTimer(Report& report, std::string step)
      : report_(report)
      , step_(std::move(step))
      , start_(std::chrono::steady_clock::now())
  {
  }
  StepTimer(const StepTimer&) = delete;
  StepTimer&
  operator=(const StepTimer&) = delete;
  ~StepTimer();

private:
  Report& report_;
  std::string step_;
  std::chrono::steady_clock::time_point start_;
};

} // namespace pcl_uvol
