// SPDX-License-Identifier: BSD-3-Clause
// Profiles, trajectories and grids of NetCDF, of known numbers.
#include "common/records.h"
#include "common/scalar_field.h"
#include "random_dataset.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/expressions/derived_fields.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <netcdf.h>
#include <string>
#include <vector>

namespace test_netcdf {

using namespace pcl_uvol;
using uvol_test::numberOf;
using uvol_test::wordOf;

constexpr double degree = 6371.0088 * 3.14159265358979323846 / 180.0;

/** A file that is written variable by variable. */
class NetcdfWriter {
public:
  /** \param mode NC_NETCDF4, or 0 for the classic format */
  NetcdfWriter(const std::string& path, int mode)
  {
    check(nc_create(path.c_str(), NC_CLOBBER | mode, &file_));
  }
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter&
  operator=(const NetcdfWriter&) = delete;
  ~NetcdfWriter()
  {
    check(nc_close(file_));
  }

  int
  dimension(const char* name, std::size_t size)
  {
    int id = 0;
    check(nc_def_dim(file_, name, size, &id));
    return id;
  }

  int
  variable(const char* name, nc_type type, const std::vector<int>& dimensions)
  {
    int id = 0;
    check(nc_def_var(file_,
                     name,
                     type,
                     static_cast<int>(dimensions.size()),
                     dimensions.data(),
                     &id));
    return id;
  }

  void
  text(int variable, const char* name, const std::string& text)
  {
    check(nc_put_att_text(file_, variable, name, text.size(), text.c_str()));
  }

  void
  number(int variable, const char* name, nc_type type, double number)
  {
    check(nc_put_att_double(file_, variable, name, type, 1, &number));
  }

  void
  beginData()
  {
    check(nc_enddef(file_));
  }

  void
  put(int variable, const std::vector<double>& numbers)
  {
    check(nc_put_var_double(file_, variable, numbers.data()));
  }

  void
  putText(int variable, const std::string& text)
  {
    check(nc_put_var_text(file_, variable, text.c_str()));
  }

private:
  static void
  check(int status)
  {
    ASSERT_EQ(NC_NOERR, status) << nc_strerror(status);
  }

  int file_ = 0;
};

class Netcdf : public ::testing::TestWithParam<int> {
protected:
  std::string
  path(const std::string& name) const
  {
    return folder_ / name;
  }

