// SPDX-License-Identifier: BSD-3-Clause
// CSV and its relatives, selection of rows, and the real data sets.
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

#include <filesystem>

using namespace pcl_uvol;
using namespace uvol_test;

namespace {

Dataset
load(const std::string& text,
     const LoadOptions& options = {},
     const std::string& name = "a.csv")
{
  const TemporaryFolder folder;
  writeFile(folder / name, text);
  return loadDataset(folder / name, options);
}

std::string
fieldsOf(const std::string& text, const LoadOptions& options = {})
{
  return describeFields(load(text, options).cloud.fields);
}

std::string
errorOf(const std::string& text, const LoadOptions& options = {})
{
  return messageOf<IOError>([&] { load(text, options); });
}

const std::string xyz = "x (float32), y (float32), z (float32)";

std::size_t
kept(const std::string& where)
{
  Dataset dataset = load(
      "x,y,z,n,T\n5000000.125,0,0,1,4.1\n5000001.125,0,3,2,\n5000002.125,4,3,2,5\n");
  const std::size_t removed = selectRows(dataset, where);
  EXPECT_EQ(dataset.cloud.width + removed, 3u);
  EXPECT_EQ(dataset.cloud.data.size(),
            std::size_t(dataset.cloud.width) * dataset.cloud.point_step);
  return dataset.cloud.width;
}

} // namespace

TEST(TextTables, Separators)
{
  for (const char* const text :
       {"x,y,z,a\n1,2,3,4\n",
        "x; Y ;z;a\r\n1;2; 3 ;4\r\n",
        "z\tx\ty\ta\n3\t1\t2\t4",
        "a  x y  z\n 4 1\t2   3 \n\n",
        "\xEF\xBB\xBF# c\n\"x\",\"y\",\"z\",\"a\"\n1,2,\"3\",4\n#\n",
        "# x y z a\n1 2 3 4\n",
        "//X Y Z a\n1 2 3 4\n"}) {
    const auto dataset = load(text);
    ASSERT_EQ(describeFields(dataset.cloud.fields), xyz + ", a (int32)") << text;
    ASSERT_EQ(dataset.cloud.width, 1u) << text;
    EXPECT_EQ(valueOf(dataset, "x", 0), 1.0);
    EXPECT_EQ(valueOf(dataset, "z", 0), 3.0);
    EXPECT_EQ(valueOf(dataset, "a", 0), 4.0);
    EXPECT_TRUE(dataset.notes.empty()) << text;
  }
}

TEST(TextTables, TypesOfColumns)
{
  EXPECT_EQ(fieldsOf("x,y,z,i,f,d,big,gap,none,name\n"
                     "1,2,3,-7,0.5,0.123456789,3000000000,1,,left\n"
                     "1,2,3,2147483647,1e-3,2,1,NaN,n/a,\"out, side\"\n"),
            xyz +
                ", i (int32), f (float32), d (float64), big (float32), gap (float32), "
                "none (float32)");
  EXPECT_EQ(fieldsOf("x,y,z,big\n1,2,3,3000000001\n"), xyz + ", big (float64)");
  EXPECT_FALSE(load("x,y,z\n1.5,2,3\n").double_coordinates);
  EXPECT_TRUE(load("x,y,z\n1.123456789,2,3\n").double_coordinates);
  EXPECT_FALSE(load("x,y,z\n0.5000000000,2,3\n").double_coordinates);
  const auto names = load("x,y,z,name\n1,2,3,a\n");
  ASSERT_EQ(names.notes.size(), 1u);
  EXPECT_NE(names.notes[0].find("'name'"), std::string::npos);
  EXPECT_EQ(fieldsOf("x,y,z,name\n1,2,3,a1\n1,2,3,7\n1,2,3,b2\n"), xyz);
  EXPECT_EQ(load("x,y,z,id\n1,2,3,9007199254740993\n").notes.size(), 1u);
}

TEST(TextTables, MissingCells)
{
  const auto dataset = load("x,y,z,a,b\n1,2,3,,nan\n1,,3,NA,null\n");
  EXPECT_TRUE(std::isnan(valueOf(dataset, "a", 0)));
  EXPECT_TRUE(std::isnan(valueOf(dataset, "b", 1)));
  EXPECT_TRUE(std::isnan(valueOf(dataset, "y", 1)));
}

TEST(TextTables, WhereTheCoordinatesAre)
{
  const auto first = load("lon,lat,h,q\n1,2,3,4\n");
  EXPECT_EQ(describeFields(first.cloud.fields), xyz + ", q (int32)");
  ASSERT_EQ(first.notes.size(), 1u);
  EXPECT_NE(first.notes[0].find("lon, lat, h"), std::string::npos);
  const auto unnamed = load("1 2 3 4\n5 6 7 8\n", {}, "a.xyz");
  EXPECT_EQ(describeFields(unnamed.cloud.fields), xyz + ", column_3 (int32)");
  EXPECT_EQ(unnamed.cloud.width, 2u);
  EXPECT_EQ(unnamed.notes.size(), 2u);
  LoadOptions options;
  options.xyz_columns = {{3, 1, 0}};
  const auto chosen = load("a,x,b,c\n1,2,3,4\n", options);
  EXPECT_EQ(describeFields(chosen.cloud.fields), xyz + ", b (int32)");
  EXPECT_EQ(valueOf(chosen, "x", 0), 4.0);
  EXPECT_EQ(valueOf(chosen, "z", 0), 1.0);
  options.xyz_columns = {{1, 2, 3}};
  EXPECT_EQ(fieldsOf("x,a,b,c\n1,2,3,4\n", options), xyz + ", x_2 (int32)");
  for (const std::array<int, 3> wrong :
       {std::array<int, 3>{{0, 1, 4}}, {{0, 1, -1}}, {{0, 1, 1}}}) {
    options.xyz_columns = wrong;
    EXPECT_NE(errorOf("a,b,c,d\n1,2,3,4\n", options), "");
  }
  const TemporaryFolder folder;
  EXPECT_THROW(loadDataset(folder / "a.ply", options), InvalidArgument);
}

