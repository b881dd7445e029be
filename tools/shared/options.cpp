// SPDX-License-Identifier: BSD-3-Clause
// Parsing of one-dash options against a tool's table.
#include "shared/options.h"

#include "common/printable.h"
#include "common/similar_words.h"
#include "io/unpacked_file.h"
#include "shared/number_list.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>

namespace uvol_tools {

namespace {

std::optional<std::vector<std::string>> expected_outputs; // of a series
std::string named_file, named_output; // a tool has one command line at a time
bool is_json_asked_for = false;

/** True for a value that may start with a minus sign: -0.5, -1,0,2 or -1:0.5:1. */
bool
startsWithNumber(const std::string& text)
{
  double ignored;
  const std::string first = text.substr(0, text.find_first_of(",:"));
  return parseWhole(first, ignored);
}

bool
isOption(const std::string& argument)
{
  // "-.csv" is standard output.
  return argument.size() > 1 && argument[0] == '-' && argument[1] != '.' &&
         !startsWithNumber(argument);
}

/** The command line with one dash where it has two, and --name=value as two words. */
std::vector<std::string>
splitValues(int argc, const char* const* argv)
{
  std::vector<std::string> words;
  for (std::string word : std::vector<std::string>(argv + 1, argv + argc)) {
    const bool is_long = word.size() > 2 && word.compare(0, 2, "--") == 0 &&
                         std::isalpha(static_cast<unsigned char>(word[2]));
    const std::size_t end = is_long ? word.find('=') : std::string::npos;
    words.push_back(is_long ? word.substr(1, end - 1) : word);
    if (end != std::string::npos)
      words.push_back(word.substr(end + 1));
  }
  return words;
}

std::string
joined(const std::vector<std::string>& words, const char* separator)
{
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? "" : separator) + word;
  return text;
}

std::string
shortest(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

std::uint64_t
parseWholeIn(const std::string& name,
             const std::string& value,
             std::uint64_t minimum,
             std::uint64_t maximum)
{
  std::uint64_t number = 0;
  if (!parseWhole(value, number) || number < minimum || number > maximum)
    throw UsageError("-" + name + " is a whole number from " + std::to_string(minimum) +
                     " to " + std::to_string(maximum) + ", not " +
                     pcl_uvol::quoteText(value) + ".");
  return number;
}

} // namespace

std::vector<std::string>
parseNames(const std::string& option, const std::string& value)
{
  if (value.empty())
    return {};
  std::vector<std::string> names(1);
  bool is_in_bars = false, is_quoted = false;
  int depth = 0;
  for (const char c : value) {
    is_quoted ^= c == '"';
    is_in_bars ^= c == '|' && !is_quoted;
    if (!is_quoted)
      depth += (c == '(') - (c == ')');
    if (c == ',' && !is_in_bars && !is_quoted && depth <= 0)
      names.emplace_back();
    else
      names.back() += c;
  }
  if (std::find(names.begin(), names.end(), "") != names.end())
    throw UsageError("-" + option + " has an empty name in " + value + ".");
  return names;
}

Options::Options(std::string tool, std::string synopsis, std::string purpose)
    : tool_(std::move(tool))
    , synopsis_(std::move(synopsis))
    , purpose_(std::move(purpose))
{
  integer("threads", threads_, 0, 4096, "number of threads, 0 for all cores");
  flag("v", verbose_, "list all counts and the time of every step");
  flag("json", json_, "print the report as one JSON object");
  group("Options");
}

void
Options::group(const std::string& title, bool is_rare)
{
  const auto known = std::find_if(
      groups_.begin(), groups_.end(), [&](const Group& g) { return g.title == title; });
  current_group_ = static_cast<std::size_t>(known - groups_.begin());
  if (known == groups_.end())
    groups_.push_back({title, is_rare});
}

Options&
Options::add(Option option)
{
  if (std::any_of(options_.begin(), options_.end(), [&](const Option& known) {
        return known.name == option.name;
      }))
    throw std::logic_error("The option -" + option.name + " is declared twice.");
  option.group = current_group_;
  option.is_rare = groups_[current_group_].is_rare;
  options_.push_back(std::move(option));
  return *this;
}

void
Options::file(const std::string& name, std::string& target, bool required)
{
  positionals_.push_back({name, &target, required});
}

void
Options::files(const std::string& name, std::vector<std::string>& targets)
{
  positionals_.push_back({name, nullptr, true, &targets});
}

Options&
Options::flag(const std::string& name,
              bool& target,
              const std::string& help,
              bool value)
{
  return add({name, "", help, {}, &target, value});
}

Options&
Options::text(const std::string& name,
              const std::string& placeholder,
              std::string& target,
              const std::string& help)
{
  return add({name, placeholder, help, [&target](const std::string& value) {
                target = value;
              }});
}

Options&
Options::input(const std::string& name,
               const std::string& placeholder,
               std::string& target,
               const std::string& help)
{
  text(name, placeholder, target, help);
  options_.back().read = &target;
  return *this;
}

Options&
Options::output(const std::string& name,
                const std::string& placeholder,
                std::string& target,
                const std::string& help)
{
  text(name, placeholder, target, help);
  options_.back().written = &target;
  return *this;
}

Options&
Options::choice(const std::string& name,
                const std::vector<std::string>& words,
                std::string& target,
                const std::string& help)
{
  return choice(name, words, words, target, help, [&target](const std::string& word) {
    target = word;
  });
}

Options&
Options::choice(const std::string& name,
                const std::vector<std::string>& shown,
                const std::vector<std::string>& allowed,
                const std::string& default_word,
                const std::string& help,
                const std::function<void(const std::string&)>& assign)
{
  const auto check = [name, shown, allowed, assign](const std::string& value) {
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end())
      throw UsageError("-" + name + " is " + joined(shown, " or ") + ", not " +
                       pcl_uvol::quoteText(value) + ".");
    assign(value);
  };
  return add({name,
              joined(shown, "|"),
              default_word.empty() ? help : help + " (default " + default_word + ")",
              check});
}

