// SPDX-License-Identifier: BSD-3-Clause
// uvol in front of the tools, completion of their command lines in bash, manual pages.
#include "support/environment.h"
#include "tools/json_warnings.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <set>
#include <sstream>

namespace test_uvol {

using testing::HasSubstr;
using testing::Not;
using uvol_test::runCommand;
using uvol_test::TemporaryFolder;

const std::string tool_folder = PCL_UVOL_TOOL_DIR;
const std::string source_folder = PCL_UVOL_SOURCE_DIR;

/** What bash offers for the last word of a command line. */
std::string
complete(const std::string& words)
{
  return runCommand("bash -c 'PATH=\"" + tool_folder + ":$PATH\"; . " + source_folder +
                    "/tools/completion/uvol.bash; COMP_WORDS=(" + words +
                    "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _uvol; echo "
                    "\"${COMPREPLY[*]}\"'")
      .out;
}

TEST(Uvol, ListsTheToolsWithWhatTheyDo)
{
  const auto result = uvol_test::runWell(tool_folder + "/uvol");
  for (const auto& entry :
       std::filesystem::directory_iterator(source_folder + "/tools"))
    if (const std::string name = entry.path().stem(); name.rfind("uvol_", 0) == 0) {
      if (std::filesystem::exists(tool_folder + "/" + name)) {
        EXPECT_THAT(result.out, HasSubstr("\n  " + name.substr(5) + " ")) << name;
      }
    }
  EXPECT_THAT(result.out, HasSubstr("Summarise files of samples"));
  EXPECT_EQ("", result.err);
}

TEST(Uvol, BecomesTheTool)
{
  const auto direct = runCommand(tool_folder + "/uvol_isosurface -h all");
  EXPECT_EQ(direct.out, runCommand(tool_folder + "/uvol isosurface -h all").out);
  EXPECT_EQ(runCommand(tool_folder + "/uvol_info -h").out,
            runCommand(tool_folder + "/uvol help info").out);
  const auto wrong = runCommand(tool_folder + "/uvol isosurface");
  EXPECT_EQ(2, wrong.exit_code);
  EXPECT_THAT(wrong.err,
              testing::AllOf(HasSubstr("uvol_isosurface: "), HasSubstr("<in>")));
}

TEST(Uvol, ToolsExplainEveryOptionBelowAHeading)
{
  for (const auto& entry : std::filesystem::directory_iterator(tool_folder))
    if (const std::string name = entry.path().filename(); name.rfind("uvol_", 0) == 0) {
      const std::string help = runCommand(entry.path().string() + " -h all").out;
      EXPECT_THAT(help, Not(HasSubstr("\nOptions:\n"))) << name;
    }
}

TEST(Uvol, ToolsExplainEveryOptionOnce)
{
  for (const auto& entry : std::filesystem::directory_iterator(tool_folder))
    if (const std::string name = entry.path().filename(); name.rfind("uvol_", 0) == 0) {
      std::istringstream help(runCommand(entry.path().string() + " -h all").out);
      std::set<std::string> options;
      for (std::string line; std::getline(help, line);)
        if (line.rfind("  -", 0) == 0) {
          const std::string option = line.substr(2, line.find(' ', 2) - 2);
          EXPECT_TRUE(options.insert(option).second) << name << ' ' << option;
        }
      EXPECT_THAT(options, testing::Contains("-threads")) << name;
    }
}

TEST(Uvol, ToolsExplainWhatIsUsedMostOnAScreen)
{
  constexpr int longest = 60;
  for (const auto& entry : std::filesystem::directory_iterator(tool_folder))
    if (const std::string name = entry.path().filename(); name.rfind("uvol_", 0) == 0) {
      const std::string help = runCommand(entry.path().string() + " -h").out;
      EXPECT_LE(std::count(help.begin(), help.end(), '\n'), longest) << name;
    }
}

TEST(Uvol, RefusesOtherToolsInOneSentence)
{
  const auto result = runCommand(tool_folder + "/uvol isosurfase");
  EXPECT_EQ(2, result.exit_code);
  EXPECT_THAT(result.err, HasSubstr("isosurface?"));
  EXPECT_EQ(2, runCommand(tool_folder + "/uvol ../bin/uvol_info").exit_code);
}

TEST(Uvol, ListsFormats)
{
  const auto result = uvol_test::runWell(tool_folder + "/uvol --list-formats");
  for (const char* const ending : {".pcd",
                                   ".csv",
                                   ".vts",
                                   ".stl",
                                   ".mhd",
                                   ".pvtp",
                                   ".las",
                                   ".npz",
                                   ".bgeo",
                                   ".vtkhdf"})
    EXPECT_THAT(result.out, HasSubstr(ending));
}

TEST(Completion, OffersToolsOptionsAndWords)
{
  EXPECT_THAT(complete("uvol iso"), HasSubstr("isosurface"));
  EXPECT_EQ("-color -colormap\n", complete("uvol isosurface -colo"));
  EXPECT_EQ("--color --colormap\n", complete("uvol_isosurface --colo"));
  EXPECT_EQ("inferno\n", complete("uvol_isosurface -colormap in"));
  EXPECT_EQ("linear\n", complete("uvol_isosurface --interpolation l"));
  EXPECT_EQ("input\n", complete("uvol isosurface -h in"));
}

TEST(Completion, OffersFieldsOfTheFile)
{
  const TemporaryFolder folder;
  const std::string csv = folder / "in.csv", pcd = folder / "in.pcd";
  std::ofstream(csv) << "x,y,z,rho,rate\n0,0,0,1,2\n";
  std::ofstream(pcd) << "VERSION 0.7\nFIELDS x y z rho\nSIZE 4 4 4 4\n";
  EXPECT_EQ("rho rate\n", complete("uvol_isosurface " + csv + " out.ply -field r"));
  EXPECT_EQ("rho,rate\n",
            complete("uvol cluster " + csv + " out.ply -attributes rho,ra"));
  EXPECT_EQ("rho\n", complete("uvol_isosurface " + pcd + " -color r"));
  EXPECT_EQ("\n", complete("uvol_isosurface none.csv -field r"));
  const std::string npz = folder / "in.npz";
  EXPECT_EQ(0, runCommand("uvol_convert '" + csv + "' '" + npz + "'").exit_code);
  EXPECT_EQ("rho rate\n", complete("uvol_isosurface " + npz + " -field r"));
}

TEST(Manual, ExplainsEveryOption)
{
  const TemporaryFolder folder;
  uvol_test::runWell("python3 " + source_folder + "/tools/manual/make_pages.py man " +
                     tool_folder + " " + (folder / "man") +
                     " uvol_isosurface uvol_probe");
  std::stringstream page;
  page << std::ifstream(folder / "man/uvol_isosurface.1").rdbuf();
  std::stringstream help(runCommand(tool_folder + "/uvol_isosurface -h all").out);
  int options = 0;
  for (std::string line; std::getline(help, line);)
    if (line.rfind("  -", 0) == 0) {
      std::string name = "\\fB";
      for (const char c : line.substr(2, line.find(' ', 3) - 2))
        name += c == '-' ? std::string("\\-") : std::string(1, c);
      EXPECT_THAT(page.str(), HasSubstr(".TP\n" + name + "\\fR"));
      ++options;
    }
  EXPECT_GT(options, 50);
  EXPECT_THAT(page.str(), HasSubstr(".SH DESCRIPTION\nExtract the isosurface"));
}

} // namespace test_uvol
