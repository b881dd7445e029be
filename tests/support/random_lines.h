// SPDX-License-Identifier: BSD-3-Clause
// Random command lines of a tool on valid and on strange files: exit code 0, 1 or 2,
// one sentence where it fails, a report that is JSON, no file that was not asked for.
#pragma once

#include "support/environment.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace uvol_test {

/** \brief A tool, for which no word of a line has to make sense. */
struct RandomTool {
  const char* name;    ///< without uvol_
  const char* outputs; ///< endings of what it writes; "": it only tells
  const char* needed;  ///< options that it does not go without, parted by ;
  std::size_t inputs = 1;
  const char* output_option = ""; ///< in front of what it writes
  std::string launcher = "";      ///< what starts it, where that is not its name
};

/** \brief Lines of a tool that the default tests run; under a sanitizer, where a tool
 * takes a second to begin, fewer. */
std::uint64_t
countDefaultLines();

/** \brief One of several words. */
std::string
pick(const std::vector<std::string>& words, Random& random);

/** \brief Runs lines of a tool, each made from a seed, on files of its own. */
class RandomLines {
public:
  explicit RandomLines(const RandomTool& tool);

  /** \brief Expects of each line what is said above. */
  void
  run(std::uint64_t first_seed, std::uint64_t count);

private:
  struct Option {
    std::string name, placeholder;
  };

  static std::vector<Option>
  listOptions(const std::string& tool);

  static std::string
  makeValue(const Option& option, const std::string& folder, Random& random);

  /** The words behind the input. */
  std::string
  makeLine(Random& random) const;

  void
  runLine(std::uint64_t seed);

  /** Removes what a line left, which has to be what it was asked for. */
  void
  clearFolder(bool has_succeeded);

  const RandomTool tool_;
  const TemporaryFolder folder_;
  std::vector<Option> options_;
  std::vector<std::string> files_;
};

} // namespace uvol_test
