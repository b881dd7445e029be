// SPDX-License-Identifier: BSD-3-Clause
// What every VTK filter does: missing and wrong arrays, empty input, progress, abort,
// execution only when something was modified, the same bytes every time.
#include "vtk_setup.h"
#include <pcl_uvol/filters/vtkUvolFilter.h>
#include <pcl_uvol/filters/vtkUvolIsosurface.h>
#include <pcl_uvol/filters/vtkUvolLevelSet.h>
#include <pcl_uvol/filters/vtkUvolSplats.h>

#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <thread>

using namespace uvol_test;

namespace test_conventions {

constexpr int at_points = vtkDataObject::FIELD_ASSOCIATION_POINTS;

struct FilterCase {
  std::string name;
  std::function<vtkSmartPointer<vtkUvolFilter>()> make;
};

void
PrintTo(const FilterCase& filter, std::ostream* out)
{
  *out << filter.name;
}

vtkSmartPointer<vtkUvolFilter>
makeIsosurface()
{
  auto filter = vtkSmartPointer<vtkUvolIsosurface>::New();
  filter->SetValue(0, sample_isovalue);
  return filter;
}

vtkSmartPointer<vtkUvolFilter>
makeLevelSet()
{
  auto filter = vtkSmartPointer<vtkUvolLevelSet>::New();
  filter->SetIsovalue(sample_isovalue);
  filter->SetMaximumNumberOfSteps(20);
  return filter;
}

vtkSmartPointer<vtkUvolFilter>
makeSplats()
{
  auto filter = vtkSmartPointer<vtkUvolSplats>::New();
  filter->SetDelta(0.05);
  return filter;
}

class Convention : public testing::TestWithParam<FilterCase> {
protected:
  Convention()
      : filter_(GetParam().make())
      , listener_(*filter_)
  {
    filter_->SetInputData(samples_);
  }

  /** One error that says that, and an empty output. */
  void
  expectError(const std::string& text)
  {
    filter_->Update();
    ASSERT_EQ(listener_.errors.size(), 1u);
    EXPECT_NE(listener_.errors[0].find(text), std::string::npos) << listener_.errors[0];
    EXPECT_EQ(filter_->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(filter_->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  }

  vtkSmartPointer<vtkPolyData> samples_ = makeSamples();
  vtkSmartPointer<vtkUvolFilter> filter_;
  Listener listener_;
};

/** Those that process an array. */
class ArrayConvention : public Convention {};

TEST_P(ArrayConvention, MissingArray)
{
  filter_->SetInputArrayToProcess(0, 0, 0, at_points, "rho");
  expectError("'rho'");
  EXPECT_NE(listener_.errors[0].find("density (float32), vel (float64 x 3)"),
            std::string::npos)
      << listener_.errors[0];
  // And it recovers.
  filter_->SetInputArrayToProcess(0, 0, 0, at_points, "density");
  filter_->Update();
  EXPECT_EQ(listener_.errors.size(), 1u);
  EXPECT_GT(filter_->GetOutput()->GetNumberOfPoints(), 100);
}

TEST_P(ArrayConvention, NoActiveScalars)
{
  samples_->GetPointData()->SetActiveScalars(nullptr);
  expectError("Scalars");
}

TEST_P(ArrayConvention, ArrayOfCells)
{
  vtkNew<vtkFloatArray> of_cells;
  of_cells->SetName("of_cells");
  samples_->GetCellData()->AddArray(of_cells);
  filter_->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "of_cells");
  expectError("'of_cells'");
}

TEST_P(ArrayConvention, ArrayOfStrings)
{
  filter_->SetInputArrayToProcess(0, 0, 0, at_points, "name");
  expectError("vtkStringArray");
}

TEST_P(ArrayConvention, ArrayOfAnotherLength)
{
  vtkNew<vtkFloatArray> shorter;
  shorter->SetName("shorter");
  shorter->SetNumberOfTuples(7);
  samples_->GetPointData()->AddArray(shorter);
  filter_->SetInputArrayToProcess(0, 0, 0, at_points, "shorter");
  expectError(" 7 tuples");
  EXPECT_EQ(listener_.warnings.size(), 1u); // it is left out
}

TEST_P(ArrayConvention, NoSuchComponent)
{
  filter_->SetInputArrayToProcess(0, 0, 0, at_points, "vel");
  if (auto* const isosurface = vtkUvolIsosurface::SafeDownCast(filter_))
    isosurface->SetArrayComponent(3);
  else
    vtkUvolLevelSet::SafeDownCast(filter_)->SetArrayComponent(3);
  expectError(" 3 components");
}

TEST_P(ArrayConvention, BadParameter)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (auto* const isosurface = vtkUvolIsosurface::SafeDownCast(filter_))
    isosurface->SetValue(0, nan);
  else
    vtkUvolLevelSet::SafeDownCast(filter_)->SetIsovalue(nan);
  expectError("isovalue");
}

TEST_P(Convention, ValuesThatAreNoNumbers)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (vtkIdType i = 0; i < samples_->GetNumberOfPoints(); ++i)
    samples_->GetPoints()->SetPoint(i, nan, nan, nan);
  expectError(""); // whatever the library says
  EXPECT_GT(listener_.errors[0].size(), 80u);
}

