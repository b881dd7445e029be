// SPDX-License-Identifier: BSD-3-Clause
#include "common/large_array.h"
#include "common/records.h"
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "isosurface/iso_edges.h"
#include "levelset/level_set_input.h"
#include "neighbors/periodic_box.h"
#include "neighbors/sampling.h"
#include "pipeline/finish_isosurface.h"
#include "pipeline/gap_filling.h"
#include "pipeline/guessed_isopoints.h"
#include "pipeline/hold_out.h"
#include "pipeline/isopoint_choice.h"
#include "pipeline/isopoint_filter.h"
#include "pipeline/periodic_surface.h"
#include "pipeline/zero_level.h"
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

/** The cloud of a data set, which keeps the data set alive. */
pcl::PCLPointCloud2::ConstPtr
shareCloud(const std::shared_ptr<const Dataset>& samples)
{
  return {samples, &samples->cloud};
}

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

} // namespace

void
IsosurfacePipeline::setInput(const std::shared_ptr<const Dataset>& samples)
{
  samples_ = samples;
  extraction_.setInputCloud(samples ? shareCloud(samples) : nullptr);
}

void
IsosurfacePipeline::setIndices(const pcl::IndicesPtr& indices)
{
  indices_ = indices;
  extraction_.setIndices(indices);
}

IsosurfaceParameters
IsosurfacePipeline::resolveParameters(std::optional<ScaleChoice>* choice) const
{
  if (!samples_)
    throw InvalidArgument("IsosurfacePipeline has no input: call setInput.");
  IsosurfaceParameters parameters = parameters_.isosurface;
  if (parameters.field.empty())
    parameters.field = ScalarField::defaultName(listNumberFields(*samples_));
  if (!parameters_.automatic_scale)
    return parameters;
  Report own;
  const ScaleChoice found = chooseScale(viewOf(samples_->cloud),
                                        listPoints(),
                                        parameters.field,
                                        parameters_.rotation,
                                        threads_,
                                        own);
  parameters.scale = found.scale;
  if (choice)
    *choice = found;
  return parameters;
}

namespace {

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

/** Count isopoints again whose support an extraction has counted. */
void
countSupports(const pcl::PointCloud<PointIso>& isopoints, Report& report)
{
  for (const auto& [name, support] : {std::pair("bridged", IsoSupport::Bridged),
                                      std::pair("rim", IsoSupport::Rim),
                                      std::pair("predicted", IsoSupport::Predicted)}) {
    const auto is_so = [wanted = static_cast<std::uint8_t>(support)](
                           const PointIso& point) { return point.support == wanted; };
    const auto left = static_cast<std::uint64_t>(
        std::count_if(isopoints.begin(), isopoints.end(), is_so));
    if (left > 0 || report.getCount(name) > 0)
      report.setCount(name, left);
  }
}

/** See finishIsosurface.
 * \param found isopoints, or a mesh
 * \param gaps of the samples; null if they were not filled */
IsosurfaceResult
finish(const Dataset& samples,
       SurfaceTriangles& found,
       const IsosurfacePipelineParameters& parameters,
       const detail::FilledGaps* gaps,
       const std::optional<SamplingSummary>& sampling,
       Communicator& communicator,
       unsigned threads,
       Report&& report,
       SurfaceRole role)
{
  const CloudView view = viewOf(samples.cloud);
  pcl::PointCloud<PointIso>& isopoints = found.vertices;
  IsoEdges& edges = found.edges;
  IsopointChoice choice =
      chooseIsopoints(view, edges, parameters, threads, isopoints, report);
  if (gaps)
    gaps->judge(parameters, threads, isopoints, edges, choice, report);
  const KnownIsopoints known(
      view, parameters.isosurface, sampling, gaps ? &gaps->getSummary() : nullptr);
  dropIsopoints(isopoints, edges, choice, parameters, known, report);
  if (!parameters.mesh) // which has counted vertices that are not on caps
    countSupports(isopoints, report);
  const SurfaceGrounds examined = findGrounds(report);
  const SurfaceGrounds own = examined.known > 0
                                 ? examined
                                 : findGrounds(isopoints,
                                               edges,
                                               choice,
                                               found.is_on_cap,
                                               PeriodicBox{{}, sidesOf(parameters)});
  warnOfGuesses(addTogether(own, communicator), role, parameters, sampling, report);
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
  result.scale = parameters.isosurface.scale;
  result.errors = summarizeErrors(isopoints);
  result.report = std::move(report);
  return result;
}

} // namespace

IsosurfaceResult
finishIsosurface(const Dataset& samples,
                 pcl::PointCloud<PointIso>&& isopoints,
                 IsoEdges&& edges,
                 const IsosurfacePipelineParameters& parameters,
                 const std::optional<SamplingSummary>& sampling,
                 Communicator& communicator,
                 unsigned threads,
                 Report&& report,
                 SurfaceRole role)
{
  SurfaceTriangles found;
  found.vertices = std::move(isopoints);
  found.edges = std::move(edges);
  IsosurfaceResult result = finish(samples,
                                   found,
                                   parameters,
                                   nullptr,
                                   sampling,
                                   communicator,
                                   threads,
                                   std::move(report),
                                   role);
  setGlobeFields(result.surface);
  return result;
}

