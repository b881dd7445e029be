// SPDX-License-Identifier: BSD-3-Clause
// Cells of files that say where their data are: every kind of mesh and file, holes,
// hidden cells, samples without a value, and what has no cells.
#include "hdf5_writer.h"
#include "io/cell_loader.h"
#include "support/environment.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>
#include <vtkAMRBox.h>
#include <vtkAppendFilter.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetWriter.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOverlappingAMR.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkUniformGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataSetWriter.h>
#include <vtkXMLUniformGridAMRWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace test_cell_loader {

using namespace uvol_test;
using pcl_uvol::Dataset;
using pcl_uvol::LoadOptions;
using Place = std::array<double, 3>;
using Places = std::vector<Place>;

constexpr int nodes[] = {7, 6, 5};

/** A quarter of a thick pipe whose layers are the thinner the nearer they are to its
 * wall, by a place of the unit cube. */
Place
bend(const Place& u, double length, double shift)
{
  const double radius = 1.0 + std::pow(u[0], 6.0), angle = 1.5 * u[1];
  return {shift + length * radius * std::cos(angle),
          shift + length * radius * std::sin(angle),
          shift + length * (u[2] + 0.2 * u[0])};
}

Place
nodeAt(const std::array<int, 3>& at)
{
  return {static_cast<double>(at[0]) / (nodes[0] - 1),
          static_cast<double>(at[1]) / (nodes[1] - 1),
          static_cast<double>(at[2]) / (nodes[2] - 1)};
}

vtkSmartPointer<vtkStructuredGrid>
makePipe(double length = 1.0, double shift = 0.0)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(nodes[0], nodes[1], nodes[2]);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> field;
  field->SetName("f");
  for (int z = 0; z < nodes[2]; ++z)
    for (int y = 0; y < nodes[1]; ++y)
      for (int x = 0; x < nodes[0]; ++x) {
        points->InsertNextPoint(bend(nodeAt({x, y, z}), length, shift).data());
        field->InsertNextValue(x + y + z);
      }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(field);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid>
toUnstructured(vtkDataSet& data)
{
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(&data);
  append->Update();
  return append->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid>
toTetrahedra(vtkDataSet& data)
{
  auto mesh = toUnstructured(data);
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> corners;
  vtkNew<vtkPoints> places;
  for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i) {
    data.GetCell(i)->Triangulate(static_cast<int>(i), corners, places);
    for (vtkIdType j = 0; j < corners->GetNumberOfIds(); j += 4)
      cells->InsertNextCell(4, corners->GetPointer(j));
  }
  mesh->SetCells(VTK_TETRA, cells);
  return mesh;
}

/** Means of the corners of random cells. */
Places
insideCells(vtkDataSet& data, std::size_t count)
{
  Random random(3);
  Places places(count);
  for (Place& place : places) {
    vtkIdList& corners =
        *data
             .GetCell(static_cast<vtkIdType>(
                 random.uniform() * static_cast<double>(data.GetNumberOfCells())))
             ->GetPointIds();
    double sum = 0.0;
    place.fill(0.0);
    for (vtkIdType i = 0; i < corners.GetNumberOfIds(); ++i) {
      const double weight = random.uniform();
      double corner[3];
      data.GetPoint(corners.GetId(i), corner);
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] += weight * corner[axis];
      sum += weight;
    }
    for (double& x : place)
      x /= sum;
  }
  return places;
}

class CellLoader : public testing::Test {
protected:
  void
  writeXml(vtkDataSet& data, const std::string& name) const
  {
    vtkNew<vtkXMLDataSetWriter> writer;
    writer->SetInputData(&data);
    writer->SetFileName((folder_ / name).c_str());
    ASSERT_EQ(1, writer->Write());
  }

  void
  writeLegacy(vtkDataSet& data, const std::string& name) const
  {
    vtkNew<vtkDataSetWriter> writer;
    writer->SetInputData(&data);
    writer->SetFileName((folder_ / name).c_str());
    ASSERT_EQ(1, writer->Write());
  }

