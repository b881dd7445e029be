// SPDX-License-Identifier: BSD-3-Clause
// What a tool leaves where files have names from the start, where it is killed, and
// where its output is one of its inputs.
#include "support/environment.h"
#include "tools/json_warnings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

namespace test_writing_under_faults {

using uvol_test::CommandResult;
using uvol_test::readFile;
using uvol_test::runCommand;
using uvol_test::writeFile;
namespace fs = std::filesystem;

class WritingUnderFaults : public testing::Test {
protected:
  WritingUnderFaults()
  {
    writeFile(in_, "x,y,z,f\n0,0,0,0\n1,0,0,1\n0,1,0,1\n0,0,1,1\n1,1,1,2\n");
  }

  void
  SetUp() override
  {
    if (uvol_test::isSanitized())
      GTEST_SKIP() << "a sanitizer has to be loaded first";
  }

  CommandResult
  generate(const std::string& faults) const
  {
    return runCommand("LD_PRELOAD=" PCL_UVOL_FAULTS " UVOL_FAULTS=" + faults +
                      " uvol_generate '" + out_ + "' -n 50");
  }

  /** \param step from one failing allocation to the next */
  void
  failAllocations(int step)
  {
    for (int i = 0; i < 30; ++i)
      writeFile(folder_ / "other" + std::to_string(i), "");
    const std::string command =
        " uvol_convert '" + in_ + "' '" + (folder_ / "out.npz") + "'";
    const std::string counts = folder_ / "counts",
                      library = "LD_PRELOAD=" PCL_UVOL_FAULTS;
    uvol_test::runWell(library + " UVOL_FAULTS=count=" + counts + command);
    const std::string text = readFile(counts), call = "malloc ";
    const int calls = std::stoi(text.substr(text.find(call) + call.size()));
    ASSERT_GT(calls, 100);
    for (int i = 1; i <= calls; i += step) {
      const auto result =
          runCommand(library + " UVOL_FAULTS=malloc:" + std::to_string(i) + command);
      EXPECT_TRUE(result.exit_code >= 0 && result.exit_code <= 2)
          << i << ": " << result.exit_code << result.err;
    }
  }

