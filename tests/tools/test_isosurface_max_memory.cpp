// SPDX-License-Identifier: BSD-3-Clause
// uvol_isosurface within a bound of memory: the same file, or one sentence.
#include "common/random.h"
#include "support/environment.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"
#include "tools/tool_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace test_isosurface_max_memory {

using pcl_uvol::uniformAt;

class MaxMemory : public uvol_test::ToolTest {
protected:
  MaxMemory()
      : ToolTest("uvol_isosurface", "out.ply")
  {
  }

  void
  SetUp() override
  {
    std::ostringstream csv;
    csv << "x,y,z,distance,number\n";
    for (std::uint64_t i = 0; i < 60000; ++i) {
      const double x = uniformAt(5, i, 0), y = uniformAt(5, i, 1),
                   z = uniformAt(5, i, 2);
      csv << x << ',' << y << ',' << z << ','
          << std::sqrt((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5) +
                       (z - 0.5) * (z - 0.5))
          << ',' << i << '\n';
    }
    uvol_test::writeFile(in_, csv.str());
  }

  const std::string iso_ = "-field distance -iso 0.3,0.4,2 ";
  /** For several pieces. */
  const std::string bound_ = "-max-memory 124M ";
};

TEST_F(MaxMemory, WritesTheSameFile)
{
  for (const std::string options : {"",
                                    "-interpolation linear -criterion all",
                                    "-scale 1,2,0.5 -outside higher -normals pca",
                                    "-max-error auto -threads 1",
                                    "-max-error 0.001 -drop-bridged -threads 1"}) {
    expectSuccess(iso_ + options);
    const std::string expected = uvol_test::readFile(out_);
    const auto result = run(iso_ + options + " " + bound_);
    EXPECT_EQ(0, result.exit_code) << result.err;
    EXPECT_EQ(expected, uvol_test::readFile(out_)) << options;
    EXPECT_TRUE(std::regex_search(result.out, std::regex("pieces [2-9]")))
        << result.out;
    EXPECT_NE(std::string::npos, result.out.find("sampling: all around")) << result.out;
    EXPECT_NE(std::string::npos, result.err.find("No isopoints for 2")) << result.err;
  }
}

/** Pieces see parts of the lines, and of the isopoints that are examined. */
TEST_F(MaxMemory, ReportsWeakSupportAsInMemory)
{
  const std::string cloud = folder_ / "cloud.pcd";
  const auto made = uvol_test::runCommand("uvol_generate " + cloud +
                                          " -field torus -n 60000 -samples holes");
  ASSERT_EQ(0, made.exit_code) << made.err;
  for (const std::string interpolation : {"linear", "fit"}) {
    const auto extract = [&](const std::string& options) {
      return uvol_test::runCommand(
          "uvol_isosurface " + cloud + ' ' + out_ + " -field torus -iso 0,0.05 -json" +
          " -normals edge -interpolation " + interpolation + options);
    };
    const auto expected = extract(""), found = extract(" -max-memory 124M");
    EXPECT_TRUE(std::regex_search(found.out, std::regex("\"pieces\": [2-9]")))
        << found.out;
    const auto listWeakSupport = [](const std::string& report) {
      const std::regex pattern(
          "\"(examined|bridged|rim)[a-z_]*\": [0-9]+|[0-9]+ % of the isopoints [^\"]*|"
          "\"code\": \"[a-z_]*(isopoints)[a-z_]*\"|\"percent\": [0-9]+");
      std::string support;
      for (std::sregex_iterator i(report.begin(), report.end(), pattern), end; i != end;
           ++i)
        support += i->str() + '\n';
      return support;
    };
    const std::string support = listWeakSupport(expected.out);
    EXPECT_NE(std::string::npos, support.find("rim\": ")) << expected.out;
    EXPECT_NE(std::string::npos, support.find("\"unconstrained_isopoints\""))
        << expected.out;
    EXPECT_EQ(support, listWeakSupport(found.out));
  }
}

/** Megabytes behind a word of the report's line on memory. */
double
megabytesBehind(const std::string& word, const std::string& report)
{
  std::smatch match;
  EXPECT_TRUE(std::regex_search(
      report, match, std::regex("memory: .*" + word + " ([0-9.]+) MB")))
      << report;
  return match.empty() ? 0.0 : std::stod(match[1]);
}

TEST_F(MaxMemory, IsABoundThatHolds)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  const std::string cloud = folder_ / "cloud.pcd";
  for (const std::string samples : {"uniform", "clustered", "lattice"}) {
    const auto made = uvol_test::runCommand("uvol_generate " + cloud +
                                            " -n 1000000 -samples " + samples);
    ASSERT_EQ(0, made.exit_code) << made.err;
    const auto result = uvol_test::runCommand("uvol_isosurface " + cloud + " " + out_ +
                                              " -iso 20 -max-memory 170M");
    ASSERT_EQ(0, result.exit_code) << result.err;
    EXPECT_LE(megabytesBehind("peak", result.out),
              megabytesBehind("bound", result.out));
  }
}

/** Many fields and a surface through all samples: its rows are larger than the samples
 * of a piece. */
