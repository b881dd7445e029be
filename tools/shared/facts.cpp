// SPDX-License-Identifier: BSD-3-Clause
#include "shared/facts.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

namespace uvol_tools {

namespace {

using Json = nlohmann::ordered_json;

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

Json
toJson(double number)
{
  constexpr double most_exact = 9007199254740992.0; // 2^53
  if (!std::isfinite(number))
    return {};
  if (number == std::round(number) && std::abs(number) < most_exact)
    return static_cast<std::int64_t>(number);
  return number;
}

Json
toJson(const Fact::Numbers& numbers)
{
  Json list = Json::array();
  for (const double number : numbers)
    list.push_back(toJson(number));
  return list;
}

Json
toJson(const Fact::Members& members)
{
  if (members.empty())
    return {};
  Json object;
  for (const auto& [name, numbers] : members)
    object[name] = numbers.size() == 1 ? toJson(numbers.front()) : toJson(numbers);
  return object;
}

std::string
join(const Fact::Numbers& numbers)
{
  std::ostringstream text;
  for (const double number : numbers)
    text << (text.tellp() > 0 ? "," : "") << number;
  return text.str();
}

} // namespace

Fact::Fact(std::string name, std::string text)
    : name_(std::move(name))
    , key_(makeKey(name_))
    , text_(std::move(text))
    , json_(write(text_))
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
    , json_(write(toJson(number)))
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
    , json_(write(toJson(numbers)))
{
}

Fact::Fact(std::string name, std::string text, const Members& members)
    : name_(std::move(name))
    , key_(makeKey(name_))
    , text_(std::move(text))
    , json_(write(toJson(members)))
{
}

Fact::Fact(std::string name, const std::vector<Fact>& facts)
    : name_(std::move(name))
    , key_(makeKey(name_))
{
  Json object = Json::object();
  for (const Fact& fact : facts)
    object[fact.name_] = Json::parse(fact.json_);
  json_ = write(object);
}

Fact
Fact::withoutJson() const
{
  Fact shown = *this;
  shown.key_.clear();
  return shown;
}

} // namespace uvol_tools
