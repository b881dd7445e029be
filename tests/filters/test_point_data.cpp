// SPDX-License-Identifier: BSD-3-Clause
// VTK data become clouds and clouds VTK data: every array comes back as it was.
#include "io/random_dataset.h"
#include "support/messages.h"
#include "vtk_setup.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/filters/point_data.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <vtkBitArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkSOADataArrayTemplate.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_point_data {

vtkSmartPointer<vtkPolyData>
makePoints(vtkIdType count)
{
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < count; ++i)
    points->InsertNextPoint(static_cast<double>(i), 0.5, -2.0);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  return data;
}

TEST(PointData, EveryTypeOfNumberComesBack)
{
  const auto data = makePoints(5);
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  for (const int type : {VTK_CHAR,
                         VTK_SIGNED_CHAR,
                         VTK_UNSIGNED_CHAR,
                         VTK_SHORT,
                         VTK_UNSIGNED_SHORT,
                         VTK_INT,
                         VTK_UNSIGNED_INT,
                         VTK_LONG,
                         VTK_UNSIGNED_LONG,
                         VTK_LONG_LONG,
                         VTK_UNSIGNED_LONG_LONG,
                         VTK_ID_TYPE,
                         VTK_FLOAT,
                         VTK_DOUBLE}) {
    auto array =
        vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    array->SetName(("type " + std::to_string(type)).c_str());
    array->SetNumberOfComponents(1 + type % 3);
    array->SetNumberOfTuples(5);
    Random random(static_cast<std::uint64_t>(type));
    auto* const bytes = static_cast<unsigned char*>(array->GetVoidPointer(0));
    const auto count = array->GetNumberOfValues() * array->GetDataTypeSize();
    for (vtkIdType i = 0; i < count; ++i)
      bytes[i] = static_cast<unsigned char>(127.0 * random.uniform());
    data->GetPointData()->AddArray(array);
    arrays.push_back(array);
  }
  const Dataset cloud = toPointCloud(data);
  EXPECT_EQ(cloud.notes, std::vector<Message>());
  const auto back = fromPointCloud(cloud);
  ASSERT_EQ(back->GetPointData()->GetNumberOfArrays(), static_cast<int>(arrays.size()));
  for (const auto& array : arrays) {
    SCOPED_TRACE(array->GetName());
    auto* const other = back->GetPointData()->GetArray(array->GetName());
    ASSERT_NE(other, nullptr);
    EXPECT_EQ(other->GetDataTypeSize(), array->GetDataTypeSize());
    EXPECT_EQ(other->GetDataTypeMin(), array->GetDataTypeMin()); // with or without sign
    ASSERT_EQ(other->GetNumberOfComponents(), array->GetNumberOfComponents());
    ASSERT_EQ(other->GetNumberOfTuples(), 5);
    EXPECT_EQ(std::memcmp(other->GetVoidPointer(0),
                          array->GetVoidPointer(0),
                          static_cast<std::size_t>(array->GetNumberOfValues()) *
                              static_cast<std::size_t>(array->GetDataTypeSize())),
              0);
  }
}

TEST(PointData, RandomCloudsComeBack)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<FieldSpec> specs;
    for (const auto type : allDatatypes())
      specs.push_back(
          {"f" + std::to_string(type), type, 1 + (type + unsigned(seed)) % 4});
    Dataset dataset = makeDataset(specs, seed * 3, seed);
    if (seed % 2 == 1)
      dataset.origin = {{1024.0, 0.0, -5e6}};
    dataset.double_coordinates = seed % 2 == 1;
    const Dataset back = toPointCloud(fromPointCloud(dataset));
    EXPECT_EQ(back.double_coordinates, dataset.double_coordinates);
    if (dataset.double_coordinates)
      for (std::size_t i = 0; i < dataset.cloud.width; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
          EXPECT_NEAR(
              coordinateOf(back, axis, i), coordinateOf(dataset, axis, i), 2e-5);
    else
      expectSameFields(back, dataset);
  }
}

TEST(PointData, MemoryInAnyLayout)
{
  const auto data = makePoints(3);
  vtkNew<vtkSOADataArrayTemplate<float>> columns;
  columns->SetName("columns");
  columns->SetNumberOfComponents(2);
  columns->SetNumberOfTuples(3);
  vtkNew<vtkBitArray> bits;
  bits->SetName("bits");
  for (int i = 0; i < 3; ++i) {
    columns->SetTypedComponent(i, 0, 10.0f + static_cast<float>(i));
    columns->SetTypedComponent(i, 1, 20.0f + static_cast<float>(i));
    bits->InsertNextValue(i % 2);
  }
  data->GetPointData()->AddArray(columns);
  data->GetPointData()->AddArray(bits);
  const Dataset cloud = toPointCloud(data);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(valueOf(cloud, "columns[0]", i), 10.0 + double(i));
    EXPECT_EQ(valueOf(cloud, "columns[1]", i), 20.0 + double(i));
    EXPECT_EQ(valueOf(cloud, "bits", i), double(i % 2));
  }
}

TEST(PointData, NamesThatCoordinatesHave)
{
  const auto data = makePoints(2);
  for (const char* const name : {"x", "a", "a b", "_"}) {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->InsertNextValue(7);
    array->InsertNextValue(8);
    data->GetPointData()->AddArray(array);
  }
  vtkNew<vtkIntArray> nameless;
  nameless->SetNumberOfTuples(2);
  data->GetPointData()->AddArray(nameless);
  const Dataset cloud = toPointCloud(data);
  EXPECT_EQ(
      describeFields(cloud.cloud.fields),
      "x (float32), y (float32), z (float32), x_2 (int32), a (int32), a b (int32), "
      "__2 (int32), array_4 (int32)");
  EXPECT_EQ(
      cloud.notes,
      (std::vector<Message>{{"renamed_array", {{"array", "x"}, {"name", "x_2"}}},
                            {"renamed_array", {{"array", "_"}, {"name", "__2"}}}}));
  EXPECT_EQ(valueOf(cloud, "x", 1), 1.0);
  EXPECT_EQ(valueOf(cloud, "x_2", 1), 8.0);
}

