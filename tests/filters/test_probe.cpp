// SPDX-License-Identifier: BSD-3-Clause
// The probe in a VTK pipeline: any data in, the same data with fields of samples out.
#include "vtk_setup.h"
#include <pcl_uvol/filters/vtkUvolProbe.h>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>
#include <cmath>
#include <limits>
#include <sstream>

using namespace uvol_test;

namespace test_probe {

/** A plane of 9 x 7 points within the samples. */
vtkSmartPointer<vtkImageData>
makePlane(double z = 3.0)
{
  auto plane = vtkSmartPointer<vtkImageData>::New();
  plane->SetDimensions(9, 7, 1);
  plane->SetOrigin(-3.0, -2.0, z);
  plane->SetSpacing(0.75, 0.5, 1.0);
  return plane;
}

class VtkProbe : public testing::Test {
protected:
  VtkProbe()
      : listener_(*probe_)
  {
    probe_->SetInputData(plane_);
    probe_->SetSourceData(samples_);
    probe_->SetField("density");
  }

  vtkDataArray*
  arrayOf(const char* name)
  {
    return probe_->GetOutput()->GetPointData()->GetArray(name);
  }

  void
  expectError(const std::string& text)
  {
    probe_->Update();
    ASSERT_EQ(listener_.errors.size(), 1u);
    EXPECT_NE(listener_.errors[0].find(text), std::string::npos) << listener_.errors[0];
    EXPECT_EQ(probe_->GetOutput()->GetNumberOfPoints(), 0);
  }

  vtkSmartPointer<vtkPolyData> samples_ = makeSamples();
  vtkSmartPointer<vtkImageData> plane_ = makePlane();
  vtkNew<vtkUvolProbe> probe_;
  Listener listener_;
};

TEST_F(VtkProbe, TheInputGetsTheFieldsOfTheSource)
{
  probe_->ComputeGradientsOn();
  probe_->Update();
  auto* const image = vtkImageData::SafeDownCast(probe_->GetOutput());
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->GetDimensions()[1], 7);
  ASSERT_NE(arrayOf("density"), nullptr);
  EXPECT_STREQ(image->GetPointData()->GetScalars()->GetName(), "density");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i) {
    const double* const p = image->GetPoint(i);
    const double truth = std::hypot(p[0], p[1], p[2]);
    EXPECT_NEAR(arrayOf("density")->GetTuple1(i), truth, 0.05);
    EXPECT_NEAR(arrayOf("density_gradient")->GetComponent(i, 0), p[0] / truth, 0.2);
    EXPECT_GE(arrayOf("density_error")->GetTuple1(i), 0.0);
    EXPECT_EQ(arrayOf("support")->GetTuple1(i), 1.0);
  }
  EXPECT_TRUE(listener_.errors.empty());
  EXPECT_TRUE(listener_.warnings.empty());
}

TEST_F(VtkProbe, SameNumbersAsTheTool)
{
  const TemporaryFolder folder;
  vtkNew<vtkPolyData> points;
  points->SetPoints(makeSamples(50, 3)->GetPoints());
  points->SetVerts(makeSamples(1)->GetVerts());
  const auto write = [&](const std::string& name, vtkPolyData* data) {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName((folder / name).c_str());
    writer->SetInputData(data);
    ASSERT_EQ(writer->Write(), 1);
  };
  write("samples.vtp", samples_);
  write("points.vtp", points);
  for (const auto& [model, word] : {std::pair{vtkUvolProbe::MODEL_FIT, "fit"},
                                    std::pair{vtkUvolProbe::MODEL_NATURAL, "natural"},
                                    std::pair{vtkUvolProbe::MODEL_AUTO, "auto"}}) {
    SCOPED_TRACE(word);
    const auto run = runCommand("uvol_probe " + (folder / "samples.vtp") + " " +
                                (folder / "out.vtp") + " -field density -points " +
                                (folder / "points.vtp") + " -model " + word);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((folder / "out.vtp").c_str());
    reader->Update();
    probe_->SetInputData(points);
    probe_->SetModel(model);
    probe_->Update();
    for (const char* const name : {"density", "density_error", "support"})
      expectSameNumbers(*arrayOf(name),
                        *reader->GetOutput()->GetPointData()->GetArray(name));
  }
}

