// SPDX-License-Identifier: BSD-3-Clause
#include "io/xml_text.h"

#include "common/printable.h"

#include <string_view>

namespace pcl_uvol {
namespace io {

std::string
escapeAttribute(const std::string& text)
{
  std::string value;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t bytes = 1;
    while (bytes < 4 && !isPrintable(std::string_view(text).substr(at, bytes)))
      ++bytes;
    const char c = text[at];
    const auto byte = static_cast<unsigned char>(c);
    if (!isPrintable(std::string_view(text).substr(at, bytes))) {
      bytes = 1;
      if (byte >= 0xa0)
        value += {static_cast<char>(0xc0 | byte >> 6),
                  static_cast<char>(0x80 | (byte & 0x3f))};
      else
        value += '_';
    }
    else if (c == '&')
      value += "&amp;";
    else if (c == '<')
      value += "&lt;";
    else if (c == '>')
      value += "&gt;";
    else if (c == '"')
      value += "&quot;";
    else
      value += text.substr(at, bytes);
    at += bytes;
  }
  return value;
}

} // namespace io
} // namespace pcl_uvol
