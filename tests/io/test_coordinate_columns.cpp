// SPDX-License-Identifier: BSD-3-Clause
// Header lines as people and programs write them, and which columns are x, y and z.
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>

#include <sstream>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_coordinate_columns {

/** As many cells as the header has, with the numbers 1.5, 2.5, ... */
std::string
makeTable(const std::string& header)
{
  bool is_quoted = false;
  std::size_t cells = 1;
  for (const char c : header) {
    is_quoted ^= c == '"';
    cells += c == ',' && !is_quoted;
  }
  std::ostringstream text;
  text << header << '\n';
  for (std::size_t i = 1; i <= cells; ++i)
    text << (i > 1 ? "," : "") << i << ".5";
  text << '\n';
  return text.str();
}

Dataset
load(const std::string& header, const LoadOptions& options = {})
{
  const TemporaryFolder folder;
  writeFile(folder / "a.csv", makeTable(header));
  return loadDataset(folder / "a.csv", options);
}

struct Header {
  const char* line;
  double x, y, z; ///< columns from 1
};

class HeaderLines : public testing::TestWithParam<Header> {};

TEST_P(HeaderLines, NameTheCoordinates)
{
  const auto& [line, x, y, z] = GetParam();
  const Dataset dataset = load(line);
  EXPECT_EQ(x + 0.5, valueOf(dataset, "x", 0)) << line;
  EXPECT_EQ(y + 0.5, valueOf(dataset, "y", 0)) << line;
  EXPECT_EQ(z + 0.5, valueOf(dataset, "z", 0)) << line;
}

INSTANTIATE_TEST_SUITE_P(
    Written,
    HeaderLines,
    testing::Values(
        Header{"x,y,z,rho", 1, 2, 3},
        Header{"id,X,Y,Z,T", 2, 3, 4},
        Header{"hole,depth_from,depth_to,easting,northing,elevation,cu", 4, 5, 6},
        Header{"lon,lat,depth_qc,depth,T", 1, 2, 4},
        Header{"z,y,x,u", 3, 2, 1},
        // units of length
        Header{"x_km,y_km,z_km,rho", 1, 2, 3},
        Header{"x [m],y [m],z [m],T [K]", 1, 2, 3},
        Header{"x(m),y(m),z(m)", 1, 2, 3},
        Header{"x (mm),y (mm),z (mm),p (Pa)", 1, 2, 3},
        Header{"x/m,y/m,z/m,T/K", 1, 2, 3},
        Header{"X [ m ],Y [ m ],Z [ m ],Pressure [ Pa ]", 1, 2, 3}, // CFX
        Header{"X_cm,Y_cm,Z_cm", 1, 2, 3},
        Header{"x_mpc,y_mpc,z_mpc,m", 1, 2, 3},
        Header{"\"X, m\",\"Y, m\",\"Depth, m\",\"Porosity, fraction\"", 1, 2, 3},
        Header{"Position X [\xc2\xb5m],Position Y [\xc2\xb5m],Position Z [\xc2\xb5m]",
               1,
               2,
               3},                                           // Imaris
        Header{"\"x [nm]\",\"y [nm]\",\"z [nm]\"", 1, 2, 3}, // ThunderSTORM
        // other endings in common
        Header{"x_kpch,y_kpch,z_kpch,rho", 1, 2, 3},
        Header{"x_code_length,y_code_length,z_code_length", 1, 2, 3},
        Header{"x (cMpc/h),y (cMpc/h),z (cMpc/h)", 1, 2, 3},
        Header{"X_UTM32,Y_UTM32,Z_UTM32", 1, 2, 3},
        Header{"X_LV95,Y_LV95,elevation,grade", 1, 2, 3},
        Header{"id,x_rel,y_rel,z_rel", 2, 3, 4},
        Header{"x_vel,y_vel,z_vel,x_rg,y_rg,z_rg", 4, 5, 6},
        // words for a position
        Header{"pos_x,pos_y,pos_z,vel_x,vel_y,vel_z", 1, 2, 3},
        Header{"vx,vy,vz,pos_x,pos_y,pos_z", 4, 5, 6},
        Header{"Pos.x,Pos.y,Pos.z,Rhop", 1, 2, 3}, // DualSPHysics
        Header{"posX,posY,posZ", 1, 2, 3},
        Header{"xpos,ypos,zpos", 1, 2, 3},
        Header{"POSITION_X,POSITION_Y,POSITION_Z,FRAME", 1, 2, 3}, // TrackMate
        Header{"OBJECTID,POINT_X,POINT_Y,POINT_Z", 2, 3, 4},       // ArcGIS
        Header{"XCOORD,YCOORD,ZCOORD,AU_PPM", 1, 2, 3},
        Header{"x_coord,y_coord,z_coord", 1, 2, 3},
        Header{"CoordinateX,CoordinateY,CoordinateZ", 1, 2, 3}, // CGNS
        Header{
            "nodenumber,x-coordinate,y-coordinate,z-coordinate,p", 2, 3, 4}, // Fluent
        Header{
            "Node,X Location (mm),Y Location (mm),Z Location (mm)", 2, 3, 4}, // Ansys
        Header{"rho,Points:0,Points:1,Points:2", 2, 3, 4}, // ParaView
        Header{"rho,Points_0,Points_1,Points_2", 2, 3, 4},
        Header{"coords[0],coords[1],coords[2],f", 1, 2, 3},
        Header{"XC,YC,ZC,CU", 1, 2, 3}, // models of blocks
        Header{"centroid_x,centroid_y,centroid_z,cu", 1, 2, 3},
        Header{"hole,mid_x,mid_y,mid_z,cu", 2, 3, 4},
        Header{"XCENTRE,YCENTRE,ZCENTRE", 1, 2, 3},
        // maps
        Header{"Easting,Northing,Elevation,Au", 1, 2, 3},
        Header{"hole,EAST,NORTH,RL", 2, 3, 4},
        Header{"E,N,Z,code", 1, 2, 3},
        Header{"UTM_X,UTM_Y,Z", 1, 2, 3},
        Header{"Easting_MGA94,Northing_MGA94,RL,cu", 1, 2, 3},
        Header{"X (UTM),Y (UTM),Altitude (m)", 1, 2, 3},
        Header{"x,y,depth,T", 1, 2, 3},
        // degrees
        Header{"lon,lat,depth,T", 1, 2, 3},
        Header{"latitude,longitude,height,velocity_north,velocity_east", 2, 1, 3},
        Header{"time,Longitude [degrees_east],Latitude [degrees_north],Depth [m]",
               2,
               3,
               4},                                                 // ODV
        Header{"decimalLongitude,decimalLatitude,depth", 1, 2, 3}, // Darwin Core
        Header{"lng,lat,alt", 1, 2, 3},
        Header{"NAV_LATITUDE,NAV_LONGITUDE,NAV_DEPTH,T", 2, 1, 3},
        // a position beside other vectors and statistics
        Header{"X,Y,Z,X_r,Y_r,Z_r", 1, 2, 3},
        Header{"x_err,y_err,z_err,x_m,y_m,z_m", 4, 5, 6},
        Header{"std_lon,std_lat,std_depth,lon,lat,depth", 4, 5, 6}));

