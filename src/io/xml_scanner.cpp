// SPDX-License-Identifier: BSD-3-Clause
#include "io/xml_scanner.h"

#include "common/printable.h"

#include <charconv>

namespace pcl_uvol {
namespace io {
namespace {

/** VTK's files need 7. */
constexpr std::size_t most_depth = 100;
/** The longest tags of VTK have some hundred bytes. */
constexpr std::size_t most_tag_bytes = std::size_t(1) << 16;

bool
isBlank(char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/** A character as UTF-8. */
void
appendCharacter(std::string& text, std::uint32_t code)
{
  const auto put = [&text](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80)
    return put(code);
  if (code < 0x800)
    put(0xc0 | code >> 6);
  else {
    if (code < 0x10000)
      put(0xe0 | code >> 12);
    else {
      put(0xf0 | code >> 18);
      put(0x80 | (code >> 12 & 0x3f));
    }
    put(0x80 | (code >> 6 & 0x3f));
  }
  put(0x80 | (code & 0x3f));
}

} // namespace

const std::string*
XmlTag::find(std::string_view attribute) const
{
  for (const auto& [key, value] : attributes)
    if (key == attribute)
      return &value;
  return nullptr;
}

void
XmlScanner::fail(const FileReason& reason) const
{
  throwUnreadable(path_, cursor_.tell().line + 1, reason);
}

/** Replaces &amp; and its like. */
std::string
XmlScanner::decoded(std::string_view text) const
{
  constexpr struct {
    std::string_view name;
    char character;
  } entities[] = {
      {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '&') {
      result += text[at];
      continue;
    }
    const std::size_t end = text.find(';', at);
    const std::string_view name = text.substr(at + 1, end - at - 1);
    bool known = false;
    for (const auto& entity : entities)
      if (name == entity.name) {
        result += entity.character;
        known = true;
      }
    if (name.size() > 1 && name[0] == '#') {
      const bool hex = name[1] == 'x';
      std::uint32_t code = 0;
      const char* const last = name.data() + name.size();
      const auto parsed =
          std::from_chars(name.data() + (hex ? 2 : 1), last, code, hex ? 16 : 10);
      known = parsed.ec == std::errc() && parsed.ptr == last && code < 0x110000;
      if (known)
        appendCharacter(result, code);
    }
    if (!known || end == text.npos)
      fail({"unexpected_word", shortenText(text.substr(at, 10)), "a character of XML"});
    at = end;
  }
  return result;
}

/** What stands between < and >. */
std::string_view
XmlScanner::takeTag()
{
  tag_.clear();
  char quote = 0;
  while (true) {
    const char* const c = cursor_.take(1);
    if (!c)
      fail({"truncated_part", "a tag"});
    const bool comment = tag_.compare(0, 3, "!--") == 0;
    const bool ended = !comment || (tag_.size() == 5 && tag_.compare(3, 2, "--") == 0);
    if (*c == '>' && quote == 0 && ended)
      return tag_;
    if (comment) {
      if (tag_.size() == 5) // of a comment its end counts
        tag_.erase(3, 1);
    }
    else if (tag_.size() == most_tag_bytes)
      fail({"too_many_parts", "a tag", most_tag_bytes, "bytes"});
    else if (quote == 0 && (*c == '"' || *c == '\''))
      quote = *c;
    else if (*c == quote)
      quote = 0;
    tag_ += *c;
  }
}

void
XmlScanner::parse(std::string_view text, XmlTag& tag) const
{
  tag.attributes.clear();
  tag.closes = text.substr(0, 1) == "/";
  tag.empty = !text.empty() && text.back() == '/';
  text = text.substr(tag.closes ? 1 : 0);
  text.remove_suffix(tag.empty && !text.empty() ? 1 : 0);
  std::size_t at = 0;
  const auto skip = [&](auto&& condition) {
    const std::size_t start = at;
    while (at < text.size() && condition(text[at]))
      ++at;
    return text.substr(start, at - start);
  };
  const auto is_name = [](char c) { return !isBlank(c) && c != '='; };
  tag.name = skip(is_name);
  while (!skip(isBlank).empty() && at < text.size()) {
    const std::string_view key = skip(is_name);
    skip(isBlank);
    if (text.substr(at++, 1) != "=" || key.empty())
      fail({"incomplete_entry",
            "an attribute of the tag " + quoteText(tag.name),
            "a value"});
    skip(isBlank);
    const char quote = at < text.size() ? text[at] : '\0';
    const std::size_t end = text.find(quote, at + 1);
    if ((quote != '"' && quote != '\'') || end == text.npos)
      fail({"incomplete_entry", "a value of the tag " + quoteText(tag.name), "quotes"});
    tag.attributes.emplace_back(key, decoded(text.substr(at + 1, end - at - 1)));
    at = end + 1;
  }
  if (tag.name.empty() || at < text.size())
    fail({"unexpected_word", shortenText(text), "a tag of XML"});
}

void
XmlScanner::nest(const XmlTag& tag)
{
  if (tag.closes) {
    if (open_.empty() || open_.back() != tag.name)
      fail({"unexpected_word", shortenText(tag.name), "the end of an open tag"});
    open_.pop_back();
  }
  else if (!tag.empty) {
    if (open_.size() == most_depth)
      fail({"too_many_parts", "the nesting of its elements", most_depth, "levels"});
    open_.push_back(tag.name);
  }
}

bool
XmlScanner::next(XmlTag& tag)
{
  cursor_.skipBlanks();
  tag.text = cursor_.tell().offset;
  while (cursor_.skipTo('<')) {
    tag.begin = cursor_.tell().offset;
    cursor_.take(1);
    const std::string_view text = takeTag();
    if (!text.empty() && (text[0] == '?' || text.substr(0, 3) == "!--"))
      continue;
    parse(text, tag);
    nest(tag);
    tag.end = cursor_.tell().offset;
    return true;
  }
  return false;
}

} // namespace io
} // namespace pcl_uvol
