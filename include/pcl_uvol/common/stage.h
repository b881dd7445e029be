// SPDX-License-Identifier: BSD-3-Clause
// What the stages have in common besides their input: parameters, threads, progress,
// and a report of counts and milliseconds per step, in the order in which they came.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/message.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Called while a stage runs, with the name of the step and the part of it that
 * is done, in [0, 1]. Called from the stage's threads, one at a time, at most some
 * hundred times per step. An exception that it throws ends the stage and reaches the
 * stage's caller: the way to interrupt it. */
using ProgressCallback = std::function<void(const std::string& step, double done)>;

/** \brief Counts (samples used, non-finite, duplicates, ...), wall-clock times and
 * notes of one run of a stage. Names are lower-case words joined by underscores. */
struct PCL_UVOL_EXPORTS Report {
  std::vector<std::pair<std::string, std::uint64_t>> counts;
  std::vector<std::pair<std::string, double>> milliseconds;
  /** What the user should know although the run succeeded. */
  std::vector<Message> warnings;
  /** Called with the progress; empty: no calls. */
  ProgressCallback progress;

  /** \brief Add to the count of that name; a new name starts at 0.
   * \param name lower-case words joined by underscores
   * \param value what is added */
  void
  count(const std::string& name, std::uint64_t value);

  /** \brief Add to a count of the samples that a stage reads. Later stages read the
   * same ones: merge() does not add theirs to it.
   * \param name as of count()
   * \param value what is added */
  void
  countSamples(const std::string& name, std::uint64_t value);

  /** \brief Make that the count of that name, whatever it was.
   * \param name as of count()
   * \param value the new count */
  void
  setCount(const std::string& name, std::uint64_t value);

  /** \brief The count of that name, 0 if it does not exist.
   * \param name as of count() */
  std::uint64_t
  getCount(const std::string& name) const;

  /** \brief Add to the time of that step.
   * \param step name of the step
   * \param milliseconds_spent what is added */
  void
  time(const std::string& step, double milliseconds_spent);

  /** \brief Append a warning.
   * \param code row of the table of messages
   * \param values all that the text of that row holds */
  void
  warn(std::string code, std::vector<MessageValue> values = {});

  /** \brief Append those of several that the report does not have yet.
   * \param messages in the order in which they are appended */
  void
  warn(const std::vector<Message>& messages);

  /** \brief Append the counts, times and warnings of another stage.
   * \param other report of a stage that this one ran */
  void
  merge(const Report& other);

private:
  std::vector<std::string> of_samples_; ///< names of counts
};

/** \brief One step of a stage: the time from construction to destruction goes to the
 * report, what is done of it to the report's progress. */
class PCL_UVOL_EXPORTS StepTimer {
public:
  /** \param total work of the step, in any unit; 0: its progress is not reported
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
  std::mutex progress_mutex_;
  std::uint64_t reported_ = 0; // guarded by progress_mutex_
  std::chrono::steady_clock::time_point start_;
};

/** \brief Base of the stages, beside pcl::PCLBase. */
class Stage {
public:
  /** \brief 0 (default) = all cores. The result does not depend on it. */
  void
  setNumberOfThreads(unsigned threads)
  {
    threads_ = threads;
  }

  /** \return The number of threads that was set; 0: all cores. */
  unsigned
  getNumberOfThreads() const
  {
    return threads_;
  }

  /** \brief Set a function that is called while the stage runs; see ProgressCallback.
   * Default: no calls. */
  void
  setProgressCallback(const ProgressCallback& progress)
  {
    progress_ = progress;
  }

  /** \brief Counts and times of the last run; each stage lists its counts. */
  const Report&
  getReport() const
  {
    return report_;
  }

protected:
  Stage() = default;
  ~Stage() = default;

  /** \brief An empty report that passes on the stage's progress. */
  void
  startReport()
  {
    report_ = Report();
    report_.progress = progress_;
  }

  unsigned threads_ = 0;
  Report report_;

private:
  ProgressCallback progress_;
};

/** \brief Base of the stages whose parameters are a plain struct; their setters set its
 * members one by one. */
template <typename ParametersT>
class ParameterStage : public Stage {
public:
  using Parameters = ParametersT;

  /** \brief All of them at once; they are checked when the stage runs. */
  void
  setParameters(const Parameters& parameters)
  {
    parameters_ = parameters;
  }

  /** \return The parameters that the next run will have. */
  const Parameters&
  getParameters() const
  {
    return parameters_;
  }

protected:
  ParameterStage() = default;
  ~ParameterStage() = default;

  Parameters parameters_;
};

} // namespace pcl_uvol
