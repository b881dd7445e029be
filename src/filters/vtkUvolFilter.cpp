// SPDX-License-Identifier: BSD-3-Clause
#include "common/scalar_field.h"
#include "filters/filter_run.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/filters/vtkUvolFilter.h>

#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>

using pcl_uvol::InvalidArgument;

namespace {

/** The array that was asked for, as a subject of a sentence. */
std::string
describeChoice(vtkInformation& choice)
{
  if (choice.Has(vtkDataObject::FIELD_NAME()))
    return std::string("array '") + choice.Get(vtkDataObject::FIELD_NAME()) + "'";
  const int role = choice.Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  return std::string("active ") + vtkDataSetAttributes::GetAttributeTypeAsString(role);
}

std::string
describeArrays(const pcl_uvol::PointArrays& points)
{
  std::vector<pcl::PCLPointField> fields = points.dataset.cloud.fields;
  fields.erase(fields.begin(), fields.begin() + 3); // x, y, z
  return pcl_uvol::describeFields(fields);
}

} // namespace

void
vtkUvolFilter::PrintSelf(std::ostream& out, vtkIndent indent)
{
  this->Superclass::PrintSelf(out, indent);
  out << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n';
}

int
vtkUvolFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  for (const char* const type : {"vtkPointSet", "vtkImageData", "vtkRectilinearGrid"})
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  return 1;
}

int
vtkUvolFilter::RequestData(vtkInformation*,
                           vtkInformationVector** inputs,
                           vtkInformationVector* outputs)
{
  vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
  vtkPolyData* const output = vtkPolyData::GetData(outputs);
  if (!input || !output)
    return 0;
  return pcl_uvol::runGuarded(
      *this,
      *output,
      [&](pcl_uvol::PipelineProgress& progress, pcl_uvol::Report& report) {
        const std::vector<int> visible = pcl_uvol::visiblePoints(*input);
        if (visible.empty())
          return; // as a piece of a parallel pipeline may be
        pcl_uvol::FilterRun run{*input, visible, *output, progress, report};
        this->Execute(run);
      });
}

std::string
vtkUvolFilter::FieldToProcess(int index,
                              int component,
                              vtkDataSet& input,
                              const pcl_uvol::PointArrays& points)
{
  vtkInformation& choice = *this->GetInputArrayInformation(index);
  int association = choice.Get(vtkDataObject::FIELD_ASSOCIATION());
  vtkAbstractArray* const array =
      this->GetInputAbstractArrayToProcess(index, &input, association);
  const std::string asked_for = describeChoice(choice);
  if (association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
    throw InvalidArgument("array_not_of_points", {{"array", asked_for}});
  if (!array)
    throw InvalidArgument("no_such_array",
                          {{"array", asked_for}, {"arrays", describeArrays(points)}});
  const auto found =
      std::find_if(points.numbers.begin(),
                   points.numbers.end(),
                   [&](const auto& numbers) { return numbers.array == array; });
  if (found == points.numbers.end())
    throw InvalidArgument("array_of_other_points",
                          {{"array", asked_for},
                           {"type", array->GetClassName()},
                           {"tuples", array->GetNumberOfTuples()},
                           {"points", input.GetNumberOfPoints()},
                           {"arrays", describeArrays(points)}});
  const int components = array->GetNumberOfComponents();
  if (component >= components)
    throw InvalidArgument(
        "no_such_component",
        {{"array", asked_for}, {"components", components}, {"component", component}});
  const auto& fields = points.dataset.cloud.fields;
  const auto nameOf = [&](std::size_t i) {
    return fields[found->first_field + i].name;
  };
  const auto at = static_cast<std::size_t>(std::max(component, 0));
  if (components == 1)
    return nameOf(0);
  if (found->fields > 1) // normals
    return component >= 0 ? nameOf(at)
                          : "|" + nameOf(0) + "," + nameOf(1) + "," + nameOf(2) + "|";
  return component >= 0 ? nameOf(0) + "[" + std::to_string(at) + "]"
                        : "|" + nameOf(0) + "|";
}
