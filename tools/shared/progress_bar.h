// SPDX-License-Identifier: BSD-3-Clause
// A bar with the time left for steps that take long; nothing where stderr is no
// terminal.
#pragma once

#include <chrono>
#include <string>

namespace uvol_tools {

/** \brief A pcl_uvol::ProgressCallback (by std::ref); wipes its line when it goes. */
class ProgressBar {
public:
  /** \param always draw on a stderr that is no terminal as well */
  explicit ProgressBar(bool always = false);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar&
  operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  void
  operator()(const std::string& step, double done);

private:
  void
  wipe();

  using Clock = std::chrono::steady_clock;
  bool is_seen_;
  bool drawn_ = false;
  std::string step_;
  Clock::time_point step_start_, last_drawn_;
};

} // namespace uvol_tools
