// SPDX-License-Identifier: BSD-3-Clause
#include "common/message_texts.h"

#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <regex>

namespace pcl_uvol::detail {

const MessageText&
findMessageText(const std::string& code)
{
  static const MessageText of_none = {"text", "{text}"};
  if (code == of_none.code)
    return of_none;
  for (const MessageTexts& texts : {listWarnings(), listErrors(), listFileErrors()})
    for (const MessageText& row : texts)
      if (row.code == code)
        return row;
  throw InvalidArgument("unknown_message", {{"code", code}});
}

std::vector<std::string>
listValues(const std::string& code)
{
  static const std::regex value("\\{([a-z_]+)");
  const std::string text = findMessageText(code).text;
  std::vector<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), value), end; match != end;
       ++match)
    if (std::find(names.begin(), names.end(), (*match)[1]) == names.end())
      names.push_back((*match)[1]);
  return names;
}

} // namespace pcl_uvol::detail
