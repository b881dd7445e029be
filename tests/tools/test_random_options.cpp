// SPDX-License-Identifier: BSD-3-Clause
// Random command lines of every tool on valid and on strange clouds: exit code 0, 1 or
// 2, one sentence where it fails, a report that is JSON, no file that was not asked
// for.
#include "sentences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

namespace {

using uvol_test::Random;
using Words = std::vector<std::string>;

struct Tool {
  const char *name, *outputs, *needed; ///< endings; options that it does not go without
};

struct Option {
  std::string name, placeholder;
};

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
pick(const Words& words, Random& random)
{
  return words[static_cast<std::size_t>(random.uniform() *
                                        static_cast<double>(words.size()))];
}

/** The options that -h lists, but for those that print something else. */
std::vector<Option>
listOptions(const std::string& tool)
{
  std::vector<Option> options;
  for (const std::string& line :
       split(uvol_test::runCommand("uvol_" + tool + " -h all").out, '\n')) {
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

/** A value that may be right for an option, or not. */
std::string
makeValue(const Option& option, const std::string& folder, Random& random)
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
  if (option.name == "-size")
    return pick({"16x16", "1x1", "0x0", "40x3", "8", "x"}, random);
  if (placeholder == "n")
    return pick(counts, random);
  if (placeholder == "bytes")
    return pick({"0", "1", "100M", "2G", "x"}, random);
  if (placeholder == "folder" || placeholder == "path")
    return folder;
  if (placeholder.compare(0, 4, "out.") == 0)
    return folder + "out_" + placeholder;
  if (placeholder == "file")
    return folder + "smooth.csv";
  if (placeholder == "name" || placeholder == "field" || placeholder == "expr" ||
      placeholder == "a,b,...")
    return pick(fields, random);
  if (placeholder.find('|') != std::string::npos) {
    const std::string word = pick(split(placeholder, '|'), random);
    return word.find(',') == std::string::npos ? word : makeNumbers(word, random);
  }
  return makeNumbers(placeholder, random);
}

/** Clouds of all kinds: their files. */
Words
writeClouds(const uvol_test::TemporaryFolder& folder)
{
  Random random(1);
  const std::string head = "x,y,z,f,g\n";
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
  Words files;
  for (const auto& [name, text] : clouds) {
    uvol_test::writeFile(folder / name, head + text);
    files.push_back(name);
  }
  return files;
}

/** What docs/reference/reports.md says: counts and times are numbers, warnings are
 * sentences, and no number stands in quotes. */
void
expectReport(const std::string& text)
{
  const auto report = nlohmann::json::parse(text, nullptr, false);
  ASSERT_TRUE(report.is_object()) << text;
  ASSERT_TRUE(report.value("warnings", nlohmann::json()).is_array()) << text;
  ASSERT_TRUE(report.value("counts", nlohmann::json()).is_object()) << text;
  for (const auto& warning : report["warnings"])
    EXPECT_TRUE(warning.is_string()) << warning;
  for (const auto& [name, count] : report["counts"].items())
    EXPECT_TRUE(count.is_number_unsigned()) << name << count;
  for (const auto& [name, time] : report["milliseconds"].items())
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

class RandomOptions : public testing::TestWithParam<Tool> {
protected:
  void
  runLines(std::uint64_t first_seed, std::uint64_t count)
  {
    options_ = listOptions(GetParam().name);
    ASSERT_LT(5u, options_.size());
    clouds_ = writeClouds(folder_);
    for (std::uint64_t seed = first_seed; seed < first_seed + count; ++seed)
      runLine(seed);
  }

private:
  std::string
  makeLine(Random& random) const
  {
    const Tool& tool = GetParam();
    std::string line =
        "'" + (folder_ / "out.") + pick(split(tool.outputs, ' '), random) + "'";
    if (random.uniform() < 0.95)
      line += ' ' + pick(split(tool.needed, ';'), random);
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
  runLine(std::uint64_t seed)
  {
    Random random(seed);
    const std::string tool = std::string("uvol_") + GetParam().name;
    const std::string cloud = pick(clouds_, random);
    const bool generates = tool == "uvol_generate"; // needs no input
    const std::string line = tool + (generates ? "" : " '" + (folder_ / cloud) + "'") +
                             ' ' + makeLine(random) + " -json";
    SCOPED_TRACE(line);
    const auto result = uvol_test::runCommand("timeout 20 " + line);
    EXPECT_TRUE(result.exit_code >= 0 && result.exit_code <= 2)
        << result.exit_code << result.err;
    uvol_test::expectSentences(tool, result);
    if (result.exit_code == 0)
      expectReport(result.out);
    for (const std::string& name : folder_.list()) {
      const bool is_input =
          std::find(clouds_.begin(), clouds_.end(), name) != clouds_.end();
      const bool is_output = result.exit_code == 0 && name.compare(0, 3, "out") == 0;
      EXPECT_TRUE(is_input || is_output) << name << " is left";
      if (!is_input)
        std::filesystem::remove(folder_ / name);
    }
  }

  const uvol_test::TemporaryFolder folder_;
  std::vector<Option> options_;
  Words clouds_;
};

TEST_P(RandomOptions, EndInASentenceOrAResult)
{
  runLines(0, 25);
}

TEST_P(RandomOptions, EndInASentenceOrAResult_long)
{
  runLines(25, 175);
}

INSTANTIATE_TEST_SUITE_P(
    Tools,
    RandomOptions,
    testing::Values(
        Tool{"isosurface", "ply pcd csv vtp obj xyz", "-iso 0;-iso 0,0.1"},
        Tool{"levelset", "ply csv", "-iso 0"},
        Tool{"probe",
             "ply csv vti",
             "-plane z=0 -size 16;-line 0,0,0,1,1,1 -n "
             "20;-grid 5"},
        Tool{"cluster", "ply csv", "-attributes f;-attributes x,f;-position"},
        Tool{"project", "ply csv", "-attributes x,y,f;-attributes f,g"},
        Tool{"voronoi", "vti ply", "-grid 8"},
        Tool{"normals", "ply pcd", "-k 9"},
        Tool{"splats", "ply csv", "-delta 0.01"},
        Tool{"render", "png ply", "-size 16x16"},
        Tool{"raytrace", "png", "-size 16x16"},
        Tool{"generate", "ply pcd csv vtp", "-n 20"}),
    [](const auto& tool) { return tool.param.name; });

} // namespace
