// SPDX-License-Identifier: BSD-3-Clause
// Our readers of VTK's files against VTK's own, on every way in which VTK writes them.
#include "random_dataset.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/filters/point_data.h>
#include <pcl_uvol/io/dataset.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetReader.h>
#include <vtkDataSetWriter.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkShortArray.h>
#include <vtkSignedCharArray.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataSetWriter.h>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_vtk_readers {

template <typename ArrayT>
void
addArray(vtkDataSetAttributes* data,
         const char* name,
         int components,
         vtkIdType tuples,
         double scale)
{
  Random random(static_cast<std::uint64_t>(components) + 10);
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    array->SetValue(
        i, static_cast<typename ArrayT::ValueType>(scale * (random.uniform() - 0.4)));
  data->AddArray(array);
}

/** Arrays of many types, active scalars and normals, texts, data of cells. */
void
addData(vtkDataSet& data)
{
  const vtkIdType count = data.GetNumberOfPoints();
  auto* const points = data.GetPointData();
  addArray<vtkFloatArray>(points, "rho", 1, count, 1.0);
  addArray<vtkDoubleArray>(points, "a name <with> & \"all\" %20", 3, count, 1e-200);
  addArray<vtkShortArray>(points, "short", 2, count, 1e4);
  addArray<vtkSignedCharArray>(points, "char", 1, count, 100.0);
  addArray<vtkUnsignedCharArray>(points, "byte", 1, count, 0.0);
  addArray<vtkIntArray>(points, "int", 1, count, 1e9);
  addArray<vtkIdTypeArray>(points, "id", 1, count, 1e9);
  addArray<vtkFloatArray>(points, "N", 3, count, 1.0);
  points->SetActiveScalars("rho");
  points->SetActiveNormals("N");
  vtkNew<vtkStringArray> texts;
  texts->SetName("texts");
  for (vtkIdType i = 0; i < count; ++i)
    texts->InsertNextValue(i % 2 ? "some words" : std::string(300, 'x'));
  points->AddArray(texts);
  addArray<vtkFloatArray>(
      data.GetCellData(), "of cells", 2, data.GetNumberOfCells(), 1);
  addArray<vtkDoubleArray>(data.GetCellData(), "more", 1, data.GetNumberOfCells(), 1);
}

void
setPoints(vtkPointSet& set, vtkIdType count, bool doubles)
{
  Random random(3);
  vtkNew<vtkPoints> points;
  points->SetDataType(doubles ? VTK_DOUBLE : VTK_FLOAT);
  for (vtkIdType i = 0; i < count; ++i)
    points->InsertNextPoint(
        random.uniform() + (doubles ? 5e5 : 0.0), random.uniform(), random.uniform());
  set.SetPoints(points);
}

vtkSmartPointer<vtkDataSet>
makeData(const std::string& kind)
{
  constexpr int dims[] = {4, 3, 5};
  constexpr vtkIdType count = 60;
  vtkSmartPointer<vtkDataSet> data;
  const vtkIdType triangle[] = {0, 5, 7};
  if (kind == "vti") {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(dims);
    image->SetOrigin(1, 2, 3);
    image->SetSpacing(0.5, 0.25, 2);
    data = image;
  }
  else if (kind == "vtr") {
    auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
    vtkNew<vtkDoubleArray> axis;
    for (const double x : {0.0, 0.5, 3.0, 7.0, 9.0})
      axis->InsertNextValue(x);
    grid->SetDimensions(5, 5, 5);
    grid->SetXCoordinates(axis);
    grid->SetYCoordinates(axis);
    grid->SetZCoordinates(axis);
    data = grid;
  }
  else if (kind == "vts") {
    auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
    grid->SetDimensions(dims[0], dims[1], dims[2]);
    setPoints(*grid, count, true);
    data = grid;
  }
  else if (kind == "vtu") {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    setPoints(*grid, count, false);
    grid->InsertNextCell(VTK_TRIANGLE, 3, triangle);
    grid->InsertNextCell(VTK_LINE, 2, triangle);
    data = grid;
  }
  else {
    auto poly = vtkSmartPointer<vtkPolyData>::New();
    setPoints(*poly, count, true);
    vtkNew<vtkCellArray> triangles, lines;
    triangles->InsertNextCell(3, triangle);
    lines->InsertNextCell(2, triangle);
    poly->SetPolys(triangles);
    poly->SetLines(lines);
    data = poly;
  }
  addData(*data);
  return data;
}

void
expectSameCloud(const Dataset& actual, const Dataset& expected)
{
  expectSameFields(actual, expected);
  EXPECT_EQ(expected.origin, actual.origin);
  EXPECT_EQ(expected.double_coordinates, actual.double_coordinates);
  EXPECT_EQ(expected.notes, actual.notes);
}