namespace {

/** As in "-zoom is from 0 to 9"; the least and the largest double are no bounds. */
std::string
describeRange(double minimum, double maximum)
{
  using Limits = std::numeric_limits<double>;
  if (maximum < Limits::max())
    return "from " + shortest(minimum) + " to " + shortest(maximum);
  return minimum == Limits::min() ? "above 0" : "at least " + shortest(minimum);
}

} // namespace

Options&
Options::number(const std::string& name,
                double& target,
                double minimum,
                double maximum,
                const std::string& help)
{
  const auto assign = [name, minimum, maximum, &target](const std::string& value) {
    const double number = parseNumber(name, value);
    if (number < minimum || number > maximum)
      throw UsageError("-" + name + " is " + describeRange(minimum, maximum) +
                       ", not " + value + ".");
    target = number;
  };
  return add({name,
              "number",
              target >= minimum && std::isfinite(target)
                  ? help + " (default " + shortest(target) + ")"
                  : help,
              assign});
}

Options&
Options::automatic(const std::string& name,
                   std::optional<double>& target,
                   double low,
                   double high,
                   const std::string& help)
{
  const auto assign = [name, low, high, &target](const std::string& value) {
    target = parseAutomatic(name, value, low, high);
  };
  return add({name, "number|auto", help + " (default auto)", assign});
}

Options&
Options::integer(const std::string& name,
                 std::uint64_t& target,
                 std::uint64_t minimum,
                 std::uint64_t maximum,
                 const std::string& help)
{
  const auto assign = [name, minimum, maximum, &target](const std::string& value) {
    target = parseWholeIn(name, value, minimum, maximum);
  };
  return add(
      {name,
       "n",
       target >= minimum ? help + " (default " + std::to_string(target) + ")" : help,
       assign});
}

Options&
Options::integer(const std::string& name,
                 int& target,
                 int minimum,
                 int maximum,
                 const std::string& help)
{
  const auto assign = [name, minimum, maximum, &target](const std::string& value) {
    target = static_cast<int>(parseWholeIn(name,
                                           value,
                                           static_cast<std::uint64_t>(minimum),
                                           static_cast<std::uint64_t>(maximum)));
  };
  return add(
      {name,
       "n",
       target >= minimum ? help + " (default " + std::to_string(target) + ")" : help,
       assign});
}

Options&
Options::numbers(const std::string& name,
                 const std::string& placeholder,
                 std::size_t count,
                 std::vector<double>& target,
                 const std::string& help)
{
  const auto take = [&target](const std::vector<double>& read) { target = read; };
  return numbers(name, placeholder, count, take, help);
}

Options&
Options::numbers(const std::string& name,
                 const std::string& placeholder,
                 std::size_t count,
                 const std::function<void(const std::vector<double>&)>& take,
                 const std::string& help)
{
  const auto assign = [name, count, take](const std::string& value) {
    take(parseNumbers(name, value, count));
  };
  return add({name, placeholder, help, assign});
}

bool
Options::given(const std::string& name) const
{
  return std::any_of(options_.begin(), options_.end(), [&](const Option& option) {
    return option.name == name && option.given;
  });
}

std::string
Options::oneOf(const std::vector<std::string>& names) const
{
  std::string found, all;
  bool is_one = true;
  for (std::size_t i = 0; i < names.size(); ++i) {
    all += (i == 0 ? "-" : i + 1 < names.size() ? ", -" : " and -") + names[i];
    if (!given(names[i]))
      continue;
    is_one = found.empty();
    found = names[i];
  }
  if (!is_one)
    throw UsageError("Only one of " + all + " can be given.");
  return found;
}

Options&
Options::series(const std::string& name,
                const std::string& placeholder,
                const std::string& help)
{
  Option option; // without a target: it is taken before
  option.name = name;
  option.placeholder = placeholder;
  option.help = help;
  add(std::move(option));
  options_.back().group = 0; // "Run"
  return *this;
}

