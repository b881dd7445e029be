// SPDX-License-Identifier: BSD-3-Clause
// What is saved comes back: every format, encoding, type; large coordinates; no points.
#include "io/held_fields.h"
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cstring>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_round_trip {

struct Format {
  std::string file;
  bool ascii;
};

const std::vector<Format> formats{{"a.pcd", false},
                                  {"t.PCD", true},
                                  {"a.ply", false},
                                  {"t.ply", true},
                                  {"a.vtp", false},
                                  {"a.csv", true}};

Dataset
roundTrip(const Dataset& dataset, const Format& format)
{
  const TemporaryFolder folder;
  SaveOptions options;
  options.ascii = format.ascii;
  saveDataset(folder / format.file, dataset, options);
  EXPECT_EQ(folder.list(), std::vector<std::string>{format.file});
  return loadDataset(folder / format.file);
}

/** Random fields; components and 64-bit integers where the format has them. */
std::vector<FieldSpec>
randomSchema(Random& random, bool vectors, bool wide_integers)
{
  std::vector<FieldSpec> specs;
  const auto count = static_cast<std::size_t>(8 * random.uniform());
  for (std::size_t i = 0; i < count; ++i) {
    const auto& types = allDatatypes();
    const std::uint8_t type =
        types[static_cast<std::size_t>(random.uniform() * double(types.size()))];
    if (!wide_integers && (type == Type::INT64 || type == Type::UINT64))
      continue;
    specs.push_back({"f" + std::to_string(i),
                     type,
                     vectors ? 1 + static_cast<unsigned>(4 * random.uniform()) : 1});
  }
  return specs;
}

std::vector<double>
largeCoordinates(const std::array<double, 3>& shift, std::size_t count)
{
  Random random(5);
  std::vector<double> xyz;
  for (std::size_t i = 0; i < 3 * count; ++i)
    xyz.push_back(100.0 * random.uniform() + shift[i % 3]);
  return xyz;
}

TEST(RoundTrip, RandomSchemasKeepEveryBit)
{
  Random random(1);
  for (int round = 0; round < 20; ++round)
    for (const auto& format : formats) {
      if (format.file == "a.csv")
        continue;
      SCOPED_TRACE(format.file + " " + std::to_string(round));
      const bool ply = format.file.find("ply") != std::string::npos;
      const auto dataset = makeDataset(randomSchema(random, !ply, !ply), 37, 7);
      expectSameFields(roundTrip(dataset, format), dataset);
    }
}

TEST(RoundTrip, CsvKeepsNumbersAndMissingOnes)
{
  const auto dataset = makeDataset({{"a", Type::FLOAT32},
                                    {"b, c", Type::FLOAT64},
                                    {"id", Type::INT16},
                                    {"#q", Type::INT32}},
                                   50,
                                   3);
  const auto loaded = roundTrip(dataset, {"a.csv", true});
  ASSERT_EQ(describeFields(loaded.cloud.fields),
            "x (float32), y (float32), z (float32), a (float32), b, c (float64), id "
            "(int32), #q (int32)");
  ASSERT_EQ(loaded.cloud.width, 50u);
  for (const char* const name : {"x", "y", "z", "a", "b, c", "id", "#q"})
    for (std::size_t i = 0; i < 50; ++i)
      expectSame(valueOf(loaded, name, i), valueOf(dataset, name, i), name);
}

TEST(RoundTrip, NormalsHaveTheNamesOfTheFormat)
{
  const auto dataset = makeDataset({{"normal_x", Type::FLOAT32},
                                    {"normal_y", Type::FLOAT32},
                                    {"normal_z", Type::FLOAT32},
                                    {"q", Type::FLOAT64}},
                                   9,
                                   2);
  for (const auto& format : formats)
    if (format.file != "a.csv")
      expectSameFields(roundTrip(dataset, format), dataset);
  const TemporaryFolder folder;
  saveDataset(folder / "a.ply", dataset);
  EXPECT_NE(readFile(folder / "a.ply").find("property float nz\n"), std::string::npos);
  saveDataset(folder / "a.vtp", dataset);
  EXPECT_NE(readFile(folder / "a.vtp").find("Normals=\"Normals\""), std::string::npos);
}

TEST(RoundTrip, PackedColorsAreNumbersInPly)
{
  auto dataset = makeDataset({{"rgb", Type::FLOAT32}}, 1, 2);
  put(&dataset.cloud.data[12], std::uint32_t{0xff102030});
  for (const bool ascii : {false, true}) {
    const auto ply = roundTrip(dataset, {"a.ply", ascii});
    EXPECT_EQ(valueOf(ply, "red", 0), 0x10);
    EXPECT_EQ(valueOf(ply, "green", 0), 0x20);
    EXPECT_EQ(valueOf(ply, "blue", 0), 0x30);
    const auto pcd = roundTrip(dataset, {"a.pcd", ascii});
    std::uint32_t bits = 0;
    std::memcpy(&bits, &pcd.cloud.data[12], sizeof(bits));
    EXPECT_EQ(bits, 0xff102030u);
  }
  dataset.cloud.fields.back().name = "rgba";
  EXPECT_EQ(valueOf(roundTrip(dataset, {"a.ply", false}), "alpha", 0), 0xff);
}

TEST(RoundTrip, NamesAndCommentsThatFormatsLack)
{
  const auto dataset = makeDataset(
      {{"a b", Type::INT16}, {"a_b", Type::INT16}, {"v", Type::INT8, 2}}, 3, 2);
  for (const char* const name : {"a.pcd", "a.ply"}) {
    const TemporaryFolder folder;
    SaveOptions options;
    options.comments = {"made by\na test"};
    saveDataset(folder / name, dataset, options);
    const std::string text = readFile(folder / name);
    EXPECT_NE(text.find("made by a test\n"), std::string::npos);
    EXPECT_NE(text.find("'a b'"), std::string::npos);
    const auto loaded = loadDataset(folder / name);
    EXPECT_EQ(valueOf(loaded, "a_b", 1), valueOf(dataset, "a b", 1));
    EXPECT_EQ(valueOf(loaded, "a_b_2", 1), valueOf(dataset, "a_b", 1));
    EXPECT_EQ(valueOf(loaded, "v[1]", 2), valueOf(dataset, "v[1]", 2));
  }
}

/** Points whose field "id" has these bits. */
Dataset
withIntegers(std::uint8_t datatype, const std::vector<std::uint64_t>& numbers)
{
  Dataset dataset = makeDataset({{"id", datatype}, {"q", Type::FLOAT32}},
                                static_cast<unsigned>(numbers.size()),
                                2);
  const auto offset = findField(dataset.cloud.fields, "id")->offset;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    std::memcpy(&dataset.cloud.data[i * dataset.cloud.point_step + offset],
                &numbers[i],
                sizeof(numbers[i]));
  return dataset;
}

TEST(RoundTrip, IntegersThatPlyLacksBecomeDoublesIfTheseAreExact)
{
  constexpr std::uint64_t most = std::uint64_t(1) << 53;
  for (const bool ascii : {false, true})
    for (const auto& dataset :
         {withIntegers(Type::UINT64, {0, most, 2 * most + 4, std::uint64_t(1) << 63}),
          withIntegers(Type::INT64, {0, most, 0 - most, std::uint64_t(1) << 63})}) {
      EXPECT_TRUE(describeLosses("a.ply", dataset).empty());
      const Dataset loaded = roundTrip(dataset, {"a.ply", ascii});
      ASSERT_EQ(4u, loaded.cloud.width);
      EXPECT_EQ(Type::FLOAT64, findField(loaded.cloud.fields, "id")->datatype);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(valueOf(dataset, "id", i), valueOf(loaded, "id", i)) << i;
        EXPECT_EQ(valueOf(dataset, "q", i), valueOf(loaded, "q", i)) << i;
        EXPECT_EQ(valueOf(dataset, "z", i), valueOf(loaded, "z", i)) << i;
      }
    }
}

