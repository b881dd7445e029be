// SPDX-License-Identifier: BSD-3-Clause
#include "common/records.h"
#include "common/sample_checks.h"
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "distributed/fetch_points.h"
#include "isosurface/edge_ends.h"
#include "pipeline/extract_from_ranks.h"
#include "pipeline/isopoint_choice.h"
#include "pipeline/isosurface_run.h"
#include "pipeline/part_in_box.h"
#include "pipeline/periodic_surface.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <memory>
#include <optional>
#include <utility>

namespace pcl_uvol {

namespace {

/** Refuses what needs samples of other processes. */
void
checkDistributed(const IsosurfacePipelineParameters& parameters)
{
  if (parameters.takesAutomaticScale())
    throw InvalidArgument("distributed_scale", {});
  if (detail::StretchAxes(parameters.rotation).areTurned())
    throw InvalidArgument("distributed_rotation", {});
  if (parameters.mesh)
    throw InvalidArgument("distributed_mesh", {});
  if (parameters.smooth)
    throw InvalidArgument("distributed_level_set", {});
  if (parameters.fill_gaps)
    throw InvalidArgument("distributed_gaps", {});
  if (parameters.outside_value)
    throw InvalidArgument("distributed_value_outside", {});
  if (parameters.validation.folds > 0)
    throw InvalidArgument("distributed_hold_out", {});
  if (parameters.normals != NormalMethod::Auto &&
      parameters.normals != NormalMethod::Edge)
    throw InvalidArgument("distributed_normals", {});
}

/** The samples of this process and, of those of others, the ones at edges of its part
 * of the surface. */
class SamplesOnRanks : public SampleStore {
public:
  /** \param is_gathered whether the first process gets the whole surface */
  SamplesOnRanks(const std::shared_ptr<const Dataset>& part,
                 Communicator& communicator,
                 bool is_gathered,
                 unsigned threads)
      : given_(part)
      , communicator_(communicator)
      , is_gathered_(is_gathered)
      , threads_(threads)
  {
  }

  void
  enter(IsosurfacePipelineParameters& parameters, Report& report) override
  {
    checkDistributed(parameters);
    parameters.normals = NormalMethod::Edge; // of isopoints that have none yet
    std::string& field = parameters.isosurface.field;
    field = chooseField(*given_, field);
    warnOfUnusedBox(*given_, sidesOf(parameters), report);
    // Isopoints around one may belong to other processes: none is put back to its edge,
    // and the extraction leaves out contradicted ones.
    interpolation_ = parameters.isosurface.interpolation;
    if (interpolation_ == Interpolation::Auto)
      parameters.isosurface.interpolation = Interpolation::Fit;
    part_.emplace(given_, parameters, communicator_, threads_, report);
  }

  ExtractedSurface
  extract(const IsosurfacePipelineParameters& parameters, Report& report) override
  {
    const Dataset& points = part_->getPoints();
    const CloudView view = viewOf(points.cloud);
    const ScalarField field(view.fields, parameters.isosurface.field);
    const ValueFrame frame = findValueFrame(view, field, communicator_, threads_);
    IsosurfaceParameters extraction = withErrors(parameters);
    if (interpolation_ == Interpolation::Auto)
      extraction.interpolation = Interpolation::Auto;
    RankIsosurface found =
        extractFromRanks(part_->readSamples(field, frame, threads_, report),
                         extraction,
                         frame,
                         communicator_,
                         threads_,
                         report);
    read_ = found.samples;
    warnOfConflicts(read_, communicator_, report);
    if (is_gathered_)
      found.isopoints =
          gatherIsopoints(std::move(found.isopoints), communicator_, threads_);
    part_->numberByPoints(found.isopoints);
    EdgeEnds ends = findEdgeEnds(found.isopoints);
    ExtractedSurface surface;
    surface.sampling = read_.sampling;
    surface.triangles.tally = found.tally;
    surface.triangles.edges = std::move(ends.edges);
    for (std::size_t i = 0; i < found.isopoints.size(); ++i)
      for (const GlobalIsopoint& isopoint : found.isopoints[i])
        surface.triangles.vertices.push_back(
            toPointIso(isopoint, parameters.isosurface.isovalues[i]));
    const auto samples = std::make_shared<Dataset>(withoutCloud(points));
    samples->cloud = fetchPoints(
        points.cloud, part_->getFirstPoint(), ends.points, communicator_, report);
    samples->cloud.header = points.cloud.header;
    surface.samples = samples;
    return surface;
  }

  Communicator&
  getCommunicator() override
  {
    return communicator_;
  }

  bool
  removesUnlocated(const IsosurfacePipelineParameters&) const override
  {
    return interpolation_ == Interpolation::Auto;
  }

  void
  leave(const IsosurfacePipelineParameters&, IsosurfaceResult& result) override
  {
    part_->finish(read_, communicator_, result);
  }

private:
  const std::shared_ptr<const Dataset>& given_;
  Communicator& communicator_;
  bool is_gathered_;
  unsigned threads_;
  std::optional<PartInBox> part_;
  StageSamples read_;
  Interpolation interpolation_ = Interpolation::Auto; ///< as asked for
};

} // namespace

IsosurfaceResult
DistributedIsosurfacePipeline::run()
{
  if (!part_)
    throw InvalidArgument("distributed_without_input", {});
  startReport();
  SamplesOnRanks samples(part_, communicator_, is_gathered_, threads_);
  IsosurfaceResult result =
      runIsosurface(samples, parameters_, threads_, std::move(report_));
  report_ = result.report;
  return result;
}

} // namespace pcl_uvol