TEST_F(MaxMemory, HoldsForManyFieldsOrRefuses)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  constexpr std::size_t samples = 60000, fields = 300;
  const std::string cloud = folder_ / "cloud.pcd";
  {
    std::ofstream out(cloud, std::ios::binary);
    std::string names = "x y z f", sizes = "4 4 4 4", types = "F F F F";
    for (std::size_t i = 0; i < fields; ++i) {
      names += " f" + std::to_string(i);
      sizes += " 4";
      types += " F";
    }
    std::string counts(types);
    std::replace(counts.begin(), counts.end(), 'F', '1');
    out << "VERSION .7\nFIELDS " << names << "\nSIZE " << sizes << "\nTYPE " << types
        << "\nCOUNT " << counts << "\nWIDTH " << samples << "\nHEIGHT 1\nPOINTS "
        << samples << "\nDATA binary\n";
    std::vector<float> row(4 + fields);
    for (std::uint64_t i = 0; i < samples; ++i) {
      for (std::uint32_t axis = 0; axis < 3; ++axis)
        row[axis] = static_cast<float>(20.0 * uniformAt(6, i, axis));
      row[3] = std::sin(row[0]) * std::cos(row[1]) +
               std::sin(row[1]) * std::cos(row[2]) +
               std::sin(row[2]) * std::cos(row[0]);
      out.write(reinterpret_cast<const char*>(row.data()),
                static_cast<std::streamsize>(row.size() * sizeof(float)));
    }
  }
  const std::string picture = "-size 2000 -png " + (folder_ / "o.png");
  for (const auto& [options, code] :
       {std::pair<std::string, std::string>("-iso 0,0.3 -max-memory 140M",
                                            "not_enough_memory"),
        {"-iso 0 -normals pca -max-memory 140M", ""},
        {"-iso 0,0.3 -max-memory 200M", ""},
        {"-iso 0 -max-memory 200M " + picture, "not_enough_memory"}}) {
    SCOPED_TRACE(options);
    const auto result = uvol_test::runCommand("uvol_isosurface " + cloud + ' ' + out_ +
                                              " -field f -json " + options);
    EXPECT_EQ(code.empty() ? 0 : 1, result.exit_code) << result.err;
    if (!code.empty())
      EXPECT_TRUE(uvol_test::hasMessage(result, code)) << result.out;
    else {
      const auto memory = nlohmann::json::parse(result.out).at("memory");
      EXPECT_LE(memory.at("peak"), memory.at("bound"));
    }
  }
}

TEST_F(MaxMemory, SaysWhatIsWrong)
{
  for (const std::string size : {"x", "0", "1.5", "2X", "M", "nan", "1e30"})
    expectFailure(iso_ + "-max-memory " + size, size == "1.5" ? 1 : 2, "memory");
  expectError(iso_ + "-max-memory 100M", "memory_for_pieces");
  expectFailure(iso_ + bound_ + "-smooth", 2, "-smooth");
  expectFailure(iso_ + bound_ + "-scale auto", 2, "-scale auto");
  expectFailure(iso_ + bound_ + "-fill-gaps -smooth", 2, "-smooth, -fill-gaps: all");
  expectFailure(iso_ + bound_ + "-neighbors voronoi", 2, "-neighbors voronoi");
  expectFailure(iso_ + bound_ + "-where 'x>0'", 2, "-where");
  expectFailure(iso_ + bound_ + "-fill-gaps", 2, "-fill-gaps");
  expectFailure(iso_ + "-scratch .", 2, "-max-memory");
  expectFailure(iso_ + bound_ + "-scratch /nowhere", 1, "/nowhere");
  expectFailure(bound_ + "-iso 0.3 -field density", 1, "density");
}

TEST_F(MaxMemory, NamesFormatsThatDoNotStream)
{
  const std::string whole = folder_ / "whole.vtp";
  const auto made =
      uvol_test::runCommand("uvol_isosurface " + in_ + " " + whole + " " + iso_);
  ASSERT_EQ(0, made.exit_code) << made.err;
  const auto result = uvol_test::runCommand("uvol_isosurface " + whole + " " + out_ +
                                            " -field number -iso 100 " + bound_);
  EXPECT_EQ(1, result.exit_code);
  EXPECT_NE(std::string::npos, result.err.find("PCD")) << result.err;
}

/** A disk that is full from a write on, as the library of faults makes it, and files
 * that may not grow. */
TEST_F(MaxMemory, AFullScratchFolderIsOneSentence)
{
  namespace fs = std::filesystem;
  const std::string scratch = folder_ / "scratch";
  fs::create_directory(scratch);
  std::vector<std::string> limits{"ulimit -f 100; "};
  if (!uvol_test::isSanitized()) // which has to be loaded first
    for (const std::string write : {"1", "3", "9"})
      limits.push_back("LD_PRELOAD=" PCL_UVOL_FAULTS " UVOL_FAULTS=write:" + write +
                       "+ ");
  for (const std::string& limit : limits) {
    SCOPED_TRACE(limit);
    const auto result =
        uvol_test::runCommand(limit + "timeout 30 uvol_isosurface " + in_ + ' ' + out_ +
                              ' ' + iso_ + bound_ + "-scratch " + scratch);
    EXPECT_EQ(1, result.exit_code);
    EXPECT_NE(std::string::npos, result.err.find("The scratch folder ")) << result.err;
    uvol_test::expectSentences(tool_, result);
    EXPECT_EQ((std::vector<std::string>{"in.csv", "scratch"}), folder_.list());
    EXPECT_TRUE(fs::is_empty(scratch));
  }
}

} // namespace test_isosurface_max_memory
