// SPDX-License-Identifier: BSD-3-Clause
// The filters of a pipeline make what the tools make, point by point.
#include "support/environment.h"
#include "vtk_setup.h"
#include <pcl_uvol/filters/vtkUvolIsosurface.h>
#include <pcl_uvol/filters/vtkUvolLevelSet.h>
#include <pcl_uvol/filters/vtkUvolSplats.h>

#include <vtkCell.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>

using namespace uvol_test;

namespace test_same_as_tools {

void
write(const std::string& path, vtkPolyData* data)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  ASSERT_EQ(writer->Write(), 1);
}

vtkSmartPointer<vtkPolyData>
read(const std::string& path)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/** What a tool makes of data. */
vtkSmartPointer<vtkPolyData>
outputOf(const std::string& tool, vtkPolyData* data, const std::string& options)
{
  const TemporaryFolder folder;
  write(folder / "in.vtp", data);
  const auto result = runCommand(tool + " " + (folder / "in.vtp") + " " +
                                 (folder / "out.vtp") + " " + options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return read(folder / "out.vtp");
}

TEST(VtkIsosurface, SameMeshAsTheTool)
{
  const auto samples = makeSamples();
  const auto expected = outputOf(
      "uvol_isosurface", samples, "-field density -iso 4,5 -mesh -outside higher");
  vtkNew<vtkUvolIsosurface> filter;
  filter->SetInputData(samples);
  filter->GenerateValues(2, 4.0, 5.0);
  filter->SetOutside(vtkUvolIsosurface::OUTSIDE_HIGHER);
  filter->MeshOn();
  filter->Update();
  vtkPolyData& mesh = *filter->GetOutput();
  expectSamePoints(mesh, *expected);
  EXPECT_EQ(mesh.GetNumberOfVerts(), 0);
  ASSERT_GT(mesh.GetNumberOfPolys(), 800);
  ASSERT_EQ(mesh.GetNumberOfPolys(), expected->GetNumberOfPolys());
  for (vtkIdType i = 0; i < mesh.GetNumberOfPolys(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      ASSERT_EQ(mesh.GetCell(i)->GetPointId(corner),
                expected->GetCell(i)->GetPointId(corner));
  EXPECT_NE(mesh.GetPointData()->GetArray("piece"), nullptr);
  // Back to points.
  filter->MeshOff();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 0);
  EXPECT_GT(filter->GetOutput()->GetNumberOfVerts(), 0);
}

TEST(VtkIsosurface, SamePointsAsTheTool)
{
  const auto samples = makeSamples();
  struct Case {
    std::string options;
    std::function<void(vtkUvolIsosurface&)> configure;
  };
  const std::vector<Case> cases{
      {"-iso 5", [](auto& filter) { filter.SetValue(0, 5.0); }},
      {"-iso 3,4.5,6 -outside higher",
       [](auto& filter) {
         filter.GenerateValues(3, 3.0, 6.0);
         filter.SetOutside(vtkUvolIsosurface::OUTSIDE_HIGHER);
       }},
      {"-iso 5 -smooth",
       [](auto& filter) {
         filter.SetValue(0, 5.0);
         filter.SmoothOn();
       }},
      {"-iso 5 -max-error 0.02 -drop-bridged",
       [](auto& filter) {
         filter.SetValue(0, 5.0);
         filter.SetMaximumError(0.02);
         filter.DropBridgedOn();
       }},
      {"-iso 5 -max-error auto",
       [](auto& filter) {
         filter.SetValue(0, 5.0);
         filter.AutomaticMaximumErrorOn();
       }},
      {"-iso 5 -interpolation linear -criterion all -scale 1,1,2.5", [](auto& filter) {
         filter.SetValue(0, 5.0);
         filter.SetInterpolation(vtkUvolIsosurface::INTERPOLATION_LINEAR);
         filter.SetAngleCriterion(vtkUvolIsosurface::CRITERION_ALL);
         filter.SetScale(1.0, 1.0, 2.5);
       }}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.options);
    const auto expected =
        outputOf("uvol_isosurface", samples, "-field density " + c.options);
    vtkNew<vtkUvolIsosurface> filter;
    filter->SetInputData(samples);
    c.configure(*filter);
    filter->Update();
    expectSameData(*filter->GetOutput(), *expected);
    EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 400);
  }
}