  void
  load(const std::string& name, bool cells = false)
  {
    LoadOptions options;
    options.cells = cells;
    samples_ = pcl_uvol::loadDataset(folder_ / name, options);
    cells_ = pcl_uvol::loadCells(folder_ / name, options, samples_);
  }

  /** How many of the places are inside, samples with a value given. */
  std::size_t
  countInside(const Places& places, const std::vector<bool>& used) const
  {
    Places queries = places;
    for (Place& query : queries)
      for (std::size_t axis = 0; axis < 3; ++axis)
        query[axis] -= samples_.origin[axis];
    std::vector<std::uint8_t> inside(places.size(), 9);
    cells_->findInside(queries.data(), queries.size(), used, inside.data());
    return static_cast<std::size_t>(std::count(inside.begin(), inside.end(), 1));
  }

  std::size_t
  countInside(const Places& places) const
  {
    return countInside(places, std::vector<bool>(samples_.cloud.width, true));
  }

  TemporaryFolder folder_;
  Dataset samples_;
  std::shared_ptr<const pcl_uvol::detail::SampleCells> cells_;
};

/** Places in the hollow of the pipe and around it. */
Places
outsideOfPipe(double length, double shift)
{
  Places places;
  for (const Place& u : Places{{1.1, 0.5, 0.5},
                               {0.5, -0.1, 0.5},
                               {0.5, 1.1, 0.5},
                               {0.5, 0.5, -0.1},
                               {0.5, 0.5, 1.2}})
    places.push_back(bend(u, length, shift));
  places.push_back({std::nan(""), shift, shift});
  places.push_back({1e300, shift, shift});
  return places;
}

TEST_F(CellLoader, KnowsTheInsideOfEveryMesh)
{
  // Millimetres in metres, and far from the origin: VTK's own bound is one of volume.
  const std::pair<double, double> frames[] = {{1.0, 0.0}, {1e-8, 0.0}, {2.0, 5e6}};
  for (const auto& [length, shift] : frames) {
    SCOPED_TRACE(length);
    const auto pipe = makePipe(length, shift);
    writeXml(*pipe, "pipe.vts");
    writeXml(*toUnstructured(*pipe), "pipe.vtu");
    const auto tetrahedra = toTetrahedra(*pipe);
    writeXml(*tetrahedra, "tetrahedra.vtu");
    writeLegacy(*pipe, "pipe.vtk");
    for (const char* const name :
         {"pipe.vts", "pipe.vtu", "tetrahedra.vtu", "pipe.vtk"}) {
      SCOPED_TRACE(name);
      load(name);
      ASSERT_TRUE(cells_);
      const bool is_split = name[0] == 't';
      EXPECT_EQ(cells_->size(), (is_split ? 5u : 1u) * 6 * 5 * 4);
      EXPECT_EQ(countInside(outsideOfPipe(length, shift)), 0u);
      vtkDataSet& mesh = is_split ? *static_cast<vtkDataSet*>(tetrahedra)
                                  : *static_cast<vtkDataSet*>(pipe);
      // VTK's search misses a few places in cells of 1 : 50,000, at the inner wall.
      EXPECT_GE(countInside(insideCells(mesh, 500)), 480u);
      Places corners; // rounded to float
      const auto view = pcl_uvol::viewOf(samples_.cloud);
      for (std::size_t i = 0; i < view.count; ++i)
        corners.push_back(Place{view.xyz(i)[0] + samples_.origin[0],
                                view.xyz(i)[1] + samples_.origin[1],
                                view.xyz(i)[2] + samples_.origin[2]});
      EXPECT_GE(countInside(corners), corners.size() * 96 / 100);
    }
  }
}