TEST_F(VtkProbe, EveryNumberWithoutAField)
{
  vtkNew<vtkFloatArray> own;
  own->SetName("density");
  own->SetNumberOfTuples(plane_->GetNumberOfPoints());
  own->FillValue(77.0f);
  plane_->GetPointData()->AddArray(own);
  probe_->SetField("");
  probe_->Update();
  EXPECT_EQ(arrayOf("density")->GetTuple1(5), 77.0);
  for (const char* const name : {"density_2", "density_2_error", "vel[0]", "vel[2]"})
    EXPECT_NE(arrayOf(name), nullptr) << name;
  EXPECT_NEAR(arrayOf("vel[1]")->GetTuple1(0), -2.0, 1e-6);
  // The input itself stays as it was.
  EXPECT_EQ(plane_->GetPointData()->GetNumberOfArrays(), 1);
}

TEST_F(VtkProbe, OutsideThereIsNoValueUnlessAskedFor)
{
  probe_->SetInputData(makePlane(30.0));
  probe_->Update();
  EXPECT_TRUE(std::isnan(arrayOf("density")->GetTuple1(0)));
  EXPECT_EQ(arrayOf("support")->GetTuple1(0), 7.0);
  ASSERT_EQ(listener_.warnings.size(), 1u);
  EXPECT_NE(listener_.warnings[0].find("outside"), std::string::npos);
  probe_->ExtrapolateOn();
  probe_->Update();
  EXPECT_FALSE(std::isnan(arrayOf("density")->GetTuple1(0)));
}

TEST_F(VtkProbe, TheModelIsMadeAnewWhenSomethingChanges)
{
  probe_->Update();
  const double here = arrayOf("density")->GetTuple1(3);
  probe_->SetInputData(makePlane(3.5));
  probe_->Update();
  EXPECT_NE(arrayOf("density")->GetTuple1(3), here);
  probe_->SetInputData(plane_);
  probe_->SetNumberOfThreads(3);
  probe_->Update();
  EXPECT_EQ(arrayOf("density")->GetTuple1(3), here);
  vtkDataArray& density = *samples_->GetPointData()->GetArray("density");
  for (vtkIdType i = 0; i < density.GetNumberOfTuples(); ++i)
    density.SetTuple1(i, 7.0);
  density.Modified();
  samples_->Modified();
  probe_->Update();
  EXPECT_NEAR(arrayOf("density")->GetTuple1(3), 7.0, 1e-9);
}

TEST_F(VtkProbe, GhostsOfTheSourceAreLeftOut)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < samples_->GetNumberOfPoints(); ++i)
    ghosts->InsertNextValue(i < 3000 ? 0 : vtkDataSetAttributes::HIDDENPOINT);
  samples_->GetPointData()->AddArray(ghosts);
  probe_->Update();
  vtkNew<vtkUvolProbe> other;
  other->SetInputData(plane_);
  other->SetSourceData(makeSamples(3000));
  other->SetField("density");
  other->Update();
  expectSameNumbers(*arrayOf("density"),
                    *other->GetOutput()->GetPointData()->GetArray("density"));
  ghosts->FillValue(vtkDataSetAttributes::HIDDENPOINT);
  samples_->Modified();
  expectError("interpolate");
}

TEST_F(VtkProbe, SaysWhatIsWrong)
{
  probe_->SetField("rho");
  expectError("'rho'");
  listener_.errors.clear();
  probe_->SetField("density");
  probe_->SetScale(1.0, -1.0, 1.0);
  expectError("scale");
}

