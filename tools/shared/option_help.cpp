// SPDX-License-Identifier: BSD-3-Clause
// What -h prints: options below the headings of their groups, in lines of a screen.
#include "common/numbers.h"
#include "shared/options.h"

#include <algorithm>
#include <iostream>

namespace uvol_tools {

namespace {

constexpr std::size_t help_column = 28, line_length = 100;

/** Words from a column on, in as many lines as they take.
 * \param column where the first word stands */
void
printWords(const std::string& text, std::size_t column)
{
  std::size_t used = column;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const bool fits = used + 1 + end - start <= line_length;
    if (start > 0)
      std::cout << (fits ? " " : "\n" + std::string(help_column + 2, ' '));
    used = fits ? used + 1 + end - start : help_column + 2 + end - start;
    std::cout << text.substr(start, end - start);
    start = end + 1;
  }
  std::cout << '\n';
}

/** Help stands in its column, two blanks behind an option that reaches into it, and in
 * the next line behind one that leaves it no room. */
void
printEntry(const std::string& left, const std::string& help)
{
  if (left.size() > line_length / 2) {
    std::cout << "  " << left << '\n' << std::string(help_column + 2, ' ');
    printWords(help, help_column + 2);
    return;
  }
  const std::size_t gap = left.size() < help_column ? help_column - left.size() : 2;
  std::cout << "  " << left << std::string(gap, ' ');
  printWords(help, 2 + left.size() + gap);
}

} // namespace

bool
Options::hasOptions(std::size_t group) const
{
  return std::any_of(options_.begin(), options_.end(), [&](const Option& option) {
    return option.group == group;
  });
}

std::string
Options::listHeadings() const
{
  std::string headings;
  for (std::size_t group = 0; group < groups_.size(); ++group)
    if (hasOptions(group))
      headings += ", '" + groups_[group].title + "'";
  return headings;
}

void
Options::printGroup(std::size_t group) const
{
  if (!hasOptions(group))
    return;
  std::cout << '\n' << groups_[group].title << ":\n";
  for (const Option& option : options_)
    if (option.group == group)
      printEntry("-" + option.name +
                     (option.placeholder.empty() ? "" : " " + option.placeholder),
                 option.help);
}

void
Options::nameRareOptions() const
{
  std::cout << "\nFurther options, which -h all explains:\n";
  for (std::size_t group = 1; group < groups_.size(); ++group) {
    std::string names;
    for (const Option& option : options_)
      if (option.group == group)
        names += (names.empty() ? "-" : " -") + option.name;
    if (groups_[group].is_rare)
      printEntry(groups_[group].title, names);
  }
}

void
Options::printHelp(const std::string& topic) const
{
  const std::string wanted = pcl_uvol::lowerCase(topic);
  for (std::size_t group = 0; group < groups_.size(); ++group)
    if (pcl_uvol::lowerCase(groups_[group].title) == wanted && hasOptions(group)) {
      printGroup(group);
      return;
    }
  if (!wanted.empty() && wanted != "all")
    throw UsageError("-h has no heading '" + topic + "'; it takes all" +
                     listHeadings() + ".");
  std::cout << purpose_ << "\n\nUsage: " << tool_ << ' ' << synopsis_ << '\n';
  bool leaves_out = false;
  for (std::size_t group = 1; group < groups_.size(); ++group) {
    const bool is_left_out = groups_[group].is_rare && wanted != "all";
    leaves_out |= is_left_out;
    if (!is_left_out)
      printGroup(group);
  }
  printGroup(0);
  printEntry("-h [all|HEADING]", "print this, all options, or those below a heading");
  printEntry("-version", "print the version");
  if (leaves_out)
    nameRareOptions();
}

} // namespace uvol_tools
