// SPDX-License-Identifier: BSD-3-Clause
#include "expressions/label_text.h"

#include "common/numbers.h"

#include <algorithm>

namespace pcl_uvol {

bool
isLabelQuote(char character)
{
  return character == '"' || character == '\'';
}

bool
takeLabel(std::string_view text, std::size_t& at, std::string& name)
{
  name.clear();
  const std::string_view quote = text.substr(at, 1);
  if (!isLabelQuote(quote.empty() ? ' ' : quote[0])) {
    const std::size_t end = std::min(
        {text.find("&&", at), text.find("||", at), text.find(')', at), text.size()});
    name = trimmed(text.substr(at, end - at));
    at = end;
    return true;
  }
  for (++at; at < text.size(); ++at) {
    if (text[at] == quote[0] && text.substr(++at, 1) != quote)
      return true;
    name += text[at];
  }
  return false;
}

} // namespace pcl_uvol