TEST_F(CellLoader, KnowsTheInsideOfLattices)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 5, 6);
  image->SetOrigin(1.0, 2.0, 3.0);
  image->SetSpacing(0.5, 0.25, 0.125);
  vtkNew<vtkDoubleArray> field;
  field->SetName("f");
  field->SetNumberOfValues(image->GetNumberOfPoints());
  field->Fill(1.0);
  image->GetPointData()->AddArray(field);
  writeLegacy(*image, "image.vtk");
  load("image.vtk");
  ASSERT_TRUE(cells_);
  EXPECT_EQ(cells_->size(), 3u * 4 * 5);
  EXPECT_EQ(countInside({{1.0, 2.0, 3.0}, {2.5, 3.0, 3.625}, {1.2, 2.2, 3.2}}), 3u);
  EXPECT_EQ(countInside({{0.99, 2.5, 3.2}, {2.51, 2.5, 3.2}, {1.5, 2.5, 3.63}}), 0u);
  // Without the sample at a corner its cell does not count.
  std::vector<bool> used(4 * 5 * 6, true);
  used[0] = false;
  EXPECT_EQ(countInside({{1.1, 2.1, 3.1}, {1.6, 2.1, 3.1}}, used), 1u);
  image->SetDimensions(20, 6, 1); // flat: there is no inside
  image->GetPointData()->GetArray("f")->Resize(120);
  writeLegacy(*image, "flat.vtk");
  load("flat.vtk");
  EXPECT_FALSE(cells_);
}

TEST_F(CellLoader, LeavesOutHolesAndHiddenCells)
{
  const auto pipe = toUnstructured(*makePipe());
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < pipe->GetNumberOfCells(); ++i)
    ghosts->InsertNextValue(i == 40 ? vtkDataSetAttributes::HIDDENCELL : 0);
  pipe->GetCellData()->AddArray(ghosts);
  writeXml(*pipe, "hole.vtu");
  const auto centerOf = [&](vtkIdType cell) {
    Place center{};
    for (int i = 0; i < 8; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        center[axis] +=
            0.125 * pipe->GetPoint(pipe->GetCell(cell)->GetPointId(i))[axis];
    return center;
  };
  load("hole.vtu");
  ASSERT_TRUE(cells_);
  EXPECT_EQ(countInside({centerOf(39), centerOf(40), centerOf(41)}), 2u);
  // Centres of cells: of these the hidden one is no sample.
  vtkNew<vtkDoubleArray> field;
  field->SetName("c");
  field->SetNumberOfValues(pipe->GetNumberOfCells());
  field->Fill(1.0);
  pipe->GetCellData()->AddArray(field);
  writeXml(*pipe, "hole.vtu");
  load("hole.vtu", true);
  ASSERT_TRUE(cells_);
  ASSERT_EQ(samples_.cloud.width, 119u);
  EXPECT_EQ(countInside({centerOf(39), centerOf(40), centerOf(41)}), 2u);
  std::vector<bool> used(119, true);
  used[40] = false; // the cell 41
  EXPECT_EQ(countInside({centerOf(39), centerOf(40), centerOf(41)}, used), 1u);
}

TEST_F(CellLoader, SplitsPolyhedra)
{
  vtkNew<vtkUnstructuredGrid> mesh;
  vtkNew<vtkPoints> points;
  for (int corner = 0; corner < 8; ++corner)
    points->InsertNextPoint(corner & 1, corner / 2 & 1, corner / 4);
  mesh->SetPoints(points);
  const vtkIdType ids[] = {0, 1, 2, 3, 4, 5, 6, 7};
  const vtkIdType faces[] = {4, 0, 2, 3, 1, 4, 4, 5, 7, 6, 4, 0, 1, 5, 4,
                             4, 2, 6, 7, 3, 4, 0, 4, 6, 2, 4, 1, 3, 7, 5};
  mesh->InsertNextCell(VTK_POLYHEDRON, 8, ids, 6, faces);
  writeXml(*mesh, "polyhedron.vtu");
  load("polyhedron.vtu");
  ASSERT_TRUE(cells_);
  EXPECT_EQ(countInside({{0.5, 0.5, 0.5}, {0.01, 0.02, 0.99}, {1.0, 1.0, 1.0}}), 3u);
  EXPECT_EQ(countInside({{1.1, 0.5, 0.5}, {0.5, -0.1, 0.5}}), 0u);
}

