// SPDX-License-Identifier: BSD-3-Clause
// JSON of structs of parameters, from their lists of members (common/parameters.h).
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/parameters.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>

namespace pcl_uvol {

namespace detail {

template <typename T, typename = void>
struct HasMembers : std::false_type {
};
template <typename T>
struct HasMembers<T, std::void_t<decltype(T::listMembers())>> : std::true_type {
};

template <typename T>
struct IsOptional : std::false_type {
};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {
};

template <typename T>
constexpr bool is_eigen = std::is_base_of_v<Eigen::DenseBase<T>, T>;

/** What is not given, NaN or an empty optional, is null. */
template <typename T>
nlohmann::ordered_json
toJsonValue(const T& value)
{
  if constexpr (HasMembers<T>::value) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    forEachMember<T>([&](const char* name, auto pointer) {
      object[name] = toJsonValue(value.*pointer);
    });
    return object;
  }
  else if constexpr (IsOptional<T>::value)
    return value ? toJsonValue(*value) : nlohmann::ordered_json();
  else if constexpr (std::is_enum_v<T>)
    return toWord(value);
  else if constexpr (is_eigen<T>) {
    auto list = nlohmann::ordered_json::array();
    for (Eigen::Index i = 0; i < value.size(); ++i)
      list.push_back(value[i]);
    return list;
  }
  else if constexpr (std::is_floating_point_v<T>)
    return std::isfinite(value) ? nlohmann::ordered_json(value)
                                : nlohmann::ordered_json();
  else
    return value;
}

[[noreturn]] inline void
refuseJson(const std::string& name, const nlohmann::json& value, const char* expected)
{
  throw InvalidArgument("The parameter " + name + " is " + value.dump() +
                        " in JSON: it must be " + expected + ".");
}

template <typename T>
void
fromJsonValue(const std::string& name, const nlohmann::json& json, T& value);

template <typename Parameters>
void
readMembers(const std::string& path, const nlohmann::json& json, Parameters& parameters)
{
  if (!json.is_object())
    refuseJson(path.empty() ? "set" : path, json, "an object");
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& item : json.items()) {
    bool found = false;
    std::string names;
    forEachMember<Parameters>([&](const char* name, auto pointer) {
      names += (names.empty() ? "" : ", ") + std::string(name);
      if (item.key() != name)
        return;
      found = true;
      fromJsonValue(prefix + name, item.value(), parameters.*pointer);
    });
    if (!found)
      throw InvalidArgument("There is no parameter " + prefix + item.key() +
                            " in JSON: there are " + names + ".");
  }
}

template <typename T>
void
fromJsonNumber(const std::string& name, const nlohmann::json& json, T& value)
{
  if constexpr (std::is_same_v<T, bool>) {
    if (!json.is_boolean())
      refuseJson(name, json, "true or false");
    value = json.get<bool>();
  }
  else if constexpr (std::is_integral_v<T> && std::is_signed_v<T>) {
    if (!json.is_number_integer() ||
        json.get<std::int64_t>() != static_cast<T>(json.get<std::int64_t>()))
      refuseJson(name, json, "a whole number");
    value = json.get<T>();
  }
  else if constexpr (std::is_integral_v<T>) {
    if (!json.is_number_unsigned() ||
        json.get<std::uint64_t>() >
            static_cast<std::uint64_t>(std::numeric_limits<T>::max()))
      refuseJson(name, json, "a whole number from 0");
    value = json.get<T>();
  }
  else if (json.is_null())
    value = std::numeric_limits<T>::quiet_NaN();
  else if (json.is_number())
    value = json.get<T>();
  else
    refuseJson(name, json, "a number");
}

template <typename T>
void
fromJsonValue(const std::string& name, const nlohmann::json& json, T& value)
{
  if constexpr (HasMembers<T>::value)
    readMembers(name, json, value);
  else if constexpr (IsOptional<T>::value) {
    value.reset();
    if (!json.is_null())
      fromJsonValue(name, json, value.emplace());
  }
  else if constexpr (std::is_enum_v<T>) {
    if (!json.is_string() || !fromWord(json.get<std::string>(), value)) {
      std::string words;
      for (const auto& word : listWords(T()))
        words += (words.empty() ? "" : ", ") + std::string(word.word);
      refuseJson(name, json, ("one of " + words).c_str());
    }
  }
  else if constexpr (is_eigen<T>) {
    if (!json.is_array() || static_cast<Eigen::Index>(json.size()) != value.size())
      refuseJson(name, json, ("a list of " + std::to_string(value.size())).c_str());
    for (Eigen::Index i = 0; i < value.size(); ++i)
      fromJsonNumber(name, json[static_cast<std::size_t>(i)], value[i]);
  }
  else if constexpr (std::is_arithmetic_v<T>)
    fromJsonNumber(name, json, value);
  else if constexpr (std::is_same_v<T, std::string>) {
    if (!json.is_string())
      refuseJson(name, json, "a text");
    value = json.get<std::string>();
  }
  else { // a list
    if (!json.is_array())
      refuseJson(name, json, "a list");
    value.clear();
    for (const auto& item : json)
      fromJsonValue(name, item, value.emplace_back());
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
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded())
    throw InvalidArgument("The parameters are not JSON.");
  Parameters parameters;
  detail::readMembers("", json, parameters);
  return parameters;
}

} // namespace pcl_uvol