pcl::Indices
IsosurfacePipeline::listPoints() const
{
  if (indices_)
    return *indices_;
  pcl::Indices all;
  resizeLarge(all, samples_->cloud.width);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

IsosurfaceResult
IsosurfacePipeline::runOther(const std::shared_ptr<const Dataset>& samples,
                             const pcl::IndicesPtr& indices,
                             const IsosurfacePipelineParameters& parameters,
                             const detail::FilledGaps* gaps) const
{
  IsosurfacePipeline other;
  other.gaps_ = gaps;
  other.setInput(samples);
  other.setIndices(indices);
  other.setNumberOfThreads(threads_);
  other.setProgressCallback(report_.progress);
  other.setParameters(parameters);
  return other.run();
}

IsosurfaceResult
IsosurfacePipeline::runFilled(IsosurfacePipelineParameters parameters)
{
  parameters.automatic_scale = false; // it is filled in
  startReport();
  if (parameters.validation.folds > 0) // a field that is none fails early
    makeFolds(viewOf(samples_->cloud), parameters.validation, threads_);
  const detail::FilledGaps gaps(
      samples_, listPoints(), parameters.isosurface, threads_, report_);
  IsosurfacePipelineParameters of_result = parameters;
  of_result.validation = {};
  const auto taken = detail::takesLattice(of_result)
                         ? std::make_shared<pcl::Indices>(listPoints())
                         : gaps.getIndices();
  IsosurfaceResult result = runOther(gaps.getSamples(), taken, of_result, &gaps);
  report_.merge(result.report);
  result.report = std::move(report_);
  result.gaps = gaps.getSummary();
  if (parameters.validation.folds > 0) {
    result.validation = validate(parameters, result.report);
    warnOfScores(result.validation, parameters, result.sampling, result.report);
  }
  report_ = result.report;
  return result;
}

IsosurfaceResult
IsosurfacePipeline::runTurned()
{
  const detail::StretchAxes axes(parameters_.rotation);
  const auto turned = std::make_shared<Dataset>(*samples_);
  axes.turn(turned->cloud);
  IsosurfacePipelineParameters along_axes = parameters_;
  along_axes.rotation.setZero();
  along_axes.level_set.initial = turnShape(parameters_.level_set.initial, axes);
  IsosurfaceResult result = runOther(turned, indices_, along_axes, nullptr);
  axes.turnBack(result.surface.cloud);
  report_ = result.report;
  return result;
}

IsosurfaceResult
IsosurfacePipeline::run()
{
  checkParameters(parameters_);
  if (samples_ && detail::StretchAxes(parameters_.rotation).areTurned()) {
    IsosurfaceResult result = runTurned();
    setGlobeFields(result.surface);
    return result;
  }
  std::optional<ScaleChoice> choice;
  IsosurfacePipelineParameters parameters = parameters_;
  parameters.isosurface = resolveParameters(&choice);
  IsosurfaceResult result;
  if (parameters.fill_gaps && !gaps_)
    result = runFilled(parameters);
  else {
    startReport();
    result = isPeriodic(sidesOf(parameters)) ? runInBox(parameters)
                                             : runOnSamples(parameters);
  }
  result.scale_choice = choice;
  setGlobeFields(result.surface);
  return result;
}

IsosurfaceResult
IsosurfacePipeline::runOnSamples(const IsosurfacePipelineParameters& parameters)
{
  std::vector<LevelSetSummary> level_sets;
  if (parameters.validation.folds > 0) // a field that is none fails early
    makeFolds(viewOf(samples_->cloud), parameters.validation, threads_);
  const auto summarize = [&] {
    const StepTimer timer(report_, "sampling");
    if (!parameters.mesh)
      return summarizeSampling(*extraction_.getSamples(), threads_);
    // By a tree of its own, as that of a mesh has another order of samples.
    return summarizeSampling(viewOf(samples_->cloud),
                             listPoints(),
                             parameters.isosurface.field,
                             parameters.isosurface.scale,
                             Eigen::Array3d::Zero(),
                             threads_);
  };
  std::optional<SamplingSummary> sampling;
  if (parameters.mesh && !parameters.smooth && !gaps_)
    sampling = summarize(); // before the mesh takes the memory for it
  SurfaceTriangles found =
      parameters.smooth ? extractLevelSets(parameters.isosurface, level_sets, sampling)
                        : extract(withErrors(parameters), report_);
  if (gaps_)
    sampling = gaps_->getSampling();
  else if (!sampling)
    sampling = summarize();
  SelfCommunicator alone;
  IsosurfaceResult result = finish(*samples_,
                                   found,
                                   parameters,
                                   gaps_,
                                   sampling,
                                   alone,
                                   threads_,
                                   std::move(report_),
                                   SurfaceRole::Isosurface);
  warnOfLosses(parameters, result.surface.cloud.width, result.report);
  if (parameters.mesh) {
    setField(result.surface, "piece", found.piece_of);
    setField(result.surface,
             "cap",
             std::vector<std::int32_t>(found.is_on_cap.begin(), found.is_on_cap.end()));
    result.triangles = std::move(found.triangles);
    result.pieces = std::move(found.pieces);
    result.smallest_angle = found.smallest_angle;
  }
  result.level_sets = std::move(level_sets);
  if (parameters.validation.folds > 0) {
    result.validation = validate(parameters, result.report);
    warnOfScores(result.validation, parameters, result.sampling, result.report);
  }
  report_ = result.report;
  return result;
}

namespace {

/** Merge the report of a stage on samples that an earlier stage has told of. */
void
mergeLater(Report& report, Report stage)
{
  const auto is_of_samples = [](const auto& count) {
    const std::string& name = count.first;
    return name == "samples" || name == "no_value" || name == "non_finite" ||
           name == "duplicates" || name == "conflicting_duplicates";
  };
  stage.counts.erase(
      std::remove_if(stage.counts.begin(), stage.counts.end(), is_of_samples),
      stage.counts.end());
  stage.warnings.erase(std::remove_if(stage.warnings.begin(),
                                      stage.warnings.end(),
                                      [&](const Message& warning) {
                                        return std::count(report.warnings.begin(),
                                                          report.warnings.end(),
                                                          warning) > 0;
                                      }),
                       stage.warnings.end());
  report.merge(stage);
}

} // namespace

SurfaceTriangles
IsosurfacePipeline::extract(const IsosurfaceParameters& parameters, Report& report)
{
  if (parameters_.mesh)
    return detail::makeSurfaceMesh(viewOf(samples_->cloud),
                                   listPoints(),
                                   {parameters, *parameters_.mesh},
                                   parameters.isovalues,
                                   threads_,
                                   report);
  extraction_.setParameters(parameters);
  extraction_.setNumberOfThreads(threads_);
  extraction_.setProgressCallback(report.progress);
  SurfaceTriangles found;
  extraction_.extract(found.vertices);
  report.merge(extraction_.getReport());
  found.edges = extraction_.getEdges();
  return found;
}

SurfaceTriangles
IsosurfacePipeline::extractLevelSets(const IsosurfaceParameters& parameters,
                                     std::vector<LevelSetSummary>& summaries,
                                     std::optional<SamplingSummary>& sampling)
{
  LevelSetEvolution<pcl::PCLPointCloud2> evolution;
  evolution.setInputCloud(shareCloud(samples_));
  evolution.setIndices(indices_);
  evolution.setNumberOfThreads(threads_);
  evolution.setProgressCallback(report_.progress);
  evolution.setParameters(parameters_.level_set);
  evolution.setScalarField(parameters.field);
  evolution.setScale(parameters.scale);
  evolution.setOutside(parameters.outside);
  SurfaceTriangles all;
  bool is_first = true;
  const auto tell = [&](const Report& stage) {
    if (is_first)
      report_.merge(stage);
    else
      mergeLater(report_, stage);
    is_first = false;
  };
  for (const double isovalue : parameters.isovalues) {
    evolution.setIsoValue(isovalue);
    IsosurfaceParameters of_isovalue = parameters;
    of_isovalue.isovalues = {isovalue};
    summaries.emplace_back();
    summaries.back().smoothed = false;
    std::vector<float> phi;
    try {
      evolution.evolve(phi);
      summaries.back() = evolution.getSummary();
      sampling = evolution.getSampling();
      tell(evolution.getReport());
    }
    catch (const NoLevelSet&) {
      // Extraction says what is wrong with the isovalue, and goes on.
    }
    SurfaceTriangles found;
    Report zero_level;
    zero_level.progress = report_.progress;
    if (summaries.back().smoothed) {
      // Among points at one position edges name only the one that phi was made from.
      std::vector<float> of_sources(phi.size(),
                                    std::numeric_limits<float>::quiet_NaN());
      for (const std::uint32_t source : evolution.getSources())
        of_sources[source] = phi[source];
      const CloudView view = viewOf(samples_->cloud);
      if (parameters_.mesh)
        found = meshZeroLevel(view,
                              of_sources,
                              evolution.getDeviations(),
                              of_isovalue,
                              *parameters_.mesh,
                              threads_,
                              zero_level);
      else
        extractZeroLevel(view,
                         of_sources,
                         evolution.getDeviations(),
                         of_isovalue,
                         threads_,
                         found.vertices,
                         found.edges,
                         zero_level);
    }
    else
      found = extract(of_isovalue, zero_level);
    tell(zero_level);
    all.append(found);
  }
  return all;
}

std::vector<ValidationScore>
IsosurfacePipeline::validate(const IsosurfacePipelineParameters& parameters,
                             Report& report) const
{
  const CloudView cloud = viewOf(samples_->cloud);
  const Folds folds = makeFolds(cloud, parameters.validation, threads_);
  std::vector<ValidationScore> scores;
  for (const auto& of_isovalue :
       holdOut(samples_, listPoints(), parameters, folds, threads_, report))
    scores.push_back(scoreHeldOut(of_isovalue));
  return scores;
}

} // namespace pcl_uvol
