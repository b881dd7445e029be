// SPDX-License-Identifier: BSD-3-Clause
#include "shared/size_option.h"

#include "common/printable.h"
#include <pcl_uvol/render/renderer.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace uvol_tools {

namespace {

/** "640x480", or one number for a square. */
template <typename Number>
bool
parsePair(std::string_view text, Number& width, Number& height)
{
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  if (first.ec != std::errc())
    return false;
  height = width;
  if (first.ptr == end)
    return true;
  if (*first.ptr != 'x')
    return false;
  const auto second = std::from_chars(first.ptr + 1, end, height);
  return second.ec == std::errc() && second.ptr == end;
}

/** How many of the unit at the end of a size are an inch, and the unit taken off; 0 for
 * pixels. */
double
takeUnit(std::string_view& size)
{
  constexpr std::pair<std::string_view, double> units[] = {
      {"mm", 25.4}, {"cm", 2.54}, {"in", 1.0}};
  for (const auto& [unit, per_inch] : units)
    if (size.size() > unit.size() && size.substr(size.size() - unit.size()) == unit) {
      size.remove_suffix(unit.size());
      return per_inch;
    }
  return 0.0;
}

/** Pixels of a length, as far as they can be counted. */
int
countPixels(double inches, double dots_per_inch)
{
  constexpr double most = 1e6;
  return static_cast<int>(
      std::lround(std::min(std::max(0.0, inches * dots_per_inch), most)));
}

std::string
withDefault(const std::string& help, const std::string& usual)
{
  return usual.empty() ? help : help + " (default " + usual + ")";
}

} // namespace

void
SizeOption::declarePixels(Options& options)
{
  options.text(name_, "WxH", text_, withDefault("pixels of the window", text_));
}

Options&
SizeOption::declareSize(Options& options)
{
  takes_lengths_ = true;
  return options.text(
      name_,
      "WxH",
      text_,
      withDefault("pixels of the image, or lengths such as 85x60mm", text_));
}

void
SizeOption::declareDpi(Options& options)
{
  options
      .number("dpi",
              paper_.dots_per_inch,
              1.0,
              1e5,
              "resolution for print in dots per inch, with text of at least 7 points "
              "(default 300 where -" +
                  name_ + " has a unit)")
      .rare();
}

void
SizeOption::declareChart(Options& options)
{
  declareSize(options).rare();
  declareDpi(options);
}

bool
SizeOption::read()
{
  constexpr double usual = 300.0;
  std::string_view size = text_;
  const double per_inch = takes_lengths_ ? takeUnit(size) : 0.0;
  if (per_inch == 0.0)
    return parsePair(size, paper_.width, paper_.height);
  if (paper_.dots_per_inch == 0.0)
    paper_.dots_per_inch = usual;
  double width = 0.0, height = 0.0;
  if (!parsePair(size, width, height))
    return false;
  paper_.width = countPixels(width / per_inch, paper_.dots_per_inch);
  paper_.height = countPixels(height / per_inch, paper_.dots_per_inch);
  return true;
}

void
SizeOption::parse()
{
  if (text_.empty() || read())
    return;
  const std::string lengths =
      takes_lengths_ ? ", or in mm, cm or in, as in 85x60mm" : "";
  throw UsageError("-" + name_ + " is WxH in pixels, as in 1024x768" + lengths +
                   ", not " + pcl_uvol::quoteText(text_) + ".");
}

void
SizeOption::checkChart(const Options& options,
                       const std::string& asked_by,
                       bool is_asked_for)
{
  const auto asked =
      options.given(name_) ? name_ : std::string(options.given("dpi") ? "dpi" : "");
  if (!asked.empty() && !is_asked_for)
    throw UsageError("-" + asked + " needs -" + asked_by + ".");
  parse();
  constexpr int least = 128, most = pcl_uvol::Renderer::largest_size;
  if (options.given(name_) && (std::min(paper_.width, paper_.height) < least ||
                               std::max(paper_.width, paper_.height) > most))
    throw UsageError("-" + name_ + " is from " + std::to_string(least) + "x" +
                     std::to_string(least) + " to " + std::to_string(most) + "x" +
                     std::to_string(most) + " pixels, not " +
                     std::to_string(paper_.width) + " x " +
                     std::to_string(paper_.height) + ".");
}

} // namespace uvol_tools
