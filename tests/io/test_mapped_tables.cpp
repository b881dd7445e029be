// SPDX-License-Identifier: BSD-3-Clause
// Tables and surfaces with longitude and latitude, put on a map.
#include "io/formats.h"
#include "io/point_stream.h"
#include "support/environment.h"
#include "support/messages.h"
#include "tools/tool_test.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace test_mapped_tables {

using namespace pcl_uvol;
using uvol_test::fieldOf;
using uvol_test::numberOf;
using uvol_test::wordOf;

class MappedTables : public uvol_test::FolderTest {
protected:
  Dataset
  load(const std::string& text, const LoadOptions& options) const
  {
    write("a.csv", text);
    return loadDataset(folder_ / "a.csv", options);
  }
};

LoadOptions
onMap(const MapProjection& map)
{
  LoadOptions options;
  options.map = map;
  return options;
}

const std::string table = "lat,lon_deg,depth_m,T\n"
                          "-42,179,10,5\n-43,-179,20,6\n-42.5,180,30,7\n";

TEST_F(MappedTables, KeepDegreesWithoutAMap)
{
  const Dataset points = load(table, {});
  EXPECT_FALSE(findMap(points));
  EXPECT_EQ((std::vector<double>{179.0, -179.0, 180.0}), fieldOf(points, "x"));
  EXPECT_EQ((std::vector<double>{10.0, 20.0, 30.0}), fieldOf(points, "z"));
  ASSERT_EQ(1u, points.notes.size());
  EXPECT_EQ(Message("mixed_units",
                    {{"x", "lon_deg"},
                     {"y", "lat"},
                     {"z", "depth_m"},
                     {"are_degrees", 1},
                     {"can_be_mapped", 1}}),
            points.notes[0]);
  EXPECT_NE(std::string::npos,
            points.notes[0].text(ParameterNames::Options).find("-map auto"));
  EXPECT_NE(std::string::npos, points.notes[0].text().find("map=auto"));
}

TEST_F(MappedTables, AreMappedAroundTheirMedian)
{
  const Dataset points = load(table, onMap({}));
  const auto map = findMap(points);
  ASSERT_TRUE(map);
  EXPECT_EQ(180.0, std::abs(map->longitude));
  EXPECT_EQ(-42.5, map->latitude);
  EXPECT_EQ(1.0, map->per_kilometre);
  const auto x = fieldOf(points, "x"), y = fieldOf(points, "y");
  EXPECT_NEAR(-81.98, x[0], 0.01);
  EXPECT_NEAR(81.98, x[1], 0.01);
  EXPECT_EQ(0.0, x[2]);
  EXPECT_NEAR(55.597, y[0], 0.001);
  EXPECT_EQ((std::vector<double>{-10.0, -20.0, -30.0}), fieldOf(points, "z"));
  for (const char* const name : {"lat", "lon_deg", "depth_m", "T"})
    EXPECT_NO_THROW(fieldOf(points, name)) << name;
  ASSERT_EQ(1u, points.notes.size());
  EXPECT_EQ(Message("mapped_positions",
                    {{"longitude", "180 E"},
                     {"latitude", "42.5 S"},
                     {"in_metres", 0},
                     {"gives_z", 0},
                     {"z", ""}}),
            points.notes[0]);
}

TEST_F(MappedTables, AreMappedAroundAGivenOrigin)
{
  LoadOptions options = onMap({179.0, -42.0, 1000.0});
  const Dataset points = load(table, options);
  EXPECT_EQ(options.map->toText(), findMap(points)->toText());
  EXPECT_EQ(0.0, fieldOf(points, "x")[0]);
  EXPECT_EQ(0.0, fieldOf(points, "y")[0]);
  EXPECT_NEAR(-111195.0, fieldOf(points, "y")[1], 1.0);
  // Chosen columns count as degrees by their names.
  options.xyz_columns = {{"lon_deg", "lat", "T"}};
  EXPECT_EQ(0.0, fieldOf(load(table, options), "x")[0]);
  EXPECT_EQ(7.0, fieldOf(load(table, options), "z")[2]);
  options.xyz_columns = {{"T", "lat", "depth_m"}};
  EXPECT_EQ(5.0, fieldOf(load(table, options), "x")[0]);
}

TEST_F(MappedTables, AreTheSameInBlocks)
{
  write("a.csv", table);
  const Dataset whole = loadDataset(folder_ / "a.csv", onMap({}));
  PointStream stream(folder_ / "a.csv", onMap({}));
  Dataset streamed = stream.getHeader();
  EXPECT_EQ(whole.cloud.header.frame_id, streamed.cloud.header.frame_id);
  EXPECT_EQ(whole.notes, streamed.notes);
  stream.read(3, streamed.cloud);
  ASSERT_EQ(3u, streamed.cloud.width);
  for (const char* const name : {"x", "y", "z", "lat", "lon_deg", "T"})
    EXPECT_EQ(fieldOf(whole, name), fieldOf(streamed, name)) << name;
}

TEST_F(MappedTables, OtherCoordinatesStayAsTheyAre)
{
  for (const char* const header : {"x,y,z,T", "lon_rad,lat_rad,depth,T"}) {
    const Dataset points =
        load(std::string(header) + "\n1,2,3,4\n2,3,4,5\n", onMap({1.0, 2.0, 1.0}));
    EXPECT_FALSE(findMap(points)) << header;
    EXPECT_EQ((std::vector<double>{1.0, 2.0}), fieldOf(points, "x")) << header;
  }
}

