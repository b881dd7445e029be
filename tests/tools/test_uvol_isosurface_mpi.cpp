// SPDX-License-Identifier: BSD-3-Clause
// Processes of MPI write what one process writes, or one sentence and nothing.
#include "common/scalar_field.h"
#include "io/rank_files.h"
#include "support/clouds.h"
#include "support/environment.h"
#include "support/mpi_job.h"
#include "support/snapshots.h"
#include "tools/json_warnings.h"
#include "tools/sentences.h"
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <future>
#include <numeric>
#include <regex>
#include <sstream>

namespace test_uvol_isosurface_mpi {

using pcl_uvol::Dataset;
using uvol_test::CommandResult;
using uvol_test::mpirun;
using uvol_test::rowsOf;
using uvol_test::runCommand;

/** Points with labels that tell them apart. */
Dataset
labelled(const pcl::PointCloud<pcl::PointXYZI>& points)
{
  pcl::PointCloud<pcl::PointXYZI> dense = points;
  dense.is_dense = true;
  Dataset dataset;
  std::vector<double> xyz;
  std::vector<float> values;
  std::vector<std::int32_t> labels(points.size());
  for (const auto& point : points) {
    xyz.insert(xyz.end(), {point.x, point.y, point.z});
    values.push_back(point.intensity);
  }
  std::iota(labels.begin(), labels.end(), 0);
  setCoordinates(dataset, xyz);
  setField(dataset, "intensity", values);
  setField(dataset, "label", labels);
  return dataset;
}

/** The points of files as bytes, in one order; without the normals that
 * uvol_isosurface took from points around them, where fits had none. */
std::vector<std::string>
sortedPoints(const std::vector<std::string>& paths)
{
  std::vector<std::string> points;
  for (const std::string& path : paths) {
    const Dataset dataset = pcl_uvol::loadDataset(path);
    const auto& cloud = dataset.cloud;
    const auto offsetOf = [&](const char* name) {
      return pcl_uvol::findField(cloud.fields, name)->offset;
    };
    for (std::size_t i = 0; i < cloud.width; ++i) {
      std::string point(
          reinterpret_cast<const char*>(&cloud.data[i * cloud.point_step]),
          cloud.point_step);
      float curvature;
      std::memcpy(&curvature, &point[offsetOf("mean_curvature")], sizeof(curvature));
      if (std::isnan(curvature))
        point.replace(offsetOf("normal_x"), 3 * sizeof(float), 12, '\0');
      points.push_back(point);
    }
  }
  std::sort(points.begin(), points.end());
  return points;
}

class IsosurfaceMpi : public testing::Test {
protected:
  void
  SetUp() override
  {
    if (!uvol_test::hasMpirun())
      GTEST_SKIP() << "there is no mpirun";
  }

  CommandResult
  run(std::size_t processes, const std::string& arguments) const
  {
    return runCommand("cd " + folder_ / "" + " && " + mpirun(processes) +
                      "uvol_isosurface_mpi " + arguments);
  }

  void
  expectSuccess(std::size_t processes, const std::string& arguments) const
  {
    const auto result = run(processes, arguments);
    EXPECT_EQ(0, result.exit_code) << arguments << ": " << result.err;
  }

  void
  runAlone(const std::string& arguments) const
  {
    const auto result =
        runCommand("cd " + folder_ / "" + " && uvol_isosurface " + arguments);
    ASSERT_EQ(0, result.exit_code) << arguments << ": " << result.err;
  }

  /** That error, and no file that was not there. */
  void
  expectError(std::size_t processes,
              const std::string& arguments,
              const std::string& code,
              const std::string& value = "") const
  {
    SCOPED_TRACE(arguments);
    const auto before = folder_.list();
    expectErrorOf(run(processes, arguments + " -json"), code, value);
    EXPECT_EQ(before, folder_.list());
  }

  static void
  expectErrorOf(CommandResult result, const std::string& code, const std::string& value)
  {
    // libevent in mpirun may say that it closed a file twice, with an empty line.
    result.err =
        std::regex_replace(result.err, std::regex("\\[warn\\] Epoll [^\n]*\n\n?"), "");
    uvol_test::expectError(result, code, value);
  }

