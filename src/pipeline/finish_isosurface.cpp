// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/finish_isosurface.h"

#include "common/records.h"
#include "common/scalar_field.h"
#include "distributed/run_stage.h"
#include "isosurface/iso_edges.h"
#include "isosurface/memory_need.h"
#include "pipeline/gap_filling.h"
#include "pipeline/isopoint_choice.h"
#include "pipeline/isopoint_filter.h"
#include "pipeline/periodic_surface.h"
#include "pipeline/weak_support.h"

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

namespace pcl_uvol {

namespace {

/** Isopoints follow one another by isovalue. */
std::vector<std::size_t>
countPerIsovalue(const pcl::PointCloud<PointIso>& isopoints,
                 const std::vector<double>& isovalues)
{
  std::vector<std::size_t> counts;
  auto begin = isopoints.begin();
  for (const double isovalue : isovalues) {
    const auto end = std::find_if(begin, isopoints.end(), [&](const PointIso& point) {
      return point.isovalue != static_cast<float>(isovalue);
    });
    counts.push_back(static_cast<std::size_t>(end - begin));
    begin = end;
  }
  return counts;
}

std::optional<ErrorSummary>
summarizeErrors(const pcl::PointCloud<PointIso>& isopoints)
{
  std::vector<float> errors;
  for (const PointIso& point : isopoints)
    if (!std::isnan(point.error))
      errors.push_back(point.error);
  if (errors.empty())
    return std::nullopt;
  std::sort(errors.begin(), errors.end());
  return ErrorSummary{
      errors[errors.size() / 2], errors[errors.size() * 95 / 100], errors.back()};
}

/** Float holds some isovalues, such as 3e50, as infinite or as zero: the field of that
 * name is double then.
 * \param isopoints one per point of the surface */
void
keepIsovalues(const pcl::PointCloud<PointIso>& isopoints,
              const std::vector<double>& isovalues,
              Dataset& surface,
              Report& report)
{
  const auto is_held = [](double isovalue) {
    const auto rounded = static_cast<float>(isovalue);
    return std::isfinite(rounded) && (rounded != 0.0f || isovalue == 0.0);
  };
  if (std::all_of(isovalues.begin(), isovalues.end(), is_held))
    return;
  std::map<float, double> by_rounded;
  for (const double isovalue : isovalues)
    if (!by_rounded.emplace(static_cast<float>(isovalue), isovalue).second)
      report.warn("equal_isovalues");
  std::vector<double> values;
  for (const PointIso& point : isopoints)
    values.push_back(by_rounded.at(point.isovalue));
  setField(surface, "isovalue", values);
}

/** Gives the vertices of a mesh the isovalue as their value of the field that the mesh
 * is an isosurface of: between samples of a steep field the interpolated value is far
 * from it. Vertices on caps, lengths of vectors and integers are left as they are.
 * \param own fields of isopoints, which come before those of the samples */
void
putIsovalues(const SurfaceTriangles& found,
             const std::string& field,
             const std::vector<double>& isovalues,
             std::size_t own,
             pcl::PCLPointCloud2& cloud)
{
  const ScalarField scalar(cloud.fields, field);
  const FieldComponent& component = scalar.getComponents().front();
  if (own == cloud.fields.size() || component.offset < cloud.fields[own].offset)
    return; // a coordinate, or another field of isopoints
  const bool is_float = component.datatype == pcl::PCLPointField::FLOAT32;
  if (scalar.isLength() ||
      (!is_float && component.datatype != pcl::PCLPointField::FLOAT64))
    return;
  std::map<float, double> exact;
  for (const double isovalue : isovalues)
    exact.emplace(static_cast<float>(isovalue), isovalue);
  for (std::size_t i = 0; i < found.vertices.size(); ++i) {
    if (found.is_on_cap[i] != 0)
      continue;
    const auto known = exact.find(found.vertices[i].isovalue);
    if (known == exact.end())
      continue;
    const double isovalue = known->second;
    const auto rounded = static_cast<float>(isovalue);
    std::uint8_t* const to = &cloud.data[i * cloud.point_step + component.offset];
    if (is_float)
      std::memcpy(to, &rounded, sizeof(rounded));
    else
      std::memcpy(to, &isovalue, sizeof(isovalue));
  }
}

/** Count isopoints again whose support an extraction has counted.
 * \param are_fitted isopoints on fits have a support */
void
countSupports(const pcl::PointCloud<PointIso>& isopoints,
              bool are_fitted,
              Report& report)
{
  for (const auto& [name, support] : {std::pair("bridged", IsoSupport::Bridged),
                                      std::pair("rim", IsoSupport::Rim),
                                      std::pair("predicted", IsoSupport::Predicted)}) {
    const auto is_so = [wanted = static_cast<std::uint8_t>(support)](
                           const PointIso& point) { return point.support == wanted; };
    const auto left = static_cast<std::uint64_t>(
        std::count_if(isopoints.begin(), isopoints.end(), is_so));
    if (left > 0 || (are_fitted && support != IsoSupport::Predicted))
      report.setCount(name, left);
  }
}

/** Adds what only a mesh has. */
void
addMesh(SurfaceTriangles&& found, IsosurfaceResult& result)
{
  setField(result.surface, "piece", found.piece_of);
  setField(result.surface,
           "cap",
           std::vector<std::int32_t>(found.is_on_cap.begin(), found.is_on_cap.end()));
  result.triangles = std::move(found.triangles);
  result.pieces = std::move(found.pieces);
  result.smallest_angle = found.smallest_angle;
}

} // namespace

IsosurfaceResult
finishIsosurface(const Dataset& samples,
                 SurfaceTriangles&& found,
                 const IsosurfacePipelineParameters& parameters,
                 const std::optional<SamplingSummary>& sampling,
                 Communicator& communicator,
                 unsigned threads,
                 Report&& report,
                 SurfaceRole role,
                 const detail::FilledGaps* gaps,
                 bool removes_unlocated)
{
  const CloudView view = viewOf(samples.cloud);
  pcl::PointCloud<PointIso>& isopoints = found.vertices;
  IsoEdges& edges = found.edges;
  checkMemoryTogether("A surface with its fields",
                      isopoints.size(),
                      surfaceFieldsBytes(static_cast<double>(isopoints.size()),
                                         static_cast<double>(samples.cloud.point_step)),
                      communicator);
  IsopointChoice choice =
      chooseIsopoints(view, edges, parameters, threads, isopoints, report);
  if (gaps)
    gaps->judge(parameters, threads, isopoints, edges, choice, report);
  const SupportedIsopoints supported(
      view, parameters.isosurface, sampling, gaps ? &gaps->getSummary() : nullptr);
  const DroppedIsopoints dropped = dropIsopoints(isopoints,
                                                 edges,
                                                 choice,
                                                 parameters,
                                                 supported,
                                                 removes_unlocated,
                                                 communicator,
                                                 threads,
                                                 report);
  if (!parameters.mesh) // which has counted vertices that are not on caps
    countSupports(isopoints,
                  withErrors(parameters).interpolation != Interpolation::Linear,
                  report);
  const SupportCounts of_tally = findSupportCounts(found.tally);
  const SupportCounts own =
      of_tally.examined > 0 ? of_tally
                            : findSupportCounts(isopoints,
                                                edges,
                                                choice,
                                                found.is_on_cap,
                                                PeriodicBox{{}, sidesOf(parameters)});
  warnOfWeakSupport(addTogether(own, communicator), role, parameters, sampling, report);
  if (role == SurfaceRole::Isosurface)
    warnOfLosses(
        parameters, found.tally, dropped, isopoints.size(), communicator, report);
  report.setCount("isopoints", isopoints.size());
  IsosurfaceResult result;
  result.isopoints = countPerIsovalue(isopoints, parameters.isosurface.isovalues);
  result.surface.origin = samples.origin;
  result.surface.double_coordinates = samples.double_coordinates;
  result.surface.labels = samples.labels;
  {
    const StepTimer timer(report, "fields");
    pcl::toPCLPointCloud2(isopoints, result.surface.cloud);
    result.surface.cloud.header.frame_id = samples.cloud.header.frame_id;
    keepIsovalues(isopoints, parameters.isosurface.isovalues, result.surface, report);
    choice.addFields(parameters.isosurface.interpolation == Interpolation::Auto,
                     result.surface);
    warnOfReplacedFields(view.fields, result.surface.cloud.fields, report);
    const auto& fields = result.surface.cloud.fields;
    const auto own_fields = static_cast<std::size_t>(
        std::count_if(fields.begin(), fields.end(), [](const auto& field) {
          return !isPadding(field);
        }));
    interpolateFields(view, edges, result.surface.cloud, threads);
    if (parameters.mesh)
      putIsovalues(found,
                   parameters.isosurface.field,
                   parameters.isosurface.isovalues,
                   own_fields,
                   result.surface.cloud);
  }
  result.edges = std::move(edges);
  result.sampling = sampling;
  result.field = parameters.isosurface.field;
  result.interpolation = parameters.isosurface.interpolation;
  result.scale = parameters.isosurface.scale;
  result.errors = summarizeErrors(isopoints);
  if (parameters.mesh)
    addMesh(std::move(found), result);
  result.report = std::move(report);
  return result;
}

} // namespace pcl_uvol
