// SPDX-License-Identifier: BSD-3-Clause
#include "common/records.h"
#include "common/scalar_names.h"
#include "filters/cell_locator.h"
#include "filters/filter_run.h"
#include "filters/solid_cells.h"
#include "interpolation/answer_summary.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/filters/vtkUvolProbe.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWeakPointer.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>

vtkStandardNewMacro(vtkUvolProbe);

using pcl_uvol::InterpolatedFields;
using pcl_uvol::InterpolationParameters;
using pcl_uvol::Report;

namespace {

/** A name, or the first of name_2, name_3, ... that no array has with any ending. */
std::string
findFreeName(vtkPointData& data, const std::string& name)
{
  const auto is_taken = [&](const std::string& candidate) {
    return data.HasArray(candidate.c_str()) ||
           data.HasArray((candidate + "_error").c_str()) ||
           data.HasArray((candidate + "_gradient").c_str());
  };
  std::string free = name;
  for (int i = 2; is_taken(free); ++i)
    free = name + '_' + std::to_string(i);
  return free;
}

void
addArray(vtkPointData& data,
         const std::string& name,
         int components,
         const double* numbers,
         std::size_t count)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(count));
  std::copy_n(
      numbers, count * static_cast<std::size_t>(components), array->GetPointer(0));
  data.AddArray(array);
}

void
addArrays(const InterpolatedFields& answers, vtkPointData& data)
{
  for (std::size_t f = 0; f < answers.names.size(); ++f) {
    const std::string name = findFreeName(data, answers.names[f]);
    const std::size_t first = f * answers.size;
    addArray(data, name, 1, answers.values.data() + first, answers.size);
    addArray(data, name + "_error", 1, answers.errors.data() + first, answers.size);
    if (!answers.gradients.empty())
      addArray(data,
               name + "_gradient",
               3,
               answers.gradients.data() + 3 * first,
               answers.size);
    if (f == 0)
      data.SetActiveScalars(name.c_str());
  }
  vtkNew<vtkUnsignedCharArray> support;
  support->SetName(findFreeName(data, "support").c_str());
  support->SetNumberOfTuples(static_cast<vtkIdType>(answers.size));
  std::transform(
      answers.support.begin(),
      answers.support.end(),
      support->GetPointer(0),
      [](pcl_uvol::FieldSupport kind) { return static_cast<unsigned char>(kind); });
  data.AddArray(support);
}

/** The cells of a source; null if it has none. Where points are marked as copies, which
 * are no samples, cells count whatever values their corners have. */
std::shared_ptr<const pcl_uvol::CellLocator>
findCells(vtkDataSet& source, const std::array<double, 3>& origin)
{
  using pcl_uvol::CellLocator;
  if (vtkPolyData::SafeDownCast(&source))
    return nullptr;
  const pcl_uvol::SolidCells solid = pcl_uvol::takeSolidCells(source);
  if (solid.mesh->GetNumberOfCells() == 0)
    return nullptr;
  return std::make_shared<const CellLocator>(
      solid.mesh,
      CellLocator::Samples::Corners,
      source.GetPointGhostArray()
          ? std::size_t{0}
          : static_cast<std::size_t>(source.GetNumberOfPoints()),
      origin);
}

} // namespace

/** The source as it was read last, and the model of its fields. */
struct vtkUvolProbe::Samples {
  vtkWeakPointer<vtkDataSet> source;
  vtkMTimeType source_time = 0;
  InterpolationParameters asked_for;
  bool has_cell_mask = false;
  pcl_uvol::Dataset dataset;
  pcl::Indices visible;
  std::unique_ptr<pcl_uvol::detail::FieldInterpolator> interpolator;
  std::optional<pcl_uvol::detail::AnswerSummary> no_answers;
  Report made; ///< of reading and of the model
};

vtkUvolProbe::vtkUvolProbe()
{
  this->SetNumberOfInputPorts(2);
}

vtkUvolProbe::~vtkUvolProbe() = default;

void
vtkUvolProbe::PrintSelf(std::ostream& out, vtkIndent indent)
{
  this->Superclass::PrintSelf(out, indent);
  constexpr const char* models[] = {
      "Fit", "Nearest", "Shepard", "Natural", "Laplace", "Kriging", "Sph", "Auto"};
  out << indent << "Field: " << this->Field << '\n'
      << indent << "Model: " << models[this->Model] << '\n'
      << indent << "Extrapolate: " << (this->Extrapolate ? "On" : "Off") << '\n'
      << indent << "ComputeGradients: " << (this->ComputeGradients ? "On" : "Off")
      << '\n'
      << indent << "CellMask: " << (this->CellMask ? "On" : "Off") << '\n'
      << indent << "Scale: " << this->Scale[0] << ' ' << this->Scale[1] << ' '
      << this->Scale[2] << '\n'
      << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n';
}

