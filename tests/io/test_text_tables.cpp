// SPDX-License-Identifier: BSD-3-Clause
// CSV and its relatives, and the real data sets.
#include "io/point_stream.h"
#include "random_dataset.h"
#include "support/messages.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <filesystem>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_text_tables {

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

/** The error as data. */
Message
refusalOf(const std::string& text)
{
  Message error = thrownBy([&] { load(text); });
  EXPECT_NE("", error.code) << "It was read: " << text;
  return error;
}

/** The cell that is refused as it is not a number: "word in column, line n". */
std::string
textIn(const std::string& text)
{
  const Message error = refusalOf(text);
  EXPECT_EQ("text_in_column", error.code);
  return wordOf(error, "word") + " in " + wordOf(error, "column") + ", line " +
         std::to_string(static_cast<int>(numberOf(error, "line")));
}

const std::string xyz = "x (float32), y (float32), z (float32)";

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

/** Values of the first row: x, y, z and the first field behind. */
std::vector<double>
firstRowOf(const Dataset& dataset)
{
  std::vector<double> row;
  for (const auto& field : dataset.cloud.fields)
    row.push_back(
        ScalarField(dataset.cloud.fields, field.name).read(dataset.cloud.data.data()));
  for (std::size_t axis = 0; axis < 3; ++axis)
    row[axis] += dataset.origin[axis];
  return row;
}

/** A table as somebody writes it, and what is said of it. */
struct Wild {
  const char* text;
  std::vector<std::string> notes;
  const char* ending = ".csv";
};

TEST(TextTables, HeadsAsPeopleWriteThem)
{
  const std::vector<Wild> tables{
      {"sep=;\nx;y;z;f\n0.5;2;3;4\n", {}},
      {"sep=\t\nx\ty\tz\tf\n0.5\t2\t3\t4\n", {}},
      {"% Device,AB12\n% \nx,y,z,f\n0.5,2,3,4\n", {}},
      {"# a\n// b c\nx y z f\n0.5 2 3 4\n", {}},
      {"% x y z f\n0.5 2 3 4\n", {}},
      {"/ survey\n/ x y z f\n0.5 2 3 4\n", {}},
      {"* Sea-Bird\n# nquan = 4\n# name 0 = x: Easting [m]\n# name 1 = y: N\n# name 2 "
       "= "
       "z: Depth\n# name 3 = f: Value\n# span 0 = 0, 1\n*END*\n 0.5 2 3 4\n",
       {}},
      {"x,y,z,f\nm,m,m,degC\n0.5,2,3,4\n", {"skipped_units"}},
      {"x,y,z,f\nm,,m,\n0.5,2,3,4\n", {"skipped_units"}},
      {"Survey of 2019\nx,y,z,f\n0.5,2,3,4\n", {"skipped_titles"}},
      {"[Name]\nCube\n\n[Data]\nx, y, z, f\n0.5, 2, 3, 4\n", {"skipped_titles"}},
      {"A title of several words\nx y z f\n0.5 2 3 4\n", {"skipped_titles"}},
      {"Title\nx,y,z,f\nm,m,m,K\n0.5,2,3,4\n", {"skipped_titles", "skipped_units"}},
      {"//x;y;z;f\n2\n0.5;2;3;4\n1;2;3;4\n", {"skipped_count"}},
      {"#x,y,z,f,hole\n0.5,2,3,4,A-1\n", {}},
      {"x;y;z;f\n0,5;2;3;4\n", {"decimal_commas"}},
      {"x\ty\tz\tf\n0,5\t2\t3\t4,0\n", {"decimal_commas"}},
      {"My survey 2020\nx;y;z;f\n0,5;2,0;3,0;4,0\n",
       {"skipped_titles", "decimal_commas"}},
      {"x;y;z;f;cu\nm;m;m;K;%\n0,5;2;3;4;<0,25\n",
       {"decimal_commas", "skipped_units", "below_detection"}},
      {"TITLE=\"t\"\nVARIABLES = \"x\"\n\"y\"\n\"z\", \"f\"\nZONE N=1, E=1, F=FEPOINT\n"
       "0.5 2 3 4\n1 1 1\n",
       {"first_zone"},
       ".dat"},
      {"VARIABLES = \"x\", \"y\", \"z\", \"f\"\nZONE I=2, J=1, DATAPACKING=POINT\n0.5 "
       "2 3 "
       "4\n5 6 7 8\nZONE I=1\n9 9 9 9\n",
       {"first_zone"},
       ".dat"}};
  for (const Wild& table : tables) {
    SCOPED_TRACE(table.text);
    const Dataset read = load(table.text, {}, std::string("a") + table.ending);
    ASSERT_LT(0u, read.cloud.width);
    const std::vector<double> row = firstRowOf(read);
    ASSERT_GE(row.size(), 4u);
    EXPECT_EQ((std::vector<double>{0.5, 2.0, 3.0, 4.0}),
              std::vector<double>(row.begin(), row.begin() + 4));
    EXPECT_EQ("f", read.cloud.fields[3].name);
    EXPECT_EQ(table.notes, listCodes(read.notes));
  }
}