/** Profiles of a layer that rises and falls, with words that are no numbers. */
vtkSmartPointer<vtkPolyData>
makeProfiles()
{
  Random random(3);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  vtkNew<vtkStringArray> names;
  names->SetName("profile");
  for (int profile = 0; profile < 40; ++profile) {
    const double x = random.uniform(), y = random.uniform();
    for (int i = 0; i < 40; ++i) {
      const double z = (i + 0.3 * random.uniform()) / 40.0;
      points->InsertNextPoint(x, y, z);
      height->InsertNextValue(static_cast<float>(z - 0.5 - 0.1 * std::sin(6.0 * x)));
      names->InsertNextValue("p" + std::to_string(profile));
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->SetScalars(height);
  data->GetPointData()->AddArray(names);
  return data;
}

TEST(VtkIsosurface, FillsGapsAsTheTool)
{
  const auto samples = makeProfiles();
  const auto expected =
      outputOf("uvol_isosurface", samples, "-field height -iso 0 -fill-gaps");
  vtkNew<vtkUvolIsosurface> filter;
  filter->SetInputData(samples);
  filter->SetValue(0, 0.0);
  filter->FillGapsOn();
  filter->Update();
  vtkPolyData& surface = *filter->GetOutput();
  expectSamePoints(surface, *expected);
  EXPECT_GT(surface.GetNumberOfPoints(), 100);
  ASSERT_NE(surface.GetPointData()->GetArray("confidence"), nullptr);
  double range[2];
  surface.GetPointData()->GetArray("support")->GetRange(range);
  EXPECT_EQ(range[1], 4.0);
  // Words are those of a measured sample.
  auto* const names =
      vtkStringArray::SafeDownCast(surface.GetPointData()->GetAbstractArray("profile"));
  ASSERT_NE(names, nullptr);
  ASSERT_EQ(names->GetNumberOfValues(), surface.GetNumberOfPoints());
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
    ASSERT_EQ(names->GetValue(i).substr(0, 1), "p");
  filter->FillGapsOff();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("confidence"), nullptr);
}

TEST(VtkIsosurface, ComponentsAndLengthsOfVectors)
{
  const auto samples = makeSamples();
  for (const int component : {1, -1}) {
    SCOPED_TRACE(component);
    const auto expected =
        outputOf("uvol_isosurface",
                 samples,
                 component < 0 ? "-iso 5 -field '|vel|'" : "-iso 5 -field 'vel[1]'");
    vtkNew<vtkUvolIsosurface> filter;
    filter->SetInputData(samples);
    filter->SetInputArrayToProcess(
        0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "vel");
    filter->SetArrayComponent(component);
    filter->SetValue(0, 5.0);
    filter->Update();
    expectSameData(*filter->GetOutput(), *expected);
  }
}

TEST(VtkIsosurface, ActiveNormalsAsTheScalar)
{
  const auto samples = makeSamples();
  vtkNew<vtkFloatArray> normals;
  normals->DeepCopy(samples->GetPointData()->GetArray("vel"));
  normals->SetName("N |,[0]");
  samples->GetPointData()->SetNormals(normals);
  for (const int component : {2, -1}) {
    vtkNew<vtkUvolIsosurface> filter;
    filter->SetInputData(samples);
    filter->SetInputArrayToProcess(
        0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "N |,[0]");
    filter->SetArrayComponent(component);
    filter->SetValue(0, 4.0);
    filter->Update();
    ASSERT_GT(filter->GetOutput()->GetNumberOfPoints(), 100);
    for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i) {
      const double* const p = filter->GetOutput()->GetPoint(i);
      EXPECT_NEAR(component < 0 ? std::hypot(p[0], p[1], p[2]) : p[2], 4.0, 0.2);
    }
  }
}

