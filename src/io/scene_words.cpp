// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_words.h"

#include "common/numbers.h"
#include "common/printable.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol {
namespace io {
namespace {

/** Characters of a line: names of files are the longest words there are. */
constexpr std::size_t longest_line = 10000;

/** Coordinates and colours are float in the end, and are added up. */
constexpr double largest_number = 1e30;

/** Squares of shorter vectors vanish. */
constexpr double shortest_direction = 1e-100;

} // namespace

std::string
ScenePlace::text() const
{
  return printable(file) + ":" + std::to_string(line) + ":" + std::to_string(column);
}

void
throwAt(const ScenePlace& place, const FileReason& reason)
{
  Message message = reason.message;
  if (message.about.empty()) { // it is of no other file
    message.values.emplace_back("path", printable(place.file));
    message.values.emplace_back("line", place.line);
    message.values.emplace_back("column", place.column);
    message.about = place.text();
  }
  else
    message.about = place.text() + ": " + message.about;
  throw IOError(std::move(message));
}

std::string
cutName(const char* form)
{
  const std::string text = form;
  return text.substr(0, text.find(' '));
}

std::string
joinWords(const std::vector<std::string>& words)
{
  std::string list;
  for (const std::string& word : words)
    list += (list.empty() ? "" : ", ") + word;
  return list;
}

SceneItem::SceneItem(const ScenePlace& start, std::string_view line)
    : start_(start)
{
  if (line.size() > longest_line)
    throwAt(start, {"too_many_parts", "this line", longest_line, "characters"});
  split(line);
}

void
SceneItem::split(std::string_view line)
{
  std::size_t at = 0;
  while ((at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos &&
         line[at] != '#') {
    const std::size_t start = at;
    if (line[at] == '"') {
      const std::size_t quote = line.find('"', start + 1);
      if (quote == std::string_view::npos)
        throwAt(placeOf(start + 1), "open_quote");
      words_.push_back(
          {std::string(line.substr(start + 1, quote - start - 1)), start + 1});
      at = quote + 1;
      if (at < line.size() && line.find_first_of(" \t\r#", at) != at)
        throwAt(placeOf(at + 1), "text_behind_quote");
    }
    else {
      at = std::min(line.find_first_of(" \t\r#", at), line.size());
      words_.push_back({std::string(line.substr(start, at - start)), start + 1});
    }
    end_ = at + 1;
  }
}

ScenePlace
SceneItem::place() const
{
  return placeOf(taken_ > 0 ? words_[taken_ - 1].column : start_.column);
}

const std::string&
SceneItem::word(const std::string& what)
{
  if (atEnd())
    throwAt(placeOf(end_), {"missing_word", what, form_});
  const std::string& text = words_[taken_++].text;
  if (text.empty())
    fail({"missing_word", what, form_});
  return text;
}

bool
SceneItem::takeIf(const char* word)
{
  if (atEnd() || words_[taken_].text != word)
    return false;
  ++taken_;
  return true;
}

double
SceneItem::number(const NumberRange& range)
{
  const std::string& text = word(range.text);
  double value = 0.0;
  const bool is_number = parseNumber(text, value) && std::isfinite(value);
  const bool is_inside = range.has_ends ? value >= range.low && value <= range.high
                                        : value > range.low && value < range.high;
  if (!is_number || !is_inside)
    fail({"unexpected_word",
          shortenText(text),
          std::string(range.text) + "; write '" + form_ + "'"});
  if (std::abs(value) > largest_number)
    fail({"unexpected_word",
          shortenText(text),
          "a number within 1e30, the largest of a scene"});
  return value;
}

int
SceneItem::whole(int low, int high)
{
  const std::string what =
      "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  const std::string& text = word(what);
  std::uint64_t value = 0;
  if (!parseCount(text, value) || value < static_cast<std::uint64_t>(low) ||
      value > static_cast<std::uint64_t>(high))
    fail({"unexpected_word", shortenText(text), what + "; write '" + form_ + "'"});
  return static_cast<int>(value);
}

Eigen::Vector3d
SceneItem::point()
{
  Eigen::Vector3d point;
  for (int axis = 0; axis < 3; ++axis)
    point[axis] = number(any_number);
  return point;
}

Eigen::Vector3d
SceneItem::direction()
{
  const std::size_t first = taken_;
  Eigen::Vector3d direction = point();
  if (direction.norm() < shortest_direction)
    throwAt(
        placeOf(words_[first].column),
        {"incomplete_entry", "a direction", "a length above 0; write '" + form_ + "'"});
  return direction;
}

Color
SceneItem::color()
{
  Color color;
  for (float* const channel : {&color.r, &color.g, &color.b})
    *channel = static_cast<float>(number(not_negative));
  return color;
}

void
SceneItem::options(const std::vector<Option>& known,
                   const std::vector<std::pair<const char*, const char*>>& exclusive)
{
  const std::string item = words_.front().text;
  while (!atEnd()) {
    const std::string name = words_[taken_++].text;
    const auto option = std::find_if(known.begin(), known.end(), [&](const Option& o) {
      return cutName(o.form) == name;
    });
    if (option == known.end()) {
      std::vector<std::string> forms;
      forms.reserve(known.size());
      for (const Option& other : known)
        forms.push_back(other.form);
      fail({"unknown_word", shortenText(name), "options of " + item, joinWords(forms)});
    }
    if (hasOption(name))
      fail({"repeated_part", "'" + name + "'"});
    for (const auto& [one, other] : exclusive)
      if ((name == one && hasOption(other)) || (name == other && hasOption(one)))
        fail({"exclusive_words", one, other});
    option_names_.push_back(name);
    form_ = option->form;
    option->take();
  }
}

bool
SceneItem::hasOption(const std::string& name) const
{
  return std::find(option_names_.begin(), option_names_.end(), name) !=
         option_names_.end();
}

void
SceneItem::finish()
{
  if (atEnd())
    return;
  const std::string& text = words_[taken_++].text;
  fail({"unexpected_word", shortenText(text), "expected here; write '" + form_ + "'"});
}

} // namespace io
} // namespace pcl_uvol
