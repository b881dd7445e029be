// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracing/scene_cloud.h"

#include "common/printable.h"
#include "render/point_colors.h"
#include "surface/splat_input.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>

#include <pcl/memory.h>

#include <utility>

namespace pcl_uvol {

namespace {

Eigen::AlignedBox3d
findBox(const CloudView& view)
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < view.count; ++i) {
    const Eigen::Vector3f point = Eigen::Map<const Eigen::Vector3f>(view.xyz(i));
    if (point.allFinite())
      box.extend(point.cast<double>());
  }
  return box;
}

} // namespace

SceneCloud
coverCloud(const Dataset& dataset,
           const CloudLook& look,
           unsigned threads,
           Report& report)
{
  Report own; // its warnings get the name of the cloud
  own.progress = report.progress;
  own.warnings = dataset.notes;
  const CloudView view = viewOf(dataset.cloud);
  Splats splats = findSplats(view, look.parameters, look.has_parameters, threads, own);
  if (splats.cloud.empty())
    throw InvalidArgument("cloud_without_usable_splats",
                          {{"cloud", shortenText(look.name)}});
  for (Message& warning : own.warnings) {
    warning.about = look.name;
    report.warnings.push_back(warning); // each time: reports count equal ones
  }
  own.warnings.clear();
  report.merge(own);
  SceneCloud cloud;
  cloud.splats = pcl::make_shared<pcl::PointCloud<PointSplat>>(std::move(splats.cloud));
  cloud.sources = std::move(splats.sources);
  cloud.rims = std::move(splats.rims);
  cloud.two_sided = splats.two_sided;
  cloud.box = findBox(view);
  cloud.origin = Eigen::Map<const Eigen::Vector3d>(dataset.origin.data());
  return cloud;
}

void
colorCloud(const Dataset& dataset, const CloudLook& look, SceneCloud& cloud)
{
  const CloudView view = viewOf(dataset.cloud);
  if (look.color_field.empty() && !hasColors(view))
    return;
  const std::string field = look.color_field.empty() ? "rgb" : look.color_field;
  const PointColors points =
      colorPoints(view, field, {look.color_map, look.color_range, false});
  for (const std::uint32_t source : cloud.sources)
    cloud.colors.push_back(points.colors[source]);
}

Eigen::Vector3d
findSceneOrigin(const std::vector<CloudLook>& looks,
                const std::vector<SceneCloud>& clouds)
{
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const CloudPlacement& placement = looks[i].placement;
    if (placement.fit_size > 0.0)
      continue;
    if (clouds[i].origin.isZero(0.0))
      break;
    return placement.turn * (placement.scale * clouds[i].origin) + placement.at;
  }
  return Eigen::Vector3d::Zero();
}

void
placeCloud(const CloudLook& look,
           const Eigen::Vector3d& scene_origin,
           SceneCloud& cloud)
{
  const CloudPlacement& placement = look.placement;
  double scale = placement.scale;
  Eigen::Vector3d from = cloud.origin;
  if (placement.fit_size > 0.0) {
    const double side = cloud.box.sizes().maxCoeff();
    if (!(side > 0.0))
      throw InvalidArgument("cloud_without_extent",
                            {{"cloud", shortenText(look.name)}});
    scale = placement.fit_size / side;
    from = -cloud.box.center();
  }
  const Eigen::Vector3d shift =
      placement.turn * (scale * from) + (placement.at - scene_origin);
  // Splats turn and grow as a whole: normals in their coordinates stay what they are.
  const auto turned = [&](const auto& vector) -> Eigen::Vector3f {
    return (placement.turn * vector.template cast<double>()).template cast<float>();
  };
  for (PointSplat& splat : *cloud.splats) {
    const Eigen::Vector3d center = splat.getVector3fMap().cast<double>();
    splat.getVector3fMap() = (placement.turn * (scale * center) + shift).cast<float>();
    splat.getNormalVector3fMap() = turned(splat.getNormalVector3fMap());
    splat.getTangentVector3fMap() = turned(splat.getTangentVector3fMap());
    splat.radius = static_cast<float>(scale * splat.radius);
    splat.error = static_cast<float>(scale * splat.error);
    if (!isDrawable(splat))
      throw InvalidArgument("splat_beyond_float", {{"cloud", shortenText(look.name)}});
  }
}

} // namespace pcl_uvol
