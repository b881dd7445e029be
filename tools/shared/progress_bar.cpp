// SPDX-License-Identifier: BSD-3-Clause
#include "shared/progress_bar.h"

#include <cmath>
#include <iostream>
#include <unistd.h>

namespace uvol_tools {

namespace {

constexpr std::size_t bar_width = 40;
/** Shorter steps are not worth a bar. */
constexpr std::chrono::milliseconds patience(300);
constexpr std::chrono::milliseconds redraw_interval(100);

} // namespace

ProgressBar::ProgressBar(bool always)
    : is_seen_(always || isatty(STDERR_FILENO) != 0)
{
}

ProgressBar::~ProgressBar()
{
  wipe();
}

void
ProgressBar::wipe()
{
  if (drawn_)
    std::cerr << "\r\033[K" << std::flush;
  drawn_ = false;
}

void
ProgressBar::operator()(const std::string& step, double done)
{
  if (!is_seen_)
    return;
  const auto now = Clock::now();
  if (step != step_ || done <= 0.0) {
    step_ = step;
    step_start_ = last_drawn_ = now;
  }
  if (done >= 1.0) {
    wipe();
    return;
  }
  if (now - step_start_ < patience || now - last_drawn_ < redraw_interval)
    return;
  last_drawn_ = now;
  drawn_ = true;
  const double elapsed = std::chrono::duration<double>(now - step_start_).count();
  const auto filled = static_cast<std::size_t>(done * bar_width);
  std::cerr << "\r\033[K" << step << " [" << std::string(filled, '=')
            << std::string(bar_width - filled, ' ') << "] "
            << static_cast<int>(100.0 * done) << " %, "
            << static_cast<long>(std::ceil(elapsed * (1.0 - done) / done)) << " s left"
            << std::flush;
}

} // namespace uvol_tools
