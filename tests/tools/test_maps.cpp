// SPDX-License-Identifier: BSD-3-Clause
// One coordinate system for all files of a command, and degrees of what it writes.
#include "support/environment.h"
#include "support/messages.h"
#include "tools/json_warnings.h"
#include "tools/tool_test.h"
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace test_maps {

using namespace pcl_uvol;
using uvol_test::fieldOf;

/** A table of a temperature that falls with the depth, in a box of half a degree. */
std::string
makeTable(double east, double north, std::size_t count)
{
  std::ostringstream text;
  text << std::setprecision(10) << "lon,lat,depth,T\n";
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = [&](std::size_t step) {
      return static_cast<double>(i * step % 997) / 997.0;
    };
    const double depth = 100.0 * part(211);
    text << east + 0.5 * part(379) << ',' << north + 0.5 * part(617) << ',' << depth
         << ',' << 20.0 - 0.1 * depth << '\n';
  }
  return text.str();
}

class Maps : public uvol_test::FolderTest {
protected:
  std::string
  runWell(const std::string& arguments) const
  {
    const auto result = runTool(arguments);
    EXPECT_EQ(0, result.exit_code) << arguments << ": " << result.err;
    return result.out + result.err;
  }

  Dataset
  load(const std::string& name) const
  {
    return loadDataset(folder_ / name);
  }
};

/** A table of positions that a data set has. */
std::string
makeQueries(const Dataset& samples, const char* east, const char* north)
{
  const auto longitude = fieldOf(samples, east), latitude = fieldOf(samples, north),
             z = fieldOf(samples, "z");
  std::ostringstream text;
  text << std::setprecision(17) << "longitude,latitude,depth\n";
  for (std::size_t i = 0; i < longitude.size(); i += longitude.size() / 50)
    if (std::isfinite(longitude[i] + latitude[i] + z[i]))
      text << longitude[i] << ',' << latitude[i] << ',' << -z[i] << '\n';
  return text.str();
}

TEST_F(Maps, QueriesComeOntoTheMapOfTheSamples)
{
  write("a.csv", makeTable(8.0, -43.0, 900));
  write("b.csv", "lon,lat,depth\n8.1,-42.9,40\n8.4,-42.6,60\n");
  runWell("probe a.csv out.csv -map auto -scale auto -field T -points b.csv");
  const Dataset out = load("out.csv");
  const auto values = fieldOf(out, "T"), z = fieldOf(out, "z");
  ASSERT_EQ(2u, values.size());
  EXPECT_NEAR(16.0, values[0], 0.1);
  EXPECT_NEAR(14.0, values[1], 0.1);
  EXPECT_EQ((std::vector<double>{-40.0, -60.0}), z);
  EXPECT_NEAR(8.1, fieldOf(out, "lon")[0], 1e-6);
  EXPECT_NEAR(8.4, fieldOf(out, "lon")[1], 1e-6);
}

TEST_F(Maps, SurfacesSlicesAndGridsHaveDegrees)
{
  write("a.csv", makeTable(179.75, -43.0, 900));
  const std::string options = " -map auto -scale auto -field T";
  runWell("isosurface a.csv out.ply -iso 15" + options);
  runWell("probe a.csv line.csv -line -10,-10,-50,10,10,-50 -n 5" + options);
  runWell("probe a.csv plane.vti -plane z=-50 -size 8" + options);
  for (const char* const name : {"out.ply", "line.csv"}) {
    const Dataset points = load(name);
    const auto map = findMap(points);
    ASSERT_TRUE(map) << name;
    const bool is_surface = name[0] == 'o';
    const auto east = fieldOf(points, is_surface ? "lon" : "longitude"),
               north = fieldOf(points, is_surface ? "lat" : "latitude"),
               x = fieldOf(points, "x"), y = fieldOf(points, "y");
    ASSERT_FALSE(east.empty());
    for (std::size_t i = 0; i < east.size(); ++i) {
      const auto place = map->toGlobe(x[i], y[i]);
      EXPECT_NEAR(0.0, std::remainder(place[0] - east[i], 360.0), 1e-6);
      EXPECT_NEAR(place[1], north[i], 1e-6);
      EXPECT_LE(std::abs(std::remainder(east[i] - 180.0, 360.0)), 0.26); // not at 0
    }
  }
  const std::string plane = uvol_test::readFile(folder_ / "plane.vti");
  for (const char* const name : {"\"longitude\"", "\"latitude\""})
    EXPECT_NE(std::string::npos, plane.find(name)) << name;
}

