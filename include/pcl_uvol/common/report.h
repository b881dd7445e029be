// SPDX-License-Identifier: BSD-3-Clause
// What a stage does: its progress while it runs; counts and milliseconds per step, in
// the order in which they came, when it is done.
#pragma once

#include <pcl_uvol/common/export.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Told while a stage runs: the name of the step and the part of it that is
 * done, in [0, 1]. Called from the stage's threads, one at a time, at most some hundred
 * times per step. An exception that it throws ends the stage and reaches the stage's
 * caller: the way to interrupt it. */
using ProgressCallback = std::function<void(const std::string& step, double done)>;

/** \brief Counts (samples used, non-finite, duplicates, ...), wall-clock times and
 * notes of one run of a stage. Names are lower-case words joined by underscores. */
struct PCL_UVOL_EXPORTS Report {
  std::vector<std::pair<std::string, std::uint64_t>> counts;
  std::vector<std::pair<std::string, double>> milliseconds;
  /** One sentence each: what the user should know although the run succeeded. */
  std::vector<std::string> warnings;
  /** Empty: nobody is told. */
  ProgressCallback progress;

  /** \brief Add to the count of that name; a new name starts at 0.
   * \param name lower-case words joined by underscores
   * \param value what is added */
  void
  count(const std::string& name, std::uint64_t value);

  /** \brief Make that the count of that name, whatever it was.
   * \param name as of count()
   * \param value the new count */
  void
  setCount(const std::string& name, std::uint64_t value);

  /** \brief The count of that name, 0 if there is none.
   * \param name as of count() */
  std::uint64_t
  getCount(const std::string& name) const;

  /** \brief Add to the time of that step.
   * \param step name of the step
   * \param milliseconds_spent what is added */
  void
  time(const std::string& step, double milliseconds_spent);

  /** \brief Append the counts, times and warnings of another stage.
   * \param other report of a stage that this one ran */
  void
  merge(const Report& other);
};

/** \brief One step of a stage: the time from construction to destruction goes to the
 * report, what is done of it to the report's progress. */
class PCL_UVOL_EXPORTS StepTimer {
public:
  /** \param total work of the step, in any unit; 0: its progress is not told
   * \param report gets the time; must outlive the timer
   * \param step name of the step */
  StepTimer(Report& report, std::string step, std::uint64_t total = 0);
  StepTimer(const StepTimer&) = delete;
  StepTimer&
  operator=(const StepTimer&) = delete;
  ~StepTimer();

  /** \brief More of the work is done; from any thread.
   * \param work what is done since the last call, in the unit of the total */
  void
  advance(std::uint64_t work);

private:
  Report& report_;
  std::string step_;
  std::uint64_t total_;
  std::atomic<std::uint64_t> done_{0};
  std::mutex telling_;
  std::uint64_t told_ = 0; // guarded by telling_
  std::chrono::steady_clock::time_point start_;
};

} // namespace pcl_uvol