TEST(RoundTrip, IntegersThatDoubleDoesNotHoldAreLeftOutOfPlyOnly)
{
  constexpr std::uint64_t beyond = (std::uint64_t(1) << 53) + 1;
  for (const auto& dataset : {withIntegers(Type::UINT64, {1, beyond}),
                              withIntegers(Type::UINT64, {1, ~std::uint64_t(0)}),
                              withIntegers(Type::INT64, {1, 0 - beyond})}) {
    const Dataset loaded = roundTrip(dataset, {"a.ply", false});
    EXPECT_EQ(nullptr, findField(loaded.cloud.fields, "id"));
    EXPECT_EQ(valueOf(dataset, "q", 1), valueOf(loaded, "q", 1));
    const auto losses = describeLosses("a.ply", dataset);
    ASSERT_EQ(1u, losses.size());
    EXPECT_EQ(Message("inexact_fields_left_out",
                      {{"path", "a.ply"}, {"fields", 1}, {"names", "'id'"}}),
              losses[0]);
    EXPECT_EQ(
        "a.ply omits the field 'id': the format has no 64-bit integers, and double "
        "cannot represent its values. Try: .vtp, .pcd or .csv.",
        losses[0].text());
    for (const char* const file : {"a.pcd", "a.vtp", "a.vtkhdf", "a.npz"}) {
      EXPECT_TRUE(describeLosses(file, dataset).empty());
      expectSameFields(dataset, roundTrip(dataset, {file, false}));
    }
    EXPECT_TRUE(describeLosses("a.csv", dataset).empty());
  }
}

