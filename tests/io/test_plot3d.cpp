// SPDX-License-Identifier: BSD-3-Clause
// Grids of PLOT3D in all their layouts, of known numbers.
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_plot3d {

struct Plot3dLayout {
  bool swapped, marked, several, doubles, blanked;
};

/** The bytes of a file, record by record. */
class Plot3dWriter {
public:
  explicit Plot3dWriter(const Plot3dLayout& layout)
      : layout_(layout)
  {
  }

  template <typename T>
  void
  add(T number)
  {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &number, sizeof(T));
    if (layout_.swapped)
      std::reverse(bytes.begin(), bytes.end());
    record_ += bytes;
  }

  void
  addReal(double number)
  {
    if (layout_.doubles)
      add(number);
    else
      add(static_cast<float>(number));
  }

  void
  endRecord()
  {
    const std::string content = std::move(record_);
    record_.clear();
    if (layout_.marked)
      add(static_cast<std::int32_t>(content.size()));
    const std::string mark = std::move(record_);
    record_.clear();
    bytes_ += mark + content + mark;
  }

  void
  addSizes(const std::vector<std::array<int, 3>>& grids)
  {
    if (layout_.several) {
      add(static_cast<std::int32_t>(grids.size()));
      endRecord();
    }
    for (const auto& grid : grids)
      for (const std::int32_t size : grid)
        add(size);
    endRecord();
  }

  const std::string&
  getBytes() const
  {
    return bytes_;
  }

private:
  const Plot3dLayout layout_;
  std::string bytes_, record_;
};

double
numberOf(std::size_t grid, std::size_t which, std::size_t point)
{
  return 1000.0 * static_cast<double>(grid) + 100.0 * static_cast<double>(which) +
         static_cast<double>(point);
}

const std::vector<std::array<int, 3>> sizes{{{3, 2, 2}}, {{2, 2, 5}}};

std::string
makeGrid(const Plot3dLayout& layout, const std::vector<std::array<int, 3>>& grids)
{
  Plot3dWriter writer(layout);
  writer.addSizes(grids);
  for (std::size_t g = 0; g < grids.size(); ++g) {
    const auto points =
        static_cast<std::size_t>(grids[g][0] * grids[g][1] * grids[g][2]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < points; ++i)
        writer.addReal(numberOf(g, axis, i));
    for (std::size_t i = 0; i < points && layout.blanked; ++i)
      writer.add(static_cast<std::int32_t>(i % 2));
    writer.endRecord();
  }
  return writer.getBytes();
}

std::string
makeSolution(const Plot3dLayout& layout, const std::vector<std::array<int, 3>>& grids)
{
  Plot3dWriter writer(layout);
  writer.addSizes(grids);
  for (std::size_t g = 0; g < grids.size(); ++g) {
    const auto points =
        static_cast<std::size_t>(grids[g][0] * grids[g][1] * grids[g][2]);
    for (int i = 0; i < 4; ++i)
      writer.addReal(-7.0);
    writer.endRecord();
    for (std::size_t which = 3; which < 8; ++which)
      for (std::size_t i = 0; i < points; ++i)
        writer.addReal(numberOf(g, which, i));
    writer.endRecord();
  }
  return writer.getBytes();
}

TEST(Plot3d, AllLayoutsAreKnownByTheirSizes)
{
  const TemporaryFolder folder;
  for (int i = 0; i < 32; ++i) {
    const Plot3dLayout layout{
        (i & 1) != 0, (i & 2) != 0, (i & 4) != 0, (i & 8) != 0, (i & 16) != 0};
    const auto grids =
        layout.several ? sizes : std::vector<std::array<int, 3>>{sizes[0]};
    writeFile(folder / "axyz.bin", makeGrid(layout, grids));
    Plot3dLayout of_solution = layout;
    of_solution.swapped = !layout.swapped;
    writeFile(folder / "aq.bin", makeSolution(of_solution, grids));
    const Dataset found = loadDataset(folder / "axyz.bin");
    ASSERT_EQ(layout.several ? 32u : 12u, found.cloud.width) << i;
    for (std::size_t point = 0; point < found.cloud.width; ++point) {
      const std::size_t grid = point < 12 ? 0 : 1, at = point < 12 ? point : point - 12;
      EXPECT_EQ(numberOf(grid, 1, at), valueAt(found, "y", point) + found.origin[1]);
      EXPECT_EQ(numberOf(grid, 3, at), valueAt(found, "Density", point));
      EXPECT_EQ(numberOf(grid, 5, at), valueAt(found, "Momentum[1]", point));
      EXPECT_EQ(numberOf(grid, 7, at), valueAt(found, "StagnationEnergy", point));
      if (layout.blanked) {
        EXPECT_EQ(static_cast<double>(at % 2), valueAt(found, "iblank", point));
      }
    }
  }
}

TEST(Plot3d, OtherSizesAreRefused)
{
  const TemporaryFolder folder;
  const Plot3dLayout layout{false, true, true, false, false};
  const std::string bytes = makeGrid(layout, sizes);
  const auto sentence = [&] {
    return messageOf<IOError>([&] { loadDataset(folder / "a.p3d"); });
  };
  for (std::size_t size = 1; size < bytes.size(); size += 7) { // of no other layout
    writeFile(folder / "a.p3d", bytes.substr(0, size));
    EXPECT_NE(std::string::npos, sentence().find("a.p3d")) << size;
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x7f);
    writeFile(folder / "a.p3d", changed);
    sentence(); // an answer or a sentence
  }
  writeFile(folder / "a.p3d", bytes);
  EXPECT_EQ("", sentence());
  writeFile(folder / "a.q", makeSolution(layout, {sizes[0]}));
  EXPECT_NE(std::string::npos, sentence().find("a.q"));
}

TEST(Plot3d, RealGridsAreThoseOfVtk)
{
  if (dataFolder().empty())
    GTEST_SKIP() << "the folder of real data is not there ($PCL_UVOL_DATA)";
  const Dataset found = loadDataset(dataFolder() + "/cfd/combxyz.bin"),
                converted = loadDataset(dataFolder() + "/cfd/comb.vts");
  ASSERT_EQ(converted.cloud.width, found.cloud.width);
  for (std::size_t i = 0; i < found.cloud.width; i += 97)
    for (const char* const name : {"x", "y", "z", "Density", "Momentum[2]"})
      EXPECT_EQ(valueAt(converted, name, i), valueAt(found, name, i)) << name;
}

} // namespace test_plot3d
