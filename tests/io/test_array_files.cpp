// SPDX-License-Identifier: BSD-3-Clause
// Arrays of NumPy, laser scans, and packed files.
#include "io/memory_need.h"
#include "io/point_stream.h"
#include "random_dataset.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_array_files {

template <typename T>
void
add(std::string& bytes, T value)
{
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

class ArrayFiles : public testing::Test {
protected:
  std::string
  save(const std::string& name, const std::string& bytes) const
  {
    writeFile(folder_ / name, bytes);
    return folder_ / name;
  }

  std::string
  sentenceOf(const std::string& path) const
  {
    return messageOf<IOError>([&] { loadDataset(path); });
  }

  std::string
  refusalOf(const std::string& path) const
  {
    return codeOf([&] { loadDataset(path); });
  }

  void
  expectStreams(const std::string& path) const
  {
    const Dataset whole = loadDataset(path);
    PointStream stream(path);
    pcl::PCLPointCloud2 block;
    std::vector<std::uint8_t> data;
    while (stream.read(2, block))
      data.insert(data.end(), block.data.begin(), block.data.end());
    EXPECT_TRUE(whole.cloud.data == data) << path;
    EXPECT_EQ(whole.cloud.width, peekHeader(path).value().points);
  }

  /** Every file that is cut off or changed is read or refused in one sentence. */
  void
  damage(const std::string& name, const std::string& bytes, bool loses_all = true) const
  {
    for (std::size_t size = 1; size < bytes.size(); size += 1 + bytes.size() / 150) {
      const std::string path = save(name, bytes.substr(0, size));
      const std::string message = sentenceOf(path);
      EXPECT_EQ(loses_all, loses_all && !message.empty()) << size;
    }
    Random random(3);
    for (int i = 0; i < 150; ++i) {
      std::string other = bytes;
      for (int k = 0; k < 2; ++k)
        other[static_cast<std::size_t>(random.uniform() * double(bytes.size()))] =
            static_cast<char>(256.0 * random.uniform());
      const std::string path = save(name, other);
      const std::string message = sentenceOf(path);
      if (!message.empty()) {
        EXPECT_NE(std::string::npos, message.find(path)) << message;
      }
    }
  }

  TemporaryFolder folder_;
};

std::string
npy(const std::string& type, const std::string& shape, bool by_columns = false)
{
  std::string text = "{'descr': " + type +
                     ", 'fortran_order': " + (by_columns ? "True" : "False") +
                     ", 'shape': " + shape + ", }\n";
  std::string bytes("\x93NUMPY\1\0", 8);
  add(bytes, static_cast<std::uint16_t>(text.size()));
  return bytes + text;
}

TEST_F(ArrayFiles, TablesAreReadRowByRowAndColumnByColumn)
{
  std::string rows = npy("'<f4'", "(5, 4)"), columns = npy("'<f4'", "(5, 4)", true),
              turned = npy("'>f8'", "(5, 4)");
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 4; ++column) {
      add(rows, static_cast<float>(10 * row + column));
      const double number = 10 * row + column;
      std::string own(reinterpret_cast<const char*>(&number), sizeof(number));
      std::reverse(own.begin(), own.end());
      turned += own;
    }
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 5; ++row)
      add(columns, static_cast<float>(10 * row + column));
  for (const std::string& bytes : {rows, columns, turned}) {
    const std::string path = save("a.npy", bytes);
    const Dataset points = loadDataset(path);
    ASSERT_EQ(5u, points.cloud.width);
    EXPECT_EQ(std::vector<std::string>{"unnamed_columns"}, listCodes(points.notes));
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(10.0 * double(i) + 2.0, valueAt(points, "z", i) + points.origin[2]);
      EXPECT_EQ(10.0 * double(i) + 3.0, valueAt(points, "column_3", i));
    }
    expectStreams(path);
  }
  damage("d.npy", rows);
}

TEST_F(ArrayFiles, StructuredArraysKeepTheirNames)
{
  std::string bytes =
      npy("[('pos', '<f4', (3,)), ('v', '<f8', (2,)), ('id', '>i2')]", "(3,)");
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      add(bytes, static_cast<float>(i + k));
    for (int k = 0; k < 2; ++k)
      add(bytes, 100.0 * i + k);
    bytes += '\1';
    bytes += static_cast<char>(i);
  }
  const Dataset points = loadDataset(save("a.npy", bytes));
  ASSERT_EQ(3u, points.cloud.width);
  EXPECT_EQ(4.0, valueAt(points, "z", 2));
  EXPECT_EQ(201.0, valueAt(points, "v[1]", 2));
  EXPECT_EQ(258.0, valueAt(points, "id", 2));
  expectStreams(folder_ / "a.npy");
}

