// SPDX-License-Identifier: BSD-3-Clause
// What is said of parameters where they are listed, as JSON: for front ends that are
// not written in C++.
#pragma once

#include "common/parameter_json.h"

#include <string>

namespace pcl_uvol {

/** \brief The type of a member, as documentation of Python calls it. */
template <typename T>
std::string
describeType(const T& value)
{
  if constexpr (std::is_enum_v<T>) {
    std::string words;
    for (const auto& word : listWords(value))
      words += std::string(words.empty() ? "{\"" : ", \"") + word.word + '"';
    return words + "}";
  }
  else if constexpr (detail::IsOptional<T>::value) {
    static const typename T::value_type any{}; // Eigen leaves others undefined
    return describeType(any) + ", optional";
  }
  else if constexpr (std::is_same_v<T, bool>)
    return "bool";
  else if constexpr (std::is_integral_v<T>)
    return "int";
  else
    return "float";
}

/** \brief The members that have a help text: a list of objects with their name, the
 * name that an option has, type, default and help. */
template <typename Parameters>
std::string
writeDescription()
{
  const Parameters defaults;
  auto list = detail::JsonValue::makeList();
  forEachDescribed<Parameters>([&](const auto& member) {
    if (*member.text.help == '\0')
      return;
    auto object = detail::JsonValue::makeObject();
    const char* const option = member.text.option ? member.text.option : member.name;
    object.set("name", detail::JsonValue(std::string(member.name)));
    object.set("option", detail::JsonValue(std::string(option)));
    object.set("type", detail::JsonValue(describeType(defaults.*member.pointer)));
    object.set("default", detail::toJsonValue(defaults.*member.pointer));
    object.set("help", detail::JsonValue(std::string(member.text.help)));
    list.append(object);
  });
  return list.dump(0);
}

} // namespace pcl_uvol
