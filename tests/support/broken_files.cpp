// SPDX-License-Identifier: BSD-3-Clause
#include "support/broken_files.h"

#include <filesystem>
#include <sstream>

namespace uvol_test {

namespace {

std::string
repeat(const std::string& text, std::size_t times)
{
  std::string all;
  for (std::size_t i = 0; i < times; ++i)
    all += text;
  return all;
}

/** 12 MB of zeros in 136 KB, packed by LZF. */
std::string
makePackedZeros()
{
  const auto bytes = [](std::initializer_list<int> values) {
    return std::string(values.begin(), values.end());
  };
  return "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1000000\nHEIGHT 1\n"
         "POINTS 1000000\nDATA binary_compressed\n" +
         bytes({0xd0, 0x14, 0x02, 0x00, 0x00, 0x1b, 0xb7, 0x00}) + bytes({0, 0}) +
         repeat(bytes({0xe0, 0xff, 0}), 45454) + repeat(bytes({0xc0, 0}), 17) +
         bytes({0xa0, 0});
}

std::string
makeComments()
{
  return "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\nendian: little\n"
         "encoding: raw\n" +
         repeat("# a\n", 200000) + '\n' + std::string(48, '\1');
}

std::string
makeColumns()
{
  std::string names = "x,y,z";
  for (int i = 0; i < 100000; ++i)
    names += ",f" + std::to_string(i);
  return names + "\n1,2,3" + repeat(",1", 100000) + '\n';
}

/** Coordinates of all sizes up to one, and points that have another. */
std::string
makePoints(std::size_t count, double scale, const std::string& others)
{
  Random random(1);
  std::ostringstream text("x,y,z,rho\n", std::ios::ate);
  for (std::size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      text << scale * (2.0 * random.uniform() - 1.0) << ',';
    text << random.uniform() - 0.5 << '\n';
  }
  return text.str() + others;
}

} // namespace

void
writeBrokenFiles(const TemporaryFolder& folder)
{
  namespace fs = std::filesystem;
  for (const auto& entry :
       fs::directory_iterator(PCL_UVOL_SOURCE_DIR "/tests/data/broken"))
    fs::copy_file(entry, folder / entry.path().filename().string());
  writeFile(folder / "zeros.pcd", makePackedZeros());
  writeFile(folder / "comments.nrrd", makeComments());
  writeFile(folder / "columns.csv", makeColumns());
  writeFile(folder / "far.csv", makePoints(2000, 1e12, ""));
  writeFile(folder / "farther.csv", makePoints(2000, 1e20, ""));
  writeFile(folder / "fill.csv",
            makePoints(3000, 1.0, "-1e+34,-1e+34,-1e+34,-0.243026\n"));
}

} // namespace uvol_test
