// SPDX-License-Identifier: BSD-3-Clause
// A tool that makes one file of another one, in a folder of its own.
#pragma once

#include "common/scalar_field.h"
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace uvol_test {

/** One number per point; coordinates with the origin added. */
inline std::vector<double>
fieldOf(const pcl_uvol::Dataset& dataset, const std::string& name)
{
  const auto view = pcl_uvol::viewOf(dataset.cloud);
  const pcl_uvol::ScalarField field(view.fields, name);
  std::vector<double> values;
  for (std::size_t i = 0; i < view.count; ++i)
    values.push_back(field.read(view.point(i)));
  if (name.size() == 1 && name[0] >= 'x')
    for (double& value : values)
      value += dataset.origin[static_cast<std::size_t>(name[0] - 'x')];
  return values;
}

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

  /** The output of a run that succeeds. */
  pcl_uvol::Dataset
  resultOf(const std::string& options) const
  {
    expectSuccess(options);
    return pcl_uvol::loadDataset(out_);
  }

  /** That error, and no new file: see expectError() of sentences.h. */
  void
  expectError(const std::string& options,
              const std::string& code,
              const std::string& value = "") const
  {
    SCOPED_TRACE(options);
    const auto before = folder_.list();
    const auto result = run(options + " -json");
    uvol_test::expectError(result, code, value);
    expectSentences(tool_.substr(tool_.rfind('/') + 1), result);
    EXPECT_EQ(before, folder_.list());
  }

  /** Wrong command lines, each of which ends with one of those: the error names its
   * first word. */
  void
  expectUsageErrors(const std::string& options,
                    const std::vector<std::string>& wrong) const
  {
    for (const std::string& end : wrong)
      expectError(options + end, "command_line", end.substr(0, end.find(' ')));
  }

  const std::string tool_;
  TemporaryFolder folder_;
  std::string in_ = folder_ / "in.csv", out_;
};

/** Command lines in a folder of their own. */
class FolderTest : public testing::Test {
protected:
  /** \param arguments behind "uvol_" */
  CommandResult
  runTool(const std::string& arguments) const
  {
    return runCommand("cd '" + (folder_ / "") + "' && " PCL_UVOL_TOOL_DIR "/uvol_" +
                      arguments);
  }

  /** That error, and no new file: see expectError() of sentences.h. */
  void
  expectError(const std::string& arguments,
              const std::string& code,
              const std::string& value = "") const
  {
    SCOPED_TRACE(arguments);
    const auto before = folder_.list();
    uvol_test::expectError(runTool(arguments + " -json"), code, value);
    EXPECT_EQ(before, folder_.list());
  }

  void
  write(const std::string& name, const std::string& text) const
  {
    writeFile(folder_ / name, text);
  }

  bool
  exists(const std::string& name) const
  {
    return std::filesystem::exists(folder_ / name);
  }

  TemporaryFolder folder_;
};

} // namespace uvol_test
