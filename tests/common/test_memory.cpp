// SPDX-License-Identifier: BSD-3-Clause
// Work that does not fit into memory is refused, in figures that people can read.
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/memory.h>

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>
#include <unistd.h>

namespace {

using pcl_uvol::checkMemory;
using pcl_uvol::formatBytes;

const char* const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};

/** The number that a text such as "1.6 GB" stands for; NaN for another text. */
double
bytesOf(const std::string& text)
{
  std::istringstream words(text);
  double number = 0.0;
  std::string unit;
  words >> number >> unit;
  for (std::size_t power = 0; power < std::size(units); ++power)
    if (unit == units[power])
      return number * std::pow(1000.0, static_cast<double>(power));
  return std::nan("");
}

TEST(Memory, WhatIsAvailableIsAPartOfWhatIsThere)
{
  const double installed = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                           static_cast<double>(sysconf(_SC_PAGE_SIZE));
  const auto available = static_cast<double>(pcl_uvol::availableMemory());
  EXPECT_GT(available, 1e6);
  EXPECT_LE(available, installed);
}

TEST(Memory, BytesAreTold)
{
  EXPECT_EQ("0 bytes", formatBytes(0.0));
  EXPECT_EQ("17 bytes", formatBytes(17.0));
  EXPECT_EQ("999 bytes", formatBytes(999.0));
  EXPECT_EQ("1 kB", formatBytes(1000.0));
  EXPECT_EQ("1.6 GB", formatBytes(1.62e9));
  EXPECT_EQ("16 GB", formatBytes(16.2e9));
  EXPECT_EQ("162 GB", formatBytes(162.3e9));
  EXPECT_EQ("35 TB", formatBytes(8.0 * std::pow(16384.0, 3)));
  EXPECT_EQ("18 EB", formatBytes(std::pow(2.0, 64)));
}

/** Just below a power of ten, where rounding makes one digit more. */
TEST(Memory, BytesAreToldWithoutExponents)
{
  EXPECT_EQ("1 kB", formatBytes(999.6));
  EXPECT_EQ("1 MB", formatBytes(999.7e3));
  for (std::size_t power = 0; power < std::size(units); ++power)
    for (const double part : {1.0, 9.94, 9.96, 10.1, 99.4, 99.6, 100.4, 999.4, 999.6}) {
      const double bytes = part * std::pow(1000.0, static_cast<double>(power));
      if (bytes > 9e20) // larger than any unit
        continue;
      const std::string text = formatBytes(bytes);
      EXPECT_EQ(std::string::npos, text.find("e+"))
          << part << ' ' << units[power] << ": " << text;
      EXPECT_NEAR(bytes, bytesOf(text), 0.05 * bytes)
          << part << ' ' << units[power] << ": " << text;
    }
}

TEST(Memory, OnlyWhatDoesNotFitIsRefused)
{
  EXPECT_NO_THROW(checkMemory("A grid", 0.0));
  EXPECT_NO_THROW(checkMemory("A grid", 1e6));
  try {
    checkMemory("A grid of 9 x 9 x 9 cells", 5e18);
    FAIL() << "5 EB are there";
  }
  catch (const pcl_uvol::InvalidArgument& error) {
    EXPECT_TRUE(std::regex_match(
        error.message(),
        std::regex("A grid of 9 x 9 x 9 cells needs 5 EB of memory, and only "
                   "[0-9.]+ [kMGT]B are available\\.")))
        << error.message();
  }
}

} // namespace
