// SPDX-License-Identifier: BSD-3-Clause
// Particles of Houdini's classic binary format, written byte by byte.
#include "common/printable.h"
#include "common/records.h"
#include "io/point_stream.h"
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <filesystem>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_bgeo {

/** The highest byte first. */
template <typename T>
std::string
big(T value)
{
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof(value));
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string
text(const std::string& characters)
{
  return big(static_cast<std::uint16_t>(characters.size())) + characters;
}

/** \param defaults values of new points */
std::string
attribute(const std::string& name, int kind, std::uint16_t components)
{
  return text(name) + big(components) + big(kind) +
         std::string(std::size_t(4) * components, '\0');
}

std::string
names(const std::string& name, const std::vector<std::string>& list)
{
  std::string bytes = text(name) + big(std::uint16_t(1)) + big(4) +
                      big(static_cast<std::int32_t>(list.size()));
  for (const std::string& one : list)
    bytes += text(one);
  return bytes;
}

struct Counts {
  int points = 0, primitives = 0, point_groups = 0, point_attributes = 0,
      vertex_attributes = 0, primitive_attributes = 0, attributes = 0;
  int version = 5;
};

std::string
header(const Counts& counts)
{
  std::string bytes = "BgeoV" + big(counts.version);
  for (const int count : {counts.points,
                          counts.primitives,
                          counts.point_groups,
                          0,
                          counts.point_attributes,
                          counts.vertex_attributes,
                          counts.primitive_attributes,
                          counts.attributes})
    bytes += big(count);
  return bytes;
}

/** \param i the coordinates are i, i + 0.5 and -i */
std::string
position(int i)
{
  const auto x = static_cast<float>(i);
  return big(x) + big(x + 0.5F) + big(-x) + big(1.0F);
}

const std::string end("\0\xff", 2);

/** Three points with attributes of all kinds.
 * \param behind what follows the points */
std::string
particles(const Counts& more = {}, const std::string& behind = "")
{
  Counts counts = more;
  counts.points = 3;
  counts.point_attributes = 4;
  std::string bytes = header(counts) + attribute("density", 0, 1) +
                      attribute("id", 1, 1) + attribute("v", 5, 3) +
                      names("kind", {"water", "air", "water"});
  for (int i = 0; i < 3; ++i) {
    bytes += position(i) + big(1000.0F + static_cast<float>(i)) + big(-7 * i);
    for (const float k : {0.0F, 0.25F, 0.5F})
      bytes += big(static_cast<float>(i) + k);
    bytes += big(i == 1 ? 1 : 2 * i);
  }
  return bytes + behind + end;
}

std::string
systemOf(int kind, int vertices)
{
  std::string bytes = big(kind) + big(vertices);
  for (int i = 0; i < vertices; ++i)
    bytes += big(static_cast<std::uint16_t>(i));
  return bytes;
}

class Bgeo : public testing::Test {
protected:
  std::string
  save(const std::string& bytes, const std::string& name = "a.bgeo") const
  {
    writeFile(folder_ / name, bytes);
    return folder_ / name;
  }

  /** The code of the error; "" for a file that is read. */
  std::string
  refusalOf(const std::string& bytes) const
  {
    const std::string path = save(bytes);
    const Message thrown = thrownBy([&] { loadDataset(path); });
    if (!thrown.code.empty()) {
      const std::string message = thrown.text();
      EXPECT_EQ(0u, message.find("Cannot read '" + path + "': ")) << message;
      EXPECT_EQ('.', message.back()) << message;
      EXPECT_LE(message.size(), 300 + path.size()) << message;
      EXPECT_TRUE(isPrintable(message)) << message;
    }
    return thrown.code;
  }

  TemporaryFolder folder_;
};

TEST_F(Bgeo, AttributesKeepTheirNamesAndTypes)
{
  const Dataset points = loadDataset(save(particles()));
  ASSERT_EQ(3u, points.cloud.width);
  std::string fields;
  for (const auto& field : points.cloud.fields)
    fields += field.name + ' ' + std::to_string(field.datatype) + ' ' +
              std::to_string(field.count) + '\n';
  EXPECT_EQ("x 7 1\ny 7 1\nz 7 1\ndensity 7 1\nid 5 1\nv 7 3\nkind 5 1\n", fields);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = static_cast<double>(i);
    EXPECT_EQ(number, valueAt(points, "x", i));
    EXPECT_EQ(number + 0.5, valueAt(points, "y", i));
    EXPECT_EQ(-number, valueAt(points, "z", i));
    EXPECT_EQ(1000.0 + number, valueAt(points, "density", i));
    EXPECT_EQ(-7.0 * number, valueAt(points, "id", i));
    EXPECT_EQ(number + 0.25, valueAt(points, "v[1]", i));
  }
  EXPECT_TRUE(points.notes.empty());
  EXPECT_FALSE(points.double_coordinates);
}

