// SPDX-License-Identifier: BSD-3-Clause
// Random command lines of the tool that opens a window, which it closes with a picture.
#include "support/random_lines.h"
#include "support/virtual_display.h"

#include <gtest/gtest.h>

namespace test_random_viewer_options {

using uvol_test::RandomLines;
using uvol_test::RandomTool;

class RandomViewerOptions : public uvol_test::DisplayTest {
protected:
  const RandomTool viewer_{
      "viewer", "png", "-size 16x16;-size 16x16 -field f", 1, "-screenshot "};
};

// Each line costs a second or so: Mesa draws in software, and the display sends it.
TEST_F(RandomViewerOptions, EndInASentenceOrAResult)
{
  RandomLines(viewer_).run(0, 10);
}

TEST_F(RandomViewerOptions, EndInASentenceOrAResult_long)
{
  RandomLines(viewer_).run(10, 190);
}

} // namespace test_random_viewer_options
