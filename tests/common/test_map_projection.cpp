// SPDX-License-Identifier: BSD-3-Clause
// Positions on the globe and on a map, against spherical distances.
#include "common/scalar_field.h"
#include <pcl_uvol/common/map_projection.h>

#include <gtest/gtest.h>

#include <cmath>

namespace test_map_projection {

using namespace pcl_uvol;

constexpr double radians = 3.14159265358979323846 / 180.0;

/** Kilometres along a great circle. */
double
greatCircle(double east, double north, double other_east, double other_north)
{
  const double part = std::pow(std::sin(0.5 * (other_north - north) * radians), 2.0) +
                      std::cos(north * radians) * std::cos(other_north * radians) *
                          std::pow(std::sin(0.5 * (other_east - east) * radians), 2.0);
  return 2.0 * 6371.0088 * std::asin(std::sqrt(part));
}

TEST(MapProjection, KeepsDistancesFromItsOrigin)
{
  const MapProjection map{8.5, -42.5, 1.0};
  for (const auto& [east, north] : {std::pair(8.6, -42.5), std::pair(8.5, -42.4)}) {
    const auto at = map.toMap(east, north);
    EXPECT_NEAR(greatCircle(8.5, -42.5, east, north), std::hypot(at[0], at[1]), 1e-4);
  }
  EXPECT_EQ(1000.0 * map.toMap(8.6, -42.4)[0],
            (MapProjection{8.5, -42.5, 1000.0}.toMap(8.6, -42.4)[0]));
}

TEST(MapProjection, ComesBackAcross180Degrees)
{
  const MapProjection map{179.5, 60.0, 1000.0};
  for (const double east : {179.0, -179.0, 181.0}) {
    const auto at = map.toMap(east, 61.0);
    EXPECT_LT(std::abs(at[0]), 1e5) << east;
    const auto place = map.toGlobe(at[0], at[1]);
    EXPECT_NEAR(std::remainder(east, 360.0), place[0], 1e-12) << east;
    EXPECT_NEAR(61.0, place[1], 1e-12);
  }
}

TEST(MapProjection, ComesBackFromItsText)
{
  const MapProjection map{-71.123456, 41.0, 1000.0};
  EXPECT_EQ("+proj=eqc +lon_0=-71.123456 +lat_0=41 +lat_ts=41 +R=6371008.8 +units=m",
            map.toText());
  const auto read = MapProjection::fromText(map.toText());
  ASSERT_TRUE(read);
  EXPECT_EQ(map.longitude, read->longitude);
  EXPECT_EQ(map.latitude, read->latitude);
  EXPECT_EQ(map.per_kilometre, read->per_kilometre);
  for (const char* const other :
       {"",
        "base_link",
        "+proj=merc +lon_0=1 +lat_0=2 +units=m",
        "+proj=eqc +lon_0=a +lat_0=41 +lat_ts=41 +R=6371008.8 +units=m",
        "+proj=eqc +lon_0=1 +lat_0=41 +lat_ts=41 +R=6378137 +units=m"})
    EXPECT_FALSE(MapProjection::fromText(other)) << other;
}

Dataset
makePoints()
{
  Dataset points;
  setCoordinates(points, {0.0, 0.0, -5.0, 1.0, 2.0, -10.0});
  return points;
}

TEST(MapProjection, GivesPointsTheirLongitudeAndLatitude)
{
  Dataset points = makePoints();
  setGlobeFields(points);
  EXPECT_FALSE(findGlobeFields(points.cloud.fields)); // they are on no map
  const MapProjection map{8.5, -42.5, 1.0};
  setMap(points, map);
  setField(points, "LONGITUDE", std::vector<float>{0.0f, 0.0f}); // of no use
  setField(points, "LATITUDE", std::vector<float>{0.0f, 0.0f});
  setField(points, "LATITUDE_QC", std::vector<float>{1.0f, 1.0f});
  setGlobeFields(points);
  const auto names = findGlobeFields(points.cloud.fields);
  ASSERT_TRUE(names);
  EXPECT_EQ("LONGITUDE", (*names)[0]);
  EXPECT_EQ("LATITUDE", (*names)[1]);
  const ScalarField east(points.cloud.fields, "LONGITUDE"),
      north(points.cloud.fields, "LATITUDE");
  const std::uint8_t* const second = &points.cloud.data[points.cloud.point_step];
  const auto place = map.toGlobe(1.0, 2.0);
  EXPECT_EQ(place[0], east.read(second));
  EXPECT_EQ(place[1], north.read(second));
  EXPECT_EQ(map.toText(), findMap(points)->toText());
}

TEST(MapProjection, NamesOfOtherThingsAreNotDegrees)
{
  for (const char* const name : {"lon_rad", "LONGITUDE_QC", "long_name", "isolated"}) {
    Dataset points = makePoints();
    setField(points, name, std::vector<float>{0.0f, 0.0f});
    setField(points, "lat", std::vector<float>{0.0f, 0.0f});
    EXPECT_FALSE(findGlobeFields(points.cloud.fields)) << name;
  }
}

TEST(MapProjection, BringsPointsFromOneMapOntoAnother)
{
  Dataset points = makePoints();
  changeMap(points, {9.0, -42.0, 1000.0});
  EXPECT_FALSE(findMap(points));
  const MapProjection from{8.5, -42.5, 1.0}, onto{9.0, -42.0, 1000.0};
  setMap(points, from);
  changeMap(points, onto);
  EXPECT_EQ(onto.toText(), findMap(points)->toText());
  const auto place = from.toGlobe(1.0, 2.0);
  const auto at = onto.toMap(place[0], place[1]);
  const ScalarField x(points.cloud.fields, "x"), z(points.cloud.fields, "z");
  const std::uint8_t* const second = &points.cloud.data[points.cloud.point_step];
  EXPECT_NEAR(at[0], x.read(second) + points.origin[0], 1e-2);
  EXPECT_EQ(-10.0, z.read(second) + points.origin[2]);
}

} // namespace test_map_projection
