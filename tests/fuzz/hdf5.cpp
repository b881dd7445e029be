// SPDX-License-Identifier: BSD-3-Clause
// Files of HDF5 made of bytes: tables and attributes of any type and size under the
// names that readers look for, and chunks whose packed bytes are any. They are written
// by the library of HDF5, whose own headers stay whole: it does not survive them
// damaged.
#include "io_vtk/hdf5_column.h"
#include "point_files.h"
#include "random_cloud.h"
#include "targets.h"

#include <array>
#include <hdf5.h>
#include <string>
#include <vector>

namespace uvol_fuzz {

namespace {

constexpr std::size_t most_objects = 12, most_rows = 20, most_columns = 4;

struct AttributeName {
  const char* object;
  const char* name;
};

/** What readers of one kind of file look for. */
struct Layout {
  std::vector<const char*> groups, tables;
  std::vector<AttributeName> attributes;
};

const Layout snapshots{{"/Header", "/PartType0", "/PartType4", "/particles", "/header"},
                       {"/PartType0/Coordinates",
                        "/PartType0/Masses",
                        "/PartType0/Density",
                        "/PartType4/Coordinates",
                        "/particles/xyz",
                        "/particles/h",
                        "/particles/itype",
                        "/particles/rho",
                        "/header/hfact",
                        "/header/massoftype",
                        "/x",
                        "/y",
                        "/z",
                        "/pos",
                        "/particles/x",
                        "/particles/a b"},
                       {{"/Header", "NumPart_ThisFile"},
                        {"/Header", "NumPart_Total"},
                        {"/Header", "NumFilesPerSnapshot"},
                        {"/Header", "MassTable"},
                        {"/Header", "Redshift"},
                        {"/Header", "BoxSize"}}};

const Layout data_of_vtk{{"/VTKHDF",
                          "/VTKHDF/PointData",
                          "/VTKHDF/CellData",
                          "/VTKHDF/Polygons",
                          "/VTKHDF/Block"},
                         {"/VTKHDF/Points",
                          "/VTKHDF/NumberOfPoints",
                          "/VTKHDF/PointData/a",
                          "/VTKHDF/PointData/x",
                          "/VTKHDF/PointData/Normals",
                          "/VTKHDF/CellData/a",
                          "/VTKHDF/Polygons/NumberOfCells",
                          "/VTKHDF/Polygons/Offsets",
                          "/VTKHDF/Polygons/Connectivity",
                          "/VTKHDF/Steps/NumberOfParts",
                          "/VTKHDF/Steps/PartOffsets",
                          "/VTKHDF/Steps/PointOffsets",
                          "/VTKHDF/Steps/PointDataOffsets/a",
                          "/VTKHDF/Block/Points"},
                         {{"/VTKHDF", "WholeExtent"},
                          {"/VTKHDF", "Origin"},
                          {"/VTKHDF", "Spacing"},
                          {"/VTKHDF", "Direction"},
                          {"/VTKHDF/Steps", "NSteps"}}};

hid_t
takeType(Bytes& bytes)
{
  const std::array<hid_t, 8> types{{H5T_IEEE_F32LE,
                                    H5T_IEEE_F64LE,
                                    H5T_IEEE_F32BE,
                                    H5T_STD_I8LE,
                                    H5T_STD_U16BE,
                                    H5T_STD_I32LE,
                                    H5T_STD_U64LE,
                                    H5T_C_S1}};
  const std::array<hid_t, 8> further_types{{H5T_STD_U8LE,
                                            H5T_STD_I16LE,
                                            H5T_STD_I16BE,
                                            H5T_STD_U16LE,
                                            H5T_STD_U32LE,
                                            H5T_STD_U32BE,
                                            H5T_STD_I64LE,
                                            H5T_STD_I64BE}};
  const auto chosen = bytes.take<std::uint8_t>();
  return (chosen < 128 ? types : further_types)[chosen % types.size()];
}

class Hdf5Maker {
public:
  Hdf5Maker(const std::string& path, const Layout& layout)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT))
      , layout_(layout)
  {
    for (const char* const group : layout.groups)
      addGroup(group);
  }
  Hdf5Maker(const Hdf5Maker&) = delete;
  Hdf5Maker&
  operator=(const Hdf5Maker&) = delete;
  ~Hdf5Maker()
  {
    H5Fclose(file_);
  }

