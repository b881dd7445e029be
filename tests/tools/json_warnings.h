// SPDX-License-Identifier: BSD-3-Clause
// The warnings of a report that a tool printed with -json, by their codes.
#pragma once

#include "support/environment.h"

#include <nlohmann/json.hpp>
#include <string>

namespace uvol_test {

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
