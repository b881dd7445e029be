// SPDX-License-Identifier: BSD-3-Clause
// Files of VTK in HDF5: what is written comes back, what others write is read, and
// counts that do not fit are one sentence.
#include "common/printable.h"
#include "common/records.h"
#include "hdf5_writer.h"
#include "io/point_stream.h"
#include "random_dataset.h"
#include "support/messages.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <algorithm>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_vtkhdf {

/** The numbers of a table, by the library. */
std::vector<double>
tableOf(const std::string& path, const std::string& name)
{
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t id = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(id);
  std::vector<double> numbers(
      static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
  H5Sclose(space);
  H5Dclose(id);
  H5Fclose(file);
  return numbers;
}

/** "<f8": order, kind and bytes of a number as NumPy calls them; "S5": a text padded by
 * zeros. */
std::string
nameType(hid_t type)
{
  const std::string size = std::to_string(H5Tget_size(type));
  if (H5Tget_class(type) == H5T_STRING)
    return (H5Tget_strpad(type) == H5T_STR_NULLPAD ? "S" : "?") + size;
  const bool is_float = H5Tget_class(type) == H5T_FLOAT;
  return (H5Tget_order(type) == H5T_ORDER_LE ? "<" : ">") +
         std::string(is_float                            ? "f"
                     : H5Tget_sign(type) == H5T_SGN_NONE ? "u"
                                                         : "i") +
         size;
}

/** " <f8 4x3" */
std::string
describeTable(hid_t type, hid_t space)
{
  hsize_t sizes[H5S_MAX_RANK];
  const int rank = H5Sget_simple_extent_dims(space, sizes, nullptr);
  std::string text = ' ' + nameType(type);
  for (int i = 0; i < rank; ++i)
    text += (i > 0 ? "x" : " ") + std::to_string(sizes[i]);
  H5Sclose(space);
  H5Tclose(type);
  return text;
}

/** A line per group, table and attribute. */
std::string
describeFile(const std::string& path)
{
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  std::vector<std::string> names;
  H5Lvisit(
      file,
      H5_INDEX_NAME,
      H5_ITER_INC,
      [](hid_t, const char* name, const auto*, void* list) {
        static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return herr_t(0);
      },
      &names);
  std::string text;
  for (const std::string& name : names) {
    const hid_t object = H5Oopen(file, name.c_str(), H5P_DEFAULT);
    text += name;
    if (H5Iget_type(object) == H5I_DATASET)
      text += describeTable(H5Dget_type(object), H5Dget_space(object));
    text += '\n';
    H5Aiterate2(
        object,
        H5_INDEX_NAME,
        H5_ITER_INC,
        nullptr,
        [](hid_t owner, const char* attribute, const H5A_info_t*, void* lines) {
          const hid_t id = H5Aopen(owner, attribute, H5P_DEFAULT);
          const std::string type = describeTable(H5Aget_type(id), H5Aget_space(id));
          *static_cast<std::string*>(lines) += std::string(" ") + attribute + type;
          if (type[1] == 'S') {
            std::string value(H5Aget_storage_size(id), ' ');
            const hid_t stored = H5Aget_type(id);
            H5Aread(id, stored, value.data());
            H5Tclose(stored);
            *static_cast<std::string*>(lines) += ' ' + value;
          }
          else {
            std::int64_t values[2];
            H5Aread(id, H5T_NATIVE_INT64, values);
            *static_cast<std::string*>(lines) +=
                ' ' + std::to_string(values[0]) + ',' + std::to_string(values[1]);
          }
          *static_cast<std::string*>(lines) += '\n';
          H5Aclose(id);
          return herr_t(0);
        },
        &text);
    H5Oclose(object);
  }
  H5Fclose(file);
  return text;
}

using Numbers = std::vector<double>;

class VtkHdf : public testing::Test {
protected:
  /** Five points in two parts, the first one of two. */
  void
  savePoints(const std::string& type, const Numbers& counts = {2, 3})
  {
    Hdf5Writer file(path_);
    file.group("/VTKHDF");
    file.text("/VTKHDF", "Type", type);
    file.attribute("/VTKHDF", "Version", {2, 0});
    file.table("/VTKHDF/NumberOfPoints", H5T_STD_I64LE, 1, counts);
    file.table("/VTKHDF/Points", H5T_IEEE_F32LE, 3, numbersOf(15, 0));
    file.group("/VTKHDF/PointData");
    file.table("/VTKHDF/PointData/T", H5T_IEEE_F64BE, 1, numbersOf(5, 7));
    file.table("/VTKHDF/PointData/v", H5T_STD_I16LE, 2, numbersOf(10, -3), 2);
  }

  /** An image of 3 x 2 x 2 points. */
  void
  saveImage(const Numbers& extent = {1, 3, 0, 1, 0, 1}, bool has_data = true)
  {
    Hdf5Writer file(path_);
    file.group("/VTKHDF");
    file.text("/VTKHDF", "Type", "ImageData");
    file.attribute("/VTKHDF", "WholeExtent", extent);
    file.attribute("/VTKHDF", "Origin", {10, 20, 30});
    file.attribute("/VTKHDF", "Spacing", {0.5, 1, 2});
    file.attribute("/VTKHDF", "Direction", {0, -1, 0, 1, 0, 0, 0, 0, 1});
    file.group("/VTKHDF/PointData");
    if (!has_data)
      return;
    file.block("/VTKHDF/PointData/T", H5T_IEEE_F32LE, {2, 2, 3}, numbersOf(12, 100));
    file.block("/VTKHDF/PointData/v",
               H5T_STD_I32LE,
               {2, 2, 3, 2},
               numbersOf(24, 0),
               {1, 2, 2, 1});
    file.block(
        "/VTKHDF/PointData/w", H5T_IEEE_F64BE, {2, 2, 3}, numbersOf(12, 5), {2, 1, 2});
    file.block("/VTKHDF/PointData/short", H5T_STD_I32LE, {2, 5}, numbersOf(10, 0));
  }

  /** The code of the error; "" for a file that is read. */
  std::string
  refusalOf(const std::string& path) const
  {
    const Message thrown = thrownBy([&] { loadDataset(path); });
    if (!thrown.code.empty()) {
      const std::string message = thrown.text();
      EXPECT_EQ(0u, message.find("Cannot read '" + path_)) << message;
      EXPECT_EQ('.', message.back()) << message;
      EXPECT_LE(message.size(), 300 + path.size()) << message;
      EXPECT_TRUE(isPrintable(message)) << message;
    }
    return thrown.code;
  }

  void
  expectStreams(std::size_t points) const
  {
    const Dataset whole = loadDataset(path_);
    EXPECT_EQ(points, whole.cloud.width);
    PointStream stream(path_);
    pcl::PCLPointCloud2 block;
    std::vector<std::uint8_t> bytes;
    while (stream.read(2, block) > 0)
      bytes.insert(bytes.end(), block.data.begin(), block.data.end());
    EXPECT_TRUE(whole.cloud.data == bytes);
  }

  TemporaryFolder folder_;
  const std::string path_ = folder_ / "a.vtkhdf";
};

TEST_F(VtkHdf, PointsComeBack)
{
  std::vector<FieldSpec> specs{{"vel", Type::FLOAT32, 3}, {"pair", Type::INT16, 2}};
  for (const std::uint8_t type : allDatatypes())
    specs.push_back({"f" + std::to_string(type), type});
  for (const bool is_wide : {false, true})
    for (const std::size_t count : {0u, 1u, 20000u}) {
      Dataset dataset = makeDataset(specs, count, 5);
      dataset.double_coordinates = is_wide;
      if (is_wide)
        dataset.origin = {{1048576.0, -2097152.0, 0.0}};
      saveDataset(path_, dataset);
      const Dataset back = loadDataset(path_);
      ASSERT_EQ(count, back.cloud.width);
      EXPECT_EQ(is_wide, back.double_coordinates);
      ASSERT_EQ(dataset.cloud.fields.size(), back.cloud.fields.size());
      for (const auto& field : dataset.cloud.fields) {
        const auto* const found = findField(back.cloud.fields, field.name);
        ASSERT_NE(nullptr, found) << field.name;
        EXPECT_EQ(field.datatype, found->datatype) << field.name;
        ASSERT_EQ(field.count, found->count) << field.name;
        for (std::size_t i = 0; axisOf(field.name) < 0 && i < count; i += 17) {
          EXPECT_EQ(
              0,
              std::memcmp(
                  &dataset.cloud.data[i * dataset.cloud.point_step + field.offset],
                  &back.cloud.data[i * back.cloud.point_step + found->offset],
                  fieldBytes(field)))
              << field.name;
        }
      }
      for (std::size_t i = 0; i < count; i += 17)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::string name(1, static_cast<char>('x' + axis));
          EXPECT_EQ(dataset.origin[axis] + valueAt(dataset, name, i),
                    back.origin[axis] + valueAt(back, name, i));
        }
    }
}

