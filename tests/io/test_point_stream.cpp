// SPDX-License-Identifier: BSD-3-Clause
// A file read in blocks gives the very bytes of the file read whole.
#include "common/memory.h"
#include "io/point_stream.h"
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_point_stream {

void
expectSameLayout(const pcl::PCLPointCloud2& actual, const pcl::PCLPointCloud2& expected)
{
  ASSERT_EQ(actual.point_step, expected.point_step);
  ASSERT_EQ(actual.fields.size(), expected.fields.size());
  for (std::size_t i = 0; i < actual.fields.size(); ++i) {
    EXPECT_EQ(actual.fields[i].name, expected.fields[i].name);
    EXPECT_EQ(actual.fields[i].offset, expected.fields[i].offset);
    EXPECT_EQ(actual.fields[i].datatype, expected.fields[i].datatype);
    EXPECT_EQ(actual.fields[i].count, expected.fields[i].count);
  }
  EXPECT_EQ(actual.row_step, actual.point_step * actual.width);
  EXPECT_EQ(actual.height, 1u);
}

/** The bytes of the points from the current one on, in blocks of such a size. */
std::vector<std::uint8_t>
readOn(PointStream& stream, std::size_t block_size)
{
  std::vector<std::uint8_t> data;
  pcl::PCLPointCloud2 block;
  block.data.assign(100000, 0xAB); // of a block read before
  while (const std::size_t count = stream.read(block_size, block)) {
    EXPECT_LE(count, block_size);
    EXPECT_EQ(block.width, count);
    expectSameLayout(block, stream.getHeader().cloud);
    data.insert(data.end(), block.data.begin(), block.data.end());
  }
  EXPECT_EQ(stream.tell(), stream.size());
  EXPECT_EQ(block.data.size(), 0u);
  return data;
}

std::vector<std::uint8_t>
pointsOf(const Dataset& dataset, std::size_t begin, std::size_t end)
{
  const std::size_t step = dataset.cloud.point_step;
  const auto& data = dataset.cloud.data;
  return {data.begin() + static_cast<std::ptrdiff_t>(begin * step),
          data.begin() + static_cast<std::ptrdiff_t>(end * step)};
}

/** Blocks of every size, from any point on, and points here and there. */
void
expectStreams(const std::string& path, const LoadOptions& options = {})
{
  const Dataset whole = loadDataset(path, options);
  const std::size_t count = whole.cloud.width;
  PointStream stream(path, options);
  ASSERT_EQ(stream.size(), count);
  expectSameLayout(stream.getHeader().cloud, whole.cloud);
  EXPECT_EQ(stream.getHeader().cloud.width, 0u);
  EXPECT_EQ(stream.getHeader().origin, whole.origin);
  EXPECT_EQ(stream.getHeader().double_coordinates, whole.double_coordinates);
  EXPECT_EQ(stream.getHeader().has_coordinates, whole.has_coordinates);
  EXPECT_EQ(stream.getHeader().notes, whole.notes);
  for (const std::size_t size : {std::size_t(1) << 40, count + 1, count, count / 2 + 1})
    if (size > 0) {
      stream.seek(0);
      EXPECT_TRUE(readOn(stream, size) == whole.cloud.data) << size;
    }
  if (count < 1000) {
    stream.seek(0);
    EXPECT_TRUE(readOn(stream, 1) == whole.cloud.data);
  }
  Random random(4);
  for (int i = 0; i < 8; ++i) {
    const auto at = static_cast<std::size_t>(random.uniform() * double(count + 1));
    stream.seek(at);
    EXPECT_TRUE(readOn(stream, count / 3 + 1) == pointsOf(whole, at, count)) << at;
  }
  std::vector<std::uint64_t> points;
  std::vector<std::uint8_t> expected;
  for (std::size_t i = 0; i < count; ++i)
    for (int times = random.uniform() < 0.02 ? 1 + int(2 * random.uniform()) : 0;
         times > 0;
         --times) {
      points.push_back(i);
      const auto point = pointsOf(whole, i, i + 1);
      expected.insert(expected.end(), point.begin(), point.end());
    }
  pcl::PCLPointCloud2 rows;
  stream.readRows(points, rows);
  expectSameLayout(rows, whole.cloud);
  EXPECT_EQ(rows.width, points.size());
  EXPECT_TRUE(rows.data == expected);
}

void
expectTextStreams(const std::string& text, const std::string& name = "a.csv")
{
  SCOPED_TRACE(text.substr(0, 60));
  const TemporaryFolder folder;
  writeFile(folder / name, text);
  expectStreams(folder / name);
}

struct Format {
  std::string file;
  bool ascii;
};

const std::vector<Format> formats{{"a.pcd", false},
                                  {"t.pcd", true},
                                  {"a.ply", false},
                                  {"t.ply", true},
                                  {"a.csv", true}};

void
expectSavedStreams(const Dataset& dataset)
{
  for (const auto& format : formats) {
    SCOPED_TRACE(format.file);
    const TemporaryFolder folder;
    SaveOptions options;
    options.ascii = format.ascii;
    saveDataset(folder / format.file, dataset, options);
    expectStreams(folder / format.file);
  }
}

/** Such a PLY with the byte order turned; lists of all lengths where they are wanted.
 */
std::string
bigEndianPly(std::size_t count, bool lists)
{
  std::string text =
      "ply\nformat binary_big_endian 1.0\nelement pre 2\nproperty list uchar short l\n"
      "element vertex " +
      std::to_string(count) +
      "\nproperty double z\nproperty uchar q\nproperty float x\n" +
      (lists ? "property list uchar int l\n" : "") +
      "property short y\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "element face 1\nproperty list uchar int i\nend_header\n";
  text += std::string("\x01\x00\x05\x00", 4);
  Random random(8);
  for (std::size_t i = 0; i < count; ++i) {
    const auto real = [&random] { return static_cast<char>(64.0 * random.uniform()); };
    for (int byte = 0; byte < 13; ++byte)
      text += real();
    if (lists) {
      const auto length = static_cast<char>(i % 5);
      text += length + std::string(static_cast<std::size_t>(4 * length), 'l');
    }
    for (int byte = 0; byte < 14; ++byte)
      text += real();
  }
  return text + "\x03";
}

std::string
table(std::size_t rows, const std::string& end_of_line, double shift)
{
  std::string text = "id,x,y,z,T,name,n" + end_of_line;
  Random random(3);
  for (std::size_t i = 0; i < rows; ++i) {
    text += std::to_string(i);
    for (int axis = 0; axis < 3; ++axis)
      text += ',' + std::to_string(100.0 * random.uniform() + shift);
    text += random.uniform() < 0.2 ? "," : "," + std::to_string(random.uniform());
    text += (i % 3 ? ",\"a, b\"," : ",c,") + std::to_string(i * i) + end_of_line;
    if (i % 7 == 0)
      text += "# between" + end_of_line + end_of_line;
  }
  return text;
}

void
readInBlocks(const std::string& path)
{
  PointStream stream(path);
  pcl::PCLPointCloud2 block;
  while (stream.read(7, block) > 0) {
  }
}

/** The error of opening or of reading all. */
std::string
streamErrorOf(const std::string& path)
{
  return messageOf<IOError>([&] { readInBlocks(path); });
}

TEST(PointStream, EveryTypeOfField)
{
  std::vector<FieldSpec> specs;
  for (const std::uint8_t type : allDatatypes())
    if (type != Type::INT64 && type != Type::UINT64)
      specs.push_back({"f" + std::to_string(type), type});
  for (const std::size_t count : {0u, 1u, 2u, 137u}) {
    SCOPED_TRACE(count);
    expectSavedStreams(makeDataset(specs, count, 5));
    expectSavedStreams(makeDataset({{"density", Type::FLOAT32}}, count, 5));
  }
}

TEST(PointStream, ComponentsAndWideIntegers)
{
  const auto dataset = makeDataset(
      {{"v", Type::FLOAT64, 3}, {"id", Type::INT64}, {"b", Type::UINT8, 5}}, 50, 5);
  for (const bool ascii : {false, true}) {
    const TemporaryFolder folder;
    SaveOptions options;
    options.ascii = ascii;
    saveDataset(folder / "a.pcd", dataset, options);
    expectStreams(folder / "a.pcd");
  }
}

TEST(PointStream, MorePointsThanBuffersHold)
{
  expectSavedStreams(makeDataset({{"a", Type::FLOAT32}, {"c", Type::UINT8}}, 40000, 6));
  expectTextStreams(bigEndianPly(40000, true), "a.ply");
  expectTextStreams(bigEndianPly(40000, false), "a.ply");
}

TEST(PointStream, LargeCoordinates)
{
  Random random(5);
  std::vector<double> xyz;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < 20000; ++i)
    for (const double shift : {500000.0, 5500000.0, 100.0})
      xyz.push_back(random.uniform() < 0.01 ? nan : 100.0 * random.uniform() + shift);
  Dataset dataset = makeDataset({{"a", Type::FLOAT32}, {"c", Type::INT8}}, 20000, 2);
  dataset.double_coordinates = true;
  setCoordinates(dataset, xyz);
  ASSERT_NE(dataset.origin[1], 0.0);
  expectSavedStreams(dataset);
}