/** What has no names: numbers are not read for what they are not. */
TEST(TextTables, NumbersAsPeopleWriteThem)
{
  const auto row = firstRowOf(load("6.25D-01 2.5d+1 -1.0E2 4\n1 2 3 4\n", {}, "a.dat"));
  EXPECT_EQ((std::vector<double>{0.625, 25.0, -100.0, 4.0}), row);
  const auto comma = firstRowOf(load("0,5;2,25;3;4\n1;2;3;4\n"));
  EXPECT_EQ((std::vector<double>{0.5, 2.25, 3.0, 4.0}), comma);
  // Thousands and dates are no numbers.
  EXPECT_NE("", errorOf("x;y;z;f\n0,5;2;1.234,5;4\n"));
  EXPECT_NE("", errorOf("x,y,z,f\n0.5,2,\"1,234.5\",4\n"));
  // The ending says what they are.
  const Dataset places = load("1.5,2.5,3.5,9\n", {}, "a.xyz");
  EXPECT_EQ((std::vector<double>{1.5, 2.5, 3.5, 9.0}), firstRowOf(places));
}

/** A sign of a comment may as well begin a name. */
TEST(TextTables, NoRowIsTakenForAComment)
{
  for (const char* const head : {"name,x,y,z\n", "//name,x,y,z\n", "# c\nname,x,y,z\n"})
    for (const char* const sign : {"/", "*", "!", "%"}) {
      const std::string row = std::string(sign) + "a,0.5,2,3\n";
      EXPECT_EQ(4u, load(head + row + row + "b,0.5,2,3\n" + row).cloud.width)
          << head << row;
    }
}

/** Tables that look a little like others. */
TEST(TextTables, WhatIsNotSaidIsNotAssumed)
{
  const auto values = [](const std::string& text, const char* field) {
    const Dataset read = load(text);
    std::vector<double> found;
    for (std::size_t i = 0; i < read.cloud.width; ++i)
      found.push_back(valueOf(read, field, i));
    return found;
  };
  using Values = std::vector<double>;
  // Blanks behind commas, thousands, a pair of numbers.
  EXPECT_EQ((Values{0.0, 0.5}), values("0, 0, 0\n0.5, 0.1, 0.2\n", "x"));
  EXPECT_EQ(
      1u, load("x\ty\tz\tpop\n1\t2\t3\t12,345\n2\t3\t4\t1,234\n").labels.count("pop"));
  EXPECT_EQ((Values{1.5, 2.5}),
            values("x;y;z;pair\n1.5;2.5;3.5;1,2\n2.5;2;3;3,4\n", "x"));
  // Names that look like numbers of Fortran, rows that look like units.
  EXPECT_EQ(1u, load("x,y,z,id\n1,2,3.5,1D1\n1,2,4,2D3\n").labels.count("id"));
  EXPECT_EQ(3u, load("x,y,z,id\n,,,A\n1,2,4.5,B\n1,2,5,C\n").cloud.width);
  // A sign before the first name.
  EXPECT_EQ(3u, load("%id,x,y,z\nA,1,2,3.5\n%B,2,3,4\nC,4,4,5\n").cloud.width);
  EXPECT_EQ(2u, load("/topic,x,y,z\n/odom,1,2,3.5\n/odom,2,3,4\n").cloud.width);
  EXPECT_EQ((Values{3.0, 6.5}), values("# \"z\",\"y\",\"x\"\n1,2,3\n4,5,6.5\n", "x"));
  // Corners, indices of cells, another vector.
  EXPECT_EQ((Values{1.5}),
            values("x1,y1,z1,x2,y2,z2,x3,y3,z3\n1.5,2.5,3.5,4,5,6,7,8,9\n", "x"));
  EXPECT_EQ((Values{4.5}),
            values("cell_x,cell_y,cell_z,x_m,y_m,z_m\n1,2,3,4.5,5.5,6.5\n", "x"));
  EXPECT_EQ((Values{1.5}), values("tx,ty,tz,px,py,pz\n1.5,2.5,3.5,4,5,6\n", "x"));
  EXPECT_EQ((Values{1.5}), values("a,b,c,pressure\n1.5,2.5,3.5,4\n", "x"));
}