/** What ParaView looks for: VTK's specification, version 2.0. */
TEST_F(VtkHdf, VerticesShowEveryPoint)
{
  saveDataset(path_, makeDataset({{"a", Type::FLOAT32}}, 3, 1));
  EXPECT_EQ(Numbers{3}, tableOf(path_, "/VTKHDF/NumberOfPoints"));
  EXPECT_EQ(Numbers{3}, tableOf(path_, "/VTKHDF/Vertices/NumberOfCells"));
  EXPECT_EQ(Numbers{3}, tableOf(path_, "/VTKHDF/Vertices/NumberOfConnectivityIds"));
  EXPECT_EQ((Numbers{0, 1, 2}), tableOf(path_, "/VTKHDF/Vertices/Connectivity"));
  EXPECT_EQ((Numbers{0, 1, 2, 3}), tableOf(path_, "/VTKHDF/Vertices/Offsets"));
  for (const char* const kind : {"Lines", "Polygons", "Strips"}) {
    const std::string group = std::string("/VTKHDF/") + kind;
    EXPECT_EQ(Numbers{0}, tableOf(path_, group + "/NumberOfCells"));
    EXPECT_EQ(Numbers{0}, tableOf(path_, group + "/NumberOfConnectivityIds"));
    EXPECT_EQ(Numbers{}, tableOf(path_, group + "/Connectivity"));
    EXPECT_EQ(Numbers{0}, tableOf(path_, group + "/Offsets"));
  }
  EXPECT_EQ(9u, tableOf(path_, "/VTKHDF/Points").size());
  const std::string bytes = readFile(path_);
  saveDataset(path_, loadDataset(path_));
  EXPECT_TRUE(bytes == readFile(path_));
}