TEST(VtkIsosurface, ArraysThatNoCloudHoldsAndNamesOfComponents)
{
  vtkNew<vtkUvolIsosurface> filter;
  filter->SetInputData(makeSamples());
  filter->SetValue(0, 5.0);
  filter->Update();
  vtkPointData& data = *filter->GetOutput()->GetPointData();
  auto* const names = vtkStringArray::SafeDownCast(data.GetAbstractArray("name"));
  auto* const ids = data.GetArray("id");
  ASSERT_NE(names, nullptr);
  ASSERT_NE(ids, nullptr);
  EXPECT_EQ(ids->GetDataTypeSize(), 8);
  ASSERT_EQ(names->GetNumberOfValues(), filter->GetOutput()->GetNumberOfPoints());
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i) {
    const long long id = static_cast<vtkTypeInt64*>(ids->GetVoidPointer(0))[i];
    EXPECT_EQ(names->GetValue(i), "sample " + std::to_string(id - (1LL << 60)));
  }
  EXPECT_STREQ(data.GetArray("vel")->GetComponentName(2), "w");
  EXPECT_STREQ(data.GetScalars()->GetName(), "density");
  EXPECT_STREQ(data.GetNormals()->GetName(), "Normals");
}

TEST(VtkIsosurface, CoordinatesInDoubleKeepTheirDigits)
{
  const auto samples = makeSamples();
  vtkNew<vtkPoints> far;
  far->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < samples->GetNumberOfPoints(); ++i) {
    const double* const p = samples->GetPoint(i);
    far->InsertNextPoint(p[0] + 500000.0, p[1] + 5500000.0, p[2]);
  }
  samples->SetPoints(far);
  const auto expected = outputOf("uvol_isosurface", samples, "-field density -iso 5");
  vtkNew<vtkUvolIsosurface> filter;
  filter->SetInputData(samples);
  filter->SetValue(0, 5.0);
  filter->Update();
  expectSameData(*filter->GetOutput(), *expected);
  EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i) {
    const double* const p = filter->GetOutput()->GetPoint(i);
    EXPECT_NEAR(std::hypot(p[0] - 500000.0, p[1] - 5500000.0, p[2]), 5.0, 0.1);
  }
}

TEST(VtkIsosurface, PointsOfAnImage)
{
  constexpr int side = 12;
  vtkNew<vtkImageData> image;
  image->SetDimensions(side, side, side);
  image->SetOrigin(-5.5, -5.5, -5.5);
  vtkNew<vtkFloatArray> values;
  values->SetName("r");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i) {
    const double* const p = image->GetPoint(i);
    values->InsertNextValue(static_cast<float>(std::hypot(p[0], p[1], p[2])));
  }
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkUvolIsosurface> filter;
  filter->SetInputData(image);
  filter->SetValue(0, 4.0);
  filter->Update();
  ASSERT_GT(filter->GetOutput()->GetNumberOfPoints(), 200);
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i) {
    const double* const p = filter->GetOutput()->GetPoint(i);
    EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 4.0, 0.05);
  }
}