  uvol_test::TemporaryFolder folder_;
};

std::vector<double>
valuesOf(const Dataset& dataset, const std::string& name)
{
  const ScalarField field(dataset.cloud.fields, name);
  const int axis = axisOf(name);
  std::vector<double> values;
  for (std::size_t i = 0; i < dataset.cloud.width; ++i)
    values.push_back(
        field.read(&dataset.cloud.data[i * dataset.cloud.point_step]) +
        (axis >= 0 ? dataset.origin[static_cast<std::size_t>(axis)] : 0.0));
  return values;
}

void
expectNear(const std::vector<double>& expected, const std::vector<double>& found)
{
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (std::isnan(expected[i]))
      EXPECT_TRUE(std::isnan(found[i])) << i;
    else
      EXPECT_NEAR(expected[i], found[i], 1e-5 * std::abs(expected[i]) + 1e-9) << i;
}

const double nan_value = std::nan("");

/** As Argo has them: three profiles of two levels. */
void
writeProfiles(const std::string& path, int mode)
{
  NetcdfWriter file(path, mode);
  const int profiles = file.dimension("N_PROF", 3),
            levels = file.dimension("N_LEVELS", 2),
            letters = file.dimension("STRING4", 4);
  const int platform = file.variable("PLATFORM_NUMBER", NC_CHAR, {profiles, letters});
  const int latitude = file.variable("LATITUDE", NC_DOUBLE, {profiles}),
            longitude = file.variable("LONGITUDE", NC_DOUBLE, {profiles}),
            pressure = file.variable("PRES", NC_FLOAT, {profiles, levels}),
            temperature = file.variable("TEMP", NC_FLOAT, {profiles, levels}),
            quality = file.variable("TEMP_QC", NC_CHAR, {profiles, levels}),
            direction = file.variable("DIRECTION", NC_CHAR, {profiles}),
            cycle = file.variable("CYCLE_NUMBER", NC_INT, {profiles});
  file.text(latitude, "units", "degree_north");
  file.text(longitude, "units", "degree_east");
  file.text(pressure, "units", "decibar");
  file.number(temperature, "_FillValue", NC_FLOAT, 99999.0);
  file.beginData();
  file.putText(platform, "490149024903");
  file.put(latitude, {40.0, 42.0, 41.0});
  file.put(longitude, {179.0, -179.0, 180.0});
  file.put(pressure, {5.0, 10.0, 6.0, 11.0, 7.0, 12.0});
  file.put(temperature, {20.0, 19.0, 18.0, 99999.0, 16.0, 15.0});
  file.putText(quality, "114 12");
  file.putText(direction, "ADA");
  file.put(cycle, {7.0, 8.0, 9.0});
}

TEST_P(Netcdf, ReadsProfiles)
{
  writeProfiles(path("a.nc"), GetParam());
  Dataset dataset = loadDataset(path("a.nc"));
  ASSERT_EQ(6u, dataset.cloud.width);
  const double shrunk = std::cos(41.0 * 3.14159265358979323846 / 180.0);
  // Around 180 E, 41 N, the shorter way.
  expectNear(
      {-degree * shrunk, -degree * shrunk, degree * shrunk, degree * shrunk, 0.0, 0.0},
      valuesOf(dataset, "x"));
  expectNear({-degree, -degree, degree, degree, 0.0, 0.0}, valuesOf(dataset, "y"));
  expectNear({-5.0, -10.0, -6.0, -11.0, -7.0, -12.0}, valuesOf(dataset, "z"));
  expectNear({20.0, 19.0, 18.0, nan_value, 16.0, 15.0}, valuesOf(dataset, "TEMP"));
  expectNear({1.0, 1.0, 4.0, nan_value, 1.0, 2.0}, valuesOf(dataset, "TEMP_QC"));
  expectNear({7.0, 7.0, 8.0, 8.0, 9.0, 9.0}, valuesOf(dataset, "CYCLE_NUMBER"));
  EXPECT_EQ(pcl::PCLPointField::INT32,
            findField(dataset.cloud.fields, "CYCLE_NUMBER")->datatype);
  for (const char* const absent : {"PLATFORM_NUMBER", "DIRECTION"})
    EXPECT_EQ(nullptr, findField(dataset.cloud.fields, absent));
  ASSERT_EQ(1u, dataset.notes.size());
  EXPECT_EQ("mapped_positions", dataset.notes[0].code);
  EXPECT_EQ(0u, wordOf(dataset.notes[0], "longitude").find("180 "));
  EXPECT_EQ("41 N", wordOf(dataset.notes[0], "latitude"));
  EXPECT_EQ(0.0, numberOf(dataset.notes[0], "in_metres"));
  EXPECT_EQ(1.0, numberOf(dataset.notes[0], "gives_z"));
  EXPECT_EQ("minus PRES in decibar", wordOf(dataset.notes[0], "z"));
  pcl_uvol::Report report;
  EXPECT_EQ(3u, selectRows(dataset, "TEMP_QC=1", {}, report));
  expectNear({20.0, 19.0, 16.0}, valuesOf(dataset, "TEMP"));
}

TEST_P(Netcdf, ReadsTrajectoriesThatStandBehindOneAnother)
{
  for (const bool by_counts : {true, false}) {
    {
      NetcdfWriter file(path("a.nc"), GetParam());
      const int dives = file.dimension("dive", 2), samples = file.dimension("obs", 5);
      const int latitude = file.variable("lat", NC_FLOAT, {dives}),
                longitude = file.variable("lon", NC_FLOAT, {dives}),
                rows = file.variable("rows", NC_INT, {by_counts ? dives : samples}),
                depth = file.variable("depth", NC_FLOAT, {samples}),
                salt = file.variable("salt", NC_DOUBLE, {samples});
      file.text(rows,
                by_counts ? "sample_dimension" : "instance_dimension",
                by_counts ? "obs" : "dive");
      file.text(depth, "units", "m");
      file.beginData();
      file.put(latitude, {0.0, 0.2});
      file.put(longitude, {10.0, 10.4});
      file.put(rows,
               by_counts ? std::vector<double>{2, 3}
                         : std::vector<double>{0, 0, 1, 1, 1});
      file.put(depth, {1.0, 2.0, 3.0, 4.0, 5.0});
      file.put(salt, {31.0, 32.0, 33.0, 34.0, 35.0});
    }
    const Dataset dataset = loadDataset(path("a.nc"));
    expectNear({-1.0, -2.0, -3.0, -4.0, -5.0}, valuesOf(dataset, "z"));
    expectNear({31.0, 32.0, 33.0, 34.0, 35.0}, valuesOf(dataset, "salt"));
    const double low = -0.1 * degree * 1000.0; // metres, as it is a small region
    expectNear({low, low, -low, -low, -low}, valuesOf(dataset, "y"));
    expectNear({0.0, 0.0, 0.2f, 0.2f, 0.2f}, valuesOf(dataset, "lat"));
  }
}

TEST_P(Netcdf, LeavesOutWhatHasMoreDimensionsThanSamplesBehindOneAnother)
{
  for (const bool places_agree : {true, false}) {
    {
      NetcdfWriter file(path("a.nc"), GetParam());
      const int dives = file.dimension("dive", 2), samples = file.dimension("obs", 5),
                bands = file.dimension("band", 3);
      const int latitude = file.variable("lat", NC_FLOAT, {dives}),
                longitude =
                    file.variable("lon", NC_FLOAT, {places_agree ? dives : bands}),
                rows = file.variable("rows", NC_INT, {dives}),
                spectrum = file.variable("spectrum", NC_FLOAT, {samples, bands});
      file.text(rows, "sample_dimension", "obs");
      file.beginData();
      file.put(latitude, {0.0, 0.2});
      file.put(longitude,
               places_agree ? std::vector<double>{10.0, 10.4}
                            : std::vector<double>{10.0, 10.4, 10.8});
      file.put(rows, {2.0, 3.0});
      file.put(spectrum, std::vector<double>(15, 1.0));
    }
    const Dataset dataset = loadDataset(path("a.nc"));
    EXPECT_EQ(places_agree ? 5u : 6u, dataset.cloud.width);
    EXPECT_EQ(nullptr, findField(dataset.cloud.fields, "spectrum"));
  }
}

TEST_P(Netcdf, ReadsGridsWithPackedNumbers)
{
  {
    NetcdfWriter file(path("a.nc"), GetParam());
    const int times = file.dimension("time", 2), heights = file.dimension("level", 2),
              rows = file.dimension("y", 2), columns = file.dimension("x", 3);
    const int x = file.variable("x", NC_DOUBLE, {columns}),
              y = file.variable("y", NC_DOUBLE, {rows}),
              z = file.variable("level", NC_FLOAT, {heights}),
              time = file.variable("time", NC_INT, {times}),
              packed = file.variable("T", NC_SHORT, {times, heights, rows, columns}),
              turned = file.variable("turned", NC_FLOAT, {columns, rows}),
              flag = file.variable("flag", NC_BYTE, {rows});
    file.text(z, "axis", "Z");
    file.text(z, "positive", "up");
    file.number(packed, "scale_factor", NC_DOUBLE, 0.5);
    file.number(packed, "add_offset", NC_DOUBLE, 100.0);
    file.number(packed, "_FillValue", NC_SHORT, -1.0);
    file.text(flag, "flag_meanings", "good bad");
    file.number(flag, "_FillValue", NC_BYTE, 4.0);
    file.beginData();
    file.put(x, {0.0, 1.0, 2.0});
    file.put(y, {10.0, 20.0});
    file.put(z, {100.0, 200.0});
    file.put(time, {5.0, 6.0});
    std::vector<double> numbers(24);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = i == 7 ? -1.0 : static_cast<double>(i);
    file.put(packed, numbers);
    file.put(turned, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
    file.put(flag, {4.0, 1.0});
  }
  const Dataset dataset = loadDataset(path("a.nc"));
  ASSERT_EQ(24u, dataset.cloud.width);
  EXPECT_TRUE(dataset.notes.empty());
  const auto x = valuesOf(dataset, "x"), y = valuesOf(dataset, "y"),
             z = valuesOf(dataset, "z"), time = valuesOf(dataset, "time"),
             packed = valuesOf(dataset, "T"), turned = valuesOf(dataset, "turned"),
             flag = valuesOf(dataset, "flag");
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(static_cast<double>(i % 3), x[i]);
    EXPECT_EQ(i / 3 % 2 == 0 ? 10.0 : 20.0, y[i]);
    EXPECT_EQ(i / 6 % 2 == 0 ? 100.0 : 200.0, z[i]);
    EXPECT_EQ(i / 12 == 0 ? 5.0 : 6.0, time[i]);
    if (i == 7)
      EXPECT_TRUE(std::isnan(packed[i]));
    else
      EXPECT_EQ(100.0 + 0.5 * static_cast<double>(i), packed[i]);
    EXPECT_EQ(static_cast<double>(1 + 2 * (i % 3) + i / 3 % 2), turned[i]);
    EXPECT_EQ(i / 3 % 2 == 0 ? 4.0 : 1.0, flag[i]);
  }
}

TEST_P(Netcdf, HoldsNumbersOfIntegersAgainstARangeThatIsNone)
{
  {
    NetcdfWriter file(path("a.nc"), GetParam());
    const int samples = file.dimension("obs", 2);
    const int x = file.variable("x", NC_FLOAT, {samples}),
              y = file.variable("y", NC_FLOAT, {samples}),
              count = file.variable("count", NC_INT, {samples});
    file.number(count, "valid_min", NC_DOUBLE, nan_value);
    file.beginData();
    file.put(x, {0.0, 1.0});
    file.put(y, {0.0, 1.0});
    file.put(count, {7.0, 8.0});
  }
  expectNear({nan_value, nan_value}, valuesOf(loadDataset(path("a.nc")), "count"));
}

TEST_P(Netcdf, RefusesIndicesThatAreNone)
{
  for (const double index : {nan_value, 1e300, 2.0}) {
    {
      NetcdfWriter file(path("a.nc"), GetParam());
      const int dives = file.dimension("dive", 2), samples = file.dimension("obs", 2);
      const int x = file.variable("x", NC_FLOAT, {dives}),
                y = file.variable("y", NC_FLOAT, {dives}),
                of_dive = file.variable("of_dive", NC_DOUBLE, {samples});
      file.text(of_dive, "instance_dimension", "dive");
      file.beginData();
      file.put(x, {0.0, 1.0});
      file.put(y, {0.0, 1.0});
      file.put(of_dive, {0.0, index});
    }
    EXPECT_THROW(loadDataset(path("a.nc")), IOError) << index;
  }
}

TEST_P(Netcdf, PutsFilesOnOneMap)
{
  writeProfiles(path("a.nc"), GetParam());
  const Dataset alone = loadDataset(path("a.nc"));
  const auto map = findMap(alone);
  ASSERT_TRUE(map);
  EXPECT_EQ(41.0, map->latitude);
  EXPECT_EQ(180.0, std::abs(map->longitude));
  EXPECT_EQ(1.0, map->per_kilometre);
  LoadOptions options;
  options.map = MapProjection{179.0, 40.0, 1000.0};
  const Dataset moved = loadDataset(path("a.nc"), options);
  EXPECT_EQ(options.map->toText(), findMap(moved)->toText());
  EXPECT_EQ(0.0, valuesOf(moved, "x")[0]);
  EXPECT_EQ(0.0, valuesOf(moved, "y")[0]);
  expectNear(
      {0.0, 0.0, 2000.0 * degree, 2000.0 * degree, 1000.0 * degree, 1000.0 * degree},
      valuesOf(moved, "y"));
  options.map = MapProjection{179.0, 40.0}; // of the unit the region tells
  EXPECT_EQ(1.0, findMap(loadDataset(path("a.nc"), options))->per_kilometre);
}

TEST_P(Netcdf, NamesFixesFarFromTheOthers)
{
  {
    NetcdfWriter file(path("a.nc"), GetParam());
    const int samples = file.dimension("obs", 40);
    const int latitude = file.variable("latitude", NC_DOUBLE, {samples}),
              longitude = file.variable("longitude", NC_DOUBLE, {samples});
    file.beginData();
    std::vector<double> north(40, 0.0), east(40, 0.0);
    for (std::size_t i = 2; i < north.size(); ++i) {
      north[i] = -43.0 + 0.02 * static_cast<double>(i);
      east[i] = 8.0 + 0.02 * static_cast<double>(i);
    }
    file.put(latitude, north);
    file.put(longitude, east);
  }
  const Dataset dataset = loadDataset(path("a.nc"));
  EXPECT_NEAR(-42.59, findMap(dataset)->latitude, 0.03);
  EXPECT_NEAR(8.41, findMap(dataset)->longitude, 0.03);
  ASSERT_EQ(2u, dataset.notes.size());
  EXPECT_EQ("far_positions", dataset.notes[1].code);
  EXPECT_EQ(2.0, numberOf(dataset.notes[1], "far"));
  EXPECT_EQ(40.0, numberOf(dataset.notes[1], "positions"));
  EXPECT_EQ("latitude", wordOf(dataset.notes[1], "field"));
  EXPECT_EQ(0.0, numberOf(dataset.notes[1], "degrees"));
  EXPECT_NE(
      std::string::npos,
      dataset.notes[1].text(ParameterNames::Options).find("-where \"latitude != 0\""));
}

TEST_P(Netcdf, AnswersDamagedFilesByASentence)
{
  writeProfiles(path("a.nc"), GetParam());
  const std::string bytes = uvol_test::readFile(path("a.nc"));
  const auto load = [&](const std::string& damaged) {
    uvol_test::writeFile(path("b.nc"), damaged);
    const std::string message =
        uvol_test::messageOf<Exception>([&] { loadDataset(path("b.nc")); });
    EXPECT_TRUE(message.empty() || message.find("b.nc") != std::string::npos)
        << message;
  };
  const std::size_t step = std::max<std::size_t>(bytes.size() / 97, 1);
  for (std::size_t size = 0; size < bytes.size(); size += step)
    load(bytes.substr(0, size));
  {
    NetcdfWriter file(path("c.nc"), GetParam());
    const int samples = file.dimension("n", 2);
    const int number = file.variable("T", NC_FLOAT, {samples});
    file.beginData();
    file.put(number, {1.0, 2.0});
  }
  EXPECT_THROW(loadDataset(path("c.nc")), IOError);
  EXPECT_THROW(loadDataset(path("none.nc")), IOError);
}

INSTANTIATE_TEST_SUITE_P(Formats, Netcdf, ::testing::Values(0, NC_NETCDF4));

} // namespace test_netcdf
