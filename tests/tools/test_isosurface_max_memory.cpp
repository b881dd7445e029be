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
    const auto result = uvol_test::succeeded(run(iso_ + options + " -json " + bound_));
    EXPECT_EQ(expected, uvol_test::readFile(out_)) << options;
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_GE(report.at("counts").at("pieces"), 2);
    EXPECT_GT(report.at("sampling").at("volume"), 0.9);
    EXPECT_EQ("2", uvol_test::warnedValues(report, "no_isopoints").at("isovalue"));
  }
}

/** Pieces see parts of the lines, and of the isopoints that are examined. */
TEST_F(MaxMemory, ReportsWeakSupportAsInMemory)
{
  const std::string cloud = folder_ / "cloud.pcd";
  uvol_test::runWell("uvol_generate " + cloud +
                     " -field torus -n 60000 -samples holes");
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

TEST_F(MaxMemory, IsABoundThatHolds)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  const std::string cloud = folder_ / "cloud.pcd";
  for (const std::string samples : {"uniform", "clustered", "lattice"}) {
    uvol_test::runWell("uvol_generate " + cloud + " -n 1000000 -samples " + samples);
    const auto memory = uvol_test::jsonOf(
        uvol_test::runCommand("uvol_isosurface " + cloud + " " + out_ +
                              " -iso 20 -max-memory 170M -json"))["memory"];
    EXPECT_EQ(170e6, memory.at("bound"));
    EXPECT_LE(memory.at("peak"), memory.at("bound"));
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
  for (const std::string size : {"x", "0", "2X", "M", "nan", "1e30"})
    expectUsageErrors(iso_, {"-max-memory " + size});
  for (const std::string size : {"1.5", "100M"})
    expectError(iso_ + "-max-memory " + size, "memory_for_pieces");
  expectUsageErrors(iso_ + bound_,
                    {"-smooth",
                     "-scale auto",
                     "-fill-gaps -smooth",
                     "-neighbors voronoi",
                     "-where 'x>0'",
                     "-fill-gaps"});
  expectUsageErrors(iso_, {"-scratch ."});
  expectError(
      iso_ + bound_ + "-scratch /nowhere", "scratch_folder_refused", "/nowhere");
  expectError(bound_ + "-iso 0.3 -field density", "unknown_lone_field", "\"density\"");
}

TEST_F(MaxMemory, NamesFormatsThatDoNotStream)
{
  const std::string whole = folder_ / "whole.vtp";
  uvol_test::runWell("uvol_isosurface " + in_ + " " + whole + " " + iso_);
  uvol_test::expectError(uvol_test::runCommand("uvol_isosurface " + whole + " " + out_ +
                                               " -field number -iso 100 -json " +
                                               bound_),
                         "not_streamable",
                         "whole.vtp");
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
                              ' ' + iso_ + bound_ + "-json -scratch " + scratch);
    uvol_test::expectError(result, "scratch_folder_full", "scratch");
    uvol_test::expectSentences(tool_, result);
    EXPECT_EQ((std::vector<std::string>{"in.csv", "scratch"}), folder_.list());
    EXPECT_TRUE(fs::is_empty(scratch));
  }
}

} // namespace test_isosurface_max_memory
