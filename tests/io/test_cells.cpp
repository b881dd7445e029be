// SPDX-License-Identifier: BSD-3-Clause
// Centres of cells as samples: of grids in several files, without ghosts, of adaptive
// meshes and of octrees.
#include "common/scalar_field.h"
#include "support/environment.h"
#include "support/messages.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <gtest/gtest.h>
#include <vtkAMRBox.h>
#include <vtkAppendFilter.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetWriter.h>
#include <vtkDoubleArray.h>
#include <vtkHyperTree.h>
#include <vtkHyperTreeGrid.h>
#include <vtkHyperTreeGridNonOrientedCursor.h>
#include <vtkHyperTreeGridNonOrientedGeometryCursor.h>
#include <vtkNew.h>
#include <vtkOverlappingAMR.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUniformGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataSetWriter.h>
#include <vtkXMLHyperTreeGridWriter.h>
#include <vtkXMLUniformGridAMRWriter.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <set>

namespace test_cells {

using namespace uvol_test;
using pcl_uvol::Dataset;
using Place = std::array<double, 3>;

double
fieldAt(const Place& x)
{
  return 1.0 + 2.0 * x[0] - 3.0 * x[1] + 0.5 * x[2];
}

/** The field at the centres of boxes, which their bounds tell. */
vtkSmartPointer<vtkDoubleArray>
fieldOfCells(vtkDataSet& data)
{
  auto field = vtkSmartPointer<vtkDoubleArray>::New();
  field->SetName("f");
  for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i) {
    double bounds[6];
    data.GetCellBounds(i, bounds);
    field->InsertNextValue(fieldAt({0.5 * (bounds[0] + bounds[1]),
                                    0.5 * (bounds[2] + bounds[3]),
                                    0.5 * (bounds[4] + bounds[5])}));
  }
  return field;
}

/** 5 x 4 x 3 boxes of different sides. */
vtkSmartPointer<vtkRectilinearGrid>
makeBoxes()
{
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  const int counts[] = {6, 5, 4};
  grid->SetDimensions(counts);
  vtkSmartPointer<vtkDoubleArray> axes[3];
  for (int axis = 0; axis < 3; ++axis) {
    axes[axis] = vtkSmartPointer<vtkDoubleArray>::New();
    for (int i = 0; i < counts[axis]; ++i)
      axes[axis]->InsertNextValue(std::pow(i + axis, 1.25));
  }
  grid->SetXCoordinates(axes[0]);
  grid->SetYCoordinates(axes[1]);
  grid->SetZCoordinates(axes[2]);
  grid->GetCellData()->AddArray(fieldOfCells(*grid));
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

void
writeXml(vtkDataSet& data, const std::string& path)
{
  vtkNew<vtkXMLDataSetWriter> writer;
  writer->SetInputData(&data);
  writer->SetFileName(path.c_str());
  ASSERT_EQ(1, writer->Write());
}

class Cells : public testing::Test {
protected:
  static Dataset
  load(const std::string& path)
  {
    pcl_uvol::LoadOptions options;
    options.cells = true;
    return pcl_uvol::loadDataset(path, options);
  }

  /** Every sample has the field of its place. */
  static void
  expectField(const Dataset& samples, std::size_t count)
  {
    ASSERT_EQ(count, samples.cloud.width);
    const auto view = pcl_uvol::viewOf(samples.cloud);
    const pcl::PCLPointField* const field =
        pcl_uvol::findField(samples.cloud.fields, "f");
    ASSERT_NE(nullptr, field);
    std::set<Place> places;
    for (std::size_t i = 0; i < count; ++i) {
      Place place;
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] = view.xyz(i)[axis] + samples.origin[axis];
      double value = 0.0;
      std::memcpy(&value, view.point(i) + field->offset, sizeof value);
      ASSERT_NEAR(fieldAt(place), value, 1e-5);
      places.insert(place);
    }
    EXPECT_EQ(count, places.size()) << "a cell counts twice";
  }

  TemporaryFolder folder_;
};