TEST(TextTables, Errors)
{
  EXPECT_NE(errorOf("x,y,q\n1,2,3\n").find("only some"), std::string::npos);
  EXPECT_NE(errorOf("a,b\n1,2\n").find("2 columns"), std::string::npos);
  EXPECT_NE(errorOf("x,y,z\n1,2,3\n1,2\n").find("line 3: there are 2 cells"),
            std::string::npos);
  EXPECT_NE(errorOf("x,y,z\n1,2,3,4\n").find("line 2"), std::string::npos);
  EXPECT_NE(errorOf("x,y,z,a\n1,2,3,4\n1,2,3,four\n")
                .find("line 3: 'four' in column 'a' is no number"),
            std::string::npos);
  EXPECT_NE(errorOf("x,y,z\n1,b,3\n").find("'b' in column 'y'"), std::string::npos);
  EXPECT_NE(errorOf("x,y,z\n1,1.5m,3\n"), "");
  EXPECT_NE(errorOf("x,y,z\n1,1e999,3\n"), "");
  EXPECT_NE(errorOf("x,y,z\n1,\"2,3\n"), "");
  EXPECT_NE(errorOf("x,y,z\n1,\"2\"q,3\n"), "");
  EXPECT_NE(errorOf("# only\n\n"), "");
  EXPECT_NE(errorOf(std::string("x,y,z\n1,\0,3\n", 12)).find("no text"),
            std::string::npos);
}

TEST(SelectRows, Relations)
{
  for (const auto& [where, count] :
       std::vector<std::pair<std::string, std::size_t>>{{"n=2", 2},
                                                        {"n == 1", 1},
                                                        {"n!=1", 2},
                                                        {"T=4.1", 1},
                                                        {"T>=4.1", 2},
                                                        {"T>4.1", 1},
                                                        {"T!=4.1", 2},
                                                        {"T<100", 2},
                                                        {" n = 2 && T > 0 ", 1},
                                                        {"n<=1&&n>=2", 0},
                                                        {"x=5000001.125", 1},
                                                        {"x<5000001.5", 2},
                                                        {"|y,z|=5", 1},
                                                        {"|x,z|>5000000", 3},
                                                        {"z>-1e0", 3}})
    EXPECT_EQ(kept(where), count) << where;
}

TEST(SelectRows, MalformedExpressions)
{
  for (const char* const where : {"",
                                  "n",
                                  "n=",
                                  "=2",
                                  "n=two",
                                  "n=2&&",
                                  "&&",
                                  "n=nan",
                                  "n=2&n=3",
                                  "q=1",
                                  "n=!2",
                                  "n<<2",
                                  "n!2"})
    EXPECT_THROW(kept(where), InvalidArgument) << where;
}

TEST(RealData, EveryFileLoads)
{
  if (dataFolder().empty())
    GTEST_SKIP() << "no folder of real data";
  std::size_t count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(dataFolder())) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".csv" && ending != ".vtk" && ending != ".vtu" && ending != ".vts" &&
        ending != ".ply")
      continue;
    SCOPED_TRACE(entry.path().string());
    const auto dataset = loadDataset(entry.path().string());
    EXPECT_GT(dataset.cloud.width, 100u);
    EXPECT_EQ(dataset.cloud.fields[0].name, "x");
    ++count;
  }
  EXPECT_GE(count, 15u);
}

TEST(RealData, KnownNumbers)
{
  if (dataFolder().empty())
    GTEST_SKIP() << "no folder of real data";
  const auto holes = loadDataset(dataFolder() + "/sensors/babbitt_drillholes.csv");
  EXPECT_EQ(holes.cloud.width, 23685u);
  EXPECT_NEAR(coordinateOf(holes, 0, 0), 2296021.09, 0.005);
  EXPECT_TRUE(holes.double_coordinates);
  EXPECT_TRUE(std::isnan(valueOf(holes, "s_pct", 0)));
  const auto fin = loadDataset(dataFolder() + "/cfd/bluntfin.vts");
  EXPECT_EQ(fin.cloud.width, 40960u);
  EXPECT_EQ(findField(fin.cloud.fields, "Momentum")->count, 3u);
  const auto bunny = loadDataset(dataFolder() + "/scans/bunny.ply");
  EXPECT_EQ(bunny.cloud.width, 34834u);
  EXPECT_NE(findField(bunny.cloud.fields, "normal_z"), nullptr);
  const auto protein = loadDataset(dataFolder() + "/volumes/ironProt.vtk");
  EXPECT_EQ(protein.cloud.width, 314432u);
}