TEST_F(VtkProbe, ProgressEndsAndAbortEmptiesTheOutput)
{
  probe_->Update();
  ASSERT_FALSE(listener_.progress.empty());
  EXPECT_EQ(listener_.progress.back(), 1.0);
  probe_->Modified();
  listener_.on_progress = [&] { probe_->SetAbortExecute(1); };
  probe_->Update();
  EXPECT_EQ(probe_->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(listener_.errors.empty());
}

TEST_F(VtkProbe, PrintsItself)
{
  std::ostringstream text;
  probe_->SetModel(vtkUvolProbe::MODEL_KRIGING);
  probe_->Print(text);
  for (const char* const word : {"Field: density",
                                 "Model: Kriging",
                                 "Extrapolate: Off",
                                 "ComputeGradients: Off",
                                 "CellMask: On",
                                 "Scale: 1 1 1",
                                 "NumberOfThreads: 0"})
    EXPECT_NE(text.str().find(word), std::string::npos) << text.str();
}

/** Cubes of side 1 in [0, 8]^3, but for those in [4, 8]^3. */
vtkSmartPointer<vtkUnstructuredGrid>
makeNotchedCube()
{
  constexpr int n = 8;
  const auto numberOf = [](int x, int y, int z) {
    return static_cast<vtkIdType>(x + (n + 1) * (y + (n + 1) * z));
  };
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> field;
  field->SetName("f");
  for (int z = 0; z <= n; ++z)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        points->InsertNextPoint(x, y, z);
        field->InsertNextValue(x + 2.0 * y + 3.0 * z);
      }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(field);
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        if (x >= n / 2 && y >= n / 2 && z >= n / 2)
          continue;
        const vtkIdType corners[] = {numberOf(x, y, z),
                                     numberOf(x + 1, y, z),
                                     numberOf(x + 1, y + 1, z),
                                     numberOf(x, y + 1, z),
                                     numberOf(x, y, z + 1),
                                     numberOf(x + 1, y, z + 1),
                                     numberOf(x + 1, y + 1, z + 1),
                                     numberOf(x, y + 1, z + 1)};
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
      }
  return grid;
}

TEST(VtkProbeOfCells, CellsSayWhereTheDataAre)
{
  vtkNew<vtkPoints> places;
  places->InsertNextPoint(1.5, 2.5, 3.5); // in a cell
  places->InsertNextPoint(7.5, 7.5, 0.1); // in one at the border
  places->InsertNextPoint(6.5, 6.5, 6.5); // among nodes, in no cell
  vtkNew<vtkPolyData> queries;
  queries->SetPoints(places);
  const auto source = makeNotchedCube();
  vtkNew<vtkUvolProbe> probe;
  probe->SetInputData(queries);
  probe->SetSourceData(source);
  const auto values = [&] {
    probe->Update();
    vtkDataArray& told = *probe->GetOutput()->GetPointData()->GetArray("f");
    return std::array<double, 3>{
        told.GetTuple1(0), told.GetTuple1(1), told.GetTuple1(2)};
  };
  auto told = values();
  EXPECT_NEAR(17.0, told[0], 1e-6);
  EXPECT_NEAR(22.8, told[1], 1e-6);
  EXPECT_TRUE(std::isnan(told[2])) << told[2];
  probe->CellMaskOff();
  told = values();
  EXPECT_NEAR(17.0, told[0], 1e-6);
  EXPECT_NEAR(39.0, told[2], 1e-6);
  probe->CellMaskOn();
  // Another part has the points at the border: their cells still count.
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < source->GetNumberOfPoints(); ++i)
    ghosts->InsertNextValue(
        source->GetPoint(i)[2] == 0.0 ? vtkDataSetAttributes::DUPLICATEPOINT : 0);
  source->GetPointData()->AddArray(ghosts);
  source->Modified();
  told = values();
  EXPECT_NEAR(22.8, told[1], 0.1);
  EXPECT_TRUE(std::isnan(told[2])) << told[2];
  double corner[3]; // the source is as it was
  source->GetPoint(source->GetNumberOfPoints() - 1, corner);
  EXPECT_EQ(8.0, corner[0]);
}

} // namespace test_probe
