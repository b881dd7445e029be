// SPDX-License-Identifier: BSD-3-Clause
// A tool that makes one file of another one, in a folder of its own.
#pragma once

#include "support/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace uvol_test {

class ToolTest : public testing::Test {
protected:
  ToolTest(std::string tool, const std::string& output)
      : tool_(std::move(tool))
      , out_(folder_ / output)
  {
  }

  CommandResult
  run(const std::string& options) const
  {
    return runCommand(tool_ + " " + in_ + " " + out_ + " " + options);
  }

  void
  expectSuccess(const std::string& options) const
  {
    const auto result = run(options);
    EXPECT_EQ(0, result.exit_code) << options << ": " << result.err;
  }

  /** That exit code, one sentence with that text, and no file but the input. */
  void
  expectFailure(const std::string& options,
                int exit_code,
                const std::string& text) const
  {
    const auto result = run(options);
    EXPECT_EQ(exit_code, result.exit_code) << options << ": " << result.err;
    EXPECT_NE(std::string::npos, result.err.find(text))
        << options << ": " << result.err;
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
    EXPECT_EQ(std::vector<std::string>{"in.csv"}, folder_.list()) << options;
  }

  const std::string tool_;
  TemporaryFolder folder_;
  std::string in_ = folder_ / "in.csv", out_;
};

} // namespace uvol_test
