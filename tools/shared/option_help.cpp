// SPDX-License-Identifier: BSD-3-Clause
// What -h prints: options below the headings of their groups, in lines of a screen.
#include "common/numbers.h"
#include "common/printable.h"
#include "shared/options.h"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace uvol_tools {

namespace {

constexpr std::size_t help_column = 28, line_length = 100;

/** A longer help leaves out what is rare: nobody reads two screens for one option. */
constexpr std::ptrdiff_t longest_help = 60;

/** Words from a column on, in as many lines as they take.
 * \param column where the first word stands */
void
printWords(const std::string& text, std::size_t column, std::ostream& out)
{
  std::size_t used = column;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const bool fits = used + 1 + end - start <= line_length;
    if (start > 0)
      out << (fits ? " " : "\n" + std::string(help_column + 2, ' '));
    used = fits ? used + 1 + end - start : help_column + 2 + end - start;
    out << text.substr(start, end - start);
    start = end + 1;
  }
  out << '\n';
}

/** Help stands in its column, two blanks behind an option that reaches into it, and in
 * the next line behind one that leaves it no room. */
void
printEntry(const std::string& left, const std::string& help, std::ostream& out)
{
  if (left.size() > line_length / 2) {
    out << "  " << left << '\n' << std::string(help_column + 2, ' ');
    printWords(help, help_column + 2, out);
    return;
  }
  const std::size_t gap = left.size() < help_column ? help_column - left.size() : 2;
  out << "  " << left << std::string(gap, ' ');
  printWords(help, 2 + left.size() + gap, out);
}

/** A title as a word of the command line. */
std::string
topicOf(const std::string& title)
{
  const std::string topic = pcl_uvol::lowerCase(title);
  return topic.find(' ') == std::string::npos ? topic : "'" + topic + "'";
}

} // namespace

std::size_t
Options::countOptions(std::size_t group, bool with_rare) const
{
  return static_cast<std::size_t>(
      std::count_if(options_.begin(), options_.end(), [&](const Option& option) {
        return option.group == group && (with_rare || !option.is_rare);
      }));
}

std::string
Options::listHeadings() const
{
  std::string headings;
  for (std::size_t group = 0; group < groups_.size(); ++group)
    if (countOptions(group, true) > 0)
      headings += ", '" + groups_[group].title + "'";
  return headings;
}

void
Options::printGroup(std::size_t group, bool with_rare, std::ostream& out) const
{
  const std::size_t shown = countOptions(group, with_rare);
  const std::size_t others = countOptions(group, true) - shown;
  if (shown == 0)
    return;
  out << '\n' << groups_[group].title;
  if (others > 0)
    out << " (" << others << " more: -h " << topicOf(groups_[group].title) << ')';
  out << ":\n";
  for (const Option& option : options_)
    if (option.group == group && (with_rare || !option.is_rare))
      printEntry("-" + option.name +
                     (option.placeholder.empty() ? "" : " " + option.placeholder),
                 option.help,
                 out);
}

std::string
Options::explainHelp(bool with_rare) const
{
  std::string headings;
  for (std::size_t group = 0; group < groups_.size(); ++group)
    if (countOptions(group, with_rare) == 0 && countOptions(group, true) > 0)
      headings += (headings.empty() ? "" : ", ") + groups_[group].title;
  return "print this, all options, or those below a heading" +
         (headings.empty() ? "" : "; further headings: " + headings);
}

std::string
Options::writeHelp(bool with_rare) const
{
  std::ostringstream out;
  out << purpose_ << "\n\nUsage: " << tool_ << ' ' << synopsis_ << '\n';
  for (std::size_t group = 1; group < groups_.size(); ++group)
    printGroup(group, with_rare, out);
  printGroup(0, with_rare, out);
  printEntry("-h [all|HEADING]", explainHelp(with_rare), out);
  printEntry("-version", "print the version", out);
  return out.str();
}

void
Options::printHelp(const std::string& topic) const
{
  const std::string wanted = pcl_uvol::lowerCase(topic);
  for (std::size_t group = 0; group < groups_.size(); ++group)
    if (pcl_uvol::lowerCase(groups_[group].title) == wanted &&
        countOptions(group, true) > 0) {
      printGroup(group, true, std::cout);
      return;
    }
  if (!wanted.empty() && wanted != "all")
    throw UsageError("-h has no heading " + pcl_uvol::quoteText(topic) +
                     "; it takes all" + listHeadings() + ".");
  const std::string all = writeHelp(true);
  const bool is_short = std::count(all.begin(), all.end(), '\n') <= longest_help;
  std::cout << (wanted == "all" || is_short ? all : writeHelp(false));
}

} // namespace uvol_tools
