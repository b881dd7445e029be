// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/netcdf_file.h"

#include "io/files.h"
#include "io_vtk/hdf5_column.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <array>
#include <limits>
#include <netcdf.h>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

/** 0 for what is no number. */
std::uint8_t
datatypeOf(nc_type type)
{
  switch (type) {
  case NC_BYTE:
    return Type::INT8;
  case NC_UBYTE:
  case NC_CHAR:
    return Type::UINT8;
  case NC_SHORT:
    return Type::INT16;
  case NC_USHORT:
    return Type::UINT16;
  case NC_INT:
    return Type::INT32;
  case NC_UINT:
    return Type::UINT32;
  case NC_FLOAT:
    return Type::FLOAT32;
  case NC_DOUBLE:
  case NC_INT64:
  case NC_UINT64:
    return Type::FLOAT64;
  default:
    return 0;
  }
}

} // namespace

void
NetcdfFile::check(int status) const
{
  if (status != NC_NOERR)
    throwUnreadable(path_, {"library_error", "NetCDF", nc_strerror(status)});
}

NetcdfFile::NetcdfFile(const std::string& path)
    : path_(path)
{
  InputFile(path).head(1); // what is no file is told as of other formats
  const Hdf5Session session;
  int file = -1;
  if (nc_open(path.c_str(), NC_NOWRITE, &file) != NC_NOERR)
    throwUnreadable(path, {"not_format", "a NetCDF file"});
  file_ = std::shared_ptr<const int>(new int(file), [](const int* id) {
    const Hdf5Session closing;
    nc_close(*id);
    delete id;
  });
  int dimensions = 0, variables = 0;
  check(nc_inq(*file_, &dimensions, &variables, nullptr, nullptr));
  for (int i = 0; i < dimensions; ++i) {
    std::size_t size = 0;
    check(nc_inq_dimlen(*file_, i, &size));
    sizes_.push_back(size);
  }
  for (int i = 0; i < variables; ++i) {
    NetcdfVariable variable;
    variable.id = i;
    std::array<char, NC_MAX_NAME + 1> name{};
    nc_type type = NC_NAT;
    int count = 0;
    check(nc_inq_var(*file_, i, name.data(), &type, &count, nullptr, nullptr));
    variable.name = name.data();
    variable.datatype = datatypeOf(type);
    variable.is_text = type == NC_CHAR;
    variable.dimensions.resize(static_cast<std::size_t>(count));
    check(nc_inq_vardimid(*file_, i, variable.dimensions.data()));
    if (variable.datatype != 0)
      variables_.push_back(variable);
  }
}

std::uint64_t
NetcdfFile::sizeOf(int dimension) const
{
  return sizes_.at(static_cast<std::size_t>(dimension));
}

std::string
NetcdfFile::readName(int dimension) const
{
  const Hdf5Session session;
  std::array<char, NC_MAX_NAME + 1> name{};
  check(nc_inq_dimname(*file_, dimension, name.data()));
  return name.data();
}

std::uint64_t
NetcdfFile::countNumbers(const NetcdfVariable& variable) const
{
  const std::uint64_t most = InputFile(path_).getSize() * deflate_expansion;
  std::uint64_t size = 1;
  for (const int dimension : variable.dimensions) {
    const std::uint64_t along = sizeOf(dimension);
    if (along != 0 && size > most / along)
      throwUnreadable(path_,
                      {"truncated_part", "the variable " + quoteText(variable.name)});
    size *= along;
  }
  return size;
}

std::string
NetcdfFile::readText(const NetcdfVariable& variable, const std::string& attribute) const
{
  const Hdf5Session session;
  nc_type type = NC_NAT;
  std::size_t size = 0;
  if (nc_inq_att(*file_, variable.id, attribute.c_str(), &type, &size) != NC_NOERR ||
      type != NC_CHAR || size > std::numeric_limits<std::uint16_t>::max())
    return "";
  std::string text(size, '\0');
  check(nc_get_att_text(*file_, variable.id, attribute.c_str(), text.data()));
  return text.substr(0, text.find('\0'));
}

std::vector<double>
NetcdfFile::readNumbers(const NetcdfVariable& variable,
                        const std::string& attribute) const
{
  const Hdf5Session session;
  nc_type type = NC_NAT;
  std::size_t size = 0;
  if (nc_inq_att(*file_, variable.id, attribute.c_str(), &type, &size) != NC_NOERR ||
      datatypeOf(type) == 0 || type == NC_CHAR ||
      size > std::numeric_limits<std::uint16_t>::max())
    return {};
  std::vector<double> numbers(size);
  check(nc_get_att_double(*file_, variable.id, attribute.c_str(), numbers.data()));
  return numbers;
}

void
NetcdfFile::readSlab(const NetcdfVariable& variable,
                     const std::vector<std::size_t>& start,
                     const std::vector<std::size_t>& counts,
                     std::size_t count,
                     double* numbers) const
{
  const Hdf5Session session;
  if (!variable.is_text)
    return check(
        nc_get_vara_double(*file_, variable.id, start.data(), counts.data(), numbers));
  std::vector<char> letters(count);
  check(nc_get_vara_text(
      *file_, variable.id, start.data(), counts.data(), letters.data()));
  std::copy(letters.begin(), letters.end(), numbers);
}

void
NetcdfFile::read(const NetcdfVariable& variable,
                 std::uint64_t first,
                 std::size_t count,
                 double* numbers) const
{
  const std::size_t rank = variable.dimensions.size();
  if (rank == 0 && count > 0)
    return readSlab(variable, {0}, {1}, 1, numbers);
  while (count > 0) {
    // The largest box of whole inner rows that begins there.
    std::vector<std::size_t> start(rank), counts(rank, 1);
    std::uint64_t rest = first;
    for (std::size_t i = rank; i-- > 0;) {
      const std::uint64_t size = sizeOf(variable.dimensions[i]);
      start[i] = rest % size;
      rest /= size;
    }
    std::size_t box = 1;
    for (std::size_t i = rank; i-- > 0;) {
      const std::uint64_t size = sizeOf(variable.dimensions[i]);
      counts[i] = std::min<std::uint64_t>(size - start[i], count / box);
      box *= counts[i];
      if (counts[i] < size)
        break;
    }
    readSlab(variable, start, counts, box, numbers);
    first += box;
    count -= box;
    numbers += box;
  }
}

} // namespace io
} // namespace pcl_uvol