TEST_F(VtkHdf, NormalsAreAVectorOfVtk)
{
  const Dataset dataset = makeDataset({{"normal_x", Type::FLOAT32},
                                       {"normal_y", Type::FLOAT32},
                                       {"normal_z", Type::FLOAT32},
                                       {"a", Type::FLOAT32}},
                                      4,
                                      2);
  saveDataset(path_, dataset);
  EXPECT_EQ(12u, tableOf(path_, "/VTKHDF/PointData/Normals").size());
  const Dataset back = loadDataset(path_);
  for (const char* const axis : {"normal_x", "normal_y", "normal_z"}) {
    const double expected = valueAt(dataset, axis, 3), actual = valueAt(back, axis, 3);
    EXPECT_TRUE(expected == actual || (std::isnan(expected) && std::isnan(actual)));
  }
}

/** The library of HDF5 finds in a file what our writer of the format puts there. */
TEST_F(VtkHdf, WritesTheSameTablesTypesAndAttributes)
{
  Dataset dataset = makeDataset({{"normal_x", Type::FLOAT32},
                                 {"normal_y", Type::FLOAT32},
                                 {"normal_z", Type::FLOAT32},
                                 {"\xc3\xa4", Type::INT8},
                                 {"b", Type::UINT16},
                                 {"c", Type::FLOAT64},
                                 {"d", Type::UINT64},
                                 {"e", Type::INT32, 2},
                                 {"f", Type::BOOL}},
                                4,
                                2);
  saveMesh(path_, dataset, {{0, 1, 2}, {1, 2, 3}});
  EXPECT_EQ(describeFile(path_),
            "VTKHDF\n"
            " Type S8 PolyData\n"
            " Version <i8 2 2,0\n"
            "VTKHDF/Lines\n"
            "VTKHDF/Lines/Connectivity <i8 0\n"
            "VTKHDF/Lines/NumberOfCells <i8 1\n"
            "VTKHDF/Lines/NumberOfConnectivityIds <i8 1\n"
            "VTKHDF/Lines/Offsets <i8 1\n"
            "VTKHDF/NumberOfPoints <i8 1\n"
            "VTKHDF/PointData\n"
            "VTKHDF/PointData/Normals <f4 4x3\n"
            " Attribute S7 Normals\n"
            "VTKHDF/PointData/b <u2 4\n"
            "VTKHDF/PointData/c <f8 4\n"
            "VTKHDF/PointData/d <u8 4\n"
            "VTKHDF/PointData/e <i4 4x2\n"
            "VTKHDF/PointData/f <u1 4\n"
            "VTKHDF/PointData/\xc3\xa4 <i1 4\n"
            "VTKHDF/Points <f4 4x3\n"
            "VTKHDF/Polygons\n"
            "VTKHDF/Polygons/Connectivity <i8 6\n"
            "VTKHDF/Polygons/NumberOfCells <i8 1\n"
            "VTKHDF/Polygons/NumberOfConnectivityIds <i8 1\n"
            "VTKHDF/Polygons/Offsets <i8 3\n"
            "VTKHDF/Strips\n"
            "VTKHDF/Strips/Connectivity <i8 0\n"
            "VTKHDF/Strips/NumberOfCells <i8 1\n"
            "VTKHDF/Strips/NumberOfConnectivityIds <i8 1\n"
            "VTKHDF/Strips/Offsets <i8 1\n"
            "VTKHDF/Vertices\n"
            "VTKHDF/Vertices/Connectivity <i8 0\n"
            "VTKHDF/Vertices/NumberOfCells <i8 1\n"
            "VTKHDF/Vertices/NumberOfConnectivityIds <i8 1\n"
            "VTKHDF/Vertices/Offsets <i8 1\n");
  EXPECT_EQ((Numbers{0, 1, 2, 1, 2, 3}),
            tableOf(path_, "/VTKHDF/Polygons/Connectivity"));
  const Numbers points = tableOf(path_, "/VTKHDF/Points"),
                wide = tableOf(path_, "/VTKHDF/PointData/c");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(valueAt(dataset, "y", i), points[3 * i + 1]);
    EXPECT_EQ(valueAt(dataset, "c", i), wide[i]);
  }
  dataset.double_coordinates = true;
  saveDataset(path_, dataset);
  EXPECT_NE(std::string::npos, describeFile(path_).find("VTKHDF/Points <f8 4x3\n"));
}