TEST(VtkReaders, XmlFilesOfEveryEncoding)
{
  const TemporaryFolder folder;
  int files = 0;
  for (const char* const kind : {"vtp", "vtu", "vts"})
    for (const int mode :
         {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
      for (const int compressor : {int(vtkXMLWriter::NONE),
                                   int(vtkXMLWriter::ZLIB),
                                   int(vtkXMLWriter::LZ4),
                                   int(vtkXMLWriter::LZMA)})
        for (const int variant : {0, 1, 2, 3}) {
          const auto data = makeData(kind);
          // VTK writes such names as they are, and reads its own files no more.
          data->GetPointData()->GetAbstractArray(1)->SetName(
              "a name > ' that XML allows %20");
          vtkNew<vtkXMLDataSetWriter> writer;
          const std::string path = folder / ("a." + std::string(kind));
          writer->SetInputData(data);
          writer->SetFileName(path.c_str());
          writer->SetDataMode(mode);
          writer->SetCompressorType(compressor);
          writer->SetBlockSize(64); // many blocks, the last one whole or not
          writer->SetEncodeAppendedData(variant % 2);
          writer->SetHeaderType(variant / 2 ? vtkXMLWriter::UInt64
                                            : vtkXMLWriter::UInt32);
          writer->SetByteOrder(variant == 3 ? vtkXMLWriter::BigEndian
                                            : vtkXMLWriter::LittleEndian);
          ASSERT_EQ(1, writer->Write());
          SCOPED_TRACE(std::string(kind) + " mode " + std::to_string(mode) +
                       " compressor " + std::to_string(compressor) + " variant " +
                       std::to_string(variant));
          expectSameCloud(loadDataset(path), toPointCloud(data));
          ++files;
        }
  EXPECT_EQ(144, files);
}

TEST(VtkReaders, LegacyFilesOfEveryKind)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.vtk";
  for (const char* const kind : {"vtp", "vtu", "vts", "vti", "vtr"})
    for (const int type : {VTK_ASCII, VTK_BINARY})
      for (const int version : {42, 51}) {
        const auto data = makeData(kind);
        addArray<vtkFloatArray>(
            data->GetPointData(), "vectors", 3, data->GetNumberOfPoints(), 1);
        addArray<vtkFloatArray>(
            data->GetPointData(), "tensors", 9, data->GetNumberOfPoints(), 1);
        data->GetPointData()->SetActiveVectors("vectors");
        data->GetPointData()->SetActiveTensors("tensors");
        vtkNew<vtkDataSetWriter> writer;
        writer->SetInputData(data);
        writer->SetFileName(path.c_str());
        writer->SetFileType(type);
        writer->SetFileVersion(version);
        ASSERT_EQ(1, writer->Write());
        vtkNew<vtkDataSetReader> reader;
        reader->SetFileName(path.c_str());
        reader->ReadAllScalarsOn();
        reader->ReadAllVectorsOn();
        reader->ReadAllNormalsOn();
        reader->ReadAllTensorsOn();
        reader->ReadAllFieldsOn();
        reader->Update();
        SCOPED_TRACE(std::string(kind) + " type " + std::to_string(type) + " version " +
                     std::to_string(version));
        expectSameCloud(loadDataset(path), toPointCloud(reader->GetOutput()));
      }
}

TEST(VtkReaders, ImagesAsVolumes)
{
  const TemporaryFolder folder;
  const auto data = makeData("vti");
  data->GetPointData()->GetAbstractArray(1)->SetName("a name");
  vtkNew<vtkXMLDataSetWriter> xml;
  xml->SetInputData(data);
  xml->SetFileName((folder / "a.vti").c_str());
  ASSERT_EQ(1, xml->Write());
  vtkNew<vtkDataSetWriter> legacy;
  legacy->SetInputData(data);
  legacy->SetFileName((folder / "a.vtk").c_str());
  legacy->SetFileTypeToBinary();
  ASSERT_EQ(1, legacy->Write());
  for (const char* const name : {"a.vti", "a.vtk"}) {
    ASSERT_TRUE(isVolumeFile(folder / name));
    const Volume volume = loadVolume(folder / name);
    EXPECT_EQ("rho", volume.name);
    EXPECT_EQ((std::array<std::size_t, 3>{4, 3, 5}), volume.dims);
    EXPECT_EQ((std::array<double, 3>{1, 2, 3}), volume.origin);
    EXPECT_EQ((std::array<double, 3>{0.5, 0.25, 2}), volume.spacing);
    auto* const rho = data->GetPointData()->GetArray("rho");
    ASSERT_EQ(60u, volume.values.size());
    for (vtkIdType i = 0; i < 60; ++i)
      EXPECT_EQ(static_cast<float>(rho->GetTuple1(i)),
                volume.values[static_cast<std::size_t>(i)]);
  }
}

/** Two pieces that share a layer of points, and keys of information behind the data. */
TEST(VtkReaders, PiecesOfAGridGoToTheirPlaces)
{
  const TemporaryFolder folder;
  const auto file = [&](const std::string& second) {
    writeFile(folder / "a.vti",
              "<?xml version=\"1.0\"?><!-- > --><VTKFile type=\"ImageData\"><ImageData "
              "WholeExtent=\"0 3 0 1 0 0\">"
              "<Piece Extent=\"2 3 0 1 0 0\"><PointData><DataArray type=\"Int32\" "
              "Name=\"a\">3 4 <InformationKey><Value> 9 </Value></InformationKey>"
              "</DataArray></PointData></Piece><Piece Extent=\"" +
                  second +
                  "\"><PointData><DataArray type=\"Int32\" Name=\"a\">1 2 3 5 6 "
                  "7</DataArray></PointData></Piece></ImageData></VTKFile>");
    return loadVolume(folder / "a.vti").values;
  };
  EXPECT_NE("", messageOf<IOError>([&] { file("0 2 0 1 0 0"); })) << "4 of 8 numbers";
  writeFile(folder / "b.vti", readFile(folder / "a.vti"));
  std::string text = readFile(folder / "b.vti");
  text.replace(text.find("3 4 <"), 5, "3 4 7 8 <");
  writeFile(folder / "b.vti", text);
  EXPECT_EQ((std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}),
            loadVolume(folder / "b.vti").values);
  text.replace(text.find("0 2 0 1 0 0"), 11, "1 3 0 1 0 0");
  writeFile(folder / "b.vti", text);
  EXPECT_EQ("missing_part", codeOf([&] { loadVolume(folder / "b.vti"); }));
}

} // namespace test_vtk_readers
