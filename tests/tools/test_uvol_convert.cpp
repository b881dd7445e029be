// SPDX-License-Identifier: BSD-3-Clause
// Conversion and pipes.
#include "tool_test.h"

#include <filesystem>

using namespace uvol_test;

namespace test_uvol_convert {

class Convert : public FolderTest {
protected:
  CommandResult
  run(const std::string& arguments) const
  {
    return runTool("convert " + arguments);
  }
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

TEST_F(Convert, WhatAListNamesIsNotWritten)
{
  write("a.csv", table);
  ASSERT_EQ(0, run("a.csv p.vtp").exit_code);
  write("l.pvd",
        "<VTKFile><Collection><DataSet timestep=\"0\" file=\"p.vtp\"/><DataSet "
        "timestep=\"1\" file=\"q.vtp\"/></Collection></VTKFile>");
  write("m.vtm", "<VTKFile><DataSet file=\"l.pvd\"/></VTKFile>");
  const std::string before = readFile(folder_ / "p.vtp");
  for (const char* const line :
       {"l.pvd p.vtp", "l.pvd q.vtp", "l.pvd ./p.vtp", "m.vtm p.vtp"})
    EXPECT_EQ(2, run(line).exit_code) << line;
  EXPECT_EQ(before, readFile(folder_ / "p.vtp"));
  EXPECT_EQ(0, run("l.pvd other.csv").exit_code);
}

TEST_F(Convert, StandardInputAndOutputAreFiles)
{
  write("a.csv", table);
  const auto text = succeeded(run("a.csv -.csv"));
  EXPECT_EQ(table, text.out); // and nothing else
  EXPECT_NE(std::string::npos, text.err.find("points 3"));
  const std::string tool = PCL_UVOL_TOOL_DIR "/uvol_convert ";
  EXPECT_EQ(table, run("a.csv - | " + tool + "- -.csv").out);
  EXPECT_EQ(table, run("a.csv -.pcd | " + tool + "- -.csv").out);
  EXPECT_EQ(table, run("- -.csv < a.csv").out);
  EXPECT_EQ(1, run("- b.ply < /dev/null").exit_code);
  const auto picture = run("a.csv -.png -json"); // with the report where errors go
  EXPECT_EQ(1, picture.exit_code);
  EXPECT_NE(std::string::npos, picture.err.find("\"code\": \"unwritten_ending\""));
}

TEST_F(Convert, OtherEndingsNameAWay)
{
  write("a.laz", "x");
  write("a.pld", "x");
  expectError("convert a.laz b.ply", "convertible_ending", "laszip");
  expectError("convert a.pld b.ply", "unknown_ending", R"("similar":".pcd")");
  expectError("convert c.laz b.ply", "no_such_file", "c.laz");
}

} // namespace test_uvol_convert