TEST_F(CellLoader, JoinsTheFilesOfALists)
{
  writeXml(*makePipe(), "a.vts");
  writeXml(*makePipe(1.0, 10.0), "b.vts");
  writeFile(folder_ / "both.vtm",
            "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet>"
            "<DataSet index=\"0\" file=\"a.vts\"/><DataSet index=\"1\" "
            "file=\"b.vts\"/></vtkMultiBlockDataSet></VTKFile>");
  load("both.vtm");
  ASSERT_TRUE(cells_);
  EXPECT_EQ(cells_->size(), 2u * 6 * 5 * 4);
  Places places = insideCells(*makePipe(), 50);
  const Places others = insideCells(*makePipe(1.0, 10.0), 50);
  places.insert(places.end(), others.begin(), others.end());
  EXPECT_EQ(countInside(places), 100u);
  EXPECT_EQ(countInside(outsideOfPipe(1.0, 0.0)), 0u);
  // The samples of the second file have no value.
  std::vector<bool> used(samples_.cloud.width, true);
  std::fill(used.begin() + 7 * 6 * 5, used.end(), false);
  EXPECT_EQ(countInside(places, used), 50u);
}

TEST_F(CellLoader, TakesTheFinestLevelOfAdaptiveMeshes)
{
  vtkNew<vtkOverlappingAMR> levels;
  const int blocks[] = {1, 1};
  levels->Initialize(2, blocks);
  levels->SetGridDescription(VTK_XYZ_GRID);
  double origin[] = {0.0, 0.0, 0.0};
  levels->SetOrigin(origin);
  for (unsigned level = 0; level < 2; ++level) {
    const double side = level == 0 ? 0.125 : 0.0625, low = level == 0 ? 0.0 : 0.25;
    double spacing[] = {side, side, side};
    levels->SetSpacing(level, spacing);
    levels->SetRefinementRatio(level, 2);
    vtkNew<vtkUniformGrid> grid;
    grid->SetOrigin(low, low, low);
    grid->SetSpacing(spacing);
    grid->SetDimensions(9, 9, 9);
    vtkNew<vtkDoubleArray> field;
    field->SetName("f");
    field->SetNumberOfValues(512);
    field->Fill(1.0);
    grid->GetCellData()->AddArray(field);
    levels->SetAMRBox(
        level,
        0,
        vtkAMRBox(
            grid->GetOrigin(), grid->GetDimensions(), spacing, origin, VTK_XYZ_GRID));
    levels->SetDataSet(level, 0, grid);
  }
  vtkNew<vtkXMLUniformGridAMRWriter> writer;
  writer->SetInputData(levels);
  writer->SetFileName((folder_ / "levels.vthb").c_str());
  ASSERT_EQ(1, writer->Write());
  load("levels.vthb");
  ASSERT_TRUE(cells_);
  EXPECT_EQ(cells_->size(), samples_.cloud.width);
  EXPECT_EQ(countInside({{0.01, 0.01, 0.01}, {0.5, 0.5, 0.5}, {1.0, 1.0, 1.0}}), 3u);
  EXPECT_EQ(countInside({{-0.01, 0.5, 0.5}, {0.5, 0.5, 1.01}}), 0u);
}

TEST_F(CellLoader, ThereAreNoneInOtherFiles)
{
  writeFile(folder_ / "points.csv", "x,y,z,f\n0,0,0,1\n1,0,0,2\n");
  load("points.csv");
  EXPECT_FALSE(cells_);
  vtkNew<vtkUnstructuredGrid> mesh; // of triangles
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(1.0, 0.0, 0.0);
  points->InsertNextPoint(0.0, 1.0, 0.0);
  mesh->SetPoints(points);
  const vtkIdType ids[] = {0, 1, 2};
  mesh->InsertNextCell(VTK_TRIANGLE, 3, ids);
  writeXml(*mesh, "triangles.vtu");
  load("triangles.vtu");
  EXPECT_FALSE(cells_);
}

TEST_F(CellLoader, DamagedCellsAreAnError)
{
  writeXml(*toUnstructured(*makePipe()), "pipe.vtu");
  std::string text = readFile(folder_ / "pipe.vtu");
  const std::size_t at = text.find("Name=\"connectivity\"");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 19, "Name=\"connectivitx\"");
  writeFile(folder_ / "pipe.vtu", text);
  EXPECT_THROW(load("pipe.vtu"), pcl_uvol::IOError);
  EXPECT_EQ(samples_.cloud.width, 210u); // the points are there all the same
}

