// SPDX-License-Identifier: BSD-3-Clause
// A tool's report for people (PCL's colours on a terminal, plain in a pipe) and
// programs.
#include "common/printable.h"
#include "shared/options.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>
#include <variant>
#include <vector>

namespace uvol_tools {

namespace {

using pcl_uvol::ParameterNames;
using pcl_uvol::printable;

/** A warning, and how often it was given. */
struct CountedWarning {
  pcl_uvol::Message message;
  std::size_t times = 0;
};

/** Equal warnings, which a scene of many clouds has, once and with their number. */
std::vector<CountedWarning>
countEqual(const std::vector<pcl_uvol::Message>& warnings)
{
  std::vector<CountedWarning> counted;
  for (const pcl_uvol::Message& warning : warnings) {
    auto same =
        std::find_if(counted.begin(), counted.end(), [&](const CountedWarning& other) {
          return other.message == warning;
        });
    if (same == counted.end())
      same = counted.insert(same, {warning});
    ++same->times;
  }
  return counted;
}

nlohmann::ordered_json
toJson(const std::string& code,
       const std::string& text,
       const std::vector<pcl_uvol::MessageValue>& values)
{
  Facts facts;
  for (const auto& value : values)
    std::visit([&](const auto& held) { facts.emplace_back(value.name, held); },
               value.value);
  return {{"code", code},
          {"text", text},
          {"values", nlohmann::ordered_json::parse(Fact("values", facts).getJson())}};
}

nlohmann::ordered_json
toJson(const CountedWarning& warning)
{
  const pcl_uvol::Message& message = warning.message;
  auto object =
      toJson(message.code, message.text(ParameterNames::Options), message.values);
  if (warning.times > 1)
    object["times"] = warning.times;
  return object;
}

/** File names need not be UTF-8. */
void
printJson(const nlohmann::ordered_json& object)
{
  std::cout << object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
            << std::endl;
}

/** Switches the terminal's colour for its lifetime; nothing in a pipe. */
class Colour {
public:
  Colour(std::ostream& out, bool active, const char* code)
      : out_(out)
      , active_(active)
  {
    if (active_)
      out_ << "\033[" << code << 'm';
  }
  Colour(const Colour&) = delete;
  Colour&
  operator=(const Colour&) = delete;
  ~Colour()
  {
    if (active_)
      out_ << "\033[0m";
  }

private:
  std::ostream& out_;
  bool active_;
};

constexpr const char* value_colour = "0;36"; // PCL's cyan for figures
constexpr const char* warning_colour = "0;33";

template <typename T>
void
printRow(const std::string& name, const T& value, const char* unit, bool in_colour)
{
  std::cout << "  " << std::left << std::setw(24) << name;
  {
    const Colour colour(std::cout, in_colour, value_colour);
    std::cout << std::right << std::setw(12) << value;
  }
  std::cout << unit << '\n';
}

/** Whether a count is for those who ask for everything: bytes, and by which fit or for
 * which reason isopoints lie where they do, and what a warning goes by. */
bool
isDetail(const std::string& count)
{
  return count.find("bytes") != std::string::npos ||
         count.find("_roots") != std::string::npos || count.rfind("linear_", 0) == 0 ||
         count.rfind("examined", 0) == 0;
}

/** A line of what was counted at all. */
void
printCounts(const pcl_uvol::Report& report, bool in_colour)
{
  const char* before = "";
  for (const auto& [name, value] : report.counts)
    if (value > 0 && !isDetail(name)) {
      std::string words = name;
      std::replace(words.begin(), words.end(), '_', ' ');
      std::cout << before << words << ' ';
      const Colour colour(std::cout, in_colour, value_colour);
      std::cout << value;
      before = ", ";
    }
  if (*before != '\0')
    std::cout << '\n';
}

void
printAll(const pcl_uvol::Report& report, bool in_colour)
{
  for (const auto& [name, value] : report.counts)
    printRow(name, value, "", in_colour);
  std::cout << std::fixed << std::setprecision(1);
  for (const auto& [step, value] : report.milliseconds)
    printRow(step, value, " ms", in_colour);
}

} // namespace

void
printReport(const Options& options,
            const pcl_uvol::Report& report,
            const Facts& facts,
            bool plain)
{
  if (options.json()) {
    nlohmann::ordered_json object;
    for (const Fact& fact : facts)
      if (!fact.getKey().empty())
        object[fact.getKey()] = nlohmann::ordered_json::parse(fact.getJson());
    for (const auto& [name, value] : report.counts)
      object["counts"][name] = value;
    for (const auto& [step, value] : report.milliseconds)
      object["milliseconds"][step] = value;
    object["warnings"] = nlohmann::ordered_json::array();
    for (const CountedWarning& warning : countEqual(report.warnings))
      object["warnings"].push_back(toJson(warning));
    printJson(object);
    return;
  }
  const bool in_colour = !plain && isatty(STDOUT_FILENO) != 0;
  for (const Fact& fact : facts)
    if (!fact.getText().empty())
      std::cout << printable(fact.getName()) << ": " << printable(fact.getText())
                << '\n';
  if (options.verbose())
    printAll(report, in_colour);
  else
    printCounts(report, in_colour);
  for (const auto& [warning, times] : countEqual(report.warnings)) {
    const std::string line =
        "Warning: " + printable(warning.text(ParameterNames::Options)) +
        (times > 1 ? " (" + std::to_string(times) + " times)" : "") + '\n';
    const Colour colour(
        std::cerr, !plain && isatty(STDERR_FILENO) != 0, warning_colour);
    std::cerr << line;
  }
}

void
printError(const char* tool, const Outcome& outcome)
{
  const std::string sentence = printable(outcome.sentence);
  std::cerr << tool << ": " << sentence << '\n';
  if (!outcome.marked_lines.empty())
    std::cerr << outcome.marked_lines << '\n';
  if (isJsonAskedFor())
    printJson({{"error", toJson(outcome.code, sentence, outcome.values)}});
}

} // namespace uvol_tools
