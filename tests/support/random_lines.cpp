// SPDX-License-Identifier: BSD-3-Clause
#include "support/random_lines.h"

#include "tools/sentences.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

namespace uvol_test {

namespace {

using Words = std::vector<std::string>;

Words
split(const std::string& text, char separator)
{
  Words words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, separator);)
    words.push_back(word);
  return words;
}

std::string
makeNumbers(const std::string& placeholder, Random& random)
{
  static const Words numbers{"0", "1", "-1", "0.5", "2", "1e-30", "1e30", "nan", "x"};
  std::string text = pick(numbers, random);
  for (const char c : placeholder)
    if (c == ',')
      text += ',' + pick(numbers, random);
  return text;
}

/** Points with normals. */
std::string
makeSphere()
{
  Random random(2);
  std::ostringstream text("x,y,z,normal_x,normal_y,normal_z,f\n", std::ios::ate);
  for (int i = 0; i < 200; ++i) {
    Eigen::Vector3d place;
    for (double& coordinate : place)
      coordinate = random.uniform() - 0.5;
    place.normalize();
    for (int copy = 0; copy < 2; ++copy)
      text << place[0] << ',' << place[1] << ',' << place[2] << ',';
    text << random.uniform() << '\n';
  }
  return text.str();
}

/** Surfaces and clouds of all kinds: their files. */
Words
writeClouds(const TemporaryFolder& folder)
{
  Random random(1);
  const std::string head = "x,y,z,f,g\n";
  const std::string octahedron = "OFF\n6 8 12\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n"
                                 "0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n"
                                 "3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";
  const auto row = [&random](double scale, double flat) {
    std::ostringstream text;
    double sum = 0.0;
    for (const double factor : {scale, scale, scale * flat}) {
      const double coordinate = factor * (random.uniform() - 0.5);
      sum += coordinate * coordinate;
      text << coordinate << ',';
    }
    text << std::sqrt(sum) - 0.3 * scale << ','
         << static_cast<int>(random.uniform() * 3) << '\n';
    return text.str();
  };
  const auto rows = [&row](std::size_t count, double scale, double flat) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
      text += row(scale, flat);
    return text;
  };
  const std::vector<std::pair<std::string, std::string>> clouds{
      {"smooth.csv", rows(300, 1.0, 1.0)},
      {"few.csv", rows(5, 1.0, 1.0)},
      {"flat.csv", rows(60, 1.0, 0.0)},
      {"line.csv", "0,0,0,1,0\n1,0,0,2,0\n2,0,0,-1,0\n3,0,0,4,0\n"},
      {"same.csv", "1,2,3,1,0\n1,2,3,2,0\n1,2,3,-1,0\n"},
      {"none.csv", ""},
      {"large.csv", rows(60, 1e30, 1.0)},
      {"small.csv", rows(60, 1e-30, 1.0)},
      {"fill.csv",
       rows(60, 1.0, 1.0) + "-1e34,-1e34,-1e34,1,0\nnan,1,2,0,0\n1,2,3,1e300,0\n"}};
  Words files{"closed.off", "open.off", "normals.csv"};
  writeFile(folder / files[0], octahedron);
  writeFile(folder / files[1],
            std::regex_replace(octahedron, std::regex("3 0 3 5"), "3 0 0 0"));
  writeFile(folder / files[2], makeSphere());
  for (const auto& [name, text] : clouds) {
    writeFile(folder / name, head + text);
    files.push_back(name);
  }
  return files;
}

/** What docs/reference/reports.md says: counts and times, of a tool that has any, are
 * numbers, warnings are sentences with a code and values, and no number stands in
 * quotes. */
void
expectReport(const std::string& text)
{
  const auto report = nlohmann::json::parse(text, nullptr, false);
  ASSERT_TRUE(report.is_object()) << text;
  const auto none = nlohmann::json::object();
  const auto warnings = report.value("warnings", nlohmann::json()),
             counts = report.value("counts", none),
             times = report.value("milliseconds", none);
  ASSERT_TRUE(warnings.is_array() && counts.is_object() && times.is_object()) << text;
  static const std::regex words_joined("[a-z0-9]+(_[a-z0-9]+)*");
  for (const auto& warning : warnings) {
    ASSERT_TRUE(warning.is_object()) << warning;
    const auto code = warning.value("code", nlohmann::json()),
               sentence = warning.value("text", nlohmann::json()),
               values = warning.value("values", nlohmann::json());
    ASSERT_TRUE(code.is_string() && sentence.is_string()) << warning;
    EXPECT_TRUE(std::regex_match(code.get<std::string>(), words_joined)) << warning;
    const std::string words = sentence;
    EXPECT_TRUE(!words.empty() &&
                std::string(".?)").find(words.back()) != std::string::npos)
        << warning;
    EXPECT_TRUE(values.is_object()) << warning;
    for (const auto& [name, value] : values.items())
      EXPECT_TRUE(value.is_primitive() && std::regex_match(name, words_joined))
          << warning;
    if (warning.contains("times")) {
      EXPECT_GE(warning["times"], 2) << warning;
    }
  }
  for (const auto& [name, count] : counts.items())
    EXPECT_TRUE(count.is_number_unsigned()) << name << count;
  for (const auto& [name, time] : times.items())
    EXPECT_TRUE(time.is_number() && time >= 0.0) << name << time;
  for (const auto& [name, fact] : report.items()) {
    EXPECT_EQ(std::string::npos, name.find_first_of(" -")) << name;
    if (fact.is_string()) {
      char* end = nullptr;
      const std::string word = fact;
      std::strtod(word.c_str(), &end);
      EXPECT_TRUE(word.empty() || *end != '\0') << name << " is a number in quotes";
    }
  }
}

} // namespace

