// SPDX-License-Identifier: BSD-3-Clause
#include "shared/facts.h"

#include "common/memory.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <nlohmann/json.hpp>
#include <string_view>

namespace uvol_tools {

namespace {

using Json = nlohmann::ordered_json;

/** Writes numbers as the classic locale does, but for those that are not finite. */
class KnownNumbers : public std::num_put<char> {
protected:
  iter_type
  do_put(iter_type out, std::ios_base& stream, char fill, double number) const override
  {
    if (std::isfinite(number))
      return std::num_put<char>::do_put(out, stream, fill, number);
    constexpr std::string_view unknown = "unknown";
    return std::copy(unknown.begin(), unknown.end(), out);
  }
};

std::string
makeKey(std::string name)
{
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/** As text; names of fields and files need not be UTF-8. */
std::string
write(const Json& json)
{
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string
write(double number)
{
  constexpr double most_exact = 9007199254740992.0; // 2^53
  if (!std::isfinite(number))
    return "null";
  if (number == std::round(number) && std::abs(number) < most_exact)
    return write(Json(static_cast<std::int64_t>(number)));
  return write(Json(number));
}

// Lists and objects are put together as texts: those of Json take memory to be
// destroyed, and end the program where there is none.

std::string
write(const Fact::Numbers& numbers)
{
  std::string text;
  for (const double number : numbers)
    text += (text.empty() ? "" : ",") + write(number);
  return '[' + text + ']';
}

/** \param members names and texts of JSON */
std::string
writeObject(const std::vector<std::pair<std::string, std::string>>& members)
{
  std::string text;
  for (const auto& [name, value] : members)
    text += (text.empty() ? "" : ",") + write(Json(name)) + ':' + value;
  return '{' + text + '}';
}

std::string
write(const Fact::Members& members)
{
  std::vector<std::pair<std::string, std::string>> texts;
  for (const auto& [name, numbers] : members)
    texts.emplace_back(name,
                       numbers.size() == 1 ? write(numbers.front()) : write(numbers));
  return texts.empty() ? "null" : writeObject(texts);
}

std::string
join(const Fact::Numbers& numbers)
{
  FactText text;
  for (const double number : numbers)
    text << (text.tellp() > 0 ? "," : "") << number;
  return text.str();
}

} // namespace

FactText::FactText()
{
  imbue(std::locale(std::locale::classic(), new KnownNumbers)); // which it owns
}

Fact::Fact(std::string name, std::string text)
    : name_(std::move(name))
    , key_(makeKey(name_))
    , text_(std::move(text))
    , json_(write(Json(text_)))
{
}

Fact::Fact(std::string name, double number)
    : Fact(std::move(name), join({number}), number)
{
}

Fact::Fact(std::string name, std::string text, double number)
    : name_(std::move(name))
    , key_(makeKey(name_))
    , text_(std::move(text))
    , json_(write(number))
{
}

Fact::Fact(std::string name, const Numbers& numbers)
    : Fact(std::move(name), join(numbers), numbers)
{
}

Fact::Fact(std::string name, std::string text, const Numbers& numbers)
    : name_(std::move(name))
    , key_(makeKey(name_))
    , text_(std::move(text))
    , json_(write(numbers))
{
}

Fact::Fact(std::string name, std::string text, const Members& members)
    : name_(std::move(name))
    , key_(makeKey(name_))
    , text_(std::move(text))
    , json_(write(members))
{
}

Fact::Fact(std::string name, const std::vector<Fact>& facts)
    : name_(std::move(name))
    , key_(makeKey(name_))
{
  std::vector<std::pair<std::string, std::string>> members;
  members.reserve(facts.size());
  for (const Fact& fact : facts)
    members.emplace_back(fact.name_, fact.json_);
  json_ = writeObject(members);
}

Fact
Fact::withoutJson() const
{
  Fact shown = *this;
  shown.key_.clear();
  return shown;
}

Fact
describeMemory(double bound)
{
  const std::string name = bound > 0.0 ? "bound" : "forecast";
  const double expected = std::round(bound > 0.0 ? bound : pcl_uvol::forecastMemory());
  const auto peak = static_cast<double>(pcl_uvol::peakMemory());
  const std::string text = "peak " + pcl_uvol::formatBytes(peak);
  if (!(expected > 0.0)) // no step had points
    return {"memory", text, Fact::Members{{"peak", {peak}}}};
  return {"memory",
          name + ' ' + pcl_uvol::formatBytes(expected) + ", " + text,
          Fact::Members{{name, {expected}}, {"peak", {peak}}}};
}

} // namespace uvol_tools
