// SPDX-License-Identifier: BSD-3-Clause
// What memory there is and what the process takes. Work that does not fit into memory
// is refused, in figures that people can read.
#include "common/memory.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace test_memory {

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

/** Whether what is available shrinks to a limit, in a process of its own. */
template <typename Resource>
bool
isLimitedBy(Resource resource, double bytes)
{
  rlimit limit{};
  getrlimit(resource, &limit);
  limit.rlim_cur = static_cast<rlim_t>(bytes);
  if (setrlimit(resource, &limit) != 0)
    return false;
  const auto available = static_cast<double>(pcl_uvol::availableMemory());
  return available < bytes && available > 0.0;
}

TEST(Memory, LimitsOfTheProcessCount)
{
  if (uvol_test::isSanitized())
    GTEST_SKIP() << "Sanitizers map terabytes.";
  ASSERT_GT(pcl_uvol::availableMemory(), 1000000000u);
  EXPECT_EXIT(
      _exit(isLimitedBy(RLIMIT_AS, 9e8) ? 0 : 1), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(
      _exit(isLimitedBy(RLIMIT_DATA, 9e8) ? 0 : 1), testing::ExitedWithCode(0), "");
}

/** Files of control groups as the kernel writes them. */
class ControlGroups : public testing::Test {
protected:
  void
  write(const std::string& name, const std::string& content) const
  {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    uvol_test::writeFile(path, content + '\n');
  }

  std::uint64_t
  available(const std::string& groups) const
  {
    write("groups", groups);
    return pcl_uvol::availableInControlGroups(folder_ / "groups", folder_ / "root");
  }

  static constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();
  uvol_test::TemporaryFolder folder_;
};

TEST_F(ControlGroups, WithoutLimitsAllIsAvailable)
{
  EXPECT_EQ(unlimited, pcl_uvol::availableInControlGroups(folder_ / "none", "/none"));
  EXPECT_EQ(unlimited, available("0::/"));
  write("root/a/memory.max", "max");
  write("root/a/memory.current", "1000");
  EXPECT_EQ(unlimited, available("0::/a"));
  EXPECT_EQ(unlimited, available("garbage\n:\n0::relative\n"));
}

TEST_F(ControlGroups, TheTightestOfTheGroupsAroundCounts)
{
  write("root/a/memory.max", "5000");
  write("root/a/memory.current", "4000");
  write("root/a/b/memory.max", "9000");
  write("root/a/b/memory.current", "3000");
  EXPECT_EQ(1000u, available("0::/a/b"));
  EXPECT_EQ(1000u, available("0::/a/b/not_there"));
  write("root/a/b/memory.current", "8500");
  EXPECT_EQ(500u, available("0::/a/b"));
  write("root/a/b/memory.current", "9100");
  EXPECT_EQ(0u, available("0::/a/b"));
}

/** A container sees its own group as the root. */
TEST_F(ControlGroups, FilesInMemoryAreAvailable)
{
  write("root/memory.max", "5000");
  write("root/memory.current", "4000");
  write("root/memory.stat", "anon 900\nfile 3100\ninactive_file 2500");
  EXPECT_EQ(3500u, available("0::/"));
}

TEST_F(ControlGroups, TheFirstVersionCountsAsWell)
{
  write("root/memory/a/memory.limit_in_bytes", "5000");
  write("root/memory/a/memory.usage_in_bytes", "4000");
  write("root/memory/a/memory.stat", "inactive_file 7\ntotal_inactive_file 500");
  EXPECT_EQ(1500u, available("5:cpu,cpuacct:/\n4:memory:/a\n0::/"));
  EXPECT_EQ(1500u, available("4:hugetlb,memory:/a"));
  EXPECT_EQ(unlimited, available("4:cpu:/a"));
}

TEST(Memory, PeakIsTheMostThatWasResident)
{
  if (uvol_test::isSanitized())
    GTEST_SKIP() << "Sanitizers keep what was freed.";
  constexpr std::size_t bytes = 200000000;
  const std::uint64_t before = pcl_uvol::residentMemory();
  ASSERT_GT(before, 1000000u);
  ASSERT_GE(pcl_uvol::peakMemory(), before);
  {
    const std::vector<char> taken(bytes, 1);
    EXPECT_NEAR(
        1.0, static_cast<double>(pcl_uvol::residentMemory() - before) / bytes, 0.05);
  }
  EXPECT_NEAR(1.0, static_cast<double>(pcl_uvol::peakMemory() - before) / bytes, 0.05);
  EXPECT_LT(pcl_uvol::residentMemory(), before + bytes / 10);
}

TEST(Memory, BytesAreDescribed)
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
TEST(Memory, BytesAreDescribedWithoutExponents)
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
    std::istringstream words(error.message());
    std::string begin, unit, end;
    double available = 0.0;
    std::getline(words, begin, ',');
    words.ignore(std::string(" and only ").size());
    words >> available >> unit;
    std::getline(words, end);
    EXPECT_EQ(begin, "A grid of 9 x 9 x 9 cells needs 5 EB of memory");
    EXPECT_GT(available, 0.0);
    EXPECT_TRUE(unit == "kB" || unit == "MB" || unit == "GB" || unit == "TB") << unit;
    EXPECT_EQ(end, " are available.");
  }
}

/** Of the largest work that is not refused, small work included. */
TEST(Memory, TheForecastIsTheMostThatChecksExpect)
{
  if (pcl_uvol::residentMemory() == 0)
    GTEST_SKIP() << "This system does not tell what is resident.";
  constexpr double pages = 2e7; // that are touched later, or between blocks
  const auto expectForecast = [&](double bytes) {
    const double most = static_cast<double>(pcl_uvol::residentMemory()) + bytes;
    EXPECT_GE(pcl_uvol::forecastMemory(), most);
    EXPECT_LE(pcl_uvol::forecastMemory(), most + pages);
  };
  pcl_uvol::checkMemoryOf("Small work", 10, 9e6);
  expectForecast(9e6);
  checkMemory("A grid", 3e8);
  expectForecast(3e8);
  pcl_uvol::checkMemoryOf("Small work", 10, 9e6);
  EXPECT_THROW(checkMemory("A grid", 5e18), pcl_uvol::NotEnoughMemory);
  expectForecast(3e8);
}

} // namespace test_memory