TEST_F(ArrayFiles, ArraysThatAreNoPointsAreRefused)
{
  for (const auto& [bytes, code] : std::vector<std::pair<std::string, const char*>>{
           {npy("'<f4'", "(3,)") + std::string(12, '\0'), "no_point_array"},
           {npy("'<f4'", "(3, 2)") + std::string(24, '\0'), "no_point_array"},
           {npy("'<U4'", "(3, 3)") + std::string(200, '\0'), "unsupported_value"},
           {npy("'<f4'", "(4611686018427387904, 3)"), "truncated_part"},
           {npy("'<f4'", "(-1, 3)"), "invalid_part"},
           {npy("{", ")"), "invalid_part"},
           {"nothing that NumPy wrote", "not_format"}})
    EXPECT_EQ(code, refusalOf(save("a.npy", bytes))) << bytes;
}

TEST_F(ArrayFiles, NpzBringsEveryFieldBack)
{
  const std::vector<FieldSpec> specs{{"flag", Type::UINT8},
                                     {"mass", Type::FLOAT64},
                                     {"vel", Type::FLOAT32, 3},
                                     {"id", Type::INT64},
                                     {"n", Type::UINT16}};
  for (const bool is_wide : {false, true}) {
    Dataset dataset = makeDataset(specs, 20000, 5);
    dataset.double_coordinates = is_wide;
    if (is_wide)
      dataset.origin = {{1048576.0, -2097152.0, 0.0}};
    saveDataset(folder_ / "a.npz", dataset);
    const Dataset back = loadDataset(folder_ / "a.npz");
    ASSERT_EQ(dataset.cloud.width, back.cloud.width);
    EXPECT_EQ(is_wide, back.double_coordinates);
    for (const char* const name : {"flag", "mass", "vel[2]", "id", "n"})
      for (std::size_t i = 0; i < dataset.cloud.width; i += 17) {
        const double expected = valueAt(dataset, name, i),
                     actual = valueAt(back, name, i);
        EXPECT_TRUE(expected == actual || (std::isnan(expected) && std::isnan(actual)));
      }
    for (std::size_t i = 0; i < dataset.cloud.width; i += 17)
      EXPECT_EQ(dataset.origin[0] + valueAt(dataset, "x", i),
                back.origin[0] + valueAt(back, "x", i));
  }
  saveDataset(folder_ / "s.npz", makeDataset({{"v", Type::FLOAT32}}, 3, 5));
  expectStreams(folder_ / "s.npz");
  damage("d.npz", readFile(folder_ / "s.npz"));
  saveDataset(folder_ / "0.npz", makeDataset(specs, 0, 5));
  EXPECT_EQ(0u, loadDataset(folder_ / "0.npz").cloud.width);
}

TEST_F(ArrayFiles, PartsOfAZipDoNotShareTheirBytes)
{
  const std::string path = save(
      "a.npz",
      readFile(PCL_UVOL_SOURCE_DIR "/tests/fuzz/corpus/npz/one_part_under_many_names"));
  EXPECT_EQ("not_format", refusalOf(path));
}

/** A scan of three points in format `format`. */
std::string
las(int minor, int format, int point_bytes)
{
  std::string bytes = "LASF" + std::string(20, '\0');
  bytes += '\1';
  bytes += static_cast<char>(minor);
  bytes.resize(minor == 4 ? 375 : 227);
  const auto put_at = [&](std::size_t offset, auto value) {
    bytes.replace(
        offset, sizeof(value), reinterpret_cast<const char*>(&value), sizeof(value));
  };
  put_at(96, static_cast<std::uint32_t>(bytes.size()));
  bytes[104] = static_cast<char>(format);
  put_at(105, static_cast<std::uint16_t>(point_bytes));
  if (minor == 4)
    put_at(247, std::uint64_t(3));
  else
    put_at(107, std::uint32_t(3));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put_at(131 + 8 * axis, 0.01);
    put_at(155 + 8 * axis, 500000.0 * static_cast<double>(axis + 1));
  }
  for (int i = 0; i < 3; ++i) {
    std::string point(static_cast<std::size_t>(point_bytes), '\0');
    const auto in_point = [&](std::size_t offset, auto value) {
      point.replace(
          offset, sizeof(value), reinterpret_cast<const char*>(&value), sizeof(value));
    };
    for (int axis = 0; axis < 3; ++axis)
      in_point(static_cast<std::size_t>(4 * axis), std::int32_t(1000 * i - axis));
    in_point(12, static_cast<std::uint16_t>(40000 + i));
    const bool is_new = format >= 6;
    point[14] = static_cast<char>(is_new ? 0x32 : 0x1a); // return 2 of 3
    point[is_new ? 16 : 15] = static_cast<char>(6 + (is_new ? 0 : 0x40));
    if (is_new || format == 1 || format >= 3)
      in_point(is_new ? 22 : 20, 0.5 + i);
    if (format == 7)
      in_point(34, std::uint16_t(65000));
    if (format == 2)
      in_point(24, std::uint16_t(65000));
    if (format == 8)
      in_point(36, std::uint16_t(7));
    bytes += point;
  }
  return bytes;
}

