// SPDX-License-Identifier: BSD-3-Clause
// A step whose parts take long looks at its listener in between.
#pragma once

#include <pcl_uvol/common/stage.h>

#include <chrono>
#include <string>
#include <utility>

namespace pcl_uvol {

/** \brief Tells what is done of a step again while a part of it runs, so that whoever
 * listens can end it: some twenty times a second at most. */
class ProgressReminder {
public:
  /** \param progress empty: nobody listens
   * \param step its name */
  ProgressReminder(const ProgressCallback& progress, std::string step)
      : progress_(progress)
      , step_(std::move(step))
      , reported_at_(Clock::now())
  {
  }

  /** \brief The share of the step that is done, in [0, 1], from now on. */
  void
  setDone(double done)
  {
    done_ = done;
  }

  /** \brief To be called between pieces of work, by one thread at a time. */
  void
  remind()
  {
    constexpr std::chrono::milliseconds pause(50);
    if (!progress_ || Clock::now() - reported_at_ < pause)
      return;
    reported_at_ = Clock::now();
    progress_(step_, done_);
  }

private:
  using Clock = std::chrono::steady_clock;

  const ProgressCallback& progress_;
  std::string step_;
  double done_ = 0.0;
  Clock::time_point reported_at_;
};

} // namespace pcl_uvol
