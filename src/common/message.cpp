// SPDX-License-Identifier: BSD-3-Clause
#include "common/message_texts.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/message.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <ostream>
#include <sstream>
#include <string_view>
#include <tuple>

namespace pcl_uvol {

namespace {

/** Whole numbers up to this stand in a text with all of their digits. */
constexpr double most_whole = 9007199254740992.0;

std::string
numberWords(double number, int digits)
{
  std::ostringstream out;
  if (digits == 0 && std::abs(number) <= most_whole && number == std::trunc(number))
    out << static_cast<long long>(number);
  else {
    out.precision(digits > 0 ? digits : 6);
    out << number;
  }
  return out.str();
}

/** Options of the tools that are no parameter of C++ and Python. */
constexpr std::string_view tools_only[] = {
    "-block", "-max-memory", "-no-shading", "-position", "-where"};

/** Options that VTK's filters have as properties. */
constexpr std::string_view with_property[] = {"-drop-bridged",
                                              "-extrapolate",
                                              "-field",
                                              "-fill-gaps",
                                              "-interpolation",
                                              "-max-error",
                                              "-model",
                                              "-mu",
                                              "-outside",
                                              "-scale",
                                              "-smooth"};

bool
hasParameter(std::string_view option, ParameterNames names)
{
  const auto is_in = [&](const auto& list) {
    return std::find(std::begin(list), std::end(list), option) != std::end(list);
  };
  return names == ParameterNames::Members ? !is_in(tools_only) : is_in(with_property);
}

/** "-max-error" or "-mu 0.1" as the front end writes it; an option of the tools where
 * it has no such parameter. */
std::string
parameterWords(std::string_view option, ParameterNames names)
{
  if (names == ParameterNames::Options)
    return std::string(option);
  const std::size_t end = std::min(option.find(' '), option.size());
  if (!hasParameter(option.substr(0, end), names))
    return std::string(option) + " (tools)";
  if (option == "-viewpoint")
    return "view_point";
  std::istringstream parts{std::string(option.substr(1, end - 1))};
  std::string words;
  for (std::string word; std::getline(parts, word, '-');)
    if (names == ParameterNames::Members)
      words += (words.empty() ? "" : "_") + word;
    else if (word == "max")
      words += "Maximum"; // as VTK has it
    else {
      word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
      words += word;
    }
  if (end < option.size())
    words.append("=").append(option.substr(end + 1));
  return words;
}

/** Fills the values into one text. */
class TextWriter {
public:
  TextWriter(const Message& message, ParameterNames names)
      : message_(message)
      , names_(names)
  {
  }

  std::string
  fill(std::string_view text) const
  {
    std::string filled;
    for (std::size_t i = 0; i < text.size();) {
      const std::size_t open = std::min(text.find('{', i), text.size());
      filled.append(text.substr(i, open - i));
      if (open == text.size())
        break;
      const std::size_t close = findEnd(text, open + 1, '}');
      filled += replace(text.substr(open + 1, close - open - 1));
      i = close + 1;
    }
    return filled;
  }

private:
  /** The place of a letter that is in no further braces, or the end. */
  static std::size_t
  findEnd(std::string_view text, std::size_t from, char letter)
  {
    int depth = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
      if (depth == 0 && text[i] == letter)
        return i;
      depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
    }
    return text.size();
  }

  std::string
  replace(std::string_view braces) const
  {
    if (braces[0] == '-')
      return fill(parameterWords(braces, names_));
    const std::size_t name_end = std::min(braces.find_first_of(":|"), braces.size());
    const auto& value = valueOf(braces.substr(0, name_end));
    const std::string_view rest = braces.substr(name_end);
    if (!rest.empty() && rest[0] == '|') {
      const std::size_t middle = findEnd(rest, 1, '|');
      const auto* number = std::get_if<double>(&value);
      return fill(number != nullptr && *number == 1.0
                      ? rest.substr(1, middle - 1)
                      : rest.substr(std::min(middle + 1, rest.size())));
    }
    if (const auto* word = std::get_if<std::string>(&value))
      return *word;
    return numberWords(std::get<double>(value),
                       rest.empty() ? 0 : std::stoi(std::string(rest.substr(1))));
  }

  const std::variant<double, std::string>&
  valueOf(std::string_view name) const
  {
    for (const MessageValue& value : message_.values)
      if (value.name == name)
        return value.value;
    throw InvalidArgument("message_without_value",
                          {{"message", message_.code}, {"value", std::string(name)}});
  }

  const Message& message_;
  ParameterNames names_;
};

} // namespace

Message::Message(std::string row, std::vector<MessageValue> held)
    : code(std::move(row))
    , values(std::move(held))
{
}

Message::Message(std::string sentences)
    : Message("text", {{"text", std::move(sentences)}})
{
}

std::string
Message::text(ParameterNames names) const
{
  const std::string filled =
      TextWriter(*this, names).fill(detail::findMessageText(code).text);
  return about.empty() ? filled : about + ": " + filled;
}

Exception::Exception(Message message)
    : Exception(message, message.text())
{
}

Exception::Exception(Message message, const std::string& text)
    : pcl::PCLException(text)
    , message_(std::move(message))
    , text_(text)
{
}

bool
operator==(const Message& a, const Message& b)
{
  return a.code == b.code && a.about == b.about &&
         std::equal(a.values.begin(),
                    a.values.end(),
                    b.values.begin(),
                    b.values.end(),
                    [](const MessageValue& x, const MessageValue& y) {
                      return std::tie(x.name, x.value) == std::tie(y.name, y.value);
                    });
}

std::ostream&
operator<<(std::ostream& out, const Message& message)
{
  return out << message.text();
}

} // namespace pcl_uvol
