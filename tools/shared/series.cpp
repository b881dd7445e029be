// SPDX-License-Identifier: BSD-3-Clause
#include "shared/series.h"

#include "common/numbers.h"
#include "common/printable.h"
#include "io/files.h"
#include "io/folder.h"
#include "io/memory_need.h"
#include "io/xml_text.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <optional>
#include <set>
#include <sstream>
#include <unistd.h>
#include <utility>

namespace uvol_tools {

namespace {

namespace fs = std::filesystem;

/** Where a name has "{}", "{:d}", "{:4d}" or "{:04d}". */
struct NumberPlace {
  std::size_t begin, end;
  char fill = ' ';
  std::size_t digits = 0;
};

std::optional<NumberPlace>
findPlaceOfNumber(const std::string& text)
{
  for (std::size_t begin = text.find('{'); begin != std::string::npos;
       begin = text.find('{', begin + 1)) {
    NumberPlace place{begin, begin + 1};
    const auto next = [&] { return place.end < text.size() ? text[place.end] : '\0'; };
    if (next() == ':') {
      ++place.end;
      if (next() == '0') {
        place.fill = '0';
        ++place.end;
      }
      if (next() >= '0' && next() <= '9')
        place.digits = static_cast<std::size_t>(text[place.end++] - '0');
      if (next() != 'd')
        continue;
      ++place.end;
    }
    if (next() != '}')
      continue;
    ++place.end;
    return place;
  }
  return std::nullopt;
}

constexpr const char* time_place = "{t}";

/** The time that the header of a snapshot names. */
std::optional<double>
findTime(const std::string& path)
{
  const auto header = pcl_uvol::peekHeader(path);
  return header ? header->time : std::nullopt;
}

/** As many digits as single precision holds. */
std::string
printTime(double time)
{
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<float>::digits10 + 1) << time;
  return text.str();
}

/** The command line of a series. */
struct Series {
  std::vector<std::string> arguments; ///< without those of the series
  std::optional<std::string> snapshots;
  bool keeps_going = false;
  std::optional<NumberedName> input; ///< the first name with a place for a number
};

Series
parseSeries(int argc, char** argv)
{
  Series series;
  for (int i = 0; i < argc; ++i) {
    const std::string argument = argv[i];
    if (i > 0 && !series.input && NumberedName::isOne(argument))
      series.input.emplace(argument);
    if (argument == "-keep-going")
      series.keeps_going = true;
    else if (argument == "-snapshots" && i + 1 < argc)
      series.snapshots = argv[++i];
    else
      series.arguments.push_back(argument);
  }
  return series;
}

/** "first:last" or "first:last:step". */
std::vector<std::size_t>
parseSnapshots(const std::string& text)
{
  const UsageError wrong("-snapshots takes first:last or first:last:step, not " + text +
                         ".");
  std::vector<std::uint64_t> parts;
  std::string_view rest = text;
  for (bool more = true; more;) {
    const std::size_t colon = rest.find(':');
    std::uint64_t number = 0;
    if (!pcl_uvol::parseCount(rest.substr(0, colon), number))
      throw wrong;
    parts.push_back(number);
    more = colon != std::string_view::npos;
    rest.remove_prefix(more ? colon + 1 : rest.size());
  }
  const std::uint64_t step = parts.size() == 3 ? parts[2] : 1;
  constexpr std::uint64_t most = 1000000;
  if (parts.size() < 2 || parts.size() > 3 || step == 0 || parts[1] < parts[0] ||
      (parts[1] - parts[0]) / step >= most)
    throw wrong;
  std::vector<std::size_t> numbers;
  for (std::uint64_t number = parts[0]; number <= parts[1]; number += step)
    numbers.push_back(number);
  return numbers;
}

/** The system reads a file while the one before is worked on. */
void
prefetch(const std::string& path)
{
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
    return; // whoever reads it will say why
  ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_WILLNEED);
  ::close(descriptor);
}

using RunFile = std::function<int(int, char**, SeriesStep*)>;