/** More tables than the header of a group holds. */
TEST_F(VtkHdf, ManyFieldsComeBack)
{
  std::vector<FieldSpec> specs;
  for (int i = 0; i < 300; ++i)
    specs.push_back({"field" + std::to_string(i), Type::INT32});
  const Dataset dataset = makeDataset(specs, 2, 2);
  saveDataset(path_, dataset);
  const std::string bytes = readFile(path_);
  const Dataset back = loadDataset(path_);
  EXPECT_EQ(dataset.cloud.fields.size(), back.cloud.fields.size());
  EXPECT_EQ(valueAt(dataset, "field299", 1), valueAt(back, "field299", 1));
  saveDataset(path_, dataset);
  EXPECT_TRUE(bytes == readFile(path_));
}

TEST_F(VtkHdf, NamesMayBeAny)
{
  const Dataset dataset = makeDataset({{"a/b", Type::INT32},
                                       {"a_b", Type::INT32},
                                       {".", Type::INT32},
                                       {"two words\n\"", Type::INT32},
                                       {"\xc3\xa4", Type::INT32}},
                                      3,
                                      2);
  saveDataset(path_, dataset);
  const Dataset back = loadDataset(path_);
  EXPECT_EQ(dataset.cloud.fields.size() - 1, back.cloud.fields.size()); // "_": padding
  for (const auto& [name, called] : std::vector<std::pair<std::string, std::string>>{
           {"a/b", "a_b"},
           {"a_b", "a_b_2"},
           {"two words\n\"", "two words\n\""},
           {"\xc3\xa4", "\xc3\xa4"}})
    EXPECT_EQ(valueAt(dataset, name, 2), valueAt(back, called, 2)) << name;
}