TEST(PointStream, TheLastPointCountsForTheOrigin)
{
  // Float holds all coordinates but those of the last point.
  std::string text = "ply\nformat ascii 1.0\nelement vertex 30001\nproperty double x\n"
                     "property double y\nproperty int z\nend_header\n";
  for (int i = 0; i < 30000; ++i)
    text += std::to_string(5000000 + i % 10) + " 0 1\n";
  text += "5000000.123456789 5 1";
  expectTextStreams(text, "a.ply");
  const TemporaryFolder folder;
  writeFile(folder / "a.ply", text);
  EXPECT_NE(PointStream(folder / "a.ply").getHeader().origin[0], 0.0);
}

TEST(PointStream, LayoutsOfPcd)
{
  const std::string points = "1 2 3 4 5 6 7\n-1 -2 -3 -4 -5 -6 -7";
  for (const char* const fields :
       {"FIELDS a x _ y b z c\nSIZE 1 4 4 4 2 4 8\nTYPE I F I F I F F\n",
        "FIELDS a x x y y z a\nSIZE 4 4 4 4 4 4 1\nTYPE F F F F F F I\n",
        "FIELDS x y z a b c d\nSIZE 2 8 1 4 4 4 1\nTYPE I I I F F F I\n"})
    for (const char* const end : {"", "\n", "\r\n", "\n\n  \n"}) {
      std::string text = fields + ("WIDTH 2\nDATA ascii\n" + points + end);
      expectTextStreams(text, "a.pcd");
    }
}