TEST_F(Maps, FilesOfASeriesAreOnOneMap)
{
  write("a_1.csv", makeTable(8.0, -43.0, 300));
  write("a_2.csv", makeTable(9.0, -42.0, 300));
  runWell("convert 'a_{}.csv' 'b_{}.vtp' -map auto");
  const auto first = findMap(load("b_1.vtp")), second = findMap(load("b_2.vtp"));
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->toText(), second->toText());
  EXPECT_NEAR(8.25, first->longitude, 0.02);
  runWell("convert a_2.csv c.vtp -map 8,-43,m");
  EXPECT_EQ("+proj=eqc +lon_0=8 +lat_0=-43 +lat_ts=-43 +R=6371008.8 +units=m",
            findMap(load("c.vtp"))->toText());
}

TEST_F(Maps, SurfacesOnDifferentMapsAreCompared)
{
  write("a.csv", makeTable(8.0, -43.0, 900));
  const std::string options = " -iso 15 -scale 1,1,1000 -field T -map ";
  runWell("isosurface a.csv b.ply" + options + "8.25,-42.75,km");
  runWell("isosurface a.csv c.ply" + options + "8.2,-42.75,km");
  EXPECT_NEAR(
      4.08, fieldOf(load("c.ply"), "x")[0] - fieldOf(load("b.ply"), "x")[0], 0.01);
  runWell("compare b.ply c.ply d.csv");
  for (const double distance : fieldOf(load("d.csv"), "distance"))
    EXPECT_LT(std::abs(distance), 1e-3);
}

TEST_F(Maps, WarnsOfFilesInDifferentSystems)
{
  write("a.csv", "x,y,z,T\n0,0,0,1\n1,0,0,2\n0,1,0,3\n0,0,1,4\n1,1,1,5\n");
  EXPECT_TRUE(
      uvol_test::hasMessage(runTool("info a.csv -map auto -json"), "no_longitudes"));
}

/** A user's names of columns need not be those that are recognised. */
TEST_F(Maps, WarnsOfQueriesThatMayBeDegrees)
{
  write("a.csv", makeTable(8.0, -43.0, 900));
  const std::string query = "\n8.1,-42.9,-40\n";
  write("b.csv", "x,y,z" + query);
  const std::string heard =
      runWell("probe a.csv out.csv -map auto -scale auto -field T -points b.csv -json");
  EXPECT_NE(std::string::npos, heard.find("\"not_on_map\"")) << heard;
}

TEST_F(Maps, RefusesMapsThatAreNone)
{
  write("a.csv", makeTable(8.0, -43.0, 20));
  for (const char* const map :
       {"8", "8,-43,ft", "8,-43,m,", "8,91", "a,b", "nan,1", ","})
    expectError("convert a.csv b.ply -map " + std::string(map), "command_line", "-map");
}

/** A file of the collection beside the real data; "": it is not there. */
std::string
findForeignFile(const std::string& name)
{
  const std::string data = uvol_test::dataFolder();
  const std::string path = data.empty() ? "" : data + "/../wild/" + name;
  return !path.empty() && std::filesystem::exists(path) ? path : "";
}

TEST_F(Maps, ValuesAtPositionsOfAGlider)
{
  const std::string glider = findForeignFile("real/pyglider_eva035_timeseries.nc");
  if (glider.empty())
    GTEST_SKIP() << "the file of a glider is not there ($PCL_UVOL_DATA)";
  write("b.csv", makeQueries(loadDataset(glider), "longitude", "latitude"));
  runWell("probe '" + glider +
          "' out.csv -field temperature -scale auto -points b.csv");
  const auto values = fieldOf(load("out.csv"), "temperature");
  ASSERT_GE(values.size(), 45u);
  std::size_t found = 0;
  for (const double value : values)
    found += std::isfinite(value);
  EXPECT_GE(10 * found, 9 * values.size());
}

