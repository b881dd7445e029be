// SPDX-License-Identifier: BSD-3-Clause
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/hdf5_names.h"
#include "io_vtk/hdf5_column.h"

#include <algorithm>
#include <hdf5.h>

namespace pcl_uvol {
namespace io {
namespace {

/** Attributes and tables of headers are short. */
constexpr hssize_t most_numbers = 1 << 16;
/** Every link on the way is one of this file. */
bool
isInside(hid_t file, const std::string& name)
{
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end);
    H5L_info_t info;
    if (part.size() > 1 && (H5Lget_info(file, part.c_str(), &info, H5P_DEFAULT) < 0 ||
                            info.type > H5L_TYPE_SOFT))
      return false;
    if (end == std::string::npos)
      return true;
  }
}

/** Null for what is not there. */
Handle
openObject(hid_t file, const std::string& name)
{
  if (name != "/" && !isInside(file, name))
    return nullptr;
  return own(H5Oopen(file, name.c_str(), H5P_DEFAULT));
}

Handle
openDataset(hid_t file, const std::string& name)
{
  const Handle object = openObject(file, name);
  if (!object || H5Iget_type(*object) != H5I_DATASET)
    return nullptr;
  return own(H5Dopen2(file, name.c_str(), H5P_DEFAULT));
}

/** Null for what is not there. */
Handle
openAttribute(hid_t file, const std::string& object, const std::string& name)
{
  const Handle owner = openObject(file, object);
  if (!owner || H5Aexists(*owner, name.c_str()) <= 0)
    return nullptr;
  return own(H5Aopen(*owner, name.c_str(), H5P_DEFAULT));
}

std::optional<Hdf5Shape>
readShape(hid_t dataset)
{
  const Handle type = own(H5Dget_type(dataset)), space = own(H5Dget_space(dataset));
  if (!type || !space)
    return std::nullopt;
  const std::uint8_t datatype = hdf5Datatype(*type);
  const int rank = H5Sget_simple_extent_ndims(*space);
  if (datatype == 0 || rank < 1)
    return std::nullopt;
  std::vector<hsize_t> sizes(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(*space, sizes.data(), nullptr);
  Hdf5Shape shape{sizes[0], 1, datatype};
  for (std::size_t i = 1; i < sizes.size(); ++i) {
    if (sizes[i] == 0 || sizes[i] > UINT32_MAX / shape.components)
      return std::nullopt;
    shape.components *= sizes[i];
  }
  return shape;
}

} // namespace

Hdf5File::Hdf5File(const std::string& path)
    : path_(path)
{
  if (!isHdf5(path))
    throwUnreadable(path, {"not_format", "an HDF5 file"});
  const Hdf5Session session;
  file_ = own(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!file_)
    throwUnreadable(path, {"not_format", "a complete HDF5 file"});
}

bool
Hdf5File::hasGroup(const std::string& name) const
{
  const Hdf5Session session;
  const Handle object = openObject(*file_, name);
  return object && H5Iget_type(*object) == H5I_GROUP;
}

std::vector<std::string>
Hdf5File::list(const std::string& group) const
{
  const Hdf5Session session;
  std::vector<std::string> names;
  const Handle object = openObject(*file_, group);
  if (!object || H5Iget_type(*object) != H5I_GROUP)
    return names;
  H5Literate(
      *object,
      H5_INDEX_NAME,
      H5_ITER_INC,
      nullptr,
      [](hid_t, const char* name, const H5L_info_t*, void* list) {
        static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return herr_t(0);
      },
      &names);
  return names;
}

std::optional<Hdf5Shape>
Hdf5File::findShape(const std::string& dataset) const
{
  const Hdf5Session session;
  const Handle opened = openDataset(*file_, dataset);
  return opened ? readShape(*opened) : std::nullopt;
}

std::vector<double>
Hdf5File::readAttribute(const std::string& object, const std::string& name) const
{
  const Hdf5Session session;
  const Handle attribute = openAttribute(*file_, object, name);
  if (!attribute)
    return {};
  const Handle type = own(H5Aget_type(*attribute)),
               space = own(H5Aget_space(*attribute));
  if (!type || !space || hdf5Datatype(*type) == 0)
    return {};
  const hssize_t count = H5Sget_simple_extent_npoints(*space);
  if (count < 1 || count > most_numbers)
    return {};
  std::vector<double> numbers(static_cast<std::size_t>(count));
  if (H5Aread(*attribute, H5T_NATIVE_DOUBLE, numbers.data()) < 0)
    return {};
  return numbers;
}

std::string
Hdf5File::readText(const std::string& object, const std::string& name) const
{
  const Hdf5Session session;
  const Handle attribute = openAttribute(*file_, object, name);
  if (!attribute)
    return "";
  const Handle type = own(H5Aget_type(*attribute)),
               space = own(H5Aget_space(*attribute));
  if (!type || !space || H5Tget_class(*type) != H5T_STRING ||
      H5Sget_simple_extent_npoints(*space) != 1)
    return "";
  if (H5Tis_variable_str(*type) > 0) {
    char* characters = nullptr;
    if (H5Aread(*attribute, *type, &characters) < 0 || !characters)
      return "";
    std::string text(characters);
    H5free_memory(characters);
    return text;
  }
  const std::size_t size = H5Tget_size(*type);
  if (size > std::size_t{most_numbers})
    return "";
  std::string text(size, '\0');
  if (H5Aread(*attribute, *type, text.data()) < 0)
    return "";
  return text.substr(0, text.find('\0'));
}

std::vector<double>
Hdf5File::readNumbers(const std::string& dataset) const
{
  const Hdf5Session session;
  const Handle opened = openDataset(*file_, dataset);
  if (!opened)
    return {};
  const Handle type = own(H5Dget_type(*opened)), space = own(H5Dget_space(*opened));
  if (!type || !space || hdf5Datatype(*type) == 0)
    return {};
  const hssize_t count = H5Sget_simple_extent_npoints(*space);
  if (count < 1 || count > most_numbers)
    return {};
  std::vector<double> numbers(static_cast<std::size_t>(count));
  const Handle properties = own(H5Dget_create_plist(*opened));
  if (H5Pget_layout(*properties) == H5D_CHUNKED) { // the library trusts chunks
    const auto shape = readShape(*opened);
    if (!shape)
      return {};
    const std::size_t size = datatypeSize(shape->datatype);
    std::vector<std::uint8_t> bytes(numbers.size() * size);
    openHdf5Column(path_, dataset, opened, *shape)
        ->read(0, static_cast<std::size_t>(shape->rows), bytes.data());
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = FieldComponent{0, shape->datatype}.read(bytes.data() + i * size);
    return numbers;
  }
  if (H5Dread(
          *opened, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) <
      0)
    return {};
  return numbers;
}

std::unique_ptr<FileColumn>
Hdf5File::openColumn(const std::string& dataset) const
{
  const Hdf5Session session;
  const auto shape = findShape(dataset);
  if (!shape)
    throwUnreadable(path_,
                    {"missing_part", "the table of numbers " + quoteText(dataset)});
  return openHdf5Column(path_, dataset, openDataset(*file_, dataset), *shape);
}

} // namespace io
} // namespace pcl_uvol