TEST(PointStream, Tables)
{
  for (const double shift : {0.0, 5e6})
    for (const char* const end : {"\n", "\r\n"}) {
      const std::string text = table(20000, end, shift);
      expectTextStreams(text);
      expectTextStreams(text.substr(0, text.rfind(',') + 2)); // no last newline
    }
  for (const char* const text : {"x,y,z\n",
                                 "x,y,z\n1,2,3",
                                 "1 2 3\n4 5 6.5\n",
                                 "# x y z a\n1 2 3 4\n",
                                 "\xEF\xBB\xBFz;y;x;a\n1;2;3;9007199254740993\n",
                                 "X Y Z x a\n1 2 3 nan 5\n1 2 3 4 3000000000\n",
                                 "lon,lat,depth,T\n1,2,3,N/A\n4,5,,7\n"})
    expectTextStreams(text);
}

TEST(PointStream, OptionsOfTables)
{
  const TemporaryFolder folder;
  writeFile(folder / "a.csv", "a,b,c,d\n1,2,3,4\n5,6,7,8.5\n");
  LoadOptions columns;
  columns.xyz_columns = {{"3", "1", "0"}};
  expectStreams(folder / "a.csv", columns);
  LoadOptions none;
  none.needs_coordinates = false;
  expectStreams(folder / "a.csv", none);
  EXPECT_FALSE(PointStream(folder / "a.csv", none).getHeader().has_coordinates);
}

TEST(PointStream, LinesLongerThanABuffer)
{
  const std::string blanks(700000, ' ');
  expectTextStreams("x y z\n1 2 3\n4" + blanks + "5 6\n7 8 9\n");
}

TEST(PointStream, DamageIsReportedAsByLoading)
{
  const auto dataset = makeDataset({{"a", Type::FLOAT32}, {"id", Type::INT32}}, 40, 4);
  for (const auto& format : formats) {
    const TemporaryFolder folder;
    SaveOptions options;
    options.ascii = format.ascii;
    const std::string path = folder / format.file;
    saveDataset(path, dataset, options);
    const std::string whole = readFile(path);
    Random random(7);
    std::size_t failed = 0;
    for (int round = 0; round < 300; ++round) {
      std::string damaged = whole;
      const auto at = static_cast<std::size_t>(random.uniform() * double(whole.size()));
      if (round % 2)
        damaged.resize(at);
      else
        damaged[at] = "\n 9x#"[round / 2 % 5];
      writeFile(path, damaged);
      const std::string expected = messageOf<IOError>([&] { loadDataset(path); });
      EXPECT_EQ(streamErrorOf(path), expected);
      failed += !expected.empty();
    }
    EXPECT_GT(failed, 20u) << format.file;
  }
  const TemporaryFolder folder;
  for (const char* const name : {"e.pcd", "e.ply", "e.csv"}) {
    writeFile(folder / name, "");
    EXPECT_EQ("empty_file", codeOf([&] { readInBlocks(folder / name); }));
  }
  writeFile(folder / "more.pcd",
            "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 0\nDATA ascii\n1 2 3\n");
  EXPECT_EQ("too_many_parts", codeOf([&] { readInBlocks(folder / "more.pcd"); }));
}