  void
  save(const std::string& name, const Dataset& dataset) const
  {
    saveDataset(folder_ / name, dataset);
  }

  /** in_0.vtp, in_1.vtp, ... with the rows up to these ones. */
  void
  savePieces(const Dataset& dataset, const std::vector<std::size_t>& ends) const
  {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < ends.size(); begin = ends[i++])
      save("in_" + std::to_string(i) + ".vtp", rowsOf(dataset, begin, ends[i]));
  }

  std::vector<std::string>
  piecesOf(const std::string& name) const
  {
    return pcl_uvol::findPieces({folder_ / name});
  }

  uvol_test::TemporaryFolder folder_;
};

class IsosurfaceMpiOnShapes : public IsosurfaceMpi,
                              public testing::WithParamInterface<std::string> {};

TEST_P(IsosurfaceMpiOnShapes, WritesThePointsOfOneProcess)
{
  save("in.pcd", labelled(*uvol_test::makeCloud(GetParam(), 3000, 7)));
  const std::string options = " -iso 0.41234,0.2 -field intensity";
  runAlone("in.pcd alone.pcd -interpolation fit" + options);
  const auto expected = sortedPoints({folder_ / "alone.pcd"});
  EXPECT_LT(10u, expected.size());
  for (const std::size_t processes : {1, 2, 3, 4, 8}) {
    expectSuccess(processes, "in.pcd out.pvtp" + options);
    EXPECT_EQ(processes, piecesOf("out.pvtp").size());
    EXPECT_EQ(expected, sortedPoints(piecesOf("out.pvtp"))) << processes;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Clouds,
    IsosurfaceMpiOnShapes,
    testing::Values("uniform", "clustered", "lattice", "planar", "duplicates"),
    [](const auto& shape) { return shape.param; });

/** One file is written edge for edge as one process does. */
TEST_F(IsosurfaceMpi, WritesTheFileOfOneProcess)
{
  const auto dataset = labelled(*uvol_test::makeCloud("clustered", 5000, 2));
  save("in.ply", dataset);
  const std::string options =
      " -iso 0.3,0.45 -interpolation linear -criterion all -outside higher "
      "-scale 1,2,0.5 -field intensity -where \"label>=100\"";
  const auto expectSameFile = [&](std::size_t processes, const std::string& ending) {
    runAlone("in.ply alone" + ending + options + " -normals edge");
    expectSuccess(processes, "in.ply out" + ending + options + " -threads 2");
    EXPECT_EQ(uvol_test::readFile(folder_ / ("alone" + ending)),
              uvol_test::readFile(folder_ / ("out" + ending)))
        << ending;
  };
  for (const char* const ending : {".ply", ".pcd", ".csv", ".vtp"})
    for (const std::size_t processes : {1, 3})
      expectSameFile(processes, ending);
}

TEST_F(IsosurfaceMpi, TakesPiecesWhereverTheirPointsAre)
{
  const auto dataset = labelled(*uvol_test::makeCloud("uniform", 3000, 4));
  save("in.vtp", dataset);
  const std::string options = " out.pvtp -iso 0.4 -field intensity";
  runAlone("in.vtp alone.pcd -iso 0.4 -field intensity -interpolation fit");
  const auto expected = sortedPoints({folder_ / "alone.pcd"});
  const auto expectExpected = [&](std::size_t processes, const std::string& input) {
    expectSuccess(processes, input + options);
    EXPECT_EQ(expected, sortedPoints(piecesOf("out.pvtp"))) << input;
  };
  expectExpected(3, "in.vtp"); // all on one process
  savePieces(dataset, {100, 100, 1200, 1210, 3000});
  expectExpected(3, "in_0.vtp in_1.vtp in_2.vtp in_3.vtp in_4.vtp");
  expectExpected(8, "'in_*.vtp'"); // some processes without points
  expectSuccess(2, "in.vtp again.pvtp -iso 0.4 -field intensity");
  expectSuccess(4, "again.pvtp out.pvtp -iso 500 -field label");
}

TEST_F(IsosurfaceMpi, MergesDuplicatesAcrossProcesses)
{
  auto cloud = uvol_test::makeCloud("uniform", 1000, 4);
  const auto once = *cloud;
  *cloud += once;
  save("in.pcd", labelled(*cloud));
  runAlone("in.pcd alone.pcd -iso 0.4 -field intensity -interpolation fit");
  expectSuccess(4, "in.pcd out.pvtp -iso 0.4 -field intensity -json");
  EXPECT_EQ(sortedPoints({folder_ / "alone.pcd"}), sortedPoints(piecesOf("out.pvtp")));
}

TEST_F(IsosurfaceMpi, TakesMoreProcessesThanSamples)
{
  save("in.csv", labelled(*uvol_test::makeCloud("uniform", 5, 4)));
  runAlone("in.csv alone.csv -iso 0.4 -field intensity -interpolation linear "
           "-normals edge");
  expectSuccess(8, "in.csv out.csv -iso 0.4 -field intensity -interpolation linear");
  EXPECT_EQ(uvol_test::readFile(folder_ / "alone.csv"),
            uvol_test::readFile(folder_ / "out.csv"));
}

TEST_F(IsosurfaceMpi, KeepsLargeCoordinates)
{
  auto dataset = labelled(*uvol_test::makeCloud("uniform", 500, 4));
  dataset.origin = {{4194304.0, 8388608.0, 0.0}};
  dataset.double_coordinates = true;
  save("in.csv", dataset);
  const std::string options = ".csv -iso 0.4 -field intensity -interpolation linear";
  runAlone("in.csv alone" + options + " -normals edge");
  expectSuccess(3, "in.csv out" + options);
  EXPECT_EQ(uvol_test::readFile(folder_ / "alone.csv"),
            uvol_test::readFile(folder_ / "out.csv"));
}

TEST_F(IsosurfaceMpi, SeesAcrossTheFacesOfABox)
{
  auto dataset = labelled(*uvol_test::makeCloud("uniform", 3000, 4));
  save("in.csv", dataset);
  for (const std::string box : {"1,1,1", "0,1.02,0", "1,0,1 -scale 1,2,0.5"}) {
    const std::string options =
        " -iso 0.3,0.6 -field intensity -interpolation fit -periodic " + box;
    runAlone("in.csv alone.csv -normals edge" + options);
    runAlone("in.csv alone.pcd -normals edge" + options);
    const std::string alone = uvol_test::readFile(folder_ / "alone.csv");
    EXPECT_LT(500, std::count(alone.begin(), alone.end(), '\n'));
    for (const std::size_t processes : {1, 3}) {
      expectSuccess(processes, "in.csv out.csv" + options + " -threads 2");
      EXPECT_EQ(alone, uvol_test::readFile(folder_ / "out.csv")) << box;
    }
    expectSuccess(3, "in.csv out.pvtp" + options);
    EXPECT_EQ(sortedPoints({folder_ / "alone.pcd"}),
              sortedPoints(piecesOf("out.pvtp")));
  }
  const auto told =
      run(3, "in.csv out.csv -iso 0.3 -field intensity -json -periodic 1,1,1");
  EXPECT_EQ((std::vector<double>{1.0, 1.0, 1.0}),
            nlohmann::json::parse(told.out).at("periodic_box").at("sides"))
      << told.out;
}

TEST_F(IsosurfaceMpi, TakesTheBoxOfAFile)
{
  uvol_test::GadgetLayout layout;
  layout.here[0] = layout.total[0] = 500;
  layout.box = 101.0;
  uvol_test::writeFile(folder_ / "snap", uvol_test::makeGadget(layout));
  const std::string options = " -field '|VEL|' -iso 200 -interpolation fit";
  runAlone("snap alone.csv -normals edge -periodic header" + options);
  expectSuccess(2, "snap out.csv -periodic header" + options);
  EXPECT_EQ(uvol_test::readFile(folder_ / "alone.csv"),
            uvol_test::readFile(folder_ / "out.csv"));
  EXPECT_TRUE(
      uvol_test::hasMessage(run(2, "snap out.csv -json" + options), "box_in_file"));
}

TEST_F(IsosurfaceMpi, SpeaksWithOneVoice)
{
  save("in.pcd", labelled(*uvol_test::makeCloud("uniform", 500, 4)));
  const auto help = run(3, "-h");
  EXPECT_EQ(help.out.find("Usage:"), help.out.rfind("Usage:"));
  const std::string empty = "in.pcd out.pvtp -iso 40 -field intensity";
  const auto result = uvol_test::succeeded(run(3, empty));
  const auto report = nlohmann::json::parse(run(3, empty + " -json").out);
  EXPECT_EQ(3, report.at("processes"));
  EXPECT_EQ(std::vector<int>{0}, report.at("isopoints_per_isovalue"));
  EXPECT_TRUE(uvol_test::hasWarning(report, "no_isopoints"));
  EXPECT_EQ(result.out.find("isopoints per"), result.out.rfind("isopoints per"));
  EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
  EXPECT_EQ(std::string::npos, result.out.find('\033'));
  EXPECT_EQ(std::string::npos, result.out.find("bytes")); // these are for -v
  const auto verbose = uvol_test::succeeded(
      run(2, "in.pcd out.pvtp -iso 0.4 -field intensity -progress -v"));
  EXPECT_NE(std::string::npos, verbose.out.find("bytes_redistributed"));
}

TEST_F(IsosurfaceMpi, CountsIsopointsOfEachIsovalue)
{
  save("in.pcd", labelled(*uvol_test::makeCloud("uniform", 3000, 4)));
  const auto countsOf = [](const CommandResult& result) {
    return nlohmann::json::parse(result.out)
        .at("isopoints_per_isovalue")
        .get<std::vector<int>>();
  };
  const std::string options = " -json -iso 0.3,0.4,40 -field intensity";
  const auto alone = countsOf(runCommand(
      "cd " + folder_ / "" + " && uvol_isosurface in.pcd alone.pcd" + options));
  ASSERT_EQ(3u, alone.size());
  EXPECT_LE(10, std::min(alone[0], alone[1]));
  EXPECT_EQ(0, alone[2]);
  EXPECT_EQ(alone, countsOf(run(3, "in.pcd out.pvtp" + options)));
  EXPECT_EQ(alone, countsOf(run(2, "in.pcd out.pcd" + options)));
}

TEST_F(IsosurfaceMpi, EndsWithOneSentenceAndNoOutput)
{
  const auto dataset = labelled(*uvol_test::makeCloud("uniform", 300, 4));
  save("in.pcd", dataset);
  savePieces(dataset, {100, 200, 300});
  const std::string options = " out.pvtp -field intensity -iso 0.4";
  expectError(3, "in.pcd out.pvtp -field intensity", "command_line", "-iso");
  expectError(3, "in.pcd" + options + " -scale auto", "command_line", "-scale auto");
  expectError(3, "in.pcd" + options + " -scale 1,0,1", "command_line", "-scale");
  expectError(3, "in.pcd" + options + " -periodic 0,0,0", "command_line", "-periodic");
  expectError(3, "in.pcd" + options + " -periodic -1,1,1", "command_line", "-periodic");
  expectError(3, "in.pcd" + options + " -periodic header", "no_box_in_file");
  expectError(3, "none.pcd" + options, "no_such_file", "none.pcd");
  expectError(3, "'none_*.vtp'" + options, "no_matching_file", "none_*.vtp");
  expectError(
      3, "in.pcd out.pvtp -iso 0.4 -field speed", "unknown_lone_field", "\"speed\"");
  expectError(3, "in.pcd none/out.pvtp -iso 0.4", "no_folder", "none");
  expectError(3, "in.pcd out.doc -iso 0.4", "unwritten_ending", "out.doc");
  expectError(
      3, "in.pcd" + options + " -where 'label<0'", "no_points_where", "label<0");

  const std::string whole = uvol_test::readFile(folder_ / "in_1.vtp");
  uvol_test::writeFile(folder_ / "in_1.vtp", whole.substr(0, whole.size() / 2));
  expectError(3, "'in_*.vtp'" + options, "missing_part", "in_1.vtp");
  Dataset other = rowsOf(dataset, 100, 200);
  setField(other, "more", std::vector<float>(100));
  save("in_1.vtp", other);
  expectError(3, "'in_*.vtp'" + options, "pieces_of_other_fields", "in_1.vtp");
  std::filesystem::remove(folder_ / "in_1.vtp");
  expectError(2, "in_0.vtp in_1.vtp in_2.vtp" + options, "no_such_file", "in_1.vtp");
  std::filesystem::create_directory(folder_ / "out_1.vtp");
  expectError(3, "in.pcd" + options, "is_directory", "out_1.vtp");
}

/** One process of three meets a fault of the library of faults; mpirun ends the others,
 * in the midst of it. */
class FaultsOfARank : public IsosurfaceMpi {
protected:
  void
  SetUp() override
  {
    IsosurfaceMpi::SetUp();
    if (uvol_test::isSanitized())
      GTEST_SKIP() << "a sanitizer has to be loaded first";
    save("in.pcd", labelled(*uvol_test::makeCloud("uniform", 3000, 4)));
  }

  CommandResult
  runWith(const std::string& faults, const std::string& options = "") const
  {
    const std::string arguments =
        "uvol_isosurface_mpi in.pcd out.pvtp -iso 0.4 -field intensity" + options;
    return runCommand("cd " + folder_ / "" + " && env " + mpirun(2, 30) + arguments +
                      " : -np 1 env LD_PRELOAD=" PCL_UVOL_FAULTS " UVOL_FAULTS=" +
                      faults + ' ' + arguments);
  }

  /** How often that process calls it. */
  long
  countCalls(const std::string& call) const
  {
    const std::string file = folder_ / "counts";
    EXPECT_EQ(0, runWith("count=" + file).exit_code);
    std::istringstream words(uvol_test::readFile(file));
    std::string word;
    long count = 0;
    while (word != call && words >> word >> count)
      ;
    for (const std::string& name : folder_.list())
      if (name != "in.pcd")
        std::filesystem::remove(folder_ / name);
    return count;
  }

  /** Processes that live: those that mpirun has not asked for have no folder. */
  long
  countRanks() const
  {
    namespace fs = std::filesystem;
    const fs::directory_iterator processes("/proc");
    return std::count_if(begin(processes), end(processes), [this](const auto& entry) {
      std::error_code gone;
      std::string name;
      std::ifstream in(entry.path() / "comm");
      return fs::read_symlink(entry.path() / "cwd", gone) / "" == folder_ / "" &&
             std::getline(in, name) && name == "uvol_isosurface";
    });
  }

  /** Whether all ranks end within 30 s: mpirun 4.1 may wait for a lock of its own
   * afterwards, where one was killed while MPI began. */
  bool
  ranksEnd(const std::future<CommandResult>& job) const
  {
    bool have_begun = false;
    for (int tenths = 0; tenths < 300; ++tenths) {
      if (job.wait_for(std::chrono::milliseconds(100)) == std::future_status::ready)
        return true;
      const bool live = countRanks() > 0;
      if (have_begun && !live)
        return true;
      have_begun |= live;
    }
    return false;
  }

  /** Ends within 30 s and leaves nothing, or all where it had done its work.
   * \param moments spread over the calls of malloc */
  void
  meetAtMoments(const std::string& what, int moments, double first) const
  {
    const auto calls = static_cast<double>(countCalls("malloc"));
    for (int i = 0; i < moments; ++i) {
      const auto at = static_cast<long>(calls * (first + (0.98 - first) * i / moments));
      SCOPED_TRACE(at);
      auto job = std::async(std::launch::async, [&] {
        return runWith("malloc:" + std::to_string(at) + what);
      });
      EXPECT_TRUE(ranksEnd(job));
      EXPECT_NE(0, job.get().exit_code);
      // Nothing, or all: the list, and a piece of each process.
      const auto left = folder_.list();
      EXPECT_TRUE(left.size() == 1 || left.size() == 5) << left.size();
      for (const std::string& name : left)
        if (name != "in.pcd")
          std::filesystem::remove(folder_ / name);
    }
  }
};

TEST_F(FaultsOfARank, KilledItLeavesNothing)
{
  meetAtMoments(":9", 1, 0.9);
}

TEST_F(FaultsOfARank, KilledItLeavesNothing_long)
{
  meetAtMoments(":9", 20, 0.02);
}

TEST_F(FaultsOfARank, AFullDiskIsOneSentence)
{
  expectErrorOf(runWith("write:1+", " -json"), "full_disk", "out_");
  EXPECT_EQ(std::vector<std::string>{"in.pcd"}, folder_.list());
}

} // namespace test_uvol_isosurface_mpi
