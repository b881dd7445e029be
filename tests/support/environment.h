// SPDX-License-Identifier: BSD-3-Clause
// What the tests share: seeded clouds, temporary folders, the folder of real data.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace uvol_test {

/** \brief Uniform numbers in [0, 1) from a seed: splitmix64, the same on every machine.
 */
class Random {
public:
  explicit Random(std::uint64_t seed)
      : state_(seed)
  {
  }
  double
  uniform();

private:
  std::uint64_t state_;
};

/** \brief A folder of its own that goes with the object. */
class TemporaryFolder {
public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder&
  operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  /** \brief Path of a file in it. */
  std::string
  operator/(const std::string& name) const;
  /** \brief Names of what lies in it, sorted. */
  std::vector<std::string>
  list() const;

private:
  std::string path_;
};

std::string
readFile(const std::string& path);

void
writeFile(const std::string& path, const std::string& content);

/** \brief Folder of the real data sets: $PCL_UVOL_DATA, else ../shared/data beside the
 * repository; empty where neither is there (the test then skips). */
std::string
dataFolder();

/** \brief True under a sanitizer, whose memory is not that of the program. */
bool
isSanitized();

/** \brief Forget how much memory the process had at most.
 * \return false where the system does not allow it */
bool
resetPeakMemory();

struct CommandResult {
  int exit_code; ///< -signal where a signal ended it
  std::string out, err;
};

/** \brief Run a command line of the shell, in the folder of the tools' executables
 * first on PATH. */
CommandResult
runCommand(const std::string& command);

} // namespace uvol_test