  uvol_test::TemporaryFolder folder_;
  const std::string in_ = folder_ / "in.csv", out_ = folder_ / "out.csv";
};

TEST_F(WritingUnderFaults, FilesWithNamesAreComplete)
{
  ASSERT_EQ(0, runCommand("uvol_generate '" + out_ + "' -n 50").exit_code);
  const std::string expected = readFile(out_);
  for (const char* const faults : {"nameless", "linkat:1+"}) {
    fs::remove(out_);
    const auto result = generate(faults);
    EXPECT_EQ(0, result.exit_code) << faults << result.err;
    EXPECT_EQ(expected, readFile(out_)) << faults;
    EXPECT_EQ((std::vector<std::string>{"in.csv", "out.csv"}), folder_.list());
  }
}

TEST_F(WritingUnderFaults, SignalsTakeUnfinishedFilesAway)
{
  writeFile(out_, "old");
  EXPECT_NE(0, generate("nameless,fsync:1:15").exit_code);
  EXPECT_EQ("old", readFile(out_));
  EXPECT_EQ((std::vector<std::string>{"in.csv", "out.csv"}), folder_.list());
}

TEST_F(WritingUnderFaults, TheNextRunTakesAwayWhatAKilledOneLeft)
{
  EXPECT_NE(0, generate("nameless,fsync:1:9").exit_code);
  const auto left = folder_.list();
  ASSERT_EQ(2u, left.size());
  EXPECT_EQ(0u, left[0].find(".out.csv.")) << left[0];
  EXPECT_EQ(".part", left[0].substr(left[0].size() - 5));
  // Files of processes that live, of other hosts and of other targets stay.
  const std::string lives =
      left[0].substr(0, left[0].find_last_of('.', left[0].size() - 6)) + ".1.part";
  const std::vector<std::string> others{
      lives, ".out.csv.elsewhere.1.part", ".out.part"};
  for (const std::string& other : others)
    writeFile(folder_ / other, "");
  EXPECT_EQ(0, generate("none").exit_code);
  auto expected = others;
  expected.insert(expected.end(), {"in.csv", "out.csv"});
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(expected, folder_.list());
}

/** Folders are looked through for what killed runs left. */
TEST_F(WritingUnderFaults, EveryLackOfMemoryIsASentence)
{
  failAllocations(40);
}

TEST_F(WritingUnderFaults, EveryLackOfMemoryIsASentence_long)
{
  failAllocations(1);
}

TEST(FilesOfTools, NoOutputIsAnInputOrAnotherOutput)
{
  const uvol_test::TemporaryFolder folder;
  const std::string in = folder / "in.csv";
  const std::string text = "x,y,z,f\n0,0,0,0\n1,0,0,1\n0,1,0,1\n0,0,1,1\n1,1,1,2\n";
  writeFile(in, text);
  fs::create_symlink("in.csv", folder / "link.csv");
  fs::create_hard_link(in, folder / "hard.csv");
  fs::create_symlink(".", folder / "here");
  fs::create_symlink("new.csv", folder / "dangling.csv");
  const std::string path = folder / "";
  for (const std::string command : {"uvol_isosurface IN IN -iso 0.5",
                                    "uvol_isosurface IN DIRlink.csv -iso 0.5",
                                    "uvol_isosurface IN DIRhard.csv -iso 0.5",
                                    "uvol_isosurface DIRhere/in.csv IN -iso 0.5",
                                    "uvol_cluster IN DIRout.csv -tree IN",
                                    "uvol_cluster IN DIRnew.csv -tree DIRdangling.csv",
                                    "uvol_cluster IN DIRout.csv -tree DIRhere/out.csv",
                                    "uvol_levelset IN DIRout.csv -iso 0.5 -csv IN",
                                    "uvol_project IN DIRout.csv -axes IN",
                                    "uvol_project IN DIRout.csv -axes DIRout.csv"}) {
    std::string line = command;
    for (const auto& [name, value] :
         {std::pair<std::string, std::string>{"IN", in}, {"DIR", path}})
      for (std::size_t at = 0; (at = line.find(name, at)) != std::string::npos;
           at += value.size())
        line.replace(at, name.size(), value);
    const auto result = runCommand(line);
    EXPECT_EQ(2, result.exit_code) << line << result.err;
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
    EXPECT_EQ(text, readFile(in)) << line;
  }
  EXPECT_EQ((std::vector<std::string>{
                "dangling.csv", "hard.csv", "here", "in.csv", "link.csv"}),
            folder.list());
}

/** The numbers of a volume lie in files that its header names. */
TEST(FilesOfTools, NoOutputHoldsTheNumbersOfAnInput)
{
  const uvol_test::TemporaryFolder folder;
  const std::string numbers(8, '\1'), path = folder / "";
  const std::string meta = "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\n"
                           "ElementDataFile = ",
                    nrrd = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\n"
                           "encoding: raw\ndata file: ";
  writeFile(folder / "one.mhd", meta + "one.ply\n");
  writeFile(folder / "two.mhd", meta + "LIST\none.csv\ntwo.csv\n");
  writeFile(folder / "three.nhdr", nrrd + "one.ply\n");
  writeFile(folder / "four.nhdr", nrrd + "%d.pcd 3 4\n");
  writeFile(folder / "alone.mha", meta + "LOCAL\n" + numbers);
  for (const char* const name : {"one.ply", "one.csv", "two.csv", "3.pcd", "4.pcd"})
    writeFile(folder / name, name[0] == 'o' ? numbers : numbers.substr(0, 4));
  for (const std::string line : {"one.mhd one.ply",
                                 "two.mhd two.csv",
                                 "three.nhdr ./one.ply",
                                 "four.nhdr 4.pcd",
                                 "one.mhd other.ply -tree one.ply"}) {
    const std::string tool =
        line.find("-tree") == line.npos ? "uvol_generate " : "uvol_cluster ";
    const auto before = folder.list();
    const auto result = runCommand("cd '" + path + "' && " + tool + line);
    EXPECT_EQ(2, result.exit_code) << line << result.err;
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
    EXPECT_EQ(before, folder.list());
    EXPECT_EQ(numbers, readFile(folder / "one.ply")) << line;
    EXPECT_EQ(numbers.substr(0, 4), readFile(folder / "4.pcd")) << line;
  }
  for (const std::string line : {"one.mhd other.ply", "alone.mha one.ply"}) {
    const auto result = runCommand("cd '" + path + "' && uvol_generate -n 5 " + line);
    EXPECT_EQ(0, result.exit_code) << line << result.err;
  }
}

TEST(FilesOfTools, DanglingLinksAreFollowed)
{
  const uvol_test::TemporaryFolder folder;
  fs::create_directory(folder / "there");
  fs::create_symlink("there/new.csv", folder / "link.csv");
  uvol_test::runWell("uvol_generate '" + (folder / "link.csv") + "' -n 5");
  EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
  EXPECT_TRUE(fs::is_regular_file(folder / "there/new.csv"));
}

} // namespace test_writing_under_faults