TEST_F(VtkHdf, MeshesComeBack)
{
  const Dataset vertices = makeDataset({{"a", Type::FLOAT64}}, 4, 3);
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 2, 3}, {3, 2, 0}};
  saveMesh(path_, vertices, triangles);
  std::vector<Triangle> back;
  const Dataset loaded = loadMesh(path_, back);
  EXPECT_EQ(triangles, back);
  EXPECT_TRUE(loaded.cloud.data == vertices.cloud.data);
  EXPECT_EQ(Numbers{0}, tableOf(path_, "/VTKHDF/Vertices/NumberOfCells"));
  EXPECT_EQ((Numbers{0, 3, 6, 9}), tableOf(path_, "/VTKHDF/Polygons/Offsets"));
  saveDataset(path_, vertices);
  loadMesh(path_, back);
  EXPECT_TRUE(back.empty());
}

TEST_F(VtkHdf, PartsAreOneCloud)
{
  for (const char* const type : {"PolyData", "UnstructuredGrid"}) {
    savePoints(type);
    const Dataset points = loadDataset(path_);
    ASSERT_EQ(5u, points.cloud.width);
    EXPECT_EQ(14.0, valueAt(points, "z", 4));
    EXPECT_EQ(11.0, valueAt(points, "T", 4));
    EXPECT_EQ(Type::INT16, findField(points.cloud.fields, "v")->datatype);
    EXPECT_EQ(4.0, valueAt(points, "v[1]", 3));
    EXPECT_TRUE(points.notes.empty());
    expectStreams(5);
    EXPECT_EQ(5u, loadDataset(path_ + ":/VTKHDF").cloud.width);
  }
}

/** As h5py writes texts. */
TEST_F(VtkHdf, TypesMayHaveAnyLength)
{
  {
    Hdf5Writer file(path_);
    file.group("/VTKHDF");
    file.text("/VTKHDF", "Type", "PolyData", true);
    file.table("/VTKHDF/NumberOfPoints", H5T_STD_I64LE, 1, {1});
    file.table("/VTKHDF/Points", H5T_IEEE_F64LE, 3, {1, 2, 3});
  }
  EXPECT_EQ(3.0, valueAt(loadDataset(path_), "z", 0));
}

TEST_F(VtkHdf, PolygonsBecomeFans)
{
  savePoints("PolyData");
  {
    Hdf5Writer file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
    file.group("/VTKHDF/Polygons");
    file.table("/VTKHDF/Polygons/NumberOfCells", H5T_STD_I64LE, 1, {0, 2});
    file.table("/VTKHDF/Polygons/Offsets", H5T_STD_I32LE, 1, {0, 0, 3, 6});
    file.table("/VTKHDF/Polygons/Connectivity", H5T_STD_I32LE, 1, {0, 1, 2, 2, 1, 0});
  }
  std::vector<Triangle> triangles;
  EXPECT_EQ(5u, loadMesh(path_, triangles).cloud.width);
  EXPECT_EQ((std::vector<Triangle>{{2, 3, 4}, {4, 3, 2}}), triangles);
}