TEST_F(Cells, OfGridsBecomeSamples)
{
  const auto boxes = makeBoxes();
  writeXml(*boxes, folder_ / "boxes.vtr");
  writeXml(*toUnstructured(*boxes), folder_ / "boxes.vtu");
  vtkNew<vtkDataSetWriter> writer;
  writer->SetInputData(boxes);
  writer->SetFileName((folder_ / "boxes.vtk").c_str());
  ASSERT_EQ(1, writer->Write());
  for (const char* const name : {"boxes.vtr", "boxes.vtu", "boxes.vtk"}) {
    SCOPED_TRACE(name);
    expectField(load(folder_ / name), 5 * 4 * 3);
  }
  // Unasked, points are read and the others are named.
  const Dataset points = pcl_uvol::loadDataset(folder_ / "boxes.vtu");
  EXPECT_EQ(6u * 5u * 4u, points.cloud.width);
  ASSERT_EQ(1u, points.notes.size());
  EXPECT_EQ(std::vector<std::string>{"cell_data_left_out"}, listCodes(points.notes));
}

TEST_F(Cells, AreNamedWherePointsAreReadInstead)
{
  const auto boxes = toUnstructured(*makeBoxes());
  vtkNew<vtkDoubleArray> of_points;
  of_points->SetName("p");
  for (vtkIdType i = 0; i < boxes->GetNumberOfPoints(); ++i)
    of_points->InsertNextValue(static_cast<double>(i));
  boxes->GetPointData()->AddArray(of_points);
  writeXml(*boxes, folder_ / "boxes.vtu");
  vtkNew<vtkDataSetWriter> writer;
  writer->SetInputData(boxes);
  writer->SetFileName((folder_ / "boxes.vtk").c_str());
  ASSERT_EQ(1, writer->Write());
  for (const char* const name : {"boxes.vtu", "boxes.vtk"}) {
    const Dataset points = pcl_uvol::loadDataset(folder_ / name);
    EXPECT_EQ(std::vector<std::string>{"f"}, points.cell_fields) << name;
    EXPECT_TRUE(points.notes.empty()) << name; // who reads points need not know
    EXPECT_TRUE(load(folder_ / name).cell_fields.empty()) << name;
  }
}

TEST_F(Cells, OfListedFilesAreJoined)
{
  auto boxes = makeBoxes();
  writeXml(*boxes, folder_ / "a.vtr");
  auto other = vtkSmartPointer<vtkRectilinearGrid>::New();
  other->DeepCopy(boxes);
  auto* const x = vtkDoubleArray::SafeDownCast(other->GetXCoordinates());
  for (vtkIdType i = 0; i < x->GetNumberOfValues(); ++i)
    x->SetValue(i, x->GetValue(i) + 100.0);
  other->GetCellData()->AddArray(fieldOfCells(*other));
  writeXml(*other, folder_ / "b.vtr");
  writeFile(folder_ / "both.vtm",
            "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet>"
            "<DataSet index=\"0\" file=\"a.vtr\"/><DataSet index=\"1\" "
            "file=\"b.vtr\"/></vtkMultiBlockDataSet></VTKFile>");
  expectField(load(folder_ / "both.vtm"), 2 * 5 * 4 * 3);
}

TEST_F(Cells, OfOtherPartsAreLeftOut)
{
  const auto boxes = toUnstructured(*makeBoxes());
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  std::size_t kept = 0;
  const int kinds[] = {0,
                       vtkDataSetAttributes::DUPLICATECELL,
                       vtkDataSetAttributes::REFINEDCELL,
                       vtkDataSetAttributes::HIDDENCELL,
                       vtkDataSetAttributes::HIGHCONNECTIVITYCELL};
  for (vtkIdType i = 0; i < boxes->GetNumberOfCells(); ++i) {
    const int kind = kinds[i % 5];
    ghosts->InsertNextValue(static_cast<unsigned char>(kind));
    kept += kind == 0 || kind == vtkDataSetAttributes::HIGHCONNECTIVITYCELL ? 1 : 0;
  }
  boxes->GetCellData()->AddArray(ghosts);
  writeXml(*boxes, folder_ / "ghosts.vtu");
  expectField(load(folder_ / "ghosts.vtu"), kept);
}

TEST_F(Cells, OfAdaptiveMeshesAreThoseOfTheFinestLevel)
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
    grid->GetCellData()->AddArray(fieldOfCells(*grid));
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
  // Eight finer ones stand for each of 4 x 4 x 4.
  expectField(pcl_uvol::loadDataset(folder_ / "levels.vthb"), 512 - 64 + 512);
}