/** Grids of doubles as C writes them: their number, sizes, coordinates by axis, and
 * which points count. */
void
writePlot3d(const std::string& path,
            const std::vector<vtkSmartPointer<vtkStructuredGrid>>& grids,
            const std::vector<std::int32_t>& blanking = {})
{
  std::ofstream file(path, std::ios::binary);
  const auto put = [&](auto number) {
    file.write(reinterpret_cast<const char*>(&number), sizeof(number));
  };
  put(static_cast<std::int32_t>(grids.size()));
  for (std::size_t i = 0; i < grids.size(); ++i)
    for (const std::int32_t size : nodes)
      put(size);
  for (const auto& grid : grids) {
    for (int axis = 0; axis < 3; ++axis)
      for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
        put(grid->GetPoint(i)[axis]);
    for (const std::int32_t counts : blanking)
      put(counts);
  }
}

TEST_F(CellLoader, KnowsTheInsideOfPlot3d)
{
  const auto pipe = makePipe(), other = makePipe(1.0, 10.0);
  writePlot3d(folder_ / "pipe.p3d", {pipe, other});
  load("pipe.p3d");
  ASSERT_TRUE(cells_);
  EXPECT_EQ(cells_->size(), 2u * 6 * 5 * 4);
  EXPECT_GE(countInside(insideCells(*pipe, 500)), 480u);
  EXPECT_GE(countInside(insideCells(*other, 500)), 480u);
  EXPECT_EQ(countInside(outsideOfPipe(1.0, 0.0)), 0u);
  EXPECT_EQ(countInside(outsideOfPipe(1.0, 10.0)), 0u);
  // A point that is counted out takes its eight cells with it.
  std::vector<std::int32_t> blanking(7 * 6 * 5, 1);
  blanking[2 + 7 * (2 + 6 * 2)] = 0;
  writePlot3d(folder_ / "holed.p3d", {pipe}, blanking);
  load("holed.p3d");
  ASSERT_TRUE(cells_);
  EXPECT_EQ(cells_->size(), 6u * 5 * 4 - 8);
}

/** What is wrong with a file. */
struct Damage {
  double corner = 0.0, offset = 0.0, type = 0.0; ///< added to the numbers of the table
};

/** A mesh in two parts, the second one the first one moved. */
void
writeVtkHdf(const std::string& path,
            vtkUnstructuredGrid& mesh,
            const Damage& damage = {})
{
  const auto points = static_cast<std::size_t>(mesh.GetNumberOfPoints());
  const auto cells = static_cast<std::size_t>(mesh.GetNumberOfCells());
  std::vector<double> places, offsets, corners, types;
  for (int part = 0; part < 2; ++part) {
    for (std::size_t i = 0; i < points; ++i)
      for (int axis = 0; axis < 3; ++axis)
        places.push_back(mesh.GetPoint(static_cast<vtkIdType>(i))[axis] + 10.0 * part);
    const std::size_t before = corners.size();
    offsets.push_back(damage.offset);
    for (std::size_t i = 0; i < cells; ++i) {
      const auto cell = static_cast<vtkIdType>(i);
      vtkIdList& ids = *mesh.GetCell(cell)->GetPointIds();
      for (vtkIdType j = 0; j < ids.GetNumberOfIds(); ++j)
        corners.push_back(static_cast<double>(ids.GetId(j)) + damage.corner);
      offsets.push_back(static_cast<double>(corners.size() - before));
      types.push_back(mesh.GetCellType(cell) + damage.type);
    }
  }
  const auto of_parts = [](std::size_t count) {
    return std::vector<double>(2, static_cast<double>(count));
  };
  Hdf5Writer file(path);
  file.group("/VTKHDF");
  file.text("/VTKHDF", "Type", "UnstructuredGrid");
  file.attribute("/VTKHDF", "Version", {1, 0});
  file.table("/VTKHDF/NumberOfPoints", H5T_STD_I64LE, 1, of_parts(points));
  file.table("/VTKHDF/NumberOfCells", H5T_STD_I64LE, 1, of_parts(cells));
  file.table("/VTKHDF/NumberOfConnectivityIds",
             H5T_STD_I64LE,
             1,
             of_parts(corners.size() / 2));
  file.table("/VTKHDF/Points", H5T_IEEE_F64LE, 3, places);
  file.table("/VTKHDF/Offsets", H5T_STD_I64LE, 1, offsets);
  file.table("/VTKHDF/Connectivity", H5T_STD_I64LE, 1, corners);
  file.table("/VTKHDF/Types", H5T_STD_I16LE, 1, types); // VTK has bytes
  file.group("/VTKHDF/PointData");
  file.table("/VTKHDF/PointData/f", H5T_IEEE_F64LE, 1, std::vector<double>(2 * points));
}

