// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/level_set_job.h"

#include "common/memory.h"
#include "common/records.h"
#include "common/sample_checks.h"
#include "common/stretch_axes.h"
#include "levelset/level_set_input.h"
#include "neighbors/samples_in_box.h"
#include "pipeline/memory_need.h"
#include "pipeline/periodic_surface.h"
#include "pipeline/weak_support.h"
#include "pipeline/zero_level.h"
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <utility>

namespace pcl_uvol {

void
checkRequest(const LevelSetRequest& request)
{
  if (isPeriodic(request.periodic) &&
      detail::StretchAxes(request.level_set.rotation).areTurned())
    throw InvalidArgument("turned_periodic_box", {});
}

SmoothedSamples
runLevelSet(const std::shared_ptr<const Dataset>& samples,
            const pcl::IndicesPtr& use,
            const LevelSetRequest& request,
            const SurfaceCallback& show_surface,
            unsigned threads,
            const ProgressCallback& progress)
{
  checkRequest(request);
  const std::size_t points = countPoints({samples, use, {}});
  checkMemoryOf("A level set",
                points,
                levelSetJobBytes(static_cast<double>(points),
                                 static_cast<double>(samples->cloud.point_step),
                                 request));
  SmoothedSamples result;
  result.report.progress = progress;
  LevelSetParameters& taken = result.taken;
  taken = request.level_set;
  taken.field = chooseField(*samples, taken.field);
  refuseNames(*samples, taken.initial.field_name);
  if (request.automatic_scale) {
    result.scale_choice = chooseScale(viewOf(samples->cloud),
                                      listPoints({samples, use, {}}),
                                      taken.field,
                                      taken.rotation,
                                      threads,
                                      result.report);
    taken.scale = result.scale_choice->scale;
  }

  std::shared_ptr<const Dataset> input = samples;
  SamplesInBox boxed(input, request.periodic, taken.scale, threads, result.report);
  if (boxed.isPeriodic())
    result.box = toSampleBox(boxed.getBox(), samples->origin);
  LevelSetParameters parameters = taken;
  parameters.initial = moveShape(taken.initial, Eigen::Array3d(input->origin.data()));

  LevelSetEvolution<pcl::PCLPointCloud2> evolution;
  evolution.setInputCloud({input, &input->cloud});
  evolution.setIndices(use);
  evolution.setParameters(parameters);
  evolution.setExamined(true);
  evolution.setNumberOfThreads(threads);
  evolution.setProgressCallback(progress);
  const Eigen::Array3d sides(request.periodic.data());
  evolution.setSnapshotCallback(
      request.snapshots,
      [&](const LevelSetSummary& so_far, const std::vector<float>& phi) {
        show_surface(so_far.steps.size(),
                     extractSnapshot(*input, parameters, sides, phi, threads));
      });
  result.samples = withoutCloud(*input);
  evolution.evolve(result.samples.cloud);
  boxed.dropImages(result.samples);
  result.report.merge(evolution.getReport());
  result.summary = evolution.getSummary();
  result.sampling = *evolution.getSampling();
  if (!result.box) // most of what is examined there may be images
    if (const auto warning =
            describeWeakSupport(findSupportCounts(evolution.getTally()),
                                result.sampling,
                                {"unconstrained_level_set", {}}))
      result.report.warn({*warning});
  result.report.progress = nullptr; // which is the caller's
  return result;
}

} // namespace pcl_uvol