/** Labels are in the order of their bytes, and numbers beyond the names are none. */
TEST_F(Bgeo, NamesBecomeLabels)
{
  const Dataset points = loadDataset(save(particles()));
  ASSERT_EQ(1u, points.labels.count("kind"));
  EXPECT_EQ((std::vector<std::string>{"air", "water"}), points.labels.at("kind"));
  EXPECT_EQ(1.0, valueAt(points, "kind", 0));
  EXPECT_EQ(0.0, valueAt(points, "kind", 1));
  EXPECT_EQ(-1.0, valueAt(points, "kind", 2));
}

TEST_F(Bgeo, StreamsAndPackedFilesAreTheSame)
{
  const std::string path = save(particles());
  const Dataset whole = loadDataset(path);
  PointStream stream(path);
  pcl::PCLPointCloud2 block;
  std::vector<std::uint8_t> bytes;
  while (stream.read(2, block) > 0)
    bytes.insert(bytes.end(), block.data.begin(), block.data.end());
  EXPECT_EQ(whole.cloud.data, bytes);
  ASSERT_EQ(
      0,
      runCommand("gzip -c '" + path + "' > '" + folder_ / "b.bgeo.gz" + "'").exit_code);
  EXPECT_EQ(whole.cloud.data, loadDataset(folder_ / "b.bgeo.gz").cloud.data);
  // Partio packs files without saying so in their names.
  std::filesystem::rename(folder_ / "b.bgeo.gz", folder_ / "b.bgeo");
  EXPECT_EQ(whole.cloud.data, loadDataset(folder_ / "b.bgeo").cloud.data);
  EXPECT_EQ(whole.cloud.data, loadDataset(save(particles(), "a.bhclassic")).cloud.data);
}

TEST_F(Bgeo, SystemsOfParticlesArePassedOver)
{
  Counts counts;
  counts.primitives = 2;
  counts.vertex_attributes = counts.primitive_attributes = 1;
  counts.attributes = 2;
  counts.point_groups = 1;
  std::string behind = attribute("of vertex", 0, 1) + names("generator", {"papi"});
  for (int i = 0; i < 2; ++i) {
    behind += big(0x8000) + big(2);
    for (std::uint16_t vertex = 0; vertex < 2; ++vertex)
      behind += big(vertex) + big(0.5F);
    behind += big(0);
  }
  const Dataset points = loadDataset(save(particles(counts, behind)));
  EXPECT_EQ(3u, points.cloud.width);
  ASSERT_EQ(2u, points.notes.size());
  EXPECT_EQ(Message("file_attributes", {{"attributes", 2}}), points.notes[0]);
  EXPECT_EQ(Message("point_groups", {{"groups", 1}}), points.notes[1]);
}

/** Points of large files are numbered by four bytes. */
TEST_F(Bgeo, ManyPointsHaveLongNumbers)
{
  for (const int count : {65535, 65536}) {
    Counts counts;
    counts.points = count;
    counts.primitives = 2;
    std::string bytes = header(counts);
    for (int i = 0; i < count; ++i)
      bytes += position(i);
    for (int system = 0; system < 2; ++system) {
      bytes += big(0x8000) + big(2);
      for (int i = 0; i < 2; ++i)
        bytes += count < 65536 ? big(static_cast<std::uint16_t>(i)) : big(i);
    }
    const Dataset points = loadDataset(save(bytes + end));
    EXPECT_EQ(static_cast<std::uint32_t>(count), points.cloud.width);
    EXPECT_EQ(count - 1.0, valueAt(points, "x", points.cloud.width - 1));
  }
}

