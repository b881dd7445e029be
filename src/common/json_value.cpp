// SPDX-License-Identifier: BSD-3-Clause
#include "common/json_value.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace pcl_uvol::detail {

using Json = nlohmann::ordered_json;

// NOLINTNEXTLINE(bugprone-exception-escape): nlohmann moves without throwing
struct JsonValue::Content {
  Json json;
};

JsonValue::JsonValue()
    : content_(std::make_shared<Content>())
{
}

JsonValue::JsonValue(std::shared_ptr<Content> content)
    : content_(std::move(content))
{
}

JsonValue::JsonValue(bool value)
    : content_(std::make_shared<Content>(Content{Json(value)}))
{
}

JsonValue::JsonValue(double value)
    : content_(std::make_shared<Content>(Content{Json(value)}))
{
}

JsonValue::JsonValue(std::int64_t value)
    : content_(std::make_shared<Content>(Content{Json(value)}))
{
}

JsonValue::JsonValue(std::uint64_t value)
    : content_(std::make_shared<Content>(Content{Json(value)}))
{
}

JsonValue::JsonValue(const std::string& value)
    : content_(std::make_shared<Content>(Content{Json(value)}))
{
}

JsonValue
JsonValue::makeObject()
{
  return JsonValue(std::make_shared<Content>(Content{Json::object()}));
}

JsonValue
JsonValue::makeList()
{
  return JsonValue(std::make_shared<Content>(Content{Json::array()}));
}

std::optional<JsonValue>
JsonValue::parse(const std::string& text)
{
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
    return std::nullopt;
  return JsonValue(std::make_shared<Content>(Content{std::move(json)}));
}

bool
JsonValue::isNull() const
{
  return content_->json.is_null();
}

bool
JsonValue::isBool() const
{
  return content_->json.is_boolean();
}

bool
JsonValue::isNumber() const
{
  return content_->json.is_number();
}

bool
JsonValue::isInteger() const
{
  return content_->json.is_number_integer();
}

bool
JsonValue::isUnsigned() const
{
  return content_->json.is_number_unsigned();
}

bool
JsonValue::isString() const
{
  return content_->json.is_string();
}

bool
JsonValue::isList() const
{
  return content_->json.is_array();
}

bool
JsonValue::isObject() const
{
  return content_->json.is_object();
}

bool
JsonValue::getBool() const
{
  return content_->json.get<bool>();
}

double
JsonValue::getNumber() const
{
  return content_->json.get<double>();
}

std::int64_t
JsonValue::getInteger() const
{
  return content_->json.get<std::int64_t>();
}

std::uint64_t
JsonValue::getUnsigned() const
{
  return content_->json.get<std::uint64_t>();
}

std::string
JsonValue::getString() const
{
  return content_->json.get<std::string>();
}

std::size_t
JsonValue::size() const
{
  return content_->json.size();
}

void
JsonValue::forEach(
    const std::function<void(const std::string&, const JsonValue&)>& visit) const
{
  for (const auto& item : content_->json.items())
    visit(item.key(), JsonValue(std::make_shared<Content>(Content{item.value()})));
}

void
JsonValue::set(const std::string& key, const JsonValue& value)
{
  content_->json[key] = value.content_->json;
}

void
JsonValue::append(const JsonValue& value)
{
  content_->json.push_back(value.content_->json);
}

std::string
JsonValue::dump(int indent) const
{
  // Names of fields need not be UTF-8.
  return content_->json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace pcl_uvol::detail