TEST_F(VtkHdf, WrongPolygonsAreOneSentence)
{
  for (const auto& [ends, corners, code] :
       std::vector<std::tuple<Numbers, Numbers, std::string>>{
           {{0, 3}, {0, 1, 9}, "missing_target"},
           {{0, 3}, {0, 1, -1}, "missing_target"},
           {{0, 3}, {0, 1}, "missing_part"},
           {{0, -3}, {0, 1, 2}, "disagreeing_parts"},
           {{1, 3}, {0, 1, 2}, "disagreeing_parts"},
           {{0}, {0, 1, 2}, "missing_part"}}) {
    savePoints("PolyData", {5});
    {
      Hdf5Writer file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
      file.group("/VTKHDF/Polygons");
      file.table("/VTKHDF/Polygons/NumberOfCells", H5T_STD_I64LE, 1, {1});
      file.table("/VTKHDF/Polygons/Offsets", H5T_STD_I64LE, 1, ends);
      file.table("/VTKHDF/Polygons/Connectivity", H5T_STD_I64LE, 1, corners);
    }
    std::vector<Triangle> triangles;
    EXPECT_EQ(code, codeOf([&] { loadMesh(path_, triangles); }));
  }
}

TEST_F(VtkHdf, OfSeveralTimesTheFirstIsRead)
{
  savePoints("PolyData");
  {
    Hdf5Writer file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
    file.group("/VTKHDF/Steps");
    file.attribute("/VTKHDF/Steps", "NSteps", {2});
    file.table("/VTKHDF/Steps/NumberOfParts", H5T_STD_I64LE, 1, {1, 1});
    file.table("/VTKHDF/Steps/PartOffsets", H5T_STD_I64LE, 1, {1, 0});
    file.table("/VTKHDF/Steps/PointOffsets", H5T_STD_I64LE, 1, {2, 0});
    file.group("/VTKHDF/Steps/PointDataOffsets");
    file.table("/VTKHDF/Steps/PointDataOffsets/T", H5T_STD_I64LE, 1, {1, 0});
  }
  const Dataset points = loadDataset(path_);
  ASSERT_EQ(3u, points.cloud.width);
  EXPECT_EQ(6.0, valueAt(points, "x", 0));
  EXPECT_EQ(8.0, valueAt(points, "T", 0));
  EXPECT_EQ(-3.0, valueAt(points, "v[0]", 0));
  EXPECT_EQ((std::vector<Message>{{"first_time", {{"times", 2}}}}), points.notes);
  expectStreams(3);
  std::vector<Triangle> triangles;
  EXPECT_EQ("several_times", codeOf([&] { loadMesh(path_, triangles); }));
}

TEST_F(VtkHdf, ImagesAreSamples)
{
  saveImage();
  const Dataset points = loadDataset(path_);
  ASSERT_EQ(12u, points.cloud.width);
  for (std::size_t i = 0; i < 12; ++i) {
    const double column = 0.5 * static_cast<double>(1 + i % 3),
                 row = static_cast<double>(i / 3 % 2),
                 layer = 2.0 * static_cast<double>(i / 6);
    EXPECT_EQ(10.0 - row, valueAt(points, "x", i) + points.origin[0]);
    EXPECT_EQ(20.0 + column, valueAt(points, "y", i) + points.origin[1]);
    EXPECT_EQ(30.0 + layer, valueAt(points, "z", i) + points.origin[2]);
    EXPECT_EQ(100.0 + static_cast<double>(i), valueAt(points, "T", i));
    EXPECT_EQ(2.0 * static_cast<double>(i) + 1.0, valueAt(points, "v[1]", i));
    EXPECT_EQ(5.0 + static_cast<double>(i), valueAt(points, "w", i));
  }
  ASSERT_EQ(1u, points.notes.size());
  EXPECT_EQ("unfitting_layers", points.notes[0].code);
  EXPECT_EQ("short", wordOf(points.notes[0], "array"));
  EXPECT_EQ(2.0, numberOf(points.notes[0], "layers"));
  expectStreams(12);
}