TEST_F(Cells, OfOctreesAreTheirLeaves)
{
  vtkNew<vtkHyperTreeGrid> trees;
  const unsigned counts[] = {3, 2, 2};
  trees->SetDimensions(counts);
  trees->SetBranchFactor(2);
  const auto axis = [](int count) {
    auto nodes = vtkSmartPointer<vtkDoubleArray>::New();
    for (int i = 0; i < count; ++i)
      nodes->InsertNextValue(2.0 * i);
    return nodes;
  };
  trees->SetXCoordinates(axis(3));
  trees->SetYCoordinates(axis(2));
  trees->SetZCoordinates(axis(2));
  vtkNew<vtkHyperTreeGridNonOrientedCursor> cursor;
  vtkIdType first = 0;
  for (vtkIdType tree = 0; tree < 2; ++tree) {
    trees->InitializeNonOrientedCursor(cursor, tree, true);
    cursor->SetGlobalIndexStart(first);
    cursor->SubdivideLeaf();
    if (tree == 1) {
      cursor->ToChild(5);
      cursor->SubdivideLeaf();
      cursor->ToParent();
    }
    first += cursor->GetTree()->GetNumberOfVertices();
  }
  vtkNew<vtkDoubleArray> field;
  field->SetName("f");
  field->SetNumberOfValues(first);
  const std::function<void(vtkHyperTreeGridNonOrientedGeometryCursor&)> fill =
      [&](vtkHyperTreeGridNonOrientedGeometryCursor& at) {
        Place place;
        at.GetPoint(place.data());
        // What is refined has a value of no place.
        field->SetValue(at.GetGlobalNodeIndex(),
                        at.IsLeaf() ? fieldAt(place) : std::nan(""));
        for (unsigned char child = 0; !at.IsLeaf() && child < 8; ++child) {
          at.ToChild(child);
          fill(at);
          at.ToParent();
        }
      };
  for (vtkIdType tree = 0; tree < 2; ++tree) {
    vtkNew<vtkHyperTreeGridNonOrientedGeometryCursor> at;
    trees->InitializeNonOrientedGeometryCursor(at, tree);
    fill(*at);
  }
  trees->GetCellData()->AddArray(field);
  vtkNew<vtkXMLHyperTreeGridWriter> writer;
  writer->SetInputData(trees);
  writer->SetDataModeToBinary();
  writer->SetFileName((folder_ / "trees.htg").c_str());
  ASSERT_EQ(1, writer->Write());
  expectField(pcl_uvol::loadDataset(folder_ / "trees.htg"), 8 + 7 + 8);
  // VTK believes all of it: what it makes of damage is not known, but ends well.
  const std::string whole = readFile(folder_ / "trees.htg");
  Random random(1);
  for (int i = 0; i < 30; ++i) {
    std::string broken = whole;
    for (int change = 0; change < 4; ++change)
      broken[static_cast<std::size_t>(random.uniform() *
                                      static_cast<double>(broken.size()))] = '7';
    writeFile(folder_ / "broken.htg", broken);
    try {
      pcl_uvol::loadDataset(folder_ / "broken.htg");
    }
    catch (const pcl_uvol::IOError& error) {
      EXPECT_LT(error.message().size(), 300 + folder_.operator/("").size());
    }
  }
}

TEST_F(Cells, WhatHasNoneIsRefused)
{
  const auto codeOf = [&](const std::string& path) {
    return uvol_test::codeOf<pcl_uvol::Exception>([&] { load(path); });
  };
  writeFile(folder_ / "a.csv", "x,y,z\n1,2,3\n");
  EXPECT_EQ("cells_of_no_grid", codeOf(folder_ / "a.csv"));
  vtkNew<vtkPolyData> points;
  vtkNew<vtkPoints> places;
  places->InsertNextPoint(1.0, 2.0, 3.0);
  points->SetPoints(places);
  writeXml(*points, folder_ / "points.vtp");
  EXPECT_EQ("nothing_inside", codeOf(folder_ / "points.vtp"));
  writeFile(folder_ / "broken.vtu", "<VTKFile type=\"UnstructuredGrid\"><Unstr");
  EXPECT_NE("", codeOf(folder_ / "broken.vtu"));
  writeFile(folder_ / "empty.htg", "");
  EXPECT_NE("", codeOf(folder_ / "empty.htg"));
}

} // namespace test_cells