/** The variable length record that describes extra bytes (LAS 1.4, 2.7). */
std::string
describeExtras(const std::vector<std::tuple<int, int, std::string>>& extras)
{
  const auto put = [](std::string& bytes, std::size_t offset, auto value) {
    bytes.replace(
        offset, sizeof(value), reinterpret_cast<const char*>(&value), sizeof(value));
  };
  std::string record(54, '\0');
  record.replace(2, 9, "LASF_Spec");
  put(record, 18, std::uint16_t(4));
  put(record, 20, static_cast<std::uint16_t>(192 * extras.size()));
  for (const auto& [type, options, name] : extras) {
    std::string extra(192, '\0');
    extra[2] = static_cast<char>(type);
    extra[3] = static_cast<char>(options);
    extra.replace(4, name.size(), name);
    put(extra, 40, std::uint64_t(65535)); // no data
    put(extra, 112, 0.5);                 // scale
    put(extra, 136, 100.0);               // offset
    record += extra;
  }
  return record;
}

TEST_F(ArrayFiles, ExtraBytesOfLaserScansAreFields)
{
  // Two bytes without a type, a number with scale and offset, a plain one, and x again.
  const std::string extras = describeExtras(
      {{0, 2, "pad"}, {3, 1 + 8 + 16, "height"}, {9, 0, "ratio"}, {2, 0, "x"}});
  std::string bytes = las(2, 0, 20 + 2 + 2 + 4 + 1);
  const std::size_t head = 227;
  for (int i = 0; i < 3; ++i) {
    const std::size_t at = head + static_cast<std::size_t>(29 * i + 22);
    const std::uint16_t height = i == 2 ? 65535 : static_cast<std::uint16_t>(10 * i);
    const float ratio = 0.25f * static_cast<float>(i);
    bytes.replace(at, 2, reinterpret_cast<const char*>(&height), 2);
    bytes.replace(at + 2, 4, reinterpret_cast<const char*>(&ratio), 4);
    bytes[at + 6] = static_cast<char>(-i);
  }
  bytes.insert(head, extras);
  const auto put = [&](std::size_t offset, auto value) {
    bytes.replace(
        offset, sizeof(value), reinterpret_cast<const char*>(&value), sizeof(value));
  };
  put(94, static_cast<std::uint16_t>(head));
  put(96, static_cast<std::uint32_t>(head + extras.size()));
  put(100, std::uint32_t(1));
  const Dataset scan = loadDataset(save("a.las", bytes));
  EXPECT_TRUE(scan.notes.empty());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(0.25 * double(i), valueAt(scan, "ratio", i));
    EXPECT_EQ(-double(i), valueAt(scan, "x_2", i));
    if (i < 2) {
      EXPECT_EQ(100.0 + 5.0 * double(i), valueAt(scan, "height", i));
    }
  }
  EXPECT_TRUE(std::isnan(valueAt(scan, "height", 2)));
  // A description that does not fit the points describes nothing.
  put(105, std::uint16_t(24));
  EXPECT_EQ(std::vector<std::string>{"extra_bytes"},
            listCodes(loadDataset(save("b.las", bytes)).notes));
}

