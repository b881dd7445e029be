// SPDX-License-Identifier: BSD-3-Clause
// Files of NetCDF made of bytes: variables and attributes under the names that the
// reader looks for. They are written by the library of NetCDF, which believes the
// headers of damaged files.
#include "io_vtk/hdf5_column.h"
#include "point_files.h"
#include "random_cloud.h"
#include "targets.h"

#include <array>
#include <netcdf.h>
#include <string>
#include <vector>

namespace uvol_fuzz {

namespace {

constexpr std::size_t most_dimensions = 3, most_size = 6, most_variables = 8,
                      most_attributes = 3;

constexpr std::array<const char*, 4> dimension_names{{"obs", "profile", "lat", "z"}};
constexpr std::array<const char*, 12> variable_names{{"lon",
                                                      "lat",
                                                      "depth",
                                                      "x",
                                                      "y",
                                                      "pressure",
                                                      "row_size",
                                                      "index",
                                                      "TEMP",
                                                      "TEMP_QC",
                                                      "a b",
                                                      "time"}};
constexpr std::array<nc_type, 8> types{
    {NC_DOUBLE, NC_FLOAT, NC_INT, NC_SHORT, NC_BYTE, NC_CHAR, NC_UINT, NC_INT64}};
constexpr std::array<const char*, 9> text_names{{"standard_name",
                                                 "units",
                                                 "axis",
                                                 "positive",
                                                 "sample_dimension",
                                                 "instance_dimension",
                                                 "flag_meanings",
                                                 "_FillValue",
                                                 "scale_factor"}};
constexpr std::array<const char*, 12> texts{{"longitude",
                                             "latitude",
                                             "sea_water_pressure",
                                             "degrees_north",
                                             "dbar",
                                             "X",
                                             "Z",
                                             "up",
                                             "down",
                                             "obs",
                                             "profile",
                                             ""}};
constexpr std::array<const char*, 7> number_names{{"scale_factor",
                                                   "add_offset",
                                                   "_FillValue",
                                                   "missing_value",
                                                   "valid_range",
                                                   "valid_min",
                                                   "valid_max"}};

template <std::size_t count>
const char*
chooseName(Bytes& bytes, const std::array<const char*, count>& names)
{
  return names[bytes.choose(count)];
}

double
takeNumber(Bytes& bytes)
{
  return bytes.flip() ? bytes.take<double>() : bytes.take<std::int8_t>();
}

struct Variable {
  int id;
  std::size_t size;
  bool is_text;
};

/** What NetCDF refuses, such as a name that is there or numbers that a type cannot
 * hold, is left out. */
class NetcdfMaker {
public:
  NetcdfMaker(const std::string& path, Bytes& bytes)
      : bytes_(bytes)
  {
    // Those of HDF5, which take ten times as long, come seldom.
    constexpr std::array<int, 8> formats{{0,
                                          NC_64BIT_OFFSET,
                                          NC_NETCDF4 | NC_CLASSIC_MODEL,
                                          NC_NETCDF4,
                                          0,
                                          NC_64BIT_OFFSET,
                                          0,
                                          NC_64BIT_OFFSET}};
    const int format = formats[bytes.choose(formats.size())];
    is_hdf5_ = (format & NC_NETCDF4) != 0;
    nc_create(path.c_str(), NC_CLOBBER | format, &file_);
  }
  NetcdfMaker(const NetcdfMaker&) = delete;
  NetcdfMaker&
  operator=(const NetcdfMaker&) = delete;
  ~NetcdfMaker()
  {
    nc_close(file_);
  }

  void
  fill()
  {
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i < most_dimensions; ++i) {
      const std::size_t size = 1 + bytes_.choose(most_size);
      int id = 0;
      if (nc_def_dim(file_, dimension_names[i], size, &id) == NC_NOERR)
        sizes.push_back(size);
    }
    std::vector<Variable> variables;
    for (std::size_t i = 0; i < most_variables && bytes_.size() > 0; ++i)
      addVariable(sizes, variables);
    nc_enddef(file_);
    for (const Variable& variable : variables)
      write(variable);
  }

private:
  void
  addVariable(const std::vector<std::size_t>& sizes, std::vector<Variable>& variables)
  {
    std::vector<int> dimensions;
    Variable made{0, 1, false};
    for (std::size_t rank = bytes_.choose(most_dimensions + 1); rank > 0; --rank) {
      const std::size_t dimension = bytes_.choose(sizes.size());
      dimensions.push_back(static_cast<int>(dimension));
      made.size *= sizes[dimension];
    }
    const nc_type type = types[bytes_.choose(types.size())];
    made.is_text = type == NC_CHAR;
    if (nc_def_var(file_,
                   chooseName(bytes_, variable_names),
                   type,
                   static_cast<int>(dimensions.size()),
                   dimensions.data(),
                   &made.id) != NC_NOERR)
      return;
    variables.push_back(made);
    for (std::size_t i = bytes_.choose(most_attributes + 1); i > 0; --i)
      addAttribute(made.id, type);
  }

  void
  addAttribute(int variable, nc_type type)
  {
    if (bytes_.flip()) {
      const std::string text = chooseName(bytes_, texts);
      const char* const name = chooseName(bytes_, text_names);
      if (canHave(name, text.size(), type == NC_CHAR))
        nc_put_att_text(file_, variable, name, text.size(), text.data());
      return;
    }
    const char* const name = chooseName(bytes_, number_names);
    const std::array<double, 2> numbers{{takeNumber(bytes_), takeNumber(bytes_)}};
    const nc_type own_type = bytes_.flip() ? type : NC_DOUBLE;
    const std::size_t size = 1 + bytes_.choose(numbers.size());
    if (canHave(name, size, own_type == type))
      nc_put_att_double(file_, variable, name, own_type, size, numbers.data());
  }

  /** In files of HDF5, NetCDF reads fill values out of bounds when it writes some that
   * are not one number of their variable's type, and cannot close others. */
  bool
  canHave(const std::string& attribute, std::size_t size, bool has_same_type) const
  {
    return !is_hdf5_ || attribute != "_FillValue" || (size == 1 && has_same_type);
  }

  void
  write(const Variable& variable)
  {
    if (variable.is_text) {
      std::string text(variable.size, '\0');
      for (char& letter : text)
        letter = bytes_.take<char>();
      nc_put_var_text(file_, variable.id, text.data());
      return;
    }
    std::vector<double> numbers(variable.size);
    const bool any_number = bytes_.flip();
    for (double& number : numbers)
      number = any_number ? takeNumber(bytes_) : bytes_.take<std::int8_t>();
    nc_put_var_double(file_, variable.id, numbers.data());
  }

  Bytes& bytes_;
  int file_ = -1;
  bool is_hdf5_ = false;
};

} // namespace

void
readNetcdf(const std::uint8_t* data, std::size_t size)
{
  Bytes bytes(data, size);
  const std::string path = fileNamed("a.nc");
  {
    const pcl_uvol::io::Hdf5Session session;
    keepMemoryOfHdf5();
    NetcdfMaker(path, bytes).fill();
  }
  readPoints(path, true);
}

} // namespace uvol_fuzz