  void
  addGroup(const char* name)
  {
    H5Gclose(H5Gcreate2(file_, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  /** \param has_any_length as h5py writes it */
  void
  addText(const char* object,
          const char* name,
          const std::string& text,
          bool has_any_length = false);
  /** Fills the file. */
  void
  addObjects(Bytes& bytes)
  {
    for (std::size_t i = 0; i < most_objects && bytes.size() > 0; ++i)
      if (bytes.choose(3) == 0)
        addAttribute(bytes);
      else
        addTable(bytes);
  }

private:
  void
  addAttribute(Bytes& bytes);
  void
  addTable(Bytes& bytes);
  void
  writeNumbers(hid_t table, Bytes& bytes, std::size_t count);
  void
  writeChunk(hid_t table, Bytes& bytes);

  hid_t file_;
  const Layout& layout_;
};

void
Hdf5Maker::addText(const char* object,
                   const char* name,
                   const std::string& text,
                   bool has_any_length)
{
  const hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, has_any_length ? H5T_VARIABLE : text.size());
  const hid_t made = H5Acreate_by_name(
      file_, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const char* const characters = text.data();
  if (has_any_length)
    H5Awrite(made, type, &characters);
  else
    H5Awrite(made, type, characters);
  H5Aclose(made);
  H5Tclose(type);
  H5Sclose(space);
}

void
Hdf5Maker::addAttribute(Bytes& bytes)
{
  const AttributeName& attribute =
      layout_.attributes[bytes.choose(layout_.attributes.size())];
  if (H5Aexists_by_name(file_, attribute.object, attribute.name, H5P_DEFAULT) != 0)
    return; // it is there, or its group is not
  const hsize_t size = 1 + bytes.choose(7);
  std::vector<double> numbers;
  for (hsize_t i = 0; i < size; ++i)
    numbers.push_back(bytes.flip() ? bytes.take<double>()
                                   : static_cast<double>(bytes.choose(most_rows)));
  const hid_t space = H5Screate_simple(1, &size, nullptr);
  const hid_t made = H5Acreate_by_name(file_,
                                       attribute.object,
                                       attribute.name,
                                       takeType(bytes),
                                       space,
                                       H5P_DEFAULT,
                                       H5P_DEFAULT,
                                       H5P_DEFAULT);
  H5Awrite(made, H5T_NATIVE_DOUBLE, numbers.data());
  H5Aclose(made);
  H5Sclose(space);
}

/** Packed bytes that no filter made. */
void
Hdf5Maker::writeChunk(hid_t table, Bytes& bytes)
{
  const std::array<hsize_t, 3> first{};
  const auto mask = static_cast<std::uint32_t>(bytes.choose(8));
  std::vector<std::uint8_t> packed(1 + bytes.choose(64));
  for (std::uint8_t& byte : packed)
    byte = bytes.take<std::uint8_t>();
  H5Dwrite_chunk(table, H5P_DEFAULT, mask, first.data(), packed.size(), packed.data());
}

void
Hdf5Maker::writeNumbers(hid_t table, Bytes& bytes, std::size_t count)
{
  std::vector<float> numbers(count);
  const bool any_float = bytes.flip();
  for (float& number : numbers)
    number = any_float ? bytes.take<float>() : bytes.take<std::int8_t>();
  H5Dwrite(table, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
}

void
Hdf5Maker::addTable(Bytes& bytes)
{
  const char* const name = layout_.tables[bytes.choose(layout_.tables.size())];
  if (H5Lexists(file_, name, H5P_DEFAULT) != 0)
    return; // it is there, or its group is not
  const int rank = static_cast<int>(bytes.choose(4));
  std::array<hsize_t, 3> sizes{
      {bytes.choose(most_rows), 1 + bytes.choose(most_columns), 1}};
  const hid_t space = H5Screate_simple(rank, sizes.data(), nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  const bool has_chunks = bytes.flip() && rank > 0;
  bool has_other_filter = false; // whose damaged data the library does not survive
  if (has_chunks) {
    const std::array<hsize_t, 3> chunk{
        {1 + bytes.choose(most_rows), 1 + bytes.choose(most_columns), 1}};
    H5Pset_chunk(properties, rank, chunk.data());
    if (bytes.flip())
      H5Pset_shuffle(properties);
    if (bytes.flip())
      H5Pset_deflate(properties, 1);
    const std::size_t others = bytes.choose(16);
    if (others % 2 == 1)
      H5Pset_fletcher32(properties);
    has_other_filter = others >= 12;
    if (has_other_filter)
      H5Pset_nbit(properties);
  }
  const hid_t table = H5Dcreate2(
      file_, name, takeType(bytes), space, H5P_DEFAULT, properties, H5P_DEFAULT);
  if (table >= 0 && rank > 0 && sizes[0] > 0) {
    if (bytes.choose(8) != 0)
      writeNumbers(table, bytes, sizes[0] * (rank > 1 ? sizes[1] : 1));
    if (has_chunks && !has_other_filter && bytes.choose(4) == 0)
      writeChunk(table, bytes);
  }
  if (table >= 0)
    H5Dclose(table);
  H5Pclose(properties);
  H5Sclose(space);
}

} // namespace

void
keepMemoryOfHdf5()
{
  constexpr int all = -1;
  [[maybe_unused]] static const herr_t kept =
      H5set_free_list_limits(all, all, all, all, all, all);
}

void
readHdf5(const std::uint8_t* data, std::size_t size)
{
  Bytes bytes(data, size);
  const std::string path = fileNamed("a.h5");
  constexpr std::array<const char*, 4> insides{
      {"", ":/particles", ":/particles/xyz", ":/x,y,z"}};
  const char* const inside = insides[bytes.choose(insides.size())];
  {
    const pcl_uvol::io::Hdf5Session session;
    keepMemoryOfHdf5();
    Hdf5Maker(path, snapshots).addObjects(bytes);
  }
  readPoints(path + inside, true);
}

void
readVtkHdf(const std::uint8_t* data, std::size_t size)
{
  Bytes bytes(data, size);
  const std::string path = fileNamed("a.vtkhdf");
  constexpr std::array<const char*, 5> types{
      {"PolyData", "UnstructuredGrid", "ImageData", "MultiBlockDataSet", ""}};
  const char* const type = types[bytes.choose(types.size())];
  const std::size_t choice = bytes.choose(8);
  const bool is_series = choice % 4 == 1, has_any_length = choice >= 4;
  {
    const pcl_uvol::io::Hdf5Session session;
    keepMemoryOfHdf5();
    Hdf5Maker file(path, data_of_vtk);
    if (*type != '\0')
      file.addText("/VTKHDF", "Type", type, has_any_length);
    if (is_series)
      for (const char* const group :
           {"/VTKHDF/Steps", "/VTKHDF/Steps/PointDataOffsets"})
        file.addGroup(group);
    file.addText("/VTKHDF/Block", "Type", "PolyData");
    file.addObjects(bytes);
  }
  readPoints(path, true);
  readMesh(path);
}

} // namespace uvol_fuzz
