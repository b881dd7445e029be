// SPDX-License-Identifier: BSD-3-Clause
#include "common/message_texts.h"

#include <pcl_uvol/common/exceptions.h>

namespace pcl_uvol::detail {

const MessageText&
findMessageText(const std::string& code)
{
  static const MessageText of_none = {"text", "{text}"};
  if (code == of_none.code)
    return of_none;
  for (const MessageTexts& texts : {listWarnings(), listErrors()})
    for (const MessageText& row : texts)
      if (row.code == code)
        return row;
  throw InvalidArgument("unknown_message", {{"code", code}});
}

} // namespace pcl_uvol::detail
