// SPDX-License-Identifier: BSD-3-Clause
// Runs of tools, and the warnings of a report that is printed as JSON, by their codes.
#pragma once

#include "support/environment.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace uvol_test {

/** \brief A run that has to succeed.
 * \throws std::runtime_error, which fails the test, if it did not */
inline CommandResult
succeeded(CommandResult result)
{
  if (result.exit_code != 0)
    throw std::runtime_error("exit code " + std::to_string(result.exit_code) + ": " +
                             result.err);
  return result;
}

/** \brief What a command wrote that has to succeed. */
inline CommandResult
runWell(const std::string& command)
{
  return succeeded(runCommand(command));
}

/** \brief The report of a run with -json that has to succeed. */
inline nlohmann::json
jsonOf(const CommandResult& result)
{
  return nlohmann::json::parse(succeeded(result).out);
}

/** \brief The values of the first warning of a code; null without one. */
inline nlohmann::json
warnedValues(const nlohmann::json& report, const std::string& code)
{
  for (const auto& warning : report.at("warnings"))
    if (warning.at("code") == code)
      return warning.at("values");
  return {};
}

/** \brief Whether there is a warning of that code. */
inline bool
hasWarning(const nlohmann::json& report, const std::string& code)
{
  return !warnedValues(report, code).is_null();
}

/** \brief Whether a report that is printed as JSON has a warning or an error of that
 * code. */
inline bool
hasMessage(const CommandResult& report, const std::string& code)
{
  return report.out.find("\"code\": \"" + code + '"') != std::string::npos;
}

} // namespace uvol_test