/** A track of a glider that crosses the isotherm 22 times, between depths of 67 and 86
 * m. */
class GliderIsotherm : public Maps {
protected:
  void
  SetUp() override
  {
    glider_ = findForeignFile("real/pyglider_eva035_timeseries.nc");
    if (glider_.empty())
      GTEST_SKIP() << "the file of a glider is not there ($PCL_UVOL_DATA)";
  }

  /** The isopoints are in out.csv. */
  nlohmann::json
  extract(const std::string& options) const
  {
    const auto result = uvol_test::succeeded(
        runTool("isosurface '" + glider_ +
                "' out.csv -field temperature -iso 8 -json " + options));
    return nlohmann::json::parse(result.out);
  }

  /** How many isopoints there are. */
  std::size_t
  expectAtTheIsotherm() const
  {
    const auto heights = fieldOf(load("out.csv"), "z");
    for (const double z : heights) {
      EXPECT_LT(-93.0, z);
      EXPECT_GT(-66.0, z);
    }
    return heights.size();
  }

  std::string glider_;
};

TEST_F(GliderIsotherm, HasNoIsopointThatMayBeAnywhere)
{
  const auto report = extract("");
  EXPECT_GE(expectAtTheIsotherm(), 22u);
  EXPECT_GT(report["counts"]["unlocated"], 0);
  EXPECT_TRUE(uvol_test::hasWarning(report, "unlocated_isopoints"));
}

TEST_F(GliderIsotherm, KeepsCrossingsWhereSamplesAreFarApart)
{
  extract("-scale auto -max-error auto");
  EXPECT_GE(expectAtTheIsotherm(), 10u);
}

TEST_F(GliderIsotherm, EndsHalfAGapOutsideOfTheHull)
{
  const auto report = extract("-fill-gaps");
  EXPECT_GE(expectAtTheIsotherm(), 100u);
  const double half_gap = 0.5 * report["gaps"]["width"].get<double>();
  const Dataset samples = loadDataset(glider_), isopoints = load("out.csv");
  // By supporting planes, in the space where gaps are measured.
  for (int angle = 0; angle < 360; ++angle) {
    const double radians = angle * std::acos(-1.0) / 180.0;
    const auto farthest = [&](const Dataset& points) {
      const auto x = fieldOf(points, "x"), y = fieldOf(points, "y");
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < x.size(); ++i)
        most =
            std::fmax(most,
                      x[i] * report["scale"][0].get<double>() * std::cos(radians) +
                          y[i] * report["scale"][1].get<double>() * std::sin(radians));
      return most;
    };
    EXPECT_LE(farthest(isopoints), farthest(samples) + half_gap) << angle;
  }
}

TEST_F(Maps, TwoLostFixesDoNotChangeAVolume)
{
  const std::string good = findForeignFile("made/zz_ok.nc"),
                    two = findForeignFile("made/zz_two.nc");
  if (good.empty() || two.empty())
    GTEST_SKIP() << "the files are not there ($PCL_UVOL_DATA)";
  const auto origin = [](const std::string& path) {
    const Dataset samples = loadDataset(path);
    return std::pair(*findMap(samples), samples.notes);
  };
  const auto [map, notes] = origin(good);
  const auto [moved, with] = origin(two);
  EXPECT_NEAR(map.longitude, moved.longitude, 0.01);
  EXPECT_NEAR(map.latitude, moved.latitude, 0.01);
  EXPECT_EQ(map.per_kilometre, moved.per_kilometre);
  EXPECT_EQ(notes.size() + 1, with.size());
  EXPECT_EQ("far_positions", with[1].code);
  EXPECT_EQ(2.0, uvol_test::numberOf(with[1], "far"));
  EXPECT_EQ(1200.0, uvol_test::numberOf(with[1], "positions"));
}

} // namespace test_maps