TEST(VtkLevelSet, SamePointsAsTheTool)
{
  const auto samples = makeSamples();
  struct Case {
    std::string options;
    std::function<void(vtkUvolLevelSet&)> configure;
  };
  const std::vector<Case> cases{
      {"", [](auto&) {}},
      {"-mu 0.3 -scheme linear -flow mean -bound cfl -integration synchronous "
       "-reinit none -k 20 -steps 12 -tolerance 0.01 -band 4 -scale 1,1,1.5",
       [](auto& filter) {
         filter.AutomaticMuOff();
         filter.SetMu(0.3);
         filter.SetScheme(vtkUvolLevelSet::SCHEME_LINEAR);
         filter.SetCurvatureFlow(vtkUvolLevelSet::FLOW_MEAN);
         filter.SetStepBound(vtkUvolLevelSet::BOUND_CFL);
         filter.SetIntegration(vtkUvolLevelSet::INTEGRATION_SYNCHRONOUS);
         filter.SetReinitialization(vtkUvolLevelSet::REINITIALIZATION_NONE);
         filter.SetNumberOfNeighbors(20);
         filter.SetMaximumNumberOfSteps(12);
         filter.SetTolerance(0.01);
         filter.SetBandWidth(4.0);
         filter.SetScale(1.0, 1.0, 1.5);
       }},
      {"-steps 20 -start density", [](auto& filter) {
         filter.SetMaximumNumberOfSteps(20);
         filter.SetInputArrayToProcess(
             1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "density");
       }}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.options);
    if (c.options.find("-start") != std::string::npos) // a distance, zero at 5
      for (vtkIdType i = 0; i < samples->GetNumberOfPoints(); ++i)
        samples->GetPointData()->GetScalars()->SetComponent(
            i, 0, samples->GetPointData()->GetScalars()->GetComponent(i, 0) - 5.0);
    const double isovalue = c.options.find("-start") != std::string::npos ? 0.0 : 5.0;
    const auto expected =
        outputOf("uvol_levelset",
                 samples,
                 "-field density -iso " + std::to_string(isovalue) + " " + c.options);
    vtkNew<vtkUvolLevelSet> filter;
    const Listener listener(*filter);
    filter->SetInputData(samples);
    filter->SetIsovalue(isovalue);
    c.configure(*filter);
    filter->Update();
    EXPECT_EQ(listener.errors, std::vector<std::string>());
    expectSameData(*filter->GetOutput(), *expected);
    EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetScalars()->GetName(), "phi");
    EXPECT_NE(filter->GetOutput()->GetPointData()->GetAbstractArray("name"), nullptr);
  }
}

TEST(VtkLevelSet, ItsZeroLevelIsTheSurface)
{
  vtkNew<vtkUvolLevelSet> level_set;
  level_set->SetInputData(makeSamples());
  level_set->SetIsovalue(5.0);
  vtkNew<vtkUvolIsosurface> filter;
  filter->SetInputConnection(level_set->GetOutputPort());
  filter->Update();
  ASSERT_GT(filter->GetOutput()->GetNumberOfPoints(), 400);
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i) {
    const double* const p = filter->GetOutput()->GetPoint(i);
    EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 5.0, 0.2);
  }
}

TEST(VtkSplats, SamePointsAsTheTool)
{
  vtkNew<vtkUvolIsosurface> isosurface;
  isosurface->SetInputData(makeSamples());
  isosurface->SetValue(0, 5.0);
  isosurface->Update();
  vtkPolyData* const surface = isosurface->GetOutput();
  struct Case {
    std::string options;
    std::function<void(vtkUvolSplats&)> configure;
  };
  const std::vector<Case> cases{
      {"-delta 0.01", [](auto& filter) { filter.SetDelta(0.01); }},
      {"-delta-abs 0.2 -lambda 0.5", [](auto& filter) {
         filter.SetDelta(0.2);
         filter.DeltaIsLengthOn();
         filter.SetLambda(0.5);
       }}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.options);
    const auto expected = outputOf("uvol_splats", surface, c.options);
    vtkNew<vtkUvolSplats> filter;
    filter->SetInputConnection(isosurface->GetOutputPort());
    c.configure(*filter);
    filter->Update();
    expectSameData(*filter->GetOutput(), *expected);
    EXPECT_NE(filter->GetOutput()->GetPointData()->GetAbstractArray("name"), nullptr);
    EXPECT_LT(filter->GetOutput()->GetNumberOfPoints(), surface->GetNumberOfPoints());
  }
}

} // namespace test_same_as_tools
