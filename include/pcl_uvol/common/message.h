// SPDX-License-Identifier: BSD-3-Clause
// What a run tells beside its result, as data: a code, and the numbers and names that
// its text holds. The texts are tables: src/common/warning_texts.cpp, error_texts.cpp.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace pcl_uvol {

/** \brief How a text names parameters. */
enum class ParameterNames : std::uint8_t {
  Members,    ///< max_error: members of parameters in C++, arguments in Python
  Options,    ///< -max-error: options of the tools
  Properties, ///< MaximumError: properties of VTK's filters
};

/** \brief A number of a message, or a word such as the name of a field. */
struct MessageValue {
  /** \param name_in_text lower-case words joined by underscores
   * \param number any number; a truth is 1 or 0 */
  template <typename T, std::enable_if_t<std::is_arithmetic_v<T>, int> = 0>
  MessageValue(std::string name_in_text, T number)
      : name(std::move(name_in_text))
      , value(static_cast<double>(number))
  {
  }
  /** \param name_in_text lower-case words joined by underscores
   * \param word the word in the text */
  MessageValue(std::string name_in_text, std::string word)
      : name(std::move(name_in_text))
      , value(std::move(word))
  {
  }

  std::string name;
  std::variant<double, std::string> value;
};

/** \brief A message of a run, in addition to its result. Whether it warns or ends the
 * run is said by its place: Report::warnings or an exception, `warnings` or `error` in
 * JSON. */
struct PCL_UVOL_EXPORTS Message {
  /** \brief A message of the table.
   * \param row its code in the table, which stays when the text changes
   * \param held all that the text holds */
  Message(std::string row, std::vector<MessageValue> held);

  /** \brief A text that is in no table: its code is "text", as is the name of its
   * value.
   * \param text whole sentences */
  Message(std::string text); // NOLINT(google-explicit-constructor)

  /** \brief The text in words.
   * \param names how it names parameters
   * \throws Exception if the table has no such code, or the message lacks a value of
   * its text */
  std::string
  text(ParameterNames names = ParameterNames::Members) const;

  std::string code;
  std::vector<MessageValue> values;
  std::string about; ///< what the text begins with, a file for example; mostly empty
};

/** \brief Whether code, values and subject are equal.
 * \param a a message
 * \param b another one */
PCL_UVOL_EXPORTS bool
operator==(const Message& a, const Message& b);

/** \brief Write the text, with the names of members.
 * \param out a stream
 * \param message any */
PCL_UVOL_EXPORTS std::ostream&
operator<<(std::ostream& out, const Message& message);

} // namespace pcl_uvol