Options::Option&
Options::find(const std::string& argument)
{
  const std::string name = argument.substr(1);
  const auto found =
      std::find_if(options_.begin(), options_.end(), [&](const Option& option) {
        return option.name == name;
      });
  if (found != options_.end())
    return *found;
  std::vector<std::string> names;
  for (const Option& option : options_)
    names.push_back(option.name);
  const std::string nearest = pcl_uvol::findSimilar(names, name);
  throw UsageError("There is no option " + pcl_uvol::shortenText(argument) +
                   (nearest.empty() ? "." : "; did you mean -" + nearest + "?"));
}

void
Options::assignOption(const std::vector<std::string>& arguments, std::size_t& i)
{
  const std::string& argument = arguments[i];
  Option& option = find(argument);
  if (option.given)
    throw UsageError("The option " + argument + " was given twice.");
  option.given = true;
  if (option.flag != nullptr) {
    *option.flag = option.flag_value;
    return;
  }
  if (i + 1 == arguments.size() || isOption(arguments[i + 1]))
    throw UsageError("The option " + argument + " needs a value, '" +
                     option.placeholder + "'.");
  option.assign(arguments[++i]);
}

bool
Options::parse(int argc, const char* const* argv)
{
  noteJson(argc, argv);
  const std::vector<std::string> arguments = splitValues(argc, argv);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "-h" || argument == "-help") {
      const bool has_topic = i + 1 < arguments.size() && !isOption(arguments[i + 1]);
      printHelp(has_topic ? arguments[i + 1] : "");
      return false;
    }
    if (argument == "-version") {
      std::cout << tool_ << " of pcl_uvol " << PCL_UVOL_VERSION << '\n';
      return false;
    }
  }
  command_ = arguments;
  std::vector<std::string> files;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (isOption(argument))
      assignOption(arguments, i);
    else if (files.size() == positionals_.size() && !positionals_[0].targets)
      throw UsageError("The argument " + pcl_uvol::quoteText(argument) +
                       " is one too many.");
    else
      files.push_back(argument);
  }
  assignFiles(files);
  if (!files.empty())
    first_file_ = files.front();
  if (!files.empty() && files.size() <= positionals_.size() &&
      positionals_[files.size() - 1].name == "out")
    output_ = files.back();
  nameFiles();
  checkFiles(files);
  for (const Option& option : options_)
    if (option.given && option.check)
      option.check(option.read ? *option.read : *option.written);
  return true;
}

void
Options::nameFiles() const
{
  named_file = first_file_;
  named_output = output_;
}

void
Options::checkFiles(const std::vector<std::string>& files) const
{
  std::vector<std::string> inputs = files, outputs;
  const std::size_t last = std::min(files.size(), positionals_.size());
  if (last > 0 && positionals_[last - 1].name == "out") {
    if (pcl_uvol::io::isStandardStream(files.back()))
      std::cout.rdbuf(std::cerr.rdbuf()); // the report leaves the data alone
    else
      outputs.push_back(files.back());
    inputs.pop_back();
  }
  for (const Option& option : options_) {
    if (option.given && option.read)
      inputs.push_back(*option.read);
    if (option.given && option.written)
      outputs.push_back(*option.written);
  }
  checkDistinct(inputs, outputs);
  for (const std::string& output : outputs)
    if (!shares_outputs_ && isOfAll(output))
      throw UsageError("'" + output +
                       "' would be written anew by every file of the series: its name "
                       "needs a place for a number, as in out_{:04d}.vtp.");
}

void
Options::assignFiles(const std::vector<std::string>& files) const
{
  for (std::size_t i = files.size(); i < positionals_.size(); ++i)
    if (positionals_[i].required)
      throw UsageError("The argument <" + positionals_[i].name +
                       "> is missing: " + tool_ + " " + synopsis_);
  auto next = files.begin();
  for (std::size_t i = 0; i < positionals_.size() && next != files.end(); ++i)
    if (positionals_[i].targets != nullptr) {
      const auto last = files.end() - static_cast<int>(positionals_.size() - i - 1);
      positionals_[i].targets->assign(next, last);
      next = last;
    }
    else
      *positionals_[i].target = *next++;
}

void
noteJson(int argc, const char* const* argv)
{
  const std::vector<std::string> words = splitValues(argc, argv);
  is_json_asked_for = std::find(words.begin(), words.end(), "-json") != words.end();
}

bool
isJsonAskedFor()
{
  return is_json_asked_for;
}

const std::string&
namedFile()
{
  return named_file;
}

void
nameFile(const std::string& path)
{
  named_file = path;
}

void
expectOutputs(const std::vector<std::string>& names)
{
  expected_outputs = names;
}

bool
isOfAll(const std::string& output)
{
  return expected_outputs && !output.empty() &&
         std::find(expected_outputs->begin(), expected_outputs->end(), output) ==
             expected_outputs->end();
}

const std::string&
namedOutput()
{
  return named_output;
}

} // namespace uvol_tools