/** Nothing is assumed beside a component of a vector, or between several boxes. */
TEST(CoordinateColumns, OtherQuantitiesAreRefused)
{
  for (const char* const line : {"x_vel,y_vel,z_vel,rho",
                                 "x_m_s,y_m_s,z_m_s",
                                 "x (m/s),y (m/s),z (m/s)",
                                 "x_force,y_force,z_force,f",
                                 "x_min,y_min,z_min,x_max,y_max,z_max",
                                 "x_start,y_start,z_start,x_end,y_end,z_end",
                                 "X,Y,0,OrientX,OrientY,OrientZ",
                                 "x,y,snow_depth,T",
                                 "lon,lat,depth_qc,T",
                                 "station,longitude,latitude,wind_east,wind_north",
                                 "x_kpch,y_kpch,rho,T"}) {
    EXPECT_EQ("some_coordinates_named", codeOf([&] { load(line); })) << line;
  }
}

TEST(CoordinateColumns, OfUnknownUnitsBringANote)
{
  const Dataset dataset = load("x_kpch,y_kpch,z_kpch,rho");
  ASSERT_EQ(1u, dataset.notes.size());
  EXPECT_EQ(
      Message("common_ending", {{"x", "x_kpch"}, {"y", "y_kpch"}, {"z", "z_kpch"}}),
      dataset.notes[0]);
  LoadOptions options;
  options.may_mix_units = true;
  EXPECT_EQ(1u, load("x_kpch,y_kpch,z_kpch,rho", options).notes.size());
  options.needs_coordinates = false;
  EXPECT_TRUE(load("x_kpch,y_kpch,z_kpch,rho", options).has_coordinates);
  EXPECT_FALSE(load("x_vel,y_vel,z_vel,rho", options).has_coordinates);
}

/** Attributes that letters name are not coordinates: the letters e and n only together.
 */
TEST(CoordinateColumns, LettersOfMapsCountTogether)
{
  for (const char* const line : {"a,b,c,d,e,truth", "k,l,m,n"}) {
    const Dataset dataset = load(line);
    EXPECT_EQ(1.5, valueOf(dataset, "x", 0)) << line;
    ASSERT_EQ(1u, dataset.notes.size()) << line;
    EXPECT_EQ("assumed_coordinates", dataset.notes[0].code) << line;
  }
  EXPECT_EQ("some_coordinates_named", codeOf([&] { load("n,e,grade"); }));
}

/** A column called "0" is not in the way of the first one. */
TEST(CoordinateColumns, ThreeNumbersAreNumbers)
{
  LoadOptions options;
  const auto chosen = [&](const std::array<std::string, 3>& columns,
                          const std::string& header) {
    options.xyz_columns = columns;
    const Dataset dataset = load(header, options);
    return std::array<double, 3>{valueOf(dataset, "x", 0) - 0.5,
                                 valueOf(dataset, "y", 0) - 0.5,
                                 valueOf(dataset, "z", 0) - 0.5};
  };
  const std::string header = "X,Y,0,OrientX";
  EXPECT_EQ((std::array<double, 3>{1, 2, 3}), chosen({"0", "1", "2"}, header));
  EXPECT_EQ((std::array<double, 3>{1, 2, 3}), chosen({"X", "Y", "0"}, header));
  EXPECT_EQ((std::array<double, 3>{1, 2, 3}), chosen({"X", "1", "0"}, header));
  EXPECT_EQ((std::array<double, 3>{3, 2, 1}), chosen({"0", "1", "2"}, "2,1,0,a"));
}

} // namespace test_coordinate_columns
