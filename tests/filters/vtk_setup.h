// SPDX-License-Identifier: BSD-3-Clause
// VTK data to put through filters, what filters tell, and comparison of what comes out.
#pragma once

#include "support/environment.h"

#include <gtest/gtest.h>
#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace uvol_test {

/** \brief An isovalue of makeSamples, whose surface is a sphere. */
constexpr double sample_isovalue = 5.0;

/** \brief Random samples about the origin, active scalars `density`: the distance to
 * it; `vel`, three doubles with names, which are the position; `id`, 64 bits; `color`;
 * and `name`, a string. */
inline vtkSmartPointer<vtkPolyData>
makeSamples(std::size_t n = 4000, std::uint64_t seed = 1)
{
  constexpr double half_side = 8.0;
  Random random(seed);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> density;
  density->SetName("density");
  vtkNew<vtkDoubleArray> vel;
  vel->SetName("vel");
  vel->SetNumberOfComponents(3);
  for (int axis = 0; axis < 3; ++axis)
    vel->SetComponentName(axis, std::string(1, static_cast<char>('u' + axis)).c_str());
  vtkNew<vtkLongLongArray> id;
  id->SetName("id");
  vtkNew<vtkUnsignedCharArray> color;
  color->SetName("color");
  color->SetNumberOfComponents(3);
  vtkNew<vtkStringArray> name;
  name->SetName("name");
  for (std::size_t i = 0; i < n; ++i) {
    float p[3];
    for (float& coordinate : p)
      coordinate = static_cast<float>(half_side * (2.0 * random.uniform() - 1.0));
    points->InsertNextPoint(p);
    density->InsertNextValue(std::hypot(p[0], p[1], p[2]));
    vel->InsertNextTuple3(p[0], p[1], p[2]);
    id->InsertNextValue((1LL << 60) + static_cast<long long>(i));
    color->InsertNextTuple3(static_cast<double>(i % 256), 7, 255);
    name->InsertNextValue("sample " + std::to_string(i));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->SetScalars(density);
  for (vtkAbstractArray* const array :
       std::initializer_list<vtkAbstractArray*>{vel, id, color, name})
    data->GetPointData()->AddArray(array);
  return data;
}

/** \brief Keeps what a filter tells through events. */
class Listener {
public:
  explicit Listener(vtkAlgorithm& filter)
      : filter_(filter)
  {
    command_->SetClientData(this);
    command_->SetCallback([](vtkObject*, unsigned long event, void* self, void* data) {
      static_cast<Listener*>(self)->hear(event, data);
    });
    for (const auto event :
         {vtkCommand::ErrorEvent, vtkCommand::WarningEvent, vtkCommand::ProgressEvent})
      filter.AddObserver(event, command_);
    // Which says once more that something failed.
    filter.GetExecutive()->AddObserver(vtkCommand::ErrorEvent, silent_);
  }

  std::vector<std::string> errors, warnings;
  std::vector<double> progress;
  std::function<void()> on_progress;

private:
  void
  hear(unsigned long event, void* data)
  {
    if (event == vtkCommand::ErrorEvent)
      errors.emplace_back(static_cast<const char*>(data));
    else if (event == vtkCommand::WarningEvent)
      warnings.emplace_back(static_cast<const char*>(data));
    else {
      progress.push_back(filter_.GetProgress());
      if (on_progress)
        on_progress();
    }
  }

  vtkAlgorithm& filter_;
  vtkNew<vtkCallbackCommand> command_, silent_;
};

/** \brief Same type, components and bytes. */
inline void
expectSameNumbers(vtkDataArray& actual, vtkDataArray& expected)
{
  ASSERT_EQ(actual.GetDataType(), expected.GetDataType());
  ASSERT_EQ(actual.GetNumberOfComponents(), expected.GetNumberOfComponents());
  ASSERT_EQ(actual.GetNumberOfTuples(), expected.GetNumberOfTuples());
  const auto bytes = static_cast<std::size_t>(actual.GetNumberOfValues()) *
                     static_cast<std::size_t>(actual.GetDataTypeSize());
  EXPECT_TRUE(
      bytes == 0 ||
      std::memcmp(actual.GetVoidPointer(0), expected.GetVoidPointer(0), bytes) == 0);
}

/** \brief The points and arrays of numbers of the expected data, by bytes. */
inline void
expectSamePoints(vtkPolyData& actual, vtkPolyData& expected)
{
  ASSERT_GT(expected.GetNumberOfPoints(), 0);
  ASSERT_EQ(actual.GetNumberOfPoints(), expected.GetNumberOfPoints());
  expectSameNumbers(*actual.GetPoints()->GetData(), *expected.GetPoints()->GetData());
  vtkPointData& data = *expected.GetPointData();
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
    if (auto* const array = data.GetArray(i)) {
      SCOPED_TRACE(array->GetName());
      auto* const other = actual.GetPointData()->GetArray(array->GetName());
      ASSERT_NE(other, nullptr);
      expectSameNumbers(*other, *array);
    }
  const bool has_normals = data.GetNormals() != nullptr;
  EXPECT_EQ(actual.GetPointData()->GetNormals() != nullptr, has_normals);
}

/** \brief The same, and a vertex at every point. */
inline void
expectSameData(vtkPolyData& actual, vtkPolyData& expected)
{
  expectSamePoints(actual, expected);
  EXPECT_EQ(actual.GetNumberOfVerts(), actual.GetNumberOfPoints());
  EXPECT_EQ(expected.GetNumberOfVerts(), expected.GetNumberOfPoints());
}

} // namespace uvol_test
