// SPDX-License-Identifier: BSD-3-Clause
// The layers of the house: includes go downwards only, and the check notices if one
// does not.
#include "support/environment.h"

#include <gtest/gtest.h>

namespace test_layers {

const std::string check = "bash '" PCL_UVOL_SOURCE_DIR "/tests/tools/check_layers.sh' ";

TEST(Layers, IncludesGoDownwards)
{
  const auto result = uvol_test::runCommand(check + PCL_UVOL_SOURCE_DIR);
  EXPECT_EQ(0, result.exit_code) << result.out << result.err;
}

TEST(Layers, ABreachIsNoticed)
{
  for (const char* include : {"<pcl_uvol/isosurface/isosurface_extraction.h>",
                              "\"isosurface/isopoints.h\"",
                              "\"neighbors/kd_tree.h\"",
                              "\"bad_too.h\"",
                              "\"../isosurface/isopoints.h\"",
                              "\"./bad_too.h\"",
                              "\"common/../isosurface/isopoints.h\"",
                              "<pcl_uvol/common/../isosurface/isosurface_extraction.h>",
                              "  \"isosurface/isopoints.h\"",
                              "<vtkPolyData.h>"}) {
    const uvol_test::TemporaryFolder folder;
    const std::string header = "include/pcl_uvol/neighbors";
    uvol_test::runCommand("mkdir -p '" + (folder / header) + "'");
    uvol_test::writeFile(folder / (header + "/bad.h"),
                         "#include " + std::string(include) + "\n");
    EXPECT_EQ(1, uvol_test::runCommand(check + (folder / "")).exit_code) << include;
  }
}

/** Sources may include private headers, but of their own module and those below. */
TEST(Layers, SourcesAreLookedAtAsWell)
{
  const uvol_test::TemporaryFolder folder;
  uvol_test::runCommand("mkdir -p '" + (folder / "src/neighbors") + "'");
  const auto check_source = [&](const std::string& include) {
    uvol_test::writeFile(folder / "src/neighbors/source.cpp", "#include " + include);
    return uvol_test::runCommand(check + (folder / "")).exit_code;
  };
  EXPECT_EQ(0, check_source("\"neighbors/kd_tree.h\"\n"));
  EXPECT_EQ(0, check_source("\"common/records.h\"\n"));
  EXPECT_EQ(1, check_source("\"mesh/remeshing.h\"\n"));
  EXPECT_EQ(1, check_source("\"neighbors/../mesh/remeshing.h\"\n"));
  EXPECT_EQ(1, check_source("\"kd_tree.h\"\n"));
}

/** Who includes a stage can catch what it throws. */
TEST(Layers, HeadersHaveTheirExceptions)
{
  const uvol_test::TemporaryFolder folder;
  uvol_test::runCommand("mkdir -p '" + (folder / "include/pcl_uvol/mesh") + "'");
  const auto check_header = [&](const std::string& includes) {
    uvol_test::writeFile(folder / "include/pcl_uvol/mesh/stage.h",
                         includes + "/** \\throws InvalidArgument for bad input */\n");
    return uvol_test::runCommand(check + (folder / "")).exit_code;
  };
  EXPECT_EQ(0, check_header("#include <pcl_uvol/common/exceptions.h>\n"));
  EXPECT_EQ(1, check_header(""));
}

} // namespace test_layers