TEST(TextTables, ZonesOfTecplot)
{
  const std::string head = "VARIABLES = \"x\", \"y\", \"z\", \"f\"\n";
  const std::string rows = "0.5 2 3 4\n1 2 3 4\n2 2 3 4\n";
  EXPECT_EQ(
      3u,
      load(head + "ZONE T=\"slice i=2 of n=9\", I=3, F=POINT\n" + rows, {}, "a.dat")
          .cloud.width);
  EXPECT_EQ(3u,
            load("TITLE = \"variables of a block\"\n" + head + "ZONE I=3\n" + rows,
                 {},
                 "a.dat")
                .cloud.width);
  EXPECT_EQ("truncated_rows",
            codeOf([&] { load(head + "ZONE I=4\n" + rows, {}, "a.dat"); }));
  EXPECT_TRUE(load("variables x y z\n1 2.5 3 4\n", {}, "a.dat").notes.size() <= 1);
  const TemporaryFolder folder;
  writeFile(folder / "a.dat", head + "ZONE I=2\n" + rows);
  PointStream stream(folder / "a.dat");
  for (int pass = 0; pass < 2; ++pass) {
    pcl::PCLPointCloud2 block;
    stream.seek(0);
    EXPECT_EQ(2u, stream.read(10, block));
  }
}

TEST(TextTables, HeadersThatDoNotFitAreRefused)
{
  for (const char* const text : {"x,y,z\n1,2,3,4\n1,2,3,4\n",
                                 "x,y,z,f,g\n1,2,3,4\n",
                                 "x,y,z,hole\n1,2,3,A,\n1,2,3,B,\n"})
    EXPECT_EQ("wrong_count", refusalOf(text).code) << text;
}

TEST(TextTables, ValuesBelowDetection)
{
  std::string text = "x,y,z,cu\n";
  for (int i = 0; i < 6; ++i)
    text += std::to_string(i) + ",0.5,1," + (i % 2 ? "<0.25" : "1.5") + '\n';
  const Dataset read = load(text);
  EXPECT_EQ(xyz + ", cu (float32), cu_below (int32)",
            describeFields(read.cloud.fields));
  EXPECT_EQ(std::vector<std::string>{"below_detection"}, listCodes(read.notes));
  const ScalarField value(read.cloud.fields, "cu"), flag(read.cloud.fields, "cu_below");
  const CloudView view = viewOf(read.cloud);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(i % 2 ? 0.25 : 1.5, value.read(view.point(i)));
    EXPECT_EQ(double(i % 2), flag.read(view.point(i)));
  }
  EXPECT_EQ("coordinate_below_limit", refusalOf("x,y,z,f\n<0.5,2,3,4\n").code);
}

TEST(TextTables, TypesOfColumns)
{
  EXPECT_EQ(fieldsOf("x,y,z,i,f,d,big,gap,none,name\n"
                     "1,2,3,-7,0.5,0.123456789,3000000000,1,,left\n"
                     "1,2,3,2147483647,1e-3,2,1,NaN,n/a,\"out, side\"\n"),
            xyz +
                ", i (int32), f (float32), d (float64), big (float32), gap (float32), "
                "none (float32), name (int32)");
  EXPECT_EQ(fieldsOf("x,y,z,big\n1,2,3,3000000001\n"), xyz + ", big (float64)");
  EXPECT_FALSE(load("x,y,z\n1.5,2,3\n").double_coordinates);
  EXPECT_TRUE(load("x,y,z\n1.123456789,2,3\n").double_coordinates);
  EXPECT_FALSE(load("x,y,z\n0.5000000000,2,3\n").double_coordinates);
  EXPECT_EQ(load("x,y,z,id\n1,2,3,9007199254740993\n").notes,
            (std::vector<Message>{{"rounded_integers", {{"column", "id"}}}}));
}

