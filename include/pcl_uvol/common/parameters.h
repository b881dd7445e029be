// SPDX-License-Identifier: BSD-3-Clause
// Parameters of stages: plain structs that list their members once. Equality and JSON
// rest on that list; the words of enumerations are those of JSON and of options.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>

namespace pcl_uvol {

/** \brief A value of an enumeration and a word for it.
 *
 * Beside each enumeration stands `listWords(Enum)`, which returns an array of them: of
 * several words for one value the first is written, all are understood. */
template <typename Enum>
struct EnumWord {
  Enum value;
  const char* word;
};

/** \brief The word that is written for a value.
 * \param value of an enumeration with listWords() */
template <typename Enum>
const char*
toWord(Enum value)
{
  for (const auto& [other, word] : listWords(Enum()))
    if (other == value)
      return word;
  return "";
}

/** \brief The value of a word.
 * \param word as toWord() writes it
 * \param value unchanged if no value has this word
 * \return whether a value has this word */
template <typename Enum>
bool
fromWord(const std::string& word, Enum& value)
{
  for (const auto& [other, its_word] : listWords(Enum()))
    if (word == its_word) {
      value = other;
      return true;
    }
  return false;
}

/** \brief Description of a member for people: help of tools, docstrings of Python. */
struct MemberText {
  /** A phrase: the meaning of the member, its unit, and the meaning of special values.
   * Names of values are those of JSON. */
  const char* help = "";
  double low = -std::numeric_limits<double>::infinity(); ///< of numbers: the least
  double high = std::numeric_limits<double>::infinity(); ///< and the largest one
  const char* option = nullptr; ///< of tools, where it is not the member's name
};

/** \brief A member of a struct of parameters, which lists them all as
 * \code
 * static auto listMembers() {
 *   return std::make_tuple(Member{"k", &Own::k, {"nearest neighbours", 2, 10000}});
 * }
 * \endcode */
template <typename Parameters, typename T>
struct Member {
  const char* name;
  T Parameters::*pointer;
  MemberText text = {};
};

/** \brief Member{name, pointer} finds its types by itself. @{ */
template <typename Parameters, typename T>
Member(const char*, T Parameters::*) -> Member<Parameters, T>;
template <typename Parameters, typename T>
Member(const char*, T Parameters::*, MemberText) -> Member<Parameters, T>;
/** @} */

/** \brief Call visit(name, pointer to member) for each of them.
 * \param visit called with a name and a pointer to a member */
template <typename Parameters, typename Visit>
void
forEachMember(Visit&& visit)
{
  std::apply([&](const auto&... member) { (visit(member.name, member.pointer), ...); },
             Parameters::listMembers());
}

/** \brief The same with all that is known of a member.
 * \param visit called with each Member */
template <typename Parameters, typename Visit>
void
forEachDescribed(Visit&& visit)
{
  std::apply([&](const auto&... member) { (visit(member), ...); },
             Parameters::listMembers());
}

namespace detail {

template <typename T>
struct IsOptional : std::false_type {
};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {
};

template <typename T>
bool
areEqual(const T& a, const T& b)
{
  if constexpr (std::is_floating_point_v<T>)
    return a == b || (a != a && b != b); // NaN: not given
  else if constexpr (std::is_base_of_v<Eigen::ArrayBase<T>, T> ||
                     std::is_base_of_v<Eigen::MatrixBase<T>, T>)
    return (a.array() == b.array()).all();
  else if constexpr (IsOptional<T>::value)
    return a && b ? areEqual(*a, *b) : !a && !b;
  else
    return a == b;
}

} // namespace detail

/** \brief Two structs of parameters are equal where all their members are.
 * \param a a struct
 * \param b another one @{ */
template <typename Parameters, typename = decltype(Parameters::listMembers())>
bool
operator==(const Parameters& a, const Parameters& b)
{
  bool equal = true;
  forEachMember<Parameters>([&](const char*, auto pointer) {
    equal = equal && detail::areEqual(a.*pointer, b.*pointer);
  });
  return equal;
}

template <typename Parameters, typename = decltype(Parameters::listMembers())>
bool
operator!=(const Parameters& a, const Parameters& b)
{
  return !(a == b);
}
/** @} */

} // namespace pcl_uvol