int
runOne(const RunFile& run, const std::vector<std::string>& arguments, SeriesStep& step)
{
  std::vector<std::string> copies = arguments;
  std::vector<char*> pointers;
  pointers.reserve(copies.size() + 1);
  for (std::string& copy : copies)
    pointers.push_back(copy.data());
  pointers.push_back(nullptr);
  return run(static_cast<int>(arguments.size()), pointers.data(), &step);
}

/** A file of a list over time. */
struct ListedFile {
  std::size_t number;
  std::optional<double> time;
  std::string path;
};

/** A list of files over time, which ParaView opens as one. */
void
writeList(const std::vector<ListedFile>& written)
{
  const fs::path first = written[0].path;
  std::string stem = first.stem().string();
  while (!stem.empty() && (std::isdigit(static_cast<unsigned char>(stem.back())) != 0 ||
                           std::string("_-. ").find(stem.back()) != std::string::npos))
    stem.pop_back();
  const fs::path list =
      first.parent_path() / ((stem.empty() ? "series" : stem) + ".pvd");
  const bool have_times = std::all_of(
      written.begin(), written.end(), [](const auto& file) { return file.time; });
  pcl_uvol::checkSavePath(first); // its folder is that of the list
  pcl_uvol::writeAtomically(list, [&](const std::string& file) {
    std::ofstream out(file);
    out << "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (const auto& [number, time, path] : written)
      out << "<DataSet timestep=\""
          << (have_times ? printTime(*time) : std::to_string(number)) << "\" file=\""
          << pcl_uvol::io::escapeAttribute(fs::path(path).filename().string())
          << "\"/>\n";
    out << "</Collection>\n</VTKFile>\n";
    if (!out.flush())
      pcl_uvol::io::throwUnwritable(list.string(), pcl_uvol::io::systemError());
  });
  std::cerr << "ParaView opens all of them as " << list.string() << '\n';
}

/** The command lines of a series, one after the other. */
class SeriesArguments {
public:
  explicit SeriesArguments(const Series& series)
      : series_(series)
  {
  }

  /** The command line for a file. It may write the names that no other one has.
   * \throws IOError for {t} where the file names no time */
  std::vector<std::string>
  make(std::size_t number, std::optional<double> time)
  {
    std::vector<std::string> arguments = series_.arguments, own;
    for (std::string& argument : arguments) {
      const bool is_numbered = NumberedName::isOne(argument);
      if (is_numbered)
        argument = NumberedName(argument).insert(number);
      const bool is_timed = argument.find(time_place) != std::string::npos;
      if (is_timed && !time)
        pcl_uvol::io::throwUnreadable(series_.input->insert(number),
                                      {"no_time", time_place});
      if (is_timed)
        insertTime(printTime(*time), argument);
      if (is_numbered || (is_timed && timed_.insert(argument).second))
        own.push_back(argument);
    }
    expectOutputs(own);
    return arguments;
  }

private:
  static void
  insertTime(const std::string& time, std::string& argument)
  {
    for (std::size_t at = argument.find(time_place); at != std::string::npos;
         at = argument.find(time_place, at + time.size()))
      argument.replace(at, std::string(time_place).size(), time);
  }

  const Series& series_;
  std::set<std::string> timed_; ///< arguments with a time so far
};