/** As PLY and CloudCompare call them; numbers of cells and places are none. */
TEST(TextTables, NormalsHaveOneName)
{
  const std::string normals =
      ", normal_x (float32), normal_y (float32), normal_z (float32)";
  EXPECT_EQ(xyz + normals, fieldsOf("x,y,z,nx,ny,nz\n1,2,3,0.6,-0.8,0.\n"));
  EXPECT_EQ(xyz + normals, fieldsOf("x,y,z,Nx,Ny,Nz\n1,2,3,0.48,-0.6,-0.64\n"));
  EXPECT_EQ(
      xyz + normals,
      fieldsOf("x,y,z,nx,ny,nz\n1,2,3,0.577,0.577,0.577\n1,2,3,0,0,0\n1,2,3,,,\n"));
  const std::string cells = ", nx (int32), ny (int32), nz (int32)",
                    places = ", nx (float32), ny (float32), nz (float32)";
  EXPECT_EQ(xyz + places, fieldsOf("x,y,z,nx,ny,nz\n1,2,3,0.5,0.25,0.5\n"));
  EXPECT_EQ(xyz + places,
            fieldsOf("x,y,z,nx,ny,nz\n1,2,3,0.6,-0.8,0.\n1,2,3,0.6,-0.8,0.1\n"));
  EXPECT_EQ(xyz + cells, fieldsOf("x,y,z,nx,ny,nz\n1,2,3,0,0,0\n1,2,3,0,0,0\n"));
  EXPECT_EQ(xyz + cells, fieldsOf("x,y,z,nx,ny,nz\n1,2,3,1,0,2\n"));
  EXPECT_EQ(xyz + cells, fieldsOf("x,y,z,nx,ny,nz\n1,2,3,1,0,-2\n"));
  EXPECT_EQ(xyz + ", nx (int32), ny (int32)", fieldsOf("x,y,z,nx,ny\n1,2,3,0,1\n"));
  EXPECT_EQ(xyz + ", nx (int32), normal_x (int32), ny (int32), nz (int32)",
            fieldsOf("x,y,z,nx,normal_x,ny,nz\n1,2,3,0,1,0,1\n"));
}

TEST(TextTables, NamesAreLabels)
{
  const auto dataset = load("x,y,z,name,a\n1,2,3,b2,1\n1,2,3,7,2\n1,2,3,,3\n"
                            "1,2,3,\"say \"\"a\"\", b\",4\n1,2,3,n/a,5\n1,2,3,b2,6\n");
  EXPECT_EQ(describeFields(dataset.cloud.fields), xyz + ", name (int32), a (int32)");
  EXPECT_TRUE(dataset.notes.empty());
  EXPECT_EQ(dataset.labels, (LabelNames{{"name", {"7", "b2", "say \"a\", b"}}}));
  const double labels[] = {1, 0, -1, 2, -1, 1};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(labels[i], valueOf(dataset, "name", i)) << i;
    EXPECT_EQ(static_cast<double>(i + 1), valueOf(dataset, "a", i));
  }
  // One name more often than numbers makes no column of names.
  EXPECT_EQ("a in n, line 3", textIn("x,y,z,n\n1,2,3,4\n1,2,3,a\n"));
  // What is a field of numbers does not become one of names by its order.
  EXPECT_EQ(load("x,y,z,n\n1,2,3,b\n1,2,3,a\n").labels,
            load("x,y,z,n\n1,2,3,a\n1,2,3,b\n").labels);
}

/** Rows of names, first those of letters, "007" and "7" in turn. */
std::string
namesInRows(std::size_t letters, std::size_t numbers)
{
  std::string text = "x,y,z,hole\n";
  for (std::size_t i = 0; i < letters; ++i)
    text += "1,2,3,A-117\n";
  for (std::size_t i = 0; i < numbers; ++i)
    text += i % 2 == 0 ? "1,2,3,7\n" : "1,2,3,\"007\"\n";
  return text;
}