TEST(PointStream, ReadingGoesOnAfterAnError)
{
  const TemporaryFolder folder;
  writeFile(folder / "a.pcd",
            "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 3\nDATA ascii\n1 2 3\n"
            "4 five 6\n7 8 9\n");
  PointStream stream(folder / "a.pcd");
  pcl::PCLPointCloud2 block;
  EXPECT_EQ(stream.read(1, block), 1u);
  EXPECT_THROW(stream.read(1, block), IOError);
  stream.seek(2);
  Dataset dataset = stream.getHeader();
  EXPECT_EQ(stream.read(9, dataset.cloud), 1u);
  EXPECT_EQ(valueOf(dataset, "y", 0), 8.0);
}

TEST(PointStream, FormatsThatHaveToBeReadWhole)
{
  const TemporaryFolder folder;
  writeFile(folder / "c.pcd",
            "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nDATA binary_compressed\n");
  saveDataset(folder / "a.vtp", makeDataset({}, 3, 1));
  for (const auto& path : {folder / "c.pcd", folder / "a.vtp"}) {
    const Message error = thrownBy([&] { PointStream{path}; });
    EXPECT_EQ("not_streamable", error.code);
    EXPECT_EQ(path, wordOf(error, "path"));
  }
  for (const char* const name : {"none.vtp", "a.jpg"})
    EXPECT_EQ("no_such_file", codeOf([&] { PointStream(folder / name); }));
  LoadOptions columns;
  columns.xyz_columns = {{"2", "1", "0"}};
  EXPECT_THROW(PointStream(folder / "c.pcd", columns), InvalidArgument);
}

TEST(PointStream, PointsThatAreNotThere)
{
  const TemporaryFolder folder;
  saveDataset(folder / "a.ply", makeDataset({}, 10, 1));
  PointStream stream(folder / "a.ply");
  stream.seek(10);
  pcl::PCLPointCloud2 block;
  EXPECT_EQ(stream.read(5, block), 0u);
  EXPECT_EQ(Message("no_such_point", {{"point", 11}, {"points", 10}}),
            thrownBy<InvalidArgument>([&] { stream.seek(11); }));
  EXPECT_EQ(Message("no_such_point", {{"point", 10}, {"points", 10}}),
            thrownBy<InvalidArgument>([&] {
              stream.readRows({3, 10}, block);
            }));
  EXPECT_THROW(stream.readRows({4, 3}, block), InvalidArgument);
  EXPECT_NO_THROW(stream.readRows({3, 3, 9}, block));
  EXPECT_EQ(block.width, 3u);
  EXPECT_EQ(stream.tell(), 10u);
}

TEST(PointStream, TakesLittleMemoryBesideTheBlock)
{
  if (uvol_test::isSanitized())
    GTEST_SKIP() << "Sanitizers take memory of their own.";
  if (!uvol_test::resetPeakMemory() || pcl_uvol::peakMemory() == 0)
    GTEST_SKIP() << "This system does not tell peaks of memory.";
  constexpr std::size_t count = 1500000, block_size = 1000;
  const TemporaryFolder folder;
  {
    Dataset dataset = makeDataset({{"a", Type::FLOAT64}}, count, 1);
    saveDataset(folder / "a.pcd", dataset);
    dataset.double_coordinates = true;
    saveDataset(folder / "d.ply", dataset);
    dataset = makeDataset({}, count, 1);
    saveDataset(folder / "a.csv", dataset);
  }
  for (const char* const name : {"a.pcd", "d.ply", "a.csv"}) {
    ASSERT_TRUE(uvol_test::resetPeakMemory());
    const std::uint64_t before = pcl_uvol::peakMemory();
    PointStream stream(folder / name);
    pcl::PCLPointCloud2 block;
    std::size_t sum = 0;
    while (const std::size_t got = stream.read(block_size, block))
      sum += got;
    EXPECT_EQ(sum, count);
    EXPECT_LE(pcl_uvol::peakMemory(), before + 2000000) << name;
  }
}

} // namespace test_point_stream
