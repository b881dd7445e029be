// SPDX-License-Identifier: BSD-3-Clause
// Conversion, pipes, and command lines for many files.
#include "tool_test.h"

#include <filesystem>

using namespace uvol_test;

namespace {

class Convert : public testing::Test {
protected:
  CommandResult
  run(const std::string& arguments) const
  {
    return runCommand("cd '" + (folder_ / "") +
                      "' && " PCL_UVOL_TOOL_DIR "/uvol_convert " + arguments);
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

const std::string table = "x,y,z,rho\n1,2,3,0.5\n4,5,6,1.5\n7,8,9.25,2.5\n";

TEST_F(Convert, KeepsNamesTypesAndNumbers)
{
  write("a.csv", table);
  for (const char* const chain : {"a.csv b.npz",
                                  "b.npz c.vtp",
                                  "c.vtp d.pcd",
                                  "d.pcd d.vtkhdf",
                                  "d.vtkhdf e.ply",
                                  "e.ply f.csv"})
    ASSERT_EQ(0, run(chain).exit_code) << chain;
  EXPECT_EQ(table, readFile(folder_ / "f.csv"));
  ASSERT_EQ(0, run("a.csv g.csv -where 'rho>1'").exit_code);
  EXPECT_EQ("x,y,z,rho\n4,5,6,1.5\n7,8,9.25,2.5\n", readFile(folder_ / "g.csv"));
}

TEST_F(Convert, StandardInputAndOutputAreFiles)
{
  write("a.csv", table);
  const auto text = run("a.csv -.csv");
  EXPECT_EQ(0, text.exit_code);
  EXPECT_EQ(table, text.out); // and nothing else
  EXPECT_NE(std::string::npos, text.err.find("points 3"));
  const std::string tool = PCL_UVOL_TOOL_DIR "/uvol_convert ";
  EXPECT_EQ(table, run("a.csv - | " + tool + "- -.csv").out);
  EXPECT_EQ(table, run("a.csv -.pcd | " + tool + "- -.csv").out);
  EXPECT_EQ(table, run("- -.csv < a.csv").out);
  EXPECT_EQ(1, run("- b.ply < /dev/null").exit_code);
  const auto picture = run("a.csv -.png");
  EXPECT_EQ(1, picture.exit_code);
  EXPECT_NE(std::string::npos, picture.err.find("'.png' is not known"));
}

TEST_F(Convert, OtherEndingsNameAWay)
{
  write("a.laz", "x");
  write("a.pld", "x");
  EXPECT_NE(std::string::npos, run("a.laz b.ply").err.find("laszip"));
  EXPECT_NE(std::string::npos, run("a.pld b.ply").err.find("but .pcd is"));
  EXPECT_NE(std::string::npos, run("c.laz b.ply").err.find("no such file"));
}

class Series : public Convert {
protected:
  Series()
  {
    for (const char* const number : {"0002", "0010", "0006"})
      write(std::string("in_") + number + ".csv", table);
  }
};

TEST_F(Series, EveryFileIsConvertedInOrder)
{
  write("in_0006x.csv", table);
  write("in_6.csv", table); // another width
  const auto result = run("'in_{:04d}.csv' 'out {:02d}.vtp'");
  EXPECT_EQ(0, result.exit_code) << result.err;
  EXPECT_NE(std::string::npos, result.err.find("3 of 3 files are done"));
  const std::string list = readFile(folder_ / "out.pvd");
  const std::size_t first = list.find("timestep=\"2\" file=\"out 02.vtp\""),
                    second = list.find("timestep=\"6\" file=\"out 06.vtp\""),
                    third = list.find("timestep=\"10\" file=\"out 10.vtp\"");
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_NE(std::string::npos, third);
}

TEST_F(Series, SnapshotsAreChosen)
{
  EXPECT_EQ(0, run("'in_{:04d}.csv' 'out_{}.ply' -snapshots 2:10:4").exit_code);
  EXPECT_TRUE(exists("out_2.ply") && exists("out_6.ply") && exists("out_10.ply"));
  EXPECT_FALSE(exists("out.pvd"));
  EXPECT_EQ(0, run("'in_{:04d}.csv' 'o_{}.ply' -snapshots 6:9:4").exit_code);
  EXPECT_TRUE(exists("o_6.ply"));
  EXPECT_FALSE(exists("o_10.ply"));
  for (const char* const wrong :
       {"1", "5:1", "1:2:0", "1:2:3:4", "a:b", "1:", "0:99999999"}) {
    const auto result =
        run(std::string("'in_{:04d}.csv' 'w_{}.ply' -snapshots ") + wrong);
    EXPECT_EQ(2, result.exit_code) << wrong;
    EXPECT_NE(std::string::npos, result.err.find("first:last")) << wrong;
  }
}

TEST_F(Series, FailuresEndItUnlessTheyArePassedOver)
{
  write("in_0004.csv", "nothing\n");
  const auto ended = run("'in_{:04d}.csv' 'a_{}.ply'");
  EXPECT_EQ(1, ended.exit_code);
  EXPECT_NE(std::string::npos, ended.err.find("in_0004.csv"));
  EXPECT_TRUE(exists("a_2.ply"));
  EXPECT_FALSE(exists("a_6.ply"));
  const auto passed = run("'in_{:04d}.csv' 'b_{}.ply' -keep-going");
  EXPECT_EQ(1, passed.exit_code);
  EXPECT_TRUE(exists("b_6.ply") && exists("b_10.ply"));
  EXPECT_NE(std::string::npos, passed.err.find("3 of 4 files are done"));
}

TEST_F(Series, OptionsNeedASeries)
{
  for (const char* const options : {"-keep-going", "-snapshots 1:2"}) {
    const auto result = run(std::string("in_0002.csv b.ply ") + options);
    EXPECT_EQ(2, result.exit_code);
    EXPECT_NE(std::string::npos, result.err.find("snap_{:04d}.h5"));
  }
  EXPECT_EQ(2, run("'none_{}.csv' 'b_{}.ply'").exit_code);
}

/** The same name for every output would leave the last one only. */
TEST_F(Series, OutputsHaveDifferentNames)
{
  const auto result = run("'in_{:04d}.csv' b.ply");
  EXPECT_EQ(2, result.exit_code);
  EXPECT_NE(std::string::npos, result.err.find("place for a number")) << result.err;
  EXPECT_FALSE(exists("b.ply"));
}

} // namespace