TEST(TextTables, ManyNamesMayBeNumbers)
{
  const auto third = load(namesInRows(2, 4));
  EXPECT_EQ(third.labels, (LabelNames{{"hole", {"007", "7", "A-117"}}}));
  const double labels[] = {2, 2, 1, 0, 1, 0};
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(labels[i], valueOf(third, "hole", i)) << i;
  ASSERT_EQ(third.notes.size(), 1u);
  EXPECT_EQ(
      third.notes[0],
      Message("kept_as_names", {{"column", "hole"}, {"cell", "A-117"}, {"line", 2}}));
  EXPECT_TRUE(load(namesInRows(5, 4)).notes.empty());
  // A tenth is enough; less, and a single one, are slips.
  EXPECT_EQ(load(namesInRows(2, 18)).labels.at("hole").size(), 3u);
  for (const auto& [letters, numbers] : {std::pair(2, 19), std::pair(1, 3)})
    EXPECT_EQ("A-117 in hole, line 2", textIn(namesInRows(letters, numbers)));
  EXPECT_EQ("a in y, line 3", textIn("x,y,z\n1,2,3\n1,a,3\n1,b,3\n"));
  // Names beyond 2^53 lose no digits.
  EXPECT_EQ(load(namesInRows(3, 0) + "1,2,3,9007199254740993\n").notes.size(), 0u);
}

/** Different numbers that are more than names may be are values. */
TEST(TextTables, ManySlipsInValuesAreRefused)
{
  std::string text = "x,y,z,cu\n";
  for (int i = 0; i < (1 << 16); ++i)
    text += "1,2,3," + std::to_string(i) + (i % 5 == 0 ? "\n1,2,3,low\n" : "\n");
  EXPECT_EQ("low in cu, line 3", textIn(text));
}

TEST(TextTables, NamesThatDescribeSingleRowsAreLeftOut)
{
  std::string text = "x,y,z,name\n";
  for (int i = 0; i < (1 << 16); ++i)
    text += "1,2,3,n" + std::to_string(i) + '\n';
  EXPECT_EQ(load(text).labels.at("name").size(), 1u << 16);
  const auto dataset = load(text + "1,2,3,one_more\n");
  EXPECT_EQ(describeFields(dataset.cloud.fields), xyz);
  ASSERT_EQ(dataset.notes.size(), 1u);
  EXPECT_EQ(dataset.notes[0],
            Message("too_many_names", {{"column", "name"}, {"most", 65536}}));
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
  const auto first = load("u,v,w,q\n1.5,2.5,3.5,4\n");
  EXPECT_EQ(describeFields(first.cloud.fields), xyz + ", q (int32)");
  ASSERT_EQ(first.notes.size(), 1u);
  EXPECT_EQ(first.notes[0],
            Message("assumed_coordinates",
                    {{"skips_times", 0}, {"x", "u"}, {"y", "v"}, {"z", "w"}}));
  const auto unnamed = load("1 2 3 4\n5 6 7 8\n", {}, "a.xyz");
  EXPECT_EQ(describeFields(unnamed.cloud.fields), xyz + ", column_3 (int32)");
  EXPECT_EQ(unnamed.cloud.width, 2u);
  EXPECT_EQ(listCodes(unnamed.notes),
            (std::vector<std::string>{"no_header_line", "assumed_coordinates"}));
  EXPECT_EQ(numberOf(unnamed.notes.at(0), "last"), 3.0);
  LoadOptions options;
  options.xyz_columns = {{"3", "1", "0"}};
  const auto chosen = load("a,x,b,c\n1,2,3,4\n", options);
  EXPECT_EQ(describeFields(chosen.cloud.fields), xyz + ", b (int32)");
  EXPECT_EQ(valueOf(chosen, "x", 0), 4.0);
  EXPECT_EQ(valueOf(chosen, "z", 0), 1.0);
  options.xyz_columns = {{"1", "2", "3"}};
  EXPECT_EQ(fieldsOf("x,a,b,c\n1,2,3,4\n", options), xyz + ", x_2 (int32)");
  options.xyz_columns = {{"c", "1", "a"}};
  EXPECT_EQ(valueOf(load("a,x,b,c\n1,2,3,4\n", options), "x", 0), 4.0);
  for (const char* const wrong : {"4", "-1", "1", "e", "", "1e0"}) {
    options.xyz_columns = {{"0", "1", wrong}};
    EXPECT_NE(errorOf("a,b,c,d\n1,2,3,4\n", options), "");
  }
  const TemporaryFolder folder;
  EXPECT_THROW(loadDataset(folder / "a.ply", options), InvalidArgument);
}