int
runAll(const char* tool, const Series& series, const RunFile& run)
{
  const std::vector<std::size_t> numbers = series.snapshots
                                               ? parseSnapshots(*series.snapshots)
                                               : series.input->findNumbers();
  if (numbers.empty())
    throw UsageError("Cannot find " + series.input->insert(0) +
                     " or a file with another number.");
  int exit_code = 0;
  std::size_t failed = 0;
  std::vector<ListedFile> written;
  SeriesArguments arguments(series);
  PictureSeries pictures;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    SeriesStep step{numbers[i], findTime(series.input->insert(numbers[i])), pictures};
    if (i + 1 < numbers.size())
      prefetch(series.input->insert(numbers[i + 1]));
    const int outcome = runTool(tool, [&] {
      return runOne(run, arguments.make(step.number, step.time), step);
    });
    if (outcome == 0) {
      const fs::path output = namedOutput();
      if (output.extension() == ".vtp")
        written.push_back({step.number, step.time, output.string()});
      continue;
    }
    ++failed;
    exit_code = exit_code == 0 ? outcome : exit_code;
    if (!series.keeps_going) {
      std::cerr << tool << ": " << i << " of " << numbers.size()
                << " files are done; -keep-going passes over failures.\n";
      break;
    }
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int outcome = runTool(tool, [&] {
      pictures.draw(i);
      return 0;
    });
    failed += outcome == 0 ? 0 : 1;
    exit_code = exit_code == 0 ? outcome : exit_code;
    if (outcome != 0 && !series.keeps_going)
      break;
  }
  if (written.size() > 1)
    writeList(written);
  if (failed == 0 || series.keeps_going)
    std::cerr << tool << ": " << numbers.size() - failed << " of " << numbers.size()
              << " files are done.\n";
  return exit_code;
}

} // namespace

bool
NumberedName::isOne(const std::string& text)
{
  return findPlaceOfNumber(text).has_value();
}

NumberedName::NumberedName(const std::string& text)
{
  const std::optional<NumberPlace> place = findPlaceOfNumber(text);
  if (!place)
    throw UsageError(pcl_uvol::quoteText(text) +
                     " has no place for a number, as in snap_{:04d}.");
  before_ = text.substr(0, place->begin);
  after_ = text.substr(place->end);
  fill_ = place->fill;
  digits_ = place->digits;
}

std::string
NumberedName::insert(std::size_t number) const
{
  std::string digits = std::to_string(number);
  if (digits.size() < digits_)
    digits.insert(0, digits_ - digits.size(), fill_);
  return before_ + digits + after_;
}

std::vector<std::size_t>
NumberedName::findNumbers() const
{
  // The place may be in the name of a file only: folders are not searched.
  const std::size_t slash = before_.rfind('/');
  const std::string folder =
      slash == std::string::npos ? "." : before_.substr(0, slash + 1);
  const std::string start =
      slash == std::string::npos ? before_ : before_.substr(slash + 1);
  std::vector<std::size_t> numbers;
  for (const std::string& name : pcl_uvol::io::listFolder(folder)) {
    std::uint64_t number = 0;
    if (name.size() <= start.size() + after_.size() || name.rfind(start, 0) != 0)
      continue;
    const std::string digits =
        name.substr(start.size(), name.size() - start.size() - after_.size());
    if (pcl_uvol::parseCount(std::string(pcl_uvol::trimmed(digits)), number) &&
        insert(number) == (slash == std::string::npos ? name : folder + name))
      numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

void
declareSeries(Options& options)
{
  options
      .series("snapshots",
              "first:last:step",
              "numbers in names such as snap_{:04d}.h5 out_{:04d}.vtp; {t} is the time "
              "in a snapshot (default: all files that exist)")
      .rare();
  options.series("keep-going", "", "continue with the next file if one fails").rare();
}

int
runSeries(const char* tool, int argc, char** argv, const RunFile& run)
{
  int exit_code = 0;
  const auto body = [&] {
    noteJson(argc, argv);
    const Series series = parseSeries(argc, argv);
    if (!series.input && (series.snapshots || series.keeps_going))
      throw UsageError(
          "-snapshots and -keep-going need names with a place for a number, "
          "as in snap_{:04d}.h5.");
    if (!series.input && std::any_of(series.arguments.begin(),
                                     series.arguments.end(),
                                     [](const std::string& argument) {
                                       return argument.find(time_place) !=
                                              std::string::npos;
                                     }))
      throw UsageError(
          "{t} is the time of a file of a series, which needs names with a "
          "place for a number, as in snap_{:04d}.h5.");
    if (!series.input)
      return run(argc, argv, nullptr);
    exit_code = runAll(tool, series, run);
    return exit_code;
  };
  return runTool(tool, std::ref(body)); // by reference: without memory
}

} // namespace uvol_tools