TEST_F(VtkHdf, WrongImagesAreOneSentence)
{
  saveImage({1, 3, 0, 1, 0, 1}, false);
  EXPECT_EQ("nothing_inside", refusalOf(path_));
  for (const Numbers& extent : {Numbers{0, -1, 0, 1, 0, 1},
                                Numbers{0, 4e9, 0, 1, 0, 1},
                                Numbers{0, 99999, 0, 99999, 0, 1},
                                Numbers{0, NAN, 0, 1, 0, 1}}) {
    saveImage(extent);
    EXPECT_EQ("invalid_part", refusalOf(path_));
  }
  saveImage({0, 7, 0, 6, 0, 1});
  EXPECT_EQ("nothing_inside", refusalOf(path_));
  saveImage({0, 7, 0, 6});
  EXPECT_EQ("missing_part", refusalOf(path_));
}

TEST_F(VtkHdf, WrongCountsAreOneSentence)
{
  for (const Numbers& counts : {Numbers{2, 2},
                                Numbers{2, 4},
                                Numbers{-1, 6},
                                Numbers{9e18, 9e18},
                                Numbers{4294967296.0 + 5.0}}) {
    savePoints("PolyData", counts);
    EXPECT_EQ("wrong_count", refusalOf(path_));
  }
}

TEST_F(VtkHdf, OtherTypesAreOneSentence)
{
  savePoints("OverlappingAMR");
  EXPECT_EQ("vtkhdf_type", refusalOf(path_));
  {
    Hdf5Writer file(path_);
    file.group("/VTKHDF");
    file.text("/VTKHDF", "Type", "MultiBlockDataSet");
    file.group("/VTKHDF/Block 0");
    file.text("/VTKHDF/Block 0", "Type", "PolyData");
    file.table("/VTKHDF/Block 0/NumberOfPoints", H5T_STD_I64LE, 1, {1});
    file.table("/VTKHDF/Block 0/Points", H5T_IEEE_F64LE, 3, {1, 2, 3});
  }
  EXPECT_EQ("/VTKHDF/Block 0", wordOf(thrownBy([&] { loadDataset(path_); }), "part"));
  EXPECT_EQ(3.0, valueAt(loadDataset(path_ + ":/VTKHDF/Block 0"), "z", 0));
  LoadOptions cells;
  cells.cells = true;
  EXPECT_EQ("cells_of_no_grid",
            codeOf<InvalidArgument>([&] { loadDataset(path_, cells); }));
}

TEST_F(VtkHdf, DataOfCellsAreNamed)
{
  {
    Hdf5Writer file(path_);
    file.group("/VTKHDF");
    file.text("/VTKHDF", "Type", "UnstructuredGrid");
    file.table("/VTKHDF/NumberOfPoints", H5T_STD_I64LE, 1, {1});
    file.table("/VTKHDF/Points", H5T_IEEE_F64LE, 3, {1, 2, 3});
    file.group("/VTKHDF/CellData");
    file.table("/VTKHDF/CellData/p", H5T_IEEE_F64LE, 1, {5});
  }
  const Dataset points = loadDataset(path_);
  ASSERT_EQ(1u, points.notes.size());
  EXPECT_EQ("only_cell_data", points.notes[0].code);
}

TEST_F(VtkHdf, TruncationIsOneSentence)
{
  saveDataset(path_, makeDataset({{"a", Type::FLOAT32}}, 3, 1));
  const std::string bytes = readFile(path_);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 500) {
    writeFile(path_, bytes.substr(0, size));
    EXPECT_NE("", refusalOf(path_)) << size;
  }
}

TEST_F(VtkHdf, WritingThatFailsLeavesNothing)
{
  const std::string path = folder_ / "none/a.vtkhdf";
  EXPECT_NE("", messageOf<IOError>([&] {
              saveDataset(path, makeDataset({{"a", Type::FLOAT32}}, 3, 1));
            }));
  EXPECT_TRUE(folder_.list().empty());
}

} // namespace test_vtkhdf