TEST_F(ArrayFiles, LaserScansKeepTheirAttributes)
{
  for (const auto& [minor, format, size] :
       std::vector<std::array<int, 3>>{{2, 0, 20},
                                       {2, 1, 28},
                                       {2, 2, 26},
                                       {3, 3, 34},
                                       {4, 6, 30},
                                       {4, 7, 36},
                                       {4, 8, 41}}) {
    SCOPED_TRACE(format);
    const std::string path = save("a.las", las(minor, format, size));
    const Dataset scan = loadDataset(path);
    ASSERT_EQ(3u, scan.cloud.width);
    EXPECT_TRUE(scan.double_coordinates);
    EXPECT_EQ(format == 8 ? std::vector<std::string>{"extra_bytes"}
                          : std::vector<std::string>{},
              listCodes(scan.notes));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(
          500000.0 + 10.0 * double(i), valueAt(scan, "x", i) + scan.origin[0], 1e-6);
      EXPECT_NEAR(1500000.0 + 10.0 * double(i) - 0.02,
                  valueAt(scan, "z", i) + scan.origin[2],
                  1e-6);
      EXPECT_EQ(40000.0 + double(i), valueAt(scan, "intensity", i));
      EXPECT_EQ(2.0, valueAt(scan, "return_number", i));
      EXPECT_EQ(3.0, valueAt(scan, "number_of_returns", i));
      EXPECT_EQ(6.0, valueAt(scan, "classification", i));
      if (format == 1 || format == 3 || format >= 6) {
        EXPECT_EQ(0.5 + double(i), valueAt(scan, "gps_time", i));
      }
      if (format == 2 || format == 7) {
        EXPECT_EQ(65000.0, valueAt(scan, "blue", i));
      }
      if (format == 8) {
        EXPECT_EQ(7.0, valueAt(scan, "nir", i));
      }
    }
    expectStreams(path);
  }
  damage("d.las", las(2, 1, 28));
  std::string packed = las(2, 1, 28);
  packed[104] = static_cast<char>(0x81);
  EXPECT_EQ("packed_points", refusalOf(save("a.las", packed)));
  EXPECT_EQ("unsupported_value", refusalOf(save("a.las", las(4, 11, 80))));
}

/** The packing programs of the system make the files. */
TEST_F(ArrayFiles, PackedFilesAreThoseWithin)
{
  const Dataset dataset = makeDataset({{"v", Type::FLOAT32}}, 30000, 7);
  for (const char* const name : {"a.csv", "a.ply", "a.pcd"}) {
    saveDataset(folder_ / name, dataset);
    const Dataset whole = loadDataset(folder_ / name);
    for (const auto& [program, ending] :
         {std::pair<std::string, std::string>{"gzip", ".gz"},
          {"bzip2", ".bz2"},
          {"zstd", ".zst"}}) {
      const std::string path = folder_ / (name + ending);
      if (runCommand("command -v " + program).exit_code != 0)
        continue;
      ASSERT_EQ(0,
                runCommand(program + " -c '" + (folder_ / name) + "' > '" + path + "'")
                    .exit_code);
      const Dataset unpacked = loadDataset(path);
      EXPECT_TRUE(whole.cloud.data == unpacked.cloud.data) << path;
      PointStream stream(path);
      EXPECT_EQ(whole.cloud.width, stream.size());
      const std::string bytes = readFile(path);
      // Files of these programs may be joined: a header and rows, then rows.
      for (const std::size_t part :
           {std::size_t(1), bytes.size() / 2, bytes.size() - 1})
        EXPECT_EQ("damaged_compression",
                  refusalOf(save("cut." + std::string(name).substr(2) + ending,
                                 bytes.substr(0, part))))
            << path << part;
    }
  }
  EXPECT_EQ("packed_output",
            codeOf([&] { saveDataset(folder_ / "b.ply.gz", dataset); }));
}

TEST_F(ArrayFiles, JoinedPackedFilesAreReadToTheEnd)
{
  writeFile(folder_ / "1.csv", "x,y,z,v\n1,2,3,4\n");
  writeFile(folder_ / "2.csv", "5,6,7,8\n");
  for (const auto& [program, ending] :
       {std::pair<std::string, std::string>{"gzip", ".gz"},
        {"bzip2", ".bz2"},
        {"zstd", ".zst"}}) {
    if (runCommand("command -v " + program).exit_code != 0)
      continue;
    const std::string path = folder_ / ("a.csv" + ending);
    ASSERT_EQ(0,
              runCommand("(" + program + " -c '" + (folder_ / "1.csv") + "'; " +
                         program + " -c '" + (folder_ / "2.csv") + "') > '" + path +
                         "'")
                  .exit_code);
    const Dataset rows = loadDataset(path);
    ASSERT_EQ(2u, rows.cloud.width) << ending;
    EXPECT_EQ(8.0, valueAt(rows, "v", 1));
  }
}

} // namespace test_array_files