TEST_P(Convention, EmptyInput)
{
  vtkNew<vtkPolyData> empty;
  filter_->SetInputData(empty);
  filter_->Update();
  EXPECT_EQ(filter_->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(listener_.errors, std::vector<std::string>());
}

TEST_P(Convention, AbortInMidRun)
{
  for (const int threads : {1, 3}) {
    SCOPED_TRACE(threads);
    filter_->SetNumberOfThreads(threads);
    filter_->Modified();
    listener_.progress.clear();
    listener_.on_progress = [&] {
      if (listener_.progress.back() > 0.3)
        filter_->SetAbortExecute(1);
    };
    filter_->Update();
    EXPECT_EQ(filter_->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(listener_.errors, std::vector<std::string>());
    ASSERT_FALSE(listener_.progress.empty());
    EXPECT_GT(listener_.progress.back(), 0.3);
    EXPECT_LT(listener_.progress.back(), 1.0);
  }
  listener_.on_progress = {};
  filter_->Modified();
  filter_->Update();
  EXPECT_GT(filter_->GetOutput()->GetNumberOfPoints(), 100);
}

TEST_P(Convention, ProgressGrowsAndIsReportedFromTheCallersThread)
{
  const auto caller = std::this_thread::get_id();
  bool only_there = true;
  listener_.on_progress = [&] {
    only_there = only_there && std::this_thread::get_id() == caller;
  };
  filter_->SetNumberOfThreads(3);
  filter_->Update();
  EXPECT_TRUE(only_there);
  ASSERT_GT(listener_.progress.size(), 5u);
  EXPECT_TRUE(std::is_sorted(listener_.progress.begin(), listener_.progress.end()));
  EXPECT_EQ(listener_.progress.back(), 1.0);
  const auto in_between =
      std::count_if(listener_.progress.begin(),
                    listener_.progress.end(),
                    [](double part) { return part > 0.0 && part < 1.0; });
  EXPECT_GE(in_between, 2);
}

TEST_P(Convention, ExecutesOnlyWhenModified)
{
  int runs = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&runs);
  counter->SetCallback([](vtkObject*, unsigned long, void* count, void*) {
    ++*static_cast<int*>(count);
  });
  filter_->AddObserver(vtkCommand::StartEvent, counter);
  filter_->Update();
  filter_->Update();
  EXPECT_EQ(runs, 1);
  filter_->SetNumberOfThreads(filter_->GetNumberOfThreads()); // as it was
  filter_->Update();
  EXPECT_EQ(runs, 1);
  filter_->SetNumberOfThreads(1);
  filter_->Update();
  EXPECT_EQ(runs, 2);
  samples_->Modified();
  filter_->Update();
  EXPECT_EQ(runs, 3);
  if (auto* const isosurface = vtkUvolIsosurface::SafeDownCast(filter_)) {
    isosurface->SetValue(0, 4.0); // which another object keeps
    filter_->Update();
    EXPECT_EQ(runs, 4);
  }
}

TEST_P(Convention, TheSameBytesEveryTime)
{
  filter_->Update();
  vtkNew<vtkPolyData> first;
  first->DeepCopy(filter_->GetOutput());
  filter_->Modified();
  filter_->Update();
  expectSameData(*filter_->GetOutput(), *first);
  for (const int threads : {1, 2, 5}) {
    const auto other = GetParam().make();
    other->SetInputData(samples_);
    other->SetNumberOfThreads(threads);
    other->Update();
    expectSameData(*other->GetOutput(), *first);
  }
}

TEST_P(Convention, ChangedInputIsReadAnew)
{
  filter_->Update();
  const auto changed = makeSamples(4000, 2);
  samples_->GetPoints()->DeepCopy(changed->GetPoints());
  samples_->GetPointData()->DeepCopy(changed->GetPointData());
  samples_->Modified();
  filter_->Update();
  const auto other = GetParam().make();
  other->SetInputData(changed);
  other->Update();
  expectSameData(*filter_->GetOutput(), *other->GetOutput());
}

TEST_P(Convention, DuplicateAndHiddenPointsAreLeftOut)
{
  const auto clean = makeSamples(3000);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < samples_->GetNumberOfPoints(); ++i) // the first 3000 stay
    ghosts->InsertNextValue(i < 3000     ? 0
                            : i % 2 == 0 ? vtkDataSetAttributes::DUPLICATEPOINT
                                         : vtkDataSetAttributes::HIDDENPOINT);
  samples_->GetPointData()->AddArray(ghosts);
  filter_->Update();
  const auto other = GetParam().make();
  other->SetInputData(clean);
  other->Update();
  expectSameData(*filter_->GetOutput(), *other->GetOutput());
  // A piece that is nothing but ghosts is empty.
  ghosts->FillValue(vtkDataSetAttributes::DUPLICATEPOINT);
  samples_->Modified();
  filter_->Update();
  EXPECT_EQ(filter_->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(listener_.errors, std::vector<std::string>());
}

TEST_P(Convention, PrintsItself)
{
  std::ostringstream text;
  filter_->Print(text);
  for (const char* const word : {"NumberOfThreads: 0"})
    EXPECT_NE(text.str().find(word), std::string::npos) << text.str();
  const std::vector<std::string> words =
      GetParam().name == "Isosurface" ? std::vector<std::string>{"ArrayComponent: 0",
                                                                 "Outside: Lower",
                                                                 "Interpolation: Fit",
                                                                 "AngleCriterion: Kept",
                                                                 "Scale: 1 1 1",
                                                                 "FillGaps: Off",
                                                                 "Smooth: Off",
                                                                 "MaximumError: 0",
                                                                 "DropBridged: Off",
                                                                 "Value 0: 5"}
      : GetParam().name == "LevelSet"
          ? std::vector<std::string>{"Isovalue: 5",
                                     "AutomaticMu: On",
                                     "Scheme: Quadratic",
                                     "Reinitialization: Distance",
                                     "MaximumNumberOfSteps: 20"}
          : std::vector<std::string>{
                "Delta: 0.05", "DeltaIsLength: Off", "Lambda: 0.2"};
  for (const std::string& word : words)
    EXPECT_NE(text.str().find(word), std::string::npos) << word << "\n" << text.str();
}

TEST_P(Convention, TypesAndInputs)
{
  EXPECT_TRUE(filter_->IsA("vtkPolyDataAlgorithm"));
  EXPECT_EQ(std::string(filter_->GetClassName()), "vtkUvol" + GetParam().name);
  const vtkSmartPointer<vtkUvolFilter> another =
      vtkSmartPointer<vtkUvolFilter>::Take(filter_->NewInstance());
  EXPECT_EQ(std::string(another->GetClassName()), filter_->GetClassName());
  const Listener listener(*another); // no input
  another->Update();
  EXPECT_EQ(another->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(VtkIsosurface, AnIsovalueOutsideTheValuesWarns)
{
  vtkNew<vtkUvolIsosurface> filter;
  const Listener listener(*filter);
  filter->SetInputData(makeSamples());
  filter->SetValue(0, 1000.0);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(listener.errors.size(), 0u);
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_NE(listener.warnings[0].find("1000"), std::string::npos);
  // Its arrays are there for whatever comes next.
  EXPECT_NE(filter->GetOutput()->GetPointData()->GetArray("density"), nullptr);
}

TEST(VtkIsosurface, WarningsNameProperties)
{
  vtkNew<vtkUvolIsosurface> filter;
  const Listener listener(*filter);
  filter->SetInputData(makeSamples());
  filter->SetValue(0, 5.0);
  filter->SetMaximumError(1e-12);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(listener.errors.size(), 0u);
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_NE(listener.warnings[0].find("MaximumError"), std::string::npos)
      << listener.warnings[0];
}

TEST(VtkIsosurface, FurtherIsovaluesAreThoseOfANewFilter)
{
  const auto samples = makeSamples();
  vtkNew<vtkUvolIsosurface> filter;
  filter->SetInputData(samples);
  for (const double isovalue : {5.0, 3.0, 6.5}) {
    filter->SetValue(0, isovalue);
    filter->Update();
    vtkNew<vtkUvolIsosurface> other;
    other->SetInputData(samples);
    other->SetValue(0, isovalue);
    other->Update();
    expectSameData(*filter->GetOutput(), *other->GetOutput());
  }
}

TEST(VtkIsosurface, AnArrayThatGivesWayWarns)
{
  const auto samples = makeSamples();
  vtkNew<vtkFloatArray> error;
  error->SetName("error");
  error->SetNumberOfTuples(samples->GetNumberOfPoints());
  error->FillValue(77.0f);
  samples->GetPointData()->AddArray(error);
  vtkNew<vtkUvolIsosurface> filter;
  const Listener listener(*filter);
  filter->SetInputData(samples);
  filter->SetValue(0, 5.0);
  filter->Update();
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_NE(listener.warnings[0].find("'error'"), std::string::npos);
  EXPECT_LT(filter->GetOutput()->GetPointData()->GetArray("error")->GetRange()[1], 7.0);
}

const auto name_of = [](const auto& info) { return info.param.name; };

INSTANTIATE_TEST_SUITE_P(Vtk,
                         ArrayConvention,
                         testing::Values(FilterCase{"Isosurface", makeIsosurface},
                                         FilterCase{"LevelSet", makeLevelSet}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Vtk,
                         Convention,
                         testing::Values(FilterCase{"Isosurface", makeIsosurface},
                                         FilterCase{"LevelSet", makeLevelSet},
                                         FilterCase{"Splats", makeSplats}),
                         name_of);

} // namespace test_conventions
