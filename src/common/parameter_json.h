// SPDX-License-Identifier: BSD-3-Clause
// JSON of structs of parameters, from their lists of members (common/parameters.h).
#pragma once

#include "common/json_value.h"
#include "common/printable.h"
#include "common/similar_words.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/parameters.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace pcl_uvol {

namespace detail {

template <typename T, typename = void>
struct HasMembers : std::false_type {
};
template <typename T>
struct HasMembers<T, std::void_t<decltype(T::listMembers())>> : std::true_type {
};

template <typename T>
constexpr bool is_eigen = std::is_base_of_v<Eigen::DenseBase<T>, T>;

/** What is not given, NaN or an empty optional, is null. */
template <typename T>
JsonValue
toJsonValue(const T& value)
{
  if constexpr (HasMembers<T>::value) {
    JsonValue object = JsonValue::makeObject();
    forEachMember<T>([&](const char* name, auto pointer) {
      object.set(name, toJsonValue(value.*pointer));
    });
    return object;
  }
  else if constexpr (IsOptional<T>::value)
    return value ? toJsonValue(*value) : JsonValue();
  else if constexpr (std::is_enum_v<T>)
    return JsonValue(std::string(toWord(value)));
  else if constexpr (is_eigen<T>) {
    JsonValue list = JsonValue::makeList();
    for (Eigen::Index i = 0; i < value.size(); ++i)
      list.append(JsonValue(double(value[i])));
    return list;
  }
  else if constexpr (std::is_floating_point_v<T>)
    return std::isfinite(value) ? JsonValue(double(value)) : JsonValue();
  else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>)
    return JsonValue(value);
  else if constexpr (std::is_integral_v<T> && std::is_signed_v<T>)
    return JsonValue(std::int64_t{value});
  else if constexpr (std::is_integral_v<T>)
    return JsonValue(std::uint64_t{value});
  else { // a list
    JsonValue list = JsonValue::makeList();
    for (const auto& item : value)
      list.append(toJsonValue(item));
    return list;
  }
}

[[noreturn]] inline void
refuseJson(const std::string& name, const JsonValue& value, const char* expected)
{
  throw InvalidArgument(
      "wrong_parameter",
      {{"name", name}, {"value", shortenText(value.dump())}, {"expected", expected}});
}

/** \throws InvalidArgument that lists the names that there are */
[[noreturn]] inline void
refuseName(const std::string& prefix,
           const std::string& key,
           const std::vector<std::string>& names)
{
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ", ") + name;
  const std::string similar = findSimilar(names, key);
  throw InvalidArgument("unknown_parameter",
                        {{"name", prefix + shortenText(key)},
                         {"has_similar", !similar.empty()},
                         {"similar", similar},
                         {"names", list}});
}

template <typename T>
void
fromJsonValue(const std::string& name, const JsonValue& json, T& value);

template <typename Parameters>
void
readMembers(const std::string& path, const JsonValue& json, Parameters& parameters)
{
  if (!json.isObject())
    refuseJson(path.empty() ? "set" : path, json, "an object");
  const std::string prefix = path.empty() ? "" : path + ".";
  json.forEach([&](const std::string& key, const JsonValue& value) {
    bool found = false;
    std::vector<std::string> names;
    forEachMember<Parameters>([&](const char* name, auto pointer) {
      names.emplace_back(name);
      if (key != name)
        return;
      found = true;
      fromJsonValue(prefix + name, value, parameters.*pointer);
    });
    if (!found)
      refuseName(prefix, key, names);
  });
}

template <typename T>
void
fromJsonNumber(const std::string& name, const JsonValue& json, T& value)
{
  if constexpr (std::is_same_v<T, bool>) {
    if (!json.isBool())
      refuseJson(name, json, "true or false");
    value = json.getBool();
  }
  else if constexpr (std::is_integral_v<T> && std::is_signed_v<T>) {
    if (!json.isInteger() || json.getInteger() != static_cast<T>(json.getInteger()))
      refuseJson(name, json, "a whole number");
    value = static_cast<T>(json.getInteger());
  }
  else if constexpr (std::is_integral_v<T>) {
    if (!json.isUnsigned() ||
        json.getUnsigned() > static_cast<std::uint64_t>(std::numeric_limits<T>::max()))
      refuseJson(name, json, "a whole number from 0");
    value = static_cast<T>(json.getUnsigned());
  }
  else if (json.isNull())
    value = std::numeric_limits<T>::quiet_NaN();
  else if (json.isNumber())
    value = static_cast<T>(json.getNumber());
  else
    refuseJson(name, json, "a number");
}

template <typename T>
void
fromJsonValue(const std::string& name, const JsonValue& json, T& value)
{
  if constexpr (HasMembers<T>::value)
    readMembers(name, json, value);
  else if constexpr (IsOptional<T>::value) {
    value.reset();
    if (!json.isNull())
      fromJsonValue(name, json, value.emplace());
  }
  else if constexpr (std::is_enum_v<T>) {
    if (!json.isString() || !fromWord(json.getString(), value)) {
      std::string words;
      for (const auto& word : listWords(T()))
        words += (words.empty() ? "" : ", ") + std::string(word.word);
      refuseJson(name, json, ("one of " + words).c_str());
    }
  }
  else if constexpr (is_eigen<T>) {
    if (!json.isList() || static_cast<Eigen::Index>(json.size()) != value.size())
      refuseJson(name, json, ("a list of " + std::to_string(value.size())).c_str());
    Eigen::Index i = 0;
    json.forEach([&](const std::string&, const JsonValue& item) {
      fromJsonNumber(name, item, value[i++]);
    });
  }
  else if constexpr (std::is_arithmetic_v<T>)
    fromJsonNumber(name, json, value);
  else if constexpr (std::is_same_v<T, std::string>) {
    if (!json.isString())
      refuseJson(name, json, "a text");
    value = json.getString();
  }
  else { // a list
    if (!json.isList())
      refuseJson(name, json, "a list");
    value.clear();
    json.forEach([&](const std::string&, const JsonValue& item) {
      fromJsonValue(name, item, value.emplace_back());
    });
  }
}

} // namespace detail

/** \brief All members, in their order. */
template <typename Parameters>
std::string
writeJson(const Parameters& parameters)
{
  return detail::toJsonValue(parameters).dump(2);
}

/** \brief Members that the text does not name keep their defaults.
 * \throws InvalidArgument for text that is no JSON, unknown names, and values of
 * another type, naming what is allowed */
template <typename Parameters>
Parameters
readJson(const std::string& text)
{
  const auto json = detail::JsonValue::parse(text);
  if (!json)
    throw InvalidArgument("parameters_not_json", {});
  Parameters parameters;
  detail::readMembers("", *json, parameters);
  return parameters;
}

} // namespace pcl_uvol