TEST_F(CellLoader, KnowsTheInsideOfVtkHdf)
{
  const auto pipe = makePipe(), other = makePipe(1.0, 10.0);
  for (const auto& mesh : {toUnstructured(*pipe), toTetrahedra(*pipe)}) {
    writeVtkHdf(folder_ / "pipe.vtkhdf", *mesh);
    load("pipe.vtkhdf");
    ASSERT_TRUE(cells_);
    EXPECT_EQ(cells_->size(), 2u * static_cast<std::size_t>(mesh->GetNumberOfCells()));
    EXPECT_GE(countInside(insideCells(*pipe, 500)), 480u);
    EXPECT_GE(countInside(insideCells(*other, 500)), 480u);
    EXPECT_EQ(countInside(outsideOfPipe(1.0, 0.0)), 0u);
    EXPECT_EQ(countInside(outsideOfPipe(1.0, 10.0)), 0u);
  }
  // Corners that are not there, ends that do not fit, types of other numbers of
  // corners.
  const auto mesh = toUnstructured(*pipe);
  for (const Damage& damage : {Damage{1000.0},
                               Damage{-1.0},
                               Damage{0.0, 1.0},
                               Damage{0.0, 0.0, 1.0},
                               Damage{0.0, 0.0, 300.0},
                               Damage{0.0, 0.0, -20.0}}) {
    writeVtkHdf(folder_ / "pipe.vtkhdf", *mesh, damage);
    EXPECT_THROW(load("pipe.vtkhdf"), pcl_uvol::IOError);
  }
  // Cells whose faces the file does not tell.
  writeVtkHdf(
      folder_ / "pipe.vtkhdf", *mesh, {0.0, 0.0, VTK_POLYHEDRON - VTK_HEXAHEDRON});
  load("pipe.vtkhdf");
  EXPECT_FALSE(cells_);
  // Samples that are not all of the file's.
  writeVtkHdf(folder_ / "pipe.vtkhdf", *mesh);
  load("pipe.vtkhdf");
  ASSERT_TRUE(cells_);
  --samples_.cloud.width;
  EXPECT_FALSE(pcl_uvol::loadCells(folder_ / "pipe.vtkhdf", {}, samples_));
}

TEST_F(CellLoader, KnowsTheInsideOfImagesInVtkHdf)
{
  {
    Hdf5Writer file(folder_ / "image.vtkhdf");
    file.group("/VTKHDF");
    file.text("/VTKHDF", "Type", "ImageData");
    file.attribute("/VTKHDF", "WholeExtent", {1, 4, 0, 4, 0, 5});
    file.attribute("/VTKHDF", "Origin", {10, 20, 30});
    file.attribute("/VTKHDF", "Spacing", {0.5, 1, 2});
    file.group("/VTKHDF/PointData");
    file.block("/VTKHDF/PointData/T",
               H5T_IEEE_F32LE,
               {6, 5, 4},
               std::vector<double>(6 * 5 * 4));
  }
  load("image.vtkhdf");
  ASSERT_TRUE(cells_);
  EXPECT_EQ(cells_->size(), 3u * 4 * 5);
  EXPECT_EQ(countInside({{10.6, 20.1, 30.1}, {11.9, 23.9, 39.9}}), 2u);
  EXPECT_EQ(countInside({{10.4, 20.1, 30.1}, {12.1, 23.9, 39.9}}), 0u);
}

} // namespace test_cell_loader