TEST_F(Bgeo, EmptyFilesHaveNoPoints)
{
  Counts counts;
  counts.point_attributes = 1;
  const Dataset points =
      loadDataset(save(header(counts) + attribute("density", 0, 1) + end));
  EXPECT_EQ(0u, points.cloud.width);
  EXPECT_NE(nullptr, findField(points.cloud.fields, "density"));
}

TEST_F(Bgeo, NamesMayBeAny)
{
  Counts counts;
  counts.points = 1;
  counts.point_attributes = 3;
  const std::string bytes =
      header(counts) + attribute("x", 0, 1) + attribute("a \"b\"/\n", 1, 1) +
      attribute("\xc3\xa4", 0, 1) + position(3) + big(5.0F) + big(6) + big(7.0F) + end;
  const Dataset points = loadDataset(save(bytes));
  EXPECT_EQ(3.0, valueAt(points, "x", 0));
  EXPECT_EQ(5.0, valueAt(points, "x_2", 0));
  EXPECT_EQ(6.0, valueAt(points, "a \"b\"/\n", 0));
  EXPECT_EQ(7.0, valueAt(points, "\xc3\xa4", 0));
}

TEST_F(Bgeo, WhatCannotBeReadIsOneSentence)
{
  Counts counts;
  counts.primitives = 1;
  const auto with = [](const std::string& definition) {
    Counts one;
    one.points = one.point_attributes = 1;
    return header(one) + definition + position(0) + std::string(300, '\0') + end;
  };
  Counts other;
  other.version = 6;
  Counts negative;
  negative.points = -1;
  Counts many;
  many.points = 2147483647;
  Counts twice;
  twice.point_attributes = 2;
  for (const auto& [bytes, code] : std::vector<std::pair<std::string, std::string>>{
           {"\x7fNSJ and more", "houdini_12"},
           {"ply\n", "wrong_start"},
           {header(other) + end, "unsupported_value"},
           {header(negative) + end, "invalid_part"},
           {header(many) + end, "truncated_data"},
           {particles(counts, systemOf(1, 2)), "houdini_primitives"},
           {particles(counts, systemOf(0x8000, 2).substr(0, 9)), "truncated_part"},
           {particles(counts, big(0x8000) + big(-1)), "truncated_part"},
           {with(attribute("s", 2, 4)), "unsupported_value"},
           {with(attribute("s", 3, 1)), "unsupported_value"},
           {with(attribute("s", 0, 0)), "unsupported_value"},
           {with(attribute("s", 0, 65)), "unsupported_value"},
           {with(text("s") + big(std::uint16_t(1)) + big(4) + big(70000)),
            "too_many_parts"},
           {header(twice) + attribute("s", 0, 1) + attribute("s", 0, 1) + end,
            "repeated_part"}})
    EXPECT_EQ(code, refusalOf(bytes)) << bytes;
}

TEST_F(Bgeo, TruncationIsOneSentence)
{
  Counts counts;
  counts.primitives = 1;
  const std::string bytes = particles(counts, systemOf(0x8000, 3));
  EXPECT_EQ("", refusalOf(bytes));
  for (std::size_t size = 0; size + end.size() < bytes.size(); ++size)
    EXPECT_NE("", refusalOf(bytes.substr(0, size))) << size;
}

TEST_F(Bgeo, DamageIsOneSentence)
{
  Counts counts;
  counts.primitives = 1;
  const std::string bytes = particles(counts, systemOf(0x8000, 3));
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const char byte : {'\0', '\1', '\x7f', '\xff'}) {
      std::string other = bytes;
      other[at] = byte;
      refusalOf(other);
    }
}

} // namespace test_bgeo
