// SPDX-License-Identifier: BSD-3-Clause
#include "common/printable.h"
#include <pcl_uvol/expressions/derived_fields.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace pcl_uvol {

namespace {

/** Bytes of an expression around the place that are shown. */
constexpr std::size_t shown_before = 50, shown_after = 25;

bool
continuesCharacter(char c)
{
  return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u;
}

std::size_t
countCharacters(const std::string& text)
{
  return text.size() - static_cast<std::size_t>(
                           std::count_if(text.begin(), text.end(), continuesCharacter));
}

/** The expression around a place, and a caret below. */
std::string
markPlace(std::string_view expression, std::size_t place)
{
  place = std::min(place, expression.size());
  std::size_t begin = place > shown_before ? place - shown_before : 0;
  while (begin > 0 && continuesCharacter(expression[begin]))
    --begin;
  std::size_t end = std::min(place + shown_after, expression.size());
  while (end < expression.size() && continuesCharacter(expression[end]))
    ++end;
  const std::string before =
      (begin > 0 ? "..." : "") + printable(expression.substr(begin, place - begin));
  return "  " + before + printable(expression.substr(place, end - place)) +
         (end < expression.size() ? "..." : "") + "\n  " +
         std::string(countCharacters(before), ' ') + '^';
}

std::vector<MessageValue>
withMarkedLines(std::vector<MessageValue> values,
                const std::string& expression,
                std::size_t place)
{
  values.emplace_back("marked_lines", markPlace(expression, place));
  return values;
}

} // namespace

ExpressionError::ExpressionError(std::string code,
                                 std::vector<MessageValue> values,
                                 const std::string& expression,
                                 std::size_t place)
    : InvalidArgument(std::move(code),
                      withMarkedLines(std::move(values), expression, place))
    , marked_(markPlace(expression, place))
    , sentence_(message().substr(0, message().size() - marked_.size() - 1))
{
}

} // namespace pcl_uvol
