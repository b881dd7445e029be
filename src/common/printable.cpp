// SPDX-License-Identifier: BSD-3-Clause
#include "common/printable.h"

#include <cstddef>

namespace pcl_uvol {
namespace {

bool
isContinuation(unsigned char byte)
{
  return (byte & 0xc0) == 0x80;
}

/** Bytes of the printable character of UTF-8 that a text begins with, else 0. */
std::size_t
printableBytes(std::string_view text)
{
  const auto at = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i])
                           : static_cast<unsigned char>(0);
  };
  const unsigned char first = at(0), second = at(1);
  if (first < 0x80)
    return first >= ' ' && first != 0x7f ? 1 : 0;
  if (!isContinuation(second))
    return 0;
  if (first >= 0xc2 && first < 0xe0) // U+0080 to U+009F steer terminals, too
    return first > 0xc2 || second >= 0xa0 ? 2 : 0;
  if (first < 0xf0)
    return first >= 0xe0 && isContinuation(at(2)) && (first > 0xe0 || second >= 0xa0) &&
                   (first != 0xed || second < 0xa0) // halves of pairs of UTF-16
               ? 3
               : 0;
  return first <= 0xf4 && isContinuation(at(2)) && isContinuation(at(3)) &&
                 (first > 0xf0 || second >= 0x90) && (first < 0xf4 || second < 0x90)
             ? 4
             : 0;
}

/** \param most characters of the text that are shown */
std::string
escaped(std::string_view text, std::size_t most)
{
  constexpr char digits[] = "0123456789abcdef";
  std::string shown;
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count == most)
      return shown + "...";
    const std::size_t bytes = printableBytes(text);
    if (bytes > 0)
      shown += text.substr(0, bytes);
    else {
      const auto byte = static_cast<unsigned char>(text[0]);
      shown += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    }
    text.remove_prefix(bytes > 0 ? bytes : 1);
  }
  return shown;
}

} // namespace

std::string
printable(std::string_view text)
{
  return escaped(text, text.size());
}

std::string
shortenText(std::string_view text)
{
  constexpr std::size_t most_characters = 40;
  return escaped(text, most_characters);
}

std::string
quoteText(std::string_view text)
{
  return "'" + shortenText(text) + "'";
}

bool
isPrintable(std::string_view text)
{
  while (const std::size_t bytes = printableBytes(text))
    text.remove_prefix(bytes);
  return text.empty();
}

} // namespace pcl_uvol