TEST_F(MappedTables, DegreesComeBeforeOtherCoordinates)
{
  const std::string both = "x,y,z,lon,lat\n7,8,9,1,2\n7,8,9,1,2\n";
  EXPECT_EQ(7.0, fieldOf(load(both, {}), "x")[0]);
  const Dataset points = load(both, onMap({1.0, 2.0, 1.0}));
  EXPECT_EQ(0.0, fieldOf(points, "x")[0]);
  EXPECT_EQ(9.0, fieldOf(points, "z")[0]);
}

/** Positions in a box of 1 x 1 degree, and fixes at (0, 0). */
std::string
makeFixes(std::size_t positions, std::size_t lost)
{
  std::ostringstream text;
  text << "lon,lat,depth,T\n";
  for (std::size_t i = 0; i < positions + lost; ++i)
    if (i < lost)
      text << "0,0,10," << i << '\n';
    else
      text << 8.0 + 0.01 * static_cast<double>(i * 37 % 101) << ','
           << -43.0 + 0.01 * static_cast<double>(i * 53 % 101) << ",10," << i << '\n';
  return text.str();
}

TEST_F(MappedTables, FewFixesAtZeroDoNotMoveTheOrigin)
{
  const auto without = findMap(load(makeFixes(2000, 0), onMap({})));
  ASSERT_TRUE(without);
  EXPECT_EQ(8.5, without->longitude);
  EXPECT_EQ(-42.5, without->latitude);
  for (const std::size_t lost : {1u, 2u, 3000u}) {
    const Dataset points = load(makeFixes(2000, lost), onMap({}));
    const auto map = findMap(points);
    EXPECT_NEAR(without->longitude, map->longitude, 0.02) << lost;
    EXPECT_NEAR(without->latitude, map->latitude, 0.02) << lost;
    EXPECT_EQ(1.0, map->per_kilometre);
    ASSERT_EQ(2u, points.notes.size()) << lost;
    const Message& note = points.notes[1];
    EXPECT_EQ("far_positions", note.code);
    EXPECT_EQ(static_cast<double>(lost), numberOf(note, "far"));
    EXPECT_EQ(static_cast<double>(2000 + lost), numberOf(note, "positions"));
    EXPECT_EQ("0 E", wordOf(note, "longitude"));
    EXPECT_EQ("0 N", wordOf(note, "latitude"));
    EXPECT_NEAR(4750.0, numberOf(note, "distance"), 50.0);
    EXPECT_EQ("lat", wordOf(note, "field"));
    EXPECT_EQ(0.0, numberOf(note, "degrees"));
    EXPECT_NE(std::string::npos,
              note.text(ParameterNames::Options).find("-where \"lat != 0\""));
  }
}

TEST_F(MappedTables, PositionsThatAreNoneHaveNoSay)
{
  const Dataset points = load(
      "lon,lat,depth,T\n8,-42,1,1\nnan,nan,1,1\n9,-42,1,1\n9999,9999,1,1\n", onMap({}));
  EXPECT_EQ(8.5, findMap(points)->longitude);
  EXPECT_EQ(-42.0, findMap(points)->latitude);
  const Dataset none = load("lon,lat,depth,T\nnan,nan,1,1\n", onMap({}));
  EXPECT_EQ(0.0, findMap(none)->longitude);
  EXPECT_EQ(0u, load("lon,lat,depth,T\n", onMap({})).cloud.width);
}

TEST_F(MappedTables, SurfacesSayWhichMapTheyAreOn)
{
  Dataset points = load(table, onMap({}));
  const auto map = findMap(points);
  for (const char* const name : {"b.ply", "b.vtp", "b.csv", "b.pcd"}) {
    saveDataset(folder_ / name, points);
    const Dataset read = loadDataset(folder_ / name);
    ASSERT_TRUE(findMap(read)) << name;
    EXPECT_EQ(map->toText(), findMap(read)->toText()) << name;
    EXPECT_EQ(fieldOf(points, "x"), fieldOf(read, "x")) << name;
    const Dataset other = loadDataset(folder_ / name, onMap({179.0, -42.0, 1000.0}));
    EXPECT_NEAR(0.0, fieldOf(other, "x")[0], 1e-3) << name;
    EXPECT_NEAR(0.0, fieldOf(other, "y")[0], 1e-3) << name;
    EXPECT_EQ(fieldOf(points, "z"), fieldOf(other, "z")) << name;
  }
  setField(points, "lat", std::vector<float>{1.0f, 2.0f, 4.0f}); // of something else
  saveDataset(folder_ / "c.ply", points);
  EXPECT_FALSE(findMap(loadDataset(folder_ / "c.ply")));
}

TEST_F(MappedTables, OptionsOfOtherFormatsAreLeftOut)
{
  write("a.csv", table);
  LoadOptions options;
  options.xyz_columns = {{"0", "1", "2"}};
  EXPECT_EQ(options.xyz_columns,
            io::adaptOptions(folder_ / "a.csv", options).xyz_columns);
  saveDataset(folder_ / "b.ply", loadDataset(folder_ / "a.csv"));
  EXPECT_EQ(LoadOptions().xyz_columns,
            io::adaptOptions(folder_ / "b.ply", options).xyz_columns);
  options.cells = true;
  options.particles = "gas";
  const LoadOptions adapted = io::adaptOptions(folder_ / "b.ply", options);
  EXPECT_FALSE(adapted.cells);
  EXPECT_TRUE(adapted.particles.empty());
}

} // namespace test_mapped_tables