TEST(RoundTrip, NoPoints)
{
  const auto dataset = makeDataset({{"a", Type::FLOAT32}, {"v", Type::INT16}}, 0, 2);
  for (const auto& format : formats) {
    SCOPED_TRACE(format.file);
    const auto loaded = roundTrip(dataset, format);
    EXPECT_EQ(loaded.cloud.width, 0u);
    EXPECT_NE(findField(loaded.cloud.fields, "a"), nullptr);
  }
}

TEST(RoundTrip, PaddingAndOrderOfFieldsDoNotMatter)
{
  auto dataset = makeDataset({{"_", Type::UINT8, 7}, {"a", Type::INT16}}, 5, 2);
  std::rotate(dataset.cloud.fields.begin(),
              dataset.cloud.fields.begin() + 1,
              dataset.cloud.fields.end());
  for (const auto& format : formats) {
    SCOPED_TRACE(format.file);
    const auto loaded = roundTrip(dataset, format);
    EXPECT_EQ(loaded.cloud.fields[0].name, "x");
    EXPECT_EQ(loaded.cloud.fields[2].offset, 8u);
    EXPECT_EQ(findField(loaded.cloud.fields, "_"), nullptr);
    for (std::size_t i = 0; i < 5; ++i)
      for (const char* const name : {"x", "y", "z", "a"})
        EXPECT_EQ(valueOf(loaded, name, i), valueOf(dataset, name, i));
  }
}

TEST(Coordinates, LargeOnesKeepTheirDigits)
{
  const std::array<double, 3> shift{{500000.0, 5500000.0, 100.0}};
  const auto xyz = largeCoordinates({{0.0, 0.0, 0.0}}, 100);
  const auto far = largeCoordinates(shift, 100);
  Dataset dataset = makeDataset({{"a", Type::FLOAT32}}, 100, 2);
  setCoordinates(dataset, far);
  EXPECT_NE(dataset.origin[0], 0.0);
  for (const auto& format : formats) {
    SCOPED_TRACE(format.file);
    const auto loaded = roundTrip(dataset, format);
    EXPECT_TRUE(loaded.double_coordinates);
    for (std::size_t i = 0; i < 300; ++i)
      EXPECT_NEAR(
          coordinateOf(loaded, i % 3, i / 3) - shift[i % 3], xyz[i], 100.0 * 1e-7);
    EXPECT_EQ(valueOf(loaded, "a", 7), valueOf(dataset, "a", 7));
  }
}

} // namespace test_round_trip
