// SPDX-License-Identifier: BSD-3-Clause
#include "common/memory.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <sstream>
#include <sys/resource.h>

namespace pcl_uvol {

namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::atomic<std::uint64_t> process_limit{unlimited};
std::atomic<double> forecast{0.0};

/** The number behind a name in a file of lines "name number"; otherwise if there is
 * none. */
std::uint64_t
numberIn(const std::string& path, const std::string& name, std::uint64_t otherwise)
{
  std::ifstream file(path);
  for (std::string word; file >> word;) {
    std::uint64_t number = 0;
    if (word == name)
      return file >> number ? number : otherwise;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return otherwise;
}

/** The same in bytes, where the system counts in kB. */
std::uint64_t
bytesIn(const std::string& path, const std::string& name, std::uint64_t otherwise)
{
  constexpr std::uint64_t kibibyte = 1024;
  const std::uint64_t number = numberIn(path, name, unlimited);
  return number == unlimited ? otherwise : kibibyte * number;
}

/** The number that a file consists of; unlimited if there is none, as in "max". */
std::uint64_t
readNumber(const std::string& path)
{
  std::ifstream file(path);
  std::uint64_t number = 0;
  return file >> number ? number : unlimited;
}

/** Names of the files of a version of control groups. */
struct GroupFiles {
  const char *limit, *usage, *cache;
};

constexpr GroupFiles second_version = {"memory.max", "memory.current", "inactive_file"};
constexpr GroupFiles first_version = {
    "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};

/** What a group leaves. */
std::uint64_t
availableIn(const std::string& folder, const GroupFiles& names)
{
  const std::uint64_t limit = readNumber(folder + '/' + names.limit);
  const std::uint64_t usage = readNumber(folder + '/' + names.usage);
  if (limit == unlimited || usage == unlimited)
    return unlimited;
  const std::uint64_t cache =
      std::min(usage, numberIn(folder + "/memory.stat", names.cache, 0));
  return limit - std::min(limit, usage - cache);
}

/** What a group and those around it leave. In a container the path may be that on the
 * host, and its own group the root. */
std::uint64_t
availableAround(const std::string& root, std::string path, const GroupFiles& names)
{
  std::uint64_t available = availableIn(root, names);
  for (; path.size() > 1; path.resize(path.rfind('/')))
    available = std::min(available, availableIn(root + path, names));
  return available;
}

/** What a limit of the process leaves.
 * \param used name of what it counts */
std::uint64_t
availableTo(decltype(RLIMIT_AS) resource, const char* used)
{
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return unlimited;
  return limit.rlim_cur -
         std::min<std::uint64_t>(limit.rlim_cur, bytesIn("/proc/self/status", used, 0));
}

/** What MemoryLimit leaves. */
std::uint64_t
availableWithinLimit()
{
  const std::uint64_t limit = process_limit;
  if (limit == unlimited)
    return unlimited;
#if defined(__GLIBC__)
  malloc_trim(0); // what was freed is in use as long as the heap keeps it
#endif
  return limit - std::min(limit, residentMemory());
}

/** Pages that are touched after the start, code and tables of libraries most of all
 * (measured on runs with a thousand points). */
constexpr double later_bytes = 4e6;

/** Memory that was given back, and is in use for the system all the same, since it lies
 * between blocks that are not: over what is held (measured: 0 to 6 %), and at most, as
 * large blocks go back at once. */
constexpr double scattered_share = 0.05, most_scattered_bytes = 8e6;

/** Raise the forecast to what is in use and what work needs. */
void
addToForecast(double bytes)
{
  const double expected = static_cast<double>(residentMemory()) + later_bytes + bytes +
                          std::min(scattered_share * bytes, most_scattered_bytes);
  double before = forecast;
  while (before < expected && !forecast.compare_exchange_weak(before, expected)) {
  }
}

void
compareToAvailable(const std::string& what, double bytes)
{
  const auto available = static_cast<double>(availableMemory());
  if (bytes > available)
    throw NotEnoughMemory("not_enough_memory",
                          {{"what", what},
                           {"needed", formatBytes(bytes)},
                           {"available", formatBytes(available)}});
}

} // namespace

std::uint64_t
availableMemory()
{
  return std::min({bytesIn("/proc/meminfo", "MemAvailable:", unlimited),
                   availableInControlGroups(),
                   availableWithinLimit(),
                   availableTo(RLIMIT_AS, "VmSize:"),
                   availableTo(RLIMIT_DATA, "VmData:")});
}

std::uint64_t
availableInControlGroups(const std::string& groups, const std::string& root)
{
  std::uint64_t available = unlimited;
  std::ifstream file(groups);
  // "0::/path" of version 2, "4:memory:/path" of version 1, perhaps with others
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos || line.compare(second + 1, 1, "/") != 0)
      continue;
    const std::string path = line.substr(second + 1);
    const std::string controllers =
        ',' + line.substr(first + 1, second - first - 1) + ',';
    if (controllers == ",,")
      available = std::min(available, availableAround(root, path, second_version));
    else if (controllers.find(",memory,") != std::string::npos)
      available =
          std::min(available, availableAround(root + "/memory", path, first_version));
  }
  return available;
}

std::uint64_t
residentMemory()
{
  return bytesIn("/proc/self/status", "VmRSS:", 0);
}

std::uint64_t
peakMemory()
{
  return bytesIn("/proc/self/status", "VmHWM:", 0);
}

double
forecastMemory()
{
  return forecast;
}

MemoryLimit::MemoryLimit(std::uint64_t bytes)
    : before_(process_limit.exchange(bytes))
{
}

MemoryLimit::~MemoryLimit()
{
  process_limit = before_;
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
  compareToAvailable(what, bytes);
  addToForecast(bytes);
}

void
checkMemoryOf(const std::string& task, std::size_t points, double bytes)
{
  constexpr double small = 1e7;
  if (bytes > small || process_limit != unlimited)
    compareToAvailable(task + " of " + std::to_string(points) + " points", bytes);
  addToForecast(bytes);
}

} // namespace pcl_uvol
