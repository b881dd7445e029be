// SPDX-License-Identifier: BSD-3-Clause
#include "expressions/operand_names.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "common/records.h"
#include "common/similar_words.h"
#include "expressions/program.h"

#include <algorithm>

namespace pcl_uvol {

namespace {

constexpr std::pair<const char*, Derivative> derivatives[] = {
    {"grad", Derivative::Gradient},
    {"laplacian", Derivative::Laplacian},
    {"curvature", Derivative::Curvature},
    {"div", Derivative::Divergence},
    {"curl", Derivative::Curl},
    {"Q", Derivative::Q},
    {"lambda2", Derivative::Lambda2}};

bool
isDigit(char c)
{
  return c >= '0' && c <= '9';
}

bool
beginsName(char c)
{
  return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool
isOneOf(char c, std::string_view characters)
{
  return characters.find(c) != std::string_view::npos;
}

std::size_t
findDigitsEnd(std::string_view text, std::size_t begin)
{
  while (begin < text.size() && isDigit(text[begin]))
    ++begin;
  return begin;
}

/** Nothing that belongs to the same operand stands beside it. */
bool
isWholeOperand(std::string_view text, std::size_t begin, std::size_t size)
{
  const std::string_view before = trimmed(text.substr(0, begin));
  const std::string_view after = trimmed(text.substr(begin + size));
  return (before.empty() || isOneOf(before.back(), "(,<>=&|!")) &&
         (after.empty() || isOneOf(after.front(), "),<>=&|!"));
}

bool
isThere(const std::string& name, std::string_view text, std::size_t begin)
{
  if (name.empty() || text.compare(begin, name.size(), name) != 0)
    return false;
  double number = 0.0;
  if (parseNumber(name, number))
    return false;
  const std::size_t end = begin + name.size();
  if (name.find_first_of("+-*/^<>=!&|?,()[]\"") != std::string::npos)
    return isWholeOperand(text, begin, name.size());
  return end == text.size() || !continuesName(text[end]);
}

} // namespace

bool
continuesName(char c)
{
  return beginsName(c) || isDigit(c) || c == '.';
}

std::size_t
findNameEnd(std::string_view text, std::size_t begin)
{
  if (begin == text.size() || !beginsName(text[begin]))
    return begin;
  while (begin < text.size() && continuesName(text[begin]))
    ++begin;
  return begin;
}

std::size_t
findNumberEnd(std::string_view text, std::size_t begin)
{
  std::size_t end = findDigitsEnd(text, begin);
  std::size_t digits = end - begin;
  if (end < text.size() && text[end] == '.') {
    const std::size_t fraction = findDigitsEnd(text, end + 1);
    digits += fraction - end - 1;
    end = fraction;
  }
  if (digits == 0)
    return begin;
  if (end < text.size() && isOneOf(text[end], "eE")) {
    std::size_t exponent = end + 1;
    if (exponent < text.size() && isOneOf(text[exponent], "+-"))
      ++exponent;
    if (const std::size_t last = findDigitsEnd(text, exponent); last > exponent)
      end = last;
  }
  return end;
}

std::size_t
findFieldName(const Fields& fields, std::string_view text, std::size_t begin)
{
  std::size_t longest = 0;
  for (const auto& field : fields)
    if (field.name.size() > longest && !isPadding(field) &&
        isThere(field.name, text, begin))
      longest = field.name.size();
  return longest;
}

Operand
makeFieldOperand(const Fields& fields,
                 const std::array<double, 3>& origin,
                 const std::string& name)
{
  Operand operand;
  operand.components = findComponents(fields, name);
  operand.addends.resize(operand.components.size());
  if (const int axis = axisOf(name); axis >= 0 && operand.components.size() == 1) {
    operand.addends[0] = origin[static_cast<std::size_t>(axis)];
    operand.is_coordinate = true;
  }
  return operand;
}

std::string
withoutQuotes(const Fields& fields, const std::string& expression)
{
  const std::string_view text = trimmed(expression);
  const std::size_t end = text.empty() ? 0 : text.find('"', 1);
  if (text.empty() || text[0] != '"' || end == std::string_view::npos)
    return expression;
  const std::string name(text.substr(1, end - 1));
  const std::string_view behind = trimmed(text.substr(end + 1));
  const bool is_component =
      !behind.empty() && behind.front() == '[' && behind.find(']') + 1 == behind.size();
  return !findComponents(fields, name).empty() && (behind.empty() || is_component)
             ? name + std::string(behind)
             : expression;
}

std::optional<Derivative>
findDerivative(const std::string& name)
{
  for (const auto& [word, derivative] : derivatives)
    if (name == word)
      return derivative;
  return std::nullopt;
}

namespace {

/** Data of cells, among which a name may be: then it is told first. */
std::string
describeCellFields(std::vector<std::string> names, const std::string& name)
{
  std::stable_partition(names.begin(), names.end(), [&](const std::string& other) {
    return other == name;
  });
  constexpr std::size_t most_shown = 8;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most_shown); ++i)
    list += (i > 0 ? ", " : "") + shortenText(names[i]);
  if (names.size() > most_shown)
    list += ", ...";
  return list;
}

} // namespace

std::vector<MessageValue>
valuesOfUnknown(const Dataset& header, const std::string& name)
{
  const Fields& fields = header.cloud.fields;
  std::vector<std::string> names;
  for (const auto& field : fields)
    if (!isPadding(field))
      names.push_back(field.name);
  const std::string similar = findSimilar(names, name);
  return {{"field", shortenText(name)},
          {"has_similar", !similar.empty()},
          {"similar", shortenText(similar)},
          {"fields", describeFields(fields)},
          {"has_cell_fields", !header.cell_fields.empty()},
          {"cell_fields", describeCellFields(header.cell_fields, name)}};
}

std::vector<MessageValue>
valuesOfUnknownFunction(const std::string& name)
{
  std::vector<std::string> names = listFunctions();
  for (const auto& derivative : derivatives)
    names.emplace_back(derivative.first);
  const std::string similar = findSimilar(names, name);
  std::string list;
  for (const std::string& known : names)
    list += (list.empty() ? "" : ", ") + known;
  return {{"function", shortenText(name)},
          {"has_similar", !similar.empty()},
          {"similar", similar},
          {"functions", list}};
}

} // namespace pcl_uvol
