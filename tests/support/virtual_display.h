// SPDX-License-Identifier: BSD-3-Clause
// A display for tests that open windows.
#pragma once

#include <gtest/gtest.h>

#include <memory>
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

/** \brief Fixture of tests that open windows: one display for all of them, as VTK keeps
 * connections to it. A SetUp() of theirs calls this one first, and uses the display
 * only if not IsSkipped(). */
class DisplayTest : public testing::Test {
protected:
  static void
  TearDownTestSuite();

  void
  SetUp() override;

private:
  static std::unique_ptr<VirtualDisplay> display_;
};

} // namespace uvol_test