std::uint64_t
countDefaultLines()
{
  return isSanitized() ? 25 : 50;
}

std::string
pick(const Words& words, Random& random)
{
  return words[static_cast<std::size_t>(random.uniform() *
                                        static_cast<double>(words.size()))];
}

RandomLines::RandomLines(const RandomTool& tool)
    : tool_(tool)
    , options_(listOptions(tool.name))
    , files_(writeClouds(folder_))
{
}

void
RandomLines::run(std::uint64_t first_seed, std::uint64_t count)
{
  ASSERT_LT(3u, options_.size());
  for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed)
    runLine(seed);
}

/** The options that -h lists, but for those that print something else. */
std::vector<RandomLines::Option>
RandomLines::listOptions(const std::string& tool)
{
  std::vector<Option> options;
  for (const std::string& line :
       split(runCommand("uvol_" + tool + " -h all").out, '\n')) {
    if (line.compare(0, 3, "  -") != 0)
      continue;
    const std::size_t name_end = line.find(' ', 3);
    const std::size_t end = line.find("  ", 3);
    const std::string name = line.substr(2, name_end - 2);
    if (name == "-h" || name == "-version")
      continue;
    options.push_back(
        {name, name_end < end ? line.substr(name_end + 1, end - name_end - 1) : ""});
  }
  return options;
}

/** A value that may be right for an option, or not. */
std::string
RandomLines::makeValue(const Option& option, const std::string& folder, Random& random)
{
  static const Words counts{
      "0", "1", "2", "3", "9", "20", "-1", "99999999999999999999"};
  static const Words fields{"f",
                            "g",
                            "x",
                            "log10(f)",
                            "f/0",
                            "no",
                            "|x,y|",
                            "sqrt(-f)",
                            "f>0",
                            "grad(f)",
                            "(",
                            "",
                            "\\\"a b\\\"",
                            "\x1b[0m"};
  const std::string& placeholder = option.placeholder;
  if (placeholder == "folder" || placeholder == "path")
    return folder;
  if (placeholder.compare(0, 4, "out.") == 0)
    return folder + "out_" + placeholder;
  if (placeholder == "file")
    return folder + "smooth.csv";
  if (random.uniform() < 0.05)
    return std::string(5000, 'q');
  if (option.name == "-size")
    return pick({"16x16", "1x1", "0x0", "40x3", "8", "x"}, random);
  if (placeholder == "n")
    return pick(counts, random);
  if (placeholder == "bytes")
    return pick({"0", "1", "100M", "2G", "x"}, random);
  if (placeholder == "name" || placeholder == "field" || placeholder == "expr" ||
      placeholder == "a,b,...")
    return pick(fields, random);
  if (placeholder.find('|') != std::string::npos) {
    const std::string word = pick(split(placeholder, '|'), random);
    return word.find(',') == std::string::npos ? word : makeNumbers(word, random);
  }
  return makeNumbers(placeholder, random);
}

std::string
RandomLines::makeLine(Random& random) const
{
  std::string line;
  if (*tool_.outputs != '\0')
    line += ' ' + std::string(tool_.output_option) + '\'' + (folder_ / "out.") +
            pick(split(tool_.outputs, ' '), random) + '\'';
  if (*tool_.needed != '\0' && random.uniform() < 0.95)
    line += ' ' + pick(split(tool_.needed, ';'), random);
  const auto given = static_cast<std::size_t>(4.0 * random.uniform());
  for (std::size_t i = 0; i < given; ++i) {
    const auto& option = options_[static_cast<std::size_t>(
        random.uniform() * static_cast<double>(options_.size()))];
    line += ' ' + option.name;
    if (!option.placeholder.empty())
      line += " \"" + makeValue(option, folder_ / "", random) + '"';
  }
  return line;
}

void
RandomLines::runLine(std::uint64_t seed)
{
  Random random(seed);
  const std::string tool = std::string("uvol_") + tool_.name;
  std::string line = tool_.launcher.empty() ? tool : tool_.launcher;
  for (std::size_t i = 0; i < tool_.inputs; ++i)
    line += " '" + (folder_ / pick(files_, random)) + '\'';
  line += makeLine(random) + " -json";
  SCOPED_TRACE(line);
  const auto result = runCommand("timeout 20 " + line);
  EXPECT_TRUE(result.exit_code >= 0 && result.exit_code <= 2)
      << result.exit_code << result.err;
  expectSentences(tool, result);
  if (result.exit_code == 0)
    expectReport(result.out);
  clearFolder(result.exit_code == 0);
}

void
RandomLines::clearFolder(bool has_succeeded)
{
  for (const std::string& name : folder_.list()) {
    if (std::find(files_.begin(), files_.end(), name) != files_.end())
      continue;
    EXPECT_TRUE(has_succeeded && name.compare(0, 3, "out") == 0) << name << " is left";
    std::filesystem::remove(folder_ / name);
  }
}

} // namespace uvol_test
