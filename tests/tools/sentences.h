// SPDX-License-Identifier: BSD-3-Clause
// What tools tell people: sentences that are printable, short and free of the words of
// programmers.
#pragma once

#include "common/printable.h"
#include "support/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

namespace uvol_test {

/** Reads all that a tool wrote to stderr: warnings, and one error unless it succeeded
 * or a signal ended it. */
inline void
expectSentences(const std::string& tool, const CommandResult& result)
{
  constexpr std::size_t most_bytes = 300;
  static const std::regex folder("[^ ']*/uvol_test_[0-9_]+"); // not the tool's words
  // No class of VTK, and no address.
  static const std::regex ending_or_size("\\.vtk(hdf)?|[0-9]0x[0-9]");
  constexpr int least_signal = 128;
  std::size_t errors = 0;
  std::istringstream lines(result.err);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(pcl_uvol::isPrintable(line)) << line;
    EXPECT_FALSE(line.empty()) << result.err;
    if (line.empty())
      continue;
    EXPECT_LE(std::regex_replace(line, folder, "").size(), most_bytes) << line;
    const std::string words = std::regex_replace(line, ending_or_size, "");
    for (const char* const word : {"std::", "vector::", "0x", "vtk", "exception"})
      EXPECT_EQ(std::string::npos, words.find(word)) << line;
    const bool is_error = line.compare(0, tool.size() + 2, tool + ": ") == 0;
    errors += is_error;
    const bool is_sentence = is_error || line.compare(0, 9, "Warning: ") == 0;
    const std::string marks = line.substr(0, 2); // the place in an expression
    EXPECT_TRUE(is_sentence ? std::string(".?)").find(line.back()) != std::string::npos
                            : marks == "  ")
        << line;
  }
  if (result.exit_code >= 0 && result.exit_code < least_signal) {
    EXPECT_EQ(result.exit_code == 0 ? 0u : 1u, errors) << result.err;
  }
}

/** A run with -json that failed in one sentence, below which a wrong expression may be
 * marked: with the exit code 2 for a wrong command line, else 1.
 * \param value a part of the values of the error */
inline void
expectError(const CommandResult& result,
            const std::string& code,
            const std::string& value = "")
{
  EXPECT_EQ(code == "command_line" ? 2 : 1, result.exit_code) << result.err;
  const bool is_marked = result.err.find("\n  ") != std::string::npos;
  EXPECT_EQ(is_marked ? 3 : 1, std::count(result.err.begin(), result.err.end(), '\n'))
      << result.err;
  ASSERT_TRUE(nlohmann::json::accept(result.out)) << result.out << result.err;
  const auto error = nlohmann::json::parse(result.out).at("error");
  EXPECT_EQ(code, error.at("code")) << error;
  EXPECT_NE(std::string::npos, error.at("values").dump().find(value))
      << value << ' ' << error;
}

} // namespace uvol_test
