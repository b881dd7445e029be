// SPDX-License-Identifier: BSD-3-Clause
#include "charts/text_wrap.h"

#include "charts/drawing.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace uvol_tools {

namespace {

/** The begin of the letter behind one, which may have several bytes. */
std::size_t
nextLetter(const std::string& text, std::size_t at)
{
  for (++at; at < text.size(); ++at)
    if ((static_cast<unsigned char>(text[at]) & 0xc0) != 0x80)
      break;
  return at;
}

/** How well a line ends before a letter: 3 at a blank, 2 at one within a bracket, as
 * those of units are, and 1 behind a sign. */
int
rateEnd(const std::string& text, std::size_t at)
{
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(at);
  if (end == text.end() || *end == ' ')
    return std::count(text.begin(), end, '(') > std::count(text.begin(), end, ')') ? 2
                                                                                   : 3;
  const auto last = static_cast<unsigned char>(*(end - 1));
  return std::ispunct(last) != 0 && last != '(' ? 1 : 0;
}

/** The end of the first line of a text: the last one of the best that fit. */
std::size_t
findEnd(const std::string& text, int size, int width)
{
  std::size_t best = nextLetter(text, 0);
  int best_rate = rateEnd(text, best);
  for (std::size_t end = best; end < text.size();) {
    end = nextLetter(text, end);
    if (measureText(text.substr(0, end), size) > width)
      break;
    const int rate = rateEnd(text, end);
    if (rate >= best_rate) {
      best = end;
      best_rate = rate;
    }
  }
  return best;
}

} // namespace

std::vector<std::string>
wrapText(const std::string& text, int size, int width)
{
  std::vector<std::string> lines;
  for (std::string rest = text;;) {
    const std::size_t end =
        measureText(rest, size) <= width ? rest.size() : findEnd(rest, size, width);
    const std::size_t last = rest.find_last_not_of(' ', end - 1);
    lines.push_back(rest.substr(0, last + 1)); // none: 0
    const std::size_t begin = rest.find_first_not_of(' ', end);
    if (begin == std::string::npos)
      return lines;
    rest = rest.substr(begin);
  }
}

} // namespace uvol_tools
