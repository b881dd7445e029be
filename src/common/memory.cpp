// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/memory.h>

#include <fstream>
#include <limits>
#include <sstream>

namespace pcl_uvol {

std::uint64_t
availableMemory()
{
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name;) {
    std::uint64_t kibibytes = 0;
    if (name == "MemAvailable:" && file >> kibibytes)
      return kibibytes * 1024;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return std::numeric_limits<std::uint64_t>::max();
}

std::string
formatBytes(double bytes)
{
  static const char* const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  constexpr std::size_t largest = sizeof(units) / sizeof(units[0]) - 1;
  std::size_t unit = 0;
  // What would be rounded to the next power of ten counts as that.
  for (; bytes >= 999.5 && unit < largest; ++unit)
    bytes /= 1000.0;
  std::ostringstream text;
  text.precision(bytes < 99.5 ? 2 : 3);
  text << bytes << ' ' << units[unit];
  return text.str();
}

void
checkMemory(const std::string& what, double bytes)
{
  const auto available = static_cast<double>(availableMemory());
  if (bytes > available)
    throw InvalidArgument(what + " needs " + formatBytes(bytes) +
                          " of memory, and only " + formatBytes(available) +
                          " are available.");
}

} // namespace pcl_uvol
