// SPDX-License-Identifier: BSD-3-Clause
// A display for tests that open windows.
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace uvol_test {

/** \brief An X server without a screen (Xvfb), on a free display that $DISPLAY names
 * while the object lives. */
class VirtualDisplay {
public:
  /** \param arguments of Xvfb besides the display and its size
   * \throws std::runtime_error if it does not start */
  explicit VirtualDisplay(const std::vector<std::string>& arguments = {});
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay&
  operator=(const VirtualDisplay&) = delete;
  ~VirtualDisplay();

  /** \brief False: tests that need a display have to skip. */
  static bool
  isInstalled();

private:
  pid_t server_ = 0;
  std::string previous_; // $DISPLAY
};

} // namespace uvol_test