TEST(TextTables, CoordinatesHaveUsualNames)
{
  struct Case {
    const char* header;
    double x, y, z; ///< columns from 1
    std::size_t notes;
  };
  for (const auto& [header, x, y, z, notes] :
       {Case{"x_m,y_m,z_m,q,r", 1, 2, 3, 0},
        Case{"q,X (km),Y (km),Z (km),r", 2, 3, 4, 0},
        Case{"q,r,x[ft],y[ft],z[ft]", 3, 4, 5, 0},
        Case{"x_m,y_m,z_minus_dbar,q,r", 1, 2, 3, 0},
        Case{"x_km,y_km,z_minus_dbar,q,r", 1, 2, 3, 1},
        Case{"x_km,y_km,z_m,q,r", 1, 2, 3, 1},
        Case{"East (ft),North (ft),RL_m,q,r", 1, 2, 3, 1},
        Case{"EAST_ft,NORTH_ft,RL_ft,q,r", 1, 2, 3, 0},
        Case{"easting_utm,northing_m,elev_metres,q,r", 1, 2, 3, 0},
        Case{"x_m,y_m,depth,q,r", 1, 2, 3, 0},
        Case{"q,x_coord,y_coord,z_coord,r", 2, 3, 4, 0},
        Case{"q,X Coordinate,Y Coordinate,Z Coordinate,r", 2, 3, 4, 0},
        Case{"hole,Easting,Northing,Elevation,q", 2, 3, 4, 0},
        Case{"lon,lat,depth,q,r", 1, 2, 3, 1},
        Case{"lon_deg,lat_deg,x_m,y_m,z_m", 3, 4, 5, 0},
        Case{"x_m,y_m,z_m,x,q", 1, 2, 3, 1},
        Case{"z,y,x,x_m,y_m", 3, 2, 1, 0},
        Case{"depth_m,latitude,longitude,q,r", 3, 2, 1, 1},
        Case{"time_s,x_m,y_m,depth_m,q", 2, 3, 4, 0},
        Case{"timestamp,a,x_m,y_m,alt_m", 3, 4, 5, 0},
        Case{"Depth,y,x,q,r", 3, 2, 1, 0},
        Case{"x_m,y_m,depth_m,z_m,q", 1, 2, 4, 0},
        Case{"x,y,z_vel,height (m),q", 1, 2, 4, 0},
        Case{"lon,lat,x_m,y_m,depth_m", 3, 4, 5, 0}}) {
    const auto dataset = load(std::string(header) + "\n1,2,3,4,5\n");
    EXPECT_EQ(valueOf(dataset, "x", 0), x) << header;
    EXPECT_EQ(valueOf(dataset, "y", 0), y) << header;
    EXPECT_EQ(valueOf(dataset, "z", 0), z) << header;
    EXPECT_EQ(dataset.notes.size(), notes) << header;
  }
}

TEST(TextTables, MixedUnitsAreReportedUnlessAllowed)
{
  for (const auto& [header, mixture] : {std::pair("lon,lat,depth",
                                                  Message("mixed_units",
                                                          {{"x", "lon"},
                                                           {"y", "lat"},
                                                           {"z", "depth"},
                                                           {"are_degrees", 1},
                                                           {"can_be_mapped", 1}})),
                                        std::pair("x_km,y_km,z_m",
                                                  Message("mixed_units",
                                                          {{"x", "x_km"},
                                                           {"y", "y_km"},
                                                           {"z", "z_m"},
                                                           {"are_degrees", 0},
                                                           {"can_be_mapped", 0}}))}) {
    const std::string table = header + std::string("\n1,2,3\n");
    ASSERT_EQ(load(table).notes.size(), 1u);
    EXPECT_EQ(load(table).notes[0], mixture);
    pcl_uvol::LoadOptions options;
    options.may_mix_units = true;
    EXPECT_TRUE(load(table, options).notes.empty());
  }
}

