// SPDX-License-Identifier: BSD-3-Clause
#include "scene_cloud.h"

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/printable.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/render/point_colors.h>

#include <Eigen/Geometry>
#include <pcl/memory.h>

#include <cmath>

namespace pcl_uvol {
namespace io {
namespace {

/** Splats as the file has them, and where they are. */
struct CoveredCloud {
  pcl::PointCloud<PointSplat>::Ptr splats;
  std::vector<Rgba> colors;
  Eigen::AlignedBox3d box; ///< of the finite points
  Eigen::Vector3d origin;  ///< of their coordinates
};

Dataset
readPoints(const CloudItem& item, Report& report)
{
  const StepTimer step(report, "read");
  return callAt(item.place, [&] { return loadDataset(item.path); });
}

Splats
coverPoints(const CloudItem& item,
            const CloudView& view,
            unsigned threads,
            Report& report)
{
  Splats splats = callAt(item.place, [&] {
    return findSplats(view, item.parameters, item.has_parameters, threads, report);
  });
  if (splats.cloud.empty())
    throwAt(item.place, "none of the splats in " + quoteText(item.name) + " is usable");
  return splats;
}

std::vector<Rgba>
colorSplats(const CloudItem& item,
            const CloudView& view,
            const std::vector<std::uint32_t>& sources)
{
  if (item.color_field.empty() && !hasColors(view))
    return {};
  const std::string field = item.color_field.empty() ? "rgb" : item.color_field;
  const PointColors points = callAt(item.color_place, [&] {
    return colorPoints(view, field, item.color_map, item.color_range);
  });
  std::vector<Rgba> colors;
  colors.reserve(sources.size());
  for (const std::uint32_t source : sources)
    colors.push_back(points.colors[source]);
  return colors;
}

Eigen::AlignedBox3d
boxOf(const CloudView& view)
{
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < view.count; ++i) {
    const Eigen::Vector3f point = Eigen::Map<const Eigen::Vector3f>(view.xyz(i));
    if (point.allFinite())
      box.extend(point.cast<double>());
  }
  return box;
}

CoveredCloud
coverCloud(const CloudItem& item, unsigned threads, Report& report)
{
  const Dataset dataset = readPoints(item, report);
  Report own; // its warnings get the name of the file
  own.progress = report.progress;
  own.warnings = dataset.notes;
  const CloudView view = callAt(item.place, [&] { return viewOf(dataset.cloud); });
  Splats splats = coverPoints(item, view, threads, own);
  for (std::string& warning : own.warnings)
    warning.insert(0, item.name + ": ");
  report.merge(own);
  CoveredCloud cloud;
  cloud.colors = colorSplats(item, view, splats.sources);
  cloud.splats = pcl::make_shared<pcl::PointCloud<PointSplat>>(std::move(splats.cloud));
  cloud.box = boxOf(view);
  cloud.origin = Eigen::Map<const Eigen::Vector3d>(dataset.origin.data());
  return cloud;
}

Eigen::Vector3d
sceneOrigin(const std::vector<CloudItem>& items,
            const std::vector<CoveredCloud>& clouds)
{
  for (std::size_t i = 0; i < items.size(); ++i) {
    const CloudPlacement& placement = items[i].placement;
    if (placement.fit_size > 0.0)
      continue;
    if (clouds[i].origin.isZero(0.0))
      break;
    return placement.turn * (placement.scale * clouds[i].origin) + placement.at;
  }
  return Eigen::Vector3d::Zero();
}

/** Splats turn and grow as a whole: normals in their coordinates stay what they are. */
void
placeSplats(const CloudItem& item,
            const Eigen::Vector3d& scene_origin,
            CoveredCloud& cloud)
{
  const CloudPlacement& placement = item.placement;
  double scale = placement.scale;
  Eigen::Vector3d from = cloud.origin;
  if (placement.fit_size > 0.0) {
    const double side = cloud.box.sizes().maxCoeff();
    if (!(side > 0.0))
      throwAt(item.place,
              "all points of " + quoteText(item.name) +
                  " lie at one place, which cannot be fitted to a size");
    scale = placement.fit_size / side;
    from = -cloud.box.center();
  }
  const Eigen::Vector3d shift =
      placement.turn * (scale * from) + (placement.at - scene_origin);
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
      throwAt(
          item.place,
          "a splat of " + quoteText(item.name) +
              " becomes larger or smaller than float can hold, or goes beyond 1e18");
  }
}

} // namespace

std::array<double, 3>
addClouds(const std::vector<CloudItem>& clouds,
          unsigned threads,
          Report& report,
          Scene& scene)
{
  std::vector<CoveredCloud> covered;
  for (const CloudItem& item : clouds)
    covered.push_back(coverCloud(item, threads, report));
  const Eigen::Vector3d origin = sceneOrigin(clouds, covered);
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    placeSplats(clouds[i], origin, covered[i]);
    scene.splats.push_back(
        {covered[i].splats, std::move(covered[i].colors), clouds[i].material});
  }
  return {origin.x(), origin.y(), origin.z()};
}

} // namespace io
} // namespace pcl_uvol