void
vtkUvolProbe::SetField(const std::string& field)
{
  if (this->Field == field)
    return;
  this->Field = field;
  this->Modified();
}

int
vtkUvolProbe::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
    return this->Superclass::FillInputPortInformation(port, info);
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  for (const char* const type : {"vtkPointSet", "vtkImageData", "vtkRectilinearGrid"})
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), type);
  return 1;
}

int
vtkUvolProbe::RequestUpdateExtent(vtkInformation* request,
                                  vtkInformationVector** inputs,
                                  vtkInformationVector* outputs)
{
  this->Superclass::RequestUpdateExtent(request, inputs, outputs);
  // Whatever piece is asked for, all samples matter to it.
  pcl_uvol::askForAll(*inputs[1]->GetInformationObject(0));
  return 1;
}

InterpolationParameters
vtkUvolProbe::Parameters() const
{
  using Kind = pcl_uvol::InterpolationModel;
  constexpr Kind models[] = {Kind::Fit,
                             Kind::Nearest,
                             Kind::Shepard,
                             Kind::Sibson,
                             Kind::Laplace,
                             Kind::Kriging,
                             Kind::Sph,
                             Kind::Auto};
  InterpolationParameters parameters;
  if (!this->Field.empty())
    parameters.fields = {this->Field};
  parameters.model = models[this->Model];
  parameters.extrapolate = this->Extrapolate != 0;
  parameters.gradients = this->ComputeGradients != 0;
  parameters.scale = Eigen::Array3d(this->Scale).cast<float>();
  return parameters;
}

void
vtkUvolProbe::ReadSource(vtkDataSet& source, Report& report)
{
  InterpolationParameters parameters = this->Parameters();
  if (this->Read && this->Read->source == &source &&
      this->Read->source_time == source.GetMTime() &&
      this->Read->has_cell_mask == (this->CellMask != 0) &&
      this->Read->asked_for == parameters)
    return;
  this->Read.reset(); // before the next one takes memory
  auto read = std::make_unique<Samples>();
  read->source = &source;
  read->source_time = source.GetMTime();
  read->asked_for = parameters;
  read->has_cell_mask = this->CellMask != 0;
  read->visible = pcl_uvol::visiblePoints(source);
  if (read->visible.empty())
    throw pcl_uvol::InvalidArgument("empty_source", {});
  read->dataset = pcl_uvol::collectPoints(source).dataset;
  read->made.warnings = read->dataset.notes;
  read->made.progress = report.progress;
  if (parameters.fields.empty())
    parameters.fields =
        pcl_uvol::listScalars(pcl_uvol::listNumberFields(read->dataset));
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(read->dataset.cloud);
  read->interpolator = std::make_unique<pcl_uvol::detail::FieldInterpolator>(
      view,
      read->visible,
      parameters,
      static_cast<unsigned>(this->NumberOfThreads),
      read->made);
  if (this->CellMask)
    read->interpolator->setCells(findCells(source, read->dataset.origin));
  read->no_answers.emplace(view, read->visible, read->interpolator->getNames());
  read->made.progress = {};
  this->Read = std::move(read);
}

int
vtkUvolProbe::RequestData(vtkInformation*,
                          vtkInformationVector** inputs,
                          vtkInformationVector* outputs)
{
  vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
  vtkDataSet* const source = vtkDataSet::GetData(inputs[1]);
  vtkDataSet* const output = vtkDataSet::GetData(outputs);
  if (!input || !source || !output)
    return 0;
  return pcl_uvol::runGuarded(
      *this, *output, [&](pcl_uvol::PipelineProgress& progress, Report& report) {
        output->ShallowCopy(input);
        if (input->GetNumberOfPoints() == 0)
          return;
        progress.expect(2); // the tree, the answers
        this->ReadSource(*source, report);
        report.merge(this->Read->made);
        const auto& origin = this->Read->dataset.origin;
        std::vector<std::array<double, 3>> queries(
            static_cast<std::size_t>(input->GetNumberOfPoints()));
        for (std::size_t i = 0; i < queries.size(); ++i) {
          input->GetPoint(static_cast<vtkIdType>(i), queries[i].data());
          for (std::size_t axis = 0; axis < 3; ++axis)
            queries[i][axis] -= origin[axis];
        }
        const InterpolatedFields answers = this->Read->interpolator->interpolate(
            queries, static_cast<unsigned>(this->NumberOfThreads), report);
        pcl_uvol::detail::AnswerSummary summary = *this->Read->no_answers;
        summary.add(answers);
        summary.warn(report);
        addArrays(answers, *output->GetPointData());
      });
}