TEST(PointData, WhatNoCloudHoldsIsNoted)
{
  const auto data = makeSamples(3);
  vtkNew<vtkFloatArray> shorter;
  shorter->SetName("shorter");
  shorter->SetNumberOfTuples(2);
  data->GetPointData()->AddArray(shorter);
  const Dataset cloud = toPointCloud(data);
  ASSERT_EQ(cloud.notes.size(), 2u);
  EXPECT_EQ(
      cloud.notes[0],
      Message("unfitting_array", {{"array", "shorter"}, {"tuples", 2}, {"points", 3}}));
  EXPECT_EQ(cloud.notes[1].code, "array_of_texts");
  EXPECT_EQ(wordOf(cloud.notes[1], "array"), "name");
  EXPECT_EQ(wordOf(cloud.notes[1], "type"), "vtkStringArray");
  EXPECT_EQ(findField(cloud.cloud.fields, "name"), nullptr);
}

TEST(PointData, ActiveNormals)
{
  const auto data = makePoints(2);
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("N");
  normals->SetNumberOfComponents(3);
  normals->InsertNextTuple3(0.0, 0.0, 1.0);
  normals->InsertNextTuple3(0.0, 1.0, 0.0);
  data->GetPointData()->SetNormals(normals);
  const Dataset cloud = toPointCloud(data);
  EXPECT_EQ(valueOf(cloud, "normal_z", 0), 1.0);
  EXPECT_EQ(valueOf(cloud, "normal_y", 1), 1.0);
  const auto back_data = fromPointCloud(cloud);
  vtkDataArray* const back = back_data->GetPointData()->GetNormals();
  ASSERT_NE(back, nullptr);
  EXPECT_EQ(back->GetDataType(), VTK_DOUBLE);
  expectSameNumbers(*back, *normals);
}

TEST(PointData, PointsOfImagesAreComputed)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 3, 4);
  image->SetOrigin(100.0, 0.0, 0.0);
  image->SetSpacing(0.5, 1.0, 2.0);
  const Dataset cloud = toPointCloud(image);
  ASSERT_EQ(cloud.cloud.width, 24u);
  EXPECT_FALSE(cloud.double_coordinates);
  EXPECT_EQ(coordinateOf(cloud, 0, 23), 100.5);
  EXPECT_EQ(coordinateOf(cloud, 1, 23), 2.0);
  EXPECT_EQ(coordinateOf(cloud, 2, 23), 6.0);
}

TEST(PointData, LargeCoordinatesKeepTheirDigits)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(5000000.0001, -2e7 + 0.0003, 1.0);
  points->InsertNextPoint(5000001.0002, -2e7 + 0.0004, 2.0);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  const Dataset cloud = toPointCloud(grid);
  EXPECT_TRUE(cloud.double_coordinates);
  EXPECT_NEAR(coordinateOf(cloud, 0, 1), 5000001.0002, 1e-7);
  const auto back = fromPointCloud(cloud);
  EXPECT_EQ(back->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (vtkIdType i = 0; i < 2; ++i)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(back->GetPoint(i)[axis], points->GetPoint(i)[axis], 1e-7);
}

TEST(PointData, CloudsOfPcl)
{
  pcl::PointCloud<pcl::PointXYZRGBNormal> points(3, 2); // organized, with padding
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].x = static_cast<float>(i);
    points[i].normal_y = 1.0f;
    points[i].curvature = 0.25f;
  }
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(points, cloud);
  const auto data = fromPointCloud(cloud);
  ASSERT_EQ(data->GetNumberOfPoints(), 6);
  EXPECT_EQ(data->GetNumberOfVerts(), 6);
  EXPECT_EQ(data->GetPoint(4)[0], 4.0);
  EXPECT_EQ(data->GetPointData()->GetNormals()->GetComponent(5, 1), 1.0);
  EXPECT_EQ(data->GetPointData()->GetArray("curvature")->GetComponent(5, 0), 0.25);
  EXPECT_EQ(data->GetPointData()->GetNumberOfArrays(), 3); // rgb as well
}

TEST(PointData, NoPoints)
{
  vtkNew<vtkPolyData> empty; // not even vtkPoints
  const Dataset cloud = toPointCloud(empty);
  EXPECT_EQ(cloud.cloud.width, 0u);
  EXPECT_EQ(fromPointCloud(cloud)->GetNumberOfPoints(), 0);
}

TEST(PointData, BadInput)
{
  EXPECT_THROW(toPointCloud(nullptr), InvalidArgument);
  pcl::PCLPointCloud2 cloud = makeDataset({}, 4, 1).cloud;
  cloud.data.pop_back();
  EXPECT_THROW(fromPointCloud(cloud), InvalidArgument);
  cloud = makeDataset({}, 4, 1).cloud;
  cloud.fields[1].name = "why";
  const Message error =
      uvol_test::thrownBy<InvalidArgument>([&] { fromPointCloud(cloud); });
  EXPECT_EQ("no_coordinate_field", error.code);
  EXPECT_EQ("y", uvol_test::wordOf(error, "axis"));
  cloud.fields[1].name = "y";
  cloud.fields[2].offset = 100;
  EXPECT_THROW(fromPointCloud(cloud), InvalidArgument);
}

} // namespace test_point_data
