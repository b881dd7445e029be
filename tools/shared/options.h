// SPDX-License-Identifier: BSD-3-Clause
// One table of options per tool, in PCL's manner (one dash, positional files), strict:
// an unknown option, a missing or malformed value and a leftover argument are errors.
#pragma once

#include "shared/facts.h"
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/io/image_file.h>

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace uvol_tools {

/** \brief A wrong command line: exit code 2. */
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief The options of a tool. Targets keep their value (the default) where the
 * option is absent. -h, -version, -threads and -json are in every table. */
class Options {
public:
  /** \param synopsis what stands behind the tool's name: "in.pcd out.ply [options]"
   * \param purpose one or two sentences for -h */
  Options(std::string tool, std::string synopsis, std::string purpose);

  /** \brief What is declared from here on stands below that heading in -h; headings of
   * the same title are one.
   * \param is_rare its options all are, see rare() */
  void
  group(const std::string& title, bool is_rare = false);

  /** \brief Positional arguments, in this order; optional ones last. The last one is
   * written if it is called "out", the others are read. */
  void
  file(const std::string& name, std::string& target, bool required = true);
  /** \brief One or more of them, before all others. */
  void
  files(const std::string& name, std::vector<std::string>& targets);

  /** \param value that the target gets where the option is given */
  Options&
  flag(const std::string& name,
       bool& target,
       const std::string& help,
       bool value = true);
  Options&
  text(const std::string& name,
       const std::string& placeholder,
       std::string& target,
       const std::string& help);
  /** \brief A file to be read. */
  Options&
  input(const std::string& name,
        const std::string& placeholder,
        std::string& target,
        const std::string& help);
  /** \brief A file to be written. */
  Options&
  output(const std::string& name,
         const std::string& placeholder,
         std::string& target,
         const std::string& help);
  /** \brief An option of series, see runSeries(), which takes it from the command line.
   */
  Options&
  series(const std::string& name,
         const std::string& placeholder,
         const std::string& help);
  /** \brief A series of files may write outputs together: those whose names are the
   * same for all of them, see isOfAll(). */
  void
  shareOutputs()
  {
    shares_outputs_ = true;
  }
  /** \brief One of several words. */
  Options&
  choice(const std::string& name,
         const std::vector<std::string>& words,
         std::string& target,
         const std::string& help);
  /** \brief One of the words of an enumeration, see EnumWord. */
  template <typename Enum>
  Options&
  choice(const std::string& name, Enum& target, const std::string& help)
  {
    std::vector<std::string> shown, all;
    for (const auto& [value, word] : listWords(Enum())) {
      all.emplace_back(word);
      if (word == std::string(toWord(value)))
        shown.emplace_back(word);
    }
    return choice(
        name, shown, all, toWord(target), help, [&target](const std::string& word) {
          fromWord(word, target);
        });
  }
  /** \brief A finite number in [minimum, maximum]; a default that cannot be
   * given is not shown. */
  Options&
  number(const std::string& name,
         double& target,
         double minimum,
         double maximum,
         const std::string& help);
  Options&
  integer(const std::string& name,
          std::uint64_t& target,
          std::uint64_t minimum,
          std::uint64_t maximum,
          const std::string& help);
  /** \brief The same for numbers from 0 that are of type int. */
  Options&
  integer(const std::string& name,
          int& target,
          int minimum,
          int maximum,
          const std::string& help);
  /** \brief Finite numbers joined by commas; count 0 takes one or more, and ranges, see
   * parseNumbers. */
  Options&
  numbers(const std::string& name,
          const std::string& placeholder,
          std::size_t count,
          std::vector<double>& target,
          const std::string& help);
  /** \param take gets the numbers, as often as the option is given */
  Options&
  numbers(const std::string& name,
          const std::string& placeholder,
          std::size_t count,
          const std::function<void(const std::vector<double>& numbers)>& take,
          const std::string& help);

  /** \brief A number from low to high, or the word auto for none. */
  Options&
  automatic(const std::string& name,
            std::optional<double>& target,
            double low,
            double high,
            const std::string& help);
  /** \brief Options for some members of a struct, named and explained as its list of
   * members says.
   * \param names of these members, in the order of -h
   * \param before their help, as in "with -smooth: " */
  template <typename Parameters>
  Options&
  members(Parameters& parameters,
          const std::vector<std::string>& names,
          const std::string& before = "")
  {
    for (const std::string& name : names) {
      bool is_found = false;
      pcl_uvol::forEachDescribed<Parameters>([&](const auto& member) {
        if (member.name != name)
          return;
        is_found = true;
        addMember(member.text.option ? member.text.option : member.name,
                  parameters.*member.pointer,
                  before + member.text.help,
                  member.text);
      });
      if (!is_found)
        throw std::logic_error("There is no member " + name + ".");
    }
    return *this;
  }

  /** \brief What was declared last is seldom used: where all options take more than a
   * screen, -h only counts it below its heading; -h all and -h with the heading explain
   * it. */
  Options&
  rare()
  {
    options_.back().is_rare = true;
    return *this;
  }

  /** \brief What was declared last must be fit for what it asks for.
   * \param check called by parse() with the value, if it was given and names a file
   * that is read or written; throws */
  Options&
  check(const std::function<void(const std::string&)>& check)
  {
    options_.back().check = check;
    return *this;
  }

  /** \brief Parse; -h and -version print and return false (the tool then returns 0).
   * Two dashes are as good as one, and --name=value is --name value.
   * \throws UsageError, also where a file would be read and written, or written twice
   */
  bool
  parse(int argc, const char* const* argv);

  /** \brief True if the option was given. */
  bool
  given(const std::string& name) const;

  /** \brief The one of these options that was given; "" if none was.
   * \throws UsageError if several were */
  std::string
  oneOf(const std::vector<std::string>& names) const;

  /** \brief Value of -threads: 0 = all cores. */
  unsigned
  threads() const
  {
    return static_cast<unsigned>(threads_);
  }
  bool
  verbose() const
  {
    return verbose_;
  }

  /** \brief The command line that does the same again, without what changes no result:
   * -threads and the like, folders of files, and the names of results. */
  std::string
  describeCommand() const;

  /** \brief From now on namedFile() and namedOutput() are those of this command line,
   * as they are when it is parsed. */
  void
  nameFiles() const;

  bool
  json() const
  {
    return json_;
  }

private:
  struct Option {
    std::string name, placeholder, help;
    std::function<void(const std::string&)> assign; // empty for flags
    bool* flag = nullptr;
    bool flag_value = true;
    bool given = false;
    // The targets that name a file to be read, or to be written.
    const std::string *read = nullptr, *written = nullptr;
    std::size_t group = 0;
    bool is_rare = false;
    std::function<void(const std::string&)> check = nullptr; // of the file it names
  };
  struct Group {
    std::string title;
    bool is_rare;
  };
  struct Positional {
    std::string name;
    std::string* target;
    bool required;
    std::vector<std::string>* targets = nullptr; // of one that takes several
  };

  /** \param shown words in the help
   * \param allowed those and other words for the same */
  Options&
  choice(const std::string& name,
         const std::vector<std::string>& shown,
         const std::vector<std::string>& allowed,
         const std::string& default_word,
         const std::string& help,
         const std::function<void(const std::string&)>& assign);

  /** \throws std::logic_error for a name that another option has */
  Options&
  add(Option option);

  /** An option for a member of a struct, by its type. */
  template <typename T>
  void
  addMember(const std::string& name,
            T& target,
            const std::string& help,
            const pcl_uvol::MemberText& text)
  {
    if constexpr (std::is_enum_v<T>)
      choice(name, target, help);
    else if constexpr (std::is_same_v<T, std::optional<double>>)
      automatic(name, target, text.low, text.high, help);
    else if constexpr (std::is_same_v<T, double>)
      number(name, target, text.low, text.high, help);
    else if constexpr (std::is_same_v<T, bool>)
      flag(name, target, help);
    else if constexpr (std::is_same_v<T, std::uint64_t>) // which has a range
      integer(name,
              target,
              static_cast<std::uint64_t>(text.low),
              static_cast<std::uint64_t>(text.high),
              help);
    else
      throw std::logic_error("-" + name + " has no type that an option can have.");
  }

  Option&
  find(const std::string& argument);

  /** Reads the option at position i, which is moved on to its value. */
  void
  assignOption(const std::vector<std::string>& arguments, std::size_t& i);

  void
  assignFiles(const std::vector<std::string>& files) const;

  void
  checkFiles(const std::vector<std::string>& files) const;

  /** \param topic "all", the title of a group, or "" for what is used most
   * \throws UsageError that lists the titles, for any other one */
  void
  printHelp(const std::string& topic) const;

  void
  printGroup(std::size_t group, bool with_rare, std::ostream& out) const;

  std::size_t
  countOptions(std::size_t group, bool with_rare) const;

  /** Titles of the groups that have options, each behind a comma. */
  std::string
  listHeadings() const;

  std::string
  writeHelp(bool with_rare) const;

  /** What -h stands for, with the headings of which this help has no option. */
  std::string
  explainHelp(bool with_rare) const;

  std::string tool_, synopsis_, purpose_;
  std::vector<Option> options_;
  std::vector<Group> groups_ = {{"Run", false}}; // which is printed last
  std::size_t current_group_ = 0;
  std::vector<Positional> positionals_;
  std::vector<std::string> command_; // the words of describeCommand()
  std::string first_file_, output_;  // that they name; "" if there is none
  std::uint64_t threads_ = 0;
  bool json_ = false, verbose_ = false, shares_outputs_ = false;
};

/** \brief No file may be read and written, or written twice, by whatever names: links
 * and ways to a folder are followed, and the files that lists name are read.
 * \throws UsageError that names the file */
void
checkDistinct(const std::vector<std::string>& inputs,
              const std::vector<std::string>& outputs);

/** \brief Finite numbers joined by commas, as an option's value; count 0 takes one or
 * more, and ranges: 0.1:0.1:0.6 has a step, 0.01:1:5log has a number of values, whose
 * ratios are equal. Both ends belong to a range.
 * \throws UsageError that names the option */
std::vector<double>
parseNumbers(const std::string& option, const std::string& value, std::size_t count);

/** \brief A number from low to high, as an option's value, or none for "auto".
 * \param high infinite for no bound
 * \throws UsageError that names the option and the range */
std::optional<double>
parseAutomatic(const std::string& option,
               const std::string& value,
               double low,
               double high);

/** \brief Names joined by commas, as an option's value. Commas that part components, as
 * in |vx,vy,vz|, or arguments, as in atan2(vy,vx), or stand in a quoted name part no
 * names. "": none.
 * \throws UsageError that names the option */
std::vector<std::string>
parseNames(const std::string& option, const std::string& value);

/** \brief Print facts, what was counted, and warnings: PCL's colours on a terminal,
 * plain in a pipe. With -v all counts and times; with -json one JSON object (keys:
 * those of the facts, counts, milliseconds, warnings).
 * \param plain no colours: what looks like a terminal need not be one */
void
printReport(const Options& options,
            const pcl_uvol::Report& report,
            const Facts& facts = {},
            bool plain = false);

/** \brief The first file of the command line that was parsed, for sentences that name
 * none. */
const std::string&
namedFile();

/** \brief From now on namedFile() is that one of several. */
void
nameFile(const std::string& path);

/** \brief From now on a command line may write these files only: those of a series,
 * whose names differ. */
void
expectOutputs(const std::vector<std::string>& names);

/** \brief True for an output that all files of a series have in common. */
bool
isOfAll(const std::string& output);

/** \brief The file that it says is written; "" if there is none. */
const std::string&
namedOutput();

/** \brief How a tool's body ended. */
struct Outcome {
  int exit_code = 0;
  std::string sentence;          ///< why it failed
  std::string marked_lines = {}; ///< of an expression that is wrong: it, and where
  std::string code = {};         ///< of the table of messages
  std::vector<pcl_uvol::MessageValue> values = {};
};

/** \brief Run a tool's body: its exit code, or 1 for a failure, or 2 for a UsageError.
 * Signals that would kill a writer (SIGXFSZ, SIGPIPE) become write errors. */
Outcome
catchErrors(const char* tool, const std::function<int()>& body);

/** \brief Run a tool's body: 0, or 1 with one sentence on stderr for a failure, or 2
 * for a UsageError. */
int
runTool(const char* tool, const std::function<int()>& body);

/** \brief What runTool writes to stderr and, if the command line asks for JSON, to
 * stdout: an object with code, text and values. */
void
printError(const char* tool, const Outcome& outcome);

/** \brief Keep whether a command line asks for JSON, before anything of it can fail. */
void
noteJson(int argc, const char* const* argv);

/** \brief Whether the command line asks for JSON. */
bool
isJsonAskedFor();

/** \brief What pictures say about themselves: version and command. */
std::vector<pcl_uvol::ImageText>
describeOrigin(const Options& options);

/** \brief A number of bytes: digits, and K, M, G or T for powers of 1000.
 * \throws UsageError that names the option */
std::uint64_t
parseBytes(const std::string& option, const std::string& text);

} // namespace uvol_tools
