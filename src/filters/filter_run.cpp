// SPDX-License-Identifier: BSD-3-Clause
#include "filters/filter_run.h"

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/filters/point_data.h>

#include <vtkAlgorithm.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <limits>
#include <new>
#include <string>

namespace pcl_uvol {

namespace {

/** Strings and variants come from the nearer sample. */
void
copyTuples(vtkAbstractArray& array, const IsoEdges& edges, vtkPointData& output)
{
  const auto count = static_cast<vtkIdType>(edges.size());
  vtkNew<vtkIdList> from, to;
  from->SetNumberOfIds(count);
  to->SetNumberOfIds(count);
  for (vtkIdType i = 0; i < count; ++i) {
    const IsoEdge& edge = edges[static_cast<std::size_t>(i)];
    from->SetId(i, edge.t <= 0.5f ? edge.first : edge.second);
    to->SetId(i, i);
  }
  auto copy = vtkSmartPointer<vtkAbstractArray>::Take(array.NewInstance());
  copy->SetName(array.GetName());
  copy->SetNumberOfComponents(array.GetNumberOfComponents());
  copy->SetNumberOfTuples(count);
  copy->InsertTuples(to, from, &array);
  output.AddArray(copy);
}

void
copyComponentNames(vtkAbstractArray& from, vtkAbstractArray& to)
{
  if (from.GetNumberOfComponents() == to.GetNumberOfComponents() &&
      from.HasAComponentName())
    to.CopyComponentNames(&from);
}

/** What is active in the input is active in the output, unless something is. */
void
copyActiveArrays(vtkPointData& from, vtkPointData& to)
{
  for (const int role : {vtkDataSetAttributes::SCALARS,
                         vtkDataSetAttributes::VECTORS,
                         vtkDataSetAttributes::TCOORDS,
                         vtkDataSetAttributes::TENSORS}) {
    vtkAbstractArray* const active = from.GetAbstractAttribute(role);
    if (active && active->GetName() && to.HasArray(active->GetName()))
      to.SetActiveAttribute(active->GetName(), role);
  }
}

} // namespace

void
PipelineProgress::advanceTo(double done)
{
  if (std::this_thread::get_id() != thread_)
    return;
  if (done == 0.0)
    ++started_;
  const double steps = static_cast<double>(std::max<std::size_t>(started_, 1) - 1);
  const double whole = (steps + done) / static_cast<double>(expected_);
  filter_.UpdateProgress(std::min(std::max(whole, filter_.GetProgress()), 1.0));
  if (filter_.GetAbortExecute())
    throw Aborted();
}

int
runGuarded(vtkAlgorithm& filter,
           vtkDataObject& output,
           const std::function<void(PipelineProgress&, Report&)>& work)
{
  output.Initialize();
  PipelineProgress progress(filter);
  Report report;
  report.progress = [&](const std::string&, double done) { progress.advanceTo(done); };
  std::string error;
  try {
    work(progress, report);
  }
  catch (const Aborted&) {
    output.Initialize();
    return 1;
  }
  catch (const Exception& exception) {
    error = exception.asMessage().text(ParameterNames::Properties);
  }
  catch (const std::bad_alloc&) {
    error = Message("out_of_memory", {}).text();
  }
  catch (const std::exception& exception) {
    error = exception.what();
  }
  for (const Message& warning : report.warnings)
    vtkWarningWithObjectMacro(&filter, << warning.text(ParameterNames::Properties));
  if (error.empty())
    return 1;
  vtkErrorWithObjectMacro(&filter, << error);
  output.Initialize();
  return 0;
}

void
askForAll(vtkInformation& input)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  input.Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  input.Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  input.Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (input.Has(Pipeline::WHOLE_EXTENT()))
    input.Set(Pipeline::UPDATE_EXTENT(), input.Get(Pipeline::WHOLE_EXTENT()), 6);
}

std::vector<int>
visiblePoints(vtkDataSet& input)
{
  constexpr unsigned char absent =
      vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;
  vtkUnsignedCharArray* const ghosts = input.GetPointGhostArray();
  if (input.GetNumberOfPoints() > std::numeric_limits<int>::max())
    throw InvalidArgument("cloud_beyond_numbers",
                          {{"points", input.GetNumberOfPoints()}});
  std::vector<int> visible;
  visible.reserve(static_cast<std::size_t>(input.GetNumberOfPoints()));
  for (vtkIdType i = 0; i < input.GetNumberOfPoints(); ++i)
    if (!ghosts || (ghosts->GetValue(i) & absent) == 0)
      visible.push_back(static_cast<int>(i));
  return visible;
}

void
fillOutput(const Dataset& result,
           const PointArrays& input,
           const IsoEdges& edges,
           FilterRun& run)
{
  run.output.ShallowCopy(fromPointCloud(result));
  vtkPointData& data = *run.output.GetPointData();
  const auto& fields = input.dataset.cloud.fields;
  for (const PointArray& numbers : input.numbers)
    if (auto* const array =
            data.GetAbstractArray(fields[numbers.first_field].name.c_str()))
      copyComponentNames(*numbers.array, *array);
  for (const auto& array : input.others)
    copyTuples(*array, edges, data);
  copyActiveArrays(*run.input.GetPointData(), data);
}

IsoEdges
edgesAt(const std::vector<std::uint32_t>& sources)
{
  IsoEdges edges;
  edges.reserve(sources.size());
  for (const std::uint32_t source : sources)
    edges.push_back({source, source, 0.0f});
  return edges;
}

} // namespace pcl_uvol
