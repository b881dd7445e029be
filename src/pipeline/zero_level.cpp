// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/zero_level.h"

#include "levelset/phi_cloud.h"
#include "pipeline/extract_points.h"
#include "pipeline/finish_isosurface.h"
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

/** Error over standard deviation: it covers 95 % of the deviations where these are
 * normal and the estimate is a tenth too small. Deviations of neighbours are alike
 * after smoothing, so that chance may make most of a small surface's larger than usual.
 */
constexpr float deviation_factor = 2.2f;

/** Errors of fits to phi become errors of the surface.
 * \param deviations by sample; empty: not known
 * \param scale of the space that these are lengths of */
void
addDeviations(const std::vector<float>& deviations,
              const IsoEdges& edges,
              const Eigen::Array3f& scale,
              pcl::PointCloud<PointIso>& isopoints)
{
  for (std::size_t i = 0; i < isopoints.size(); ++i) {
    PointIso& point = isopoints[i];
    if (deviations.empty()) {
      point.error = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    // The deviation of an end far from the surface is not known: fmax takes the other
    // one.
    const float deviation =
        std::fmax(deviations[edges[i].first], deviations[edges[i].second]);
    if (!(deviation > 0.0f))
      continue;
    // Across the surface, a length of the stretched space is as much in the original
    // one.
    const float across = (point.getNormalVector3fMap().array() / scale).matrix().norm();
    point.error = std::hypot(point.error, deviation_factor * deviation * across);
  }
}

} // namespace

SurfaceTriangles
extractZeroLevel(const CloudView& samples,
                 const std::vector<float>& phi,
                 const std::vector<float>& deviations,
                 const IsosurfaceParameters& parameters,
                 const std::optional<MeshingParameters>& mesh,
                 unsigned threads,
                 Report& report)
{
  const auto cloud = makePhiCloud(samples, phi);
  IsosurfaceParameters of_phi = parameters;
  of_phi.field = "phi";
  of_phi.isovalues = {0.0};
  SurfaceTriangles found;
  if (mesh) {
    const CloudView view = viewOf(cloud);
    pcl::Indices all(view.count);
    std::iota(all.begin(), all.end(), 0);
    found = detail::makeSurfaceMesh(
        view, all, {of_phi, *mesh}, parameters.isovalues, threads, report);
  }
  else {
    IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
    extraction.setInputCloud(pcl::PCLPointCloud2::ConstPtr(&cloud, [](const void*) {}));
    found = extractPoints(extraction, of_phi, threads, report);
    for (PointIso& point : found.vertices)
      point.isovalue = static_cast<float>(parameters.isovalues.front());
  }
  addDeviations(deviations, found.edges, parameters.scale, found.vertices);
  return found;
}

Dataset
extractSnapshot(const Dataset& samples,
                const LevelSetParameters& parameters,
                const Eigen::Array3d& periodic,
                const std::vector<float>& phi,
                unsigned threads)
{
  IsosurfacePipelineParameters how;
  how.periodic = periodic;
  how.isosurface.isovalues = {parameters.isovalue};
  how.isosurface.scale = parameters.scale;
  how.isosurface.interpolation = Interpolation::Fit; // the level set fills gaps
  how.normals = NormalMethod::Fit;
  Report report;
  SurfaceTriangles found = extractZeroLevel(
      viewOf(samples.cloud), phi, {}, how.isosurface, std::nullopt, threads, report);
  SelfCommunicator alone;
  Dataset surface = finishIsosurface(samples,
                                     std::move(found),
                                     how,
                                     std::nullopt,
                                     alone,
                                     threads,
                                     std::move(report))
                        .surface;
  setGlobeFields(surface);
  return surface;
}

} // namespace pcl_uvol
