// SPDX-License-Identifier: BSD-3-Clause
// Files that broke a tool once, through every tool that reads such ones: a result or
// one sentence, soon.
#include "support/broken_files.h"
#include "tools/sentences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace test_broken_files_in_tools {

using uvol_test::runCommand;

class BrokenFilesInTools : public testing::TestWithParam<std::string> {
protected:
  BrokenFilesInTools()
  {
    writeBrokenFiles(folder_);
    files_ = folder_.list();
  }

  void
  runOn(const std::string& file) const
  {
    const std::string tool = GetParam().substr(0, GetParam().find(' '));
    std::string line = GetParam();
    line.replace(line.find("IN"), 2, file);
    SCOPED_TRACE(line);
    const auto result = runCommand("cd '" + folder_ / "" + "' && timeout 20 " + line);
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << result.exit_code;
    expectSentences(tool, result);
    clearFolder(result.exit_code == 0);
  }

  /** Nothing is left but the output of a tool that succeeds. */
  void
  clearFolder(bool has_succeeded) const
  {
    for (const std::string& name : folder_.list()) {
      if (std::find(files_.begin(), files_.end(), name) != files_.end())
        continue;
      EXPECT_TRUE(has_succeeded && name.compare(0, 4, "out.") == 0) << name;
      std::filesystem::remove(folder_ / name);
    }
  }

  uvol_test::TemporaryFolder folder_;
  std::vector<std::string> files_;
};

TEST_P(BrokenFilesInTools, EndInASentenceOrAResult)
{
  for (const std::string& file : files_)
    runOn(file);
}

INSTANTIATE_TEST_SUITE_P(Tools,
                         BrokenFilesInTools,
                         testing::Values("uvol_info IN",
                                         "uvol_convert IN out.vtp",
                                         "uvol_isosurface IN out.ply -iso 0",
                                         "uvol_normals IN out.pcd",
                                         "uvol_splats IN out.csv",
                                         "uvol_render IN out.png -size 16x16",
                                         "uvol_raytrace IN out.png -size 16x16",
                                         "uvol_measure IN out.csv -iso 0"),
                         [](const auto& line) {
                           const std::string tool = line.param.substr(5);
                           return tool.substr(0, tool.find(' '));
                         });

} // namespace test_broken_files_in_tools
