// SPDX-License-Identifier: BSD-3-Clause
// The texts of all messages.
#pragma once

#include <pcl_uvol/common/export.h>

#include <string>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A row of the table of messages. In a text stand
 * - {name}: that value; {name:3}: its first 3 digits, instead of 6
 * - {name|one|other}: the first if the value is 1, the second if it is not; both may
 * hold further braces
 * - {-max-error}, {-mu 0.1}: a parameter and a value of it, as the front end names
 * them; braces may be in the value */
struct MessageText {
  const char* code;
  const char* text;
};

/** \brief A table of texts. */
struct MessageTexts {
  const MessageText *first, *last;

  const MessageText*
  begin() const
  {
    return first;
  }

  const MessageText*
  end() const
  {
    return last;
  }
};

/** \brief What is told beside a result: warning_texts.cpp. */
MessageTexts
listWarnings();

/** \brief What exceptions tell: error_texts.cpp. */
MessageTexts
listErrors();

/** \brief Why files cannot be read or written: file_error_texts.cpp. */
MessageTexts
listFileErrors();

/** \brief The row of a code.
 * \throws InvalidArgument if there is none */
const MessageText&
findMessageText(const std::string& code);

/** \brief The names of the values in the text of a code, in their order. */
PCL_UVOL_EXPORTS std::vector<std::string>
listValues(const std::string& code);

} // namespace pcl_uvol::detail