TEST(TextTables, WhereAnAxisIsNamedNothingIsAssumed)
{
  for (const char* const header : {"time_s,x_m,y_m,q",
                                   "a,b,c,depth_m",
                                   "lat,lon,a,b",
                                   "x_coord,y_coord,a,b",
                                   "x_m,y_m,a,elevation_deg"}) {
    const auto error = refusalOf(std::string(header) + "\n1.5,2.5,3.5,4.5\n");
    EXPECT_EQ(error.code, "some_coordinates_named") << header;
    EXPECT_NE(error.text().find("(xyz)"), std::string::npos) << header;
    EXPECT_NE(error.text(ParameterNames::Options).find("(-xyz)"), std::string::npos)
        << header;
  }
  LoadOptions options;
  options.xyz_columns = {{"x_m", "y_m", "time_s"}}; // a time that is meant
  EXPECT_EQ(valueOf(load("time_s,x_m,y_m,q\n1.5,2.5,3.5,4.5\n", options), "z", 0), 1.5);
}

TEST(TextTables, TimesAreNoCoordinates)
{
  for (const char* const time : {"time",
                                 "Time_s",
                                 "timestamp",
                                 "gps_time",
                                 "DateTime",
                                 "t",
                                 "t (s)",
                                 "unix.ms"}) {
    const auto assumed = load(std::string(time) + ",u,v,w\n1.5,2.5,3.5,4.5\n");
    EXPECT_EQ(valueOf(assumed, "x", 0), 2.5) << time;
    EXPECT_EQ(assumed.notes.at(0),
              Message("assumed_coordinates",
                      {{"skips_times", 1}, {"x", "u"}, {"y", "v"}, {"z", "w"}}))
        << time;
  }
  EXPECT_EQ(valueOf(load("u,date,v,w\n1.5,2.5,3.5,4.5\n"), "z", 0), 4.5);
  EXPECT_EQ(valueOf(load("temp,u,tide\n1.5,2.5,3.5\n"), "x", 0), 1.5);
  EXPECT_EQ(refusalOf("time,u,v\n1.5,2.5,3.5\n").code, "only_times_named");
}

TEST(TextTables, WholeNumbersAreNoCoordinatesUnlessNamed)
{
  const std::string table = "experiment,ix,iy,iz,ppm\n1,0,1,2,0.5\n1,3,4,5,0.25\n";
  const auto refusal = refusalOf(table);
  EXPECT_EQ(refusal.code, "ambiguous_integers");
  EXPECT_EQ(wordOf(refusal, "column"), "experiment");
  LoadOptions options;
  options.xyz_columns = {{"ix", "iy", "iz"}};
  EXPECT_EQ(valueOf(load(table, options), "z", 1), 5.0);
  // One whole number is enough for a doubt.
  EXPECT_EQ(wordOf(refusalOf("u,v,w\n0.5,2,3.5\n"), "column"), "v");
  EXPECT_EQ(listCodes(load("u,v,w\n0.5,2.5,3.5\n").notes),
            std::vector<std::string>{"assumed_coordinates"});
  EXPECT_EQ(load("1 2 3 4\n", {}, "a.xyz").cloud.width, 1u); // no header, no doubt
}

TEST(TextTables, Errors)
{
  EXPECT_EQ("some_coordinates_named", refusalOf("x,y,q\n1,2,3\n").code);
  EXPECT_EQ("few_columns", refusalOf("a,b\n1,2\n").code);
  EXPECT_EQ(2.0, numberOf(refusalOf("x,y,z\n1,2,3\n1,2\n"), "count"));
  EXPECT_EQ(2.0, numberOf(refusalOf("x,y,z\n1,2,3,4\n"), "line"));
  EXPECT_EQ("four in a, line 3", textIn("x,y,z,a\n1,2,3,4\n1,2,3,four\n"));
  EXPECT_EQ("b in y, line 2", textIn("x,y,z\n1,b,3\n"));
  EXPECT_NE(errorOf("x,y,z\n1,1.5m,3\n"), "");
  EXPECT_NE(errorOf("x,y,z\n1,1e999,3\n"), "");
  EXPECT_NE(errorOf("x,y,z\n1,\"2,3\n"), "");
  EXPECT_NE(errorOf("x,y,z\n1,\"2\"q,3\n"), "");
  EXPECT_NE(errorOf("# only\n\n"), "");
  EXPECT_EQ("not_text_file", refusalOf(std::string("x,y,z\n1,\0,3\n", 12)).code);
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
    LoadOptions options; // a header that tells no coordinates
    if (entry.path().filename() == "orebro_gas_network.csv")
      options.xyz_columns = {{"ix", "iy", "iz"}};
    const auto dataset = loadDataset(entry.path().string(), options);
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

} // namespace test_text_tables
