// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracing/gap_dots.h"

#include "render/point_colors.h"
#include "surface/oriented_points.h"

namespace pcl_uvol {

void
addWithDots(SplatObject&& object,
            const CloudView& cloud,
            const std::vector<std::uint32_t>& sources,
            int side,
            Scene& scene)
{
  const std::vector<std::uint8_t> bridged = findBridged(cloud);
  if (bridged.empty()) {
    scene.splats.push_back(std::move(object));
    return;
  }
  constexpr float usual_side = 1000.0f; // of the picture that the dots are made for
  const float growth = usual_side / static_cast<float>(side);
  pcl::PointCloud<PointSplat> covering, small;
  SplatObject surface, dots;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Rgba color =
        object.colors.empty() ? toRgba(object.material.color) : object.colors[i];
    const bool is_dot = bridged[sources[i]] != 0;
    (is_dot ? small : covering).push_back((*object.splats)[i]);
    (is_dot ? dots : surface)
        .colors.push_back(is_dot ? makePaler(color, scene.background.color) : color);
    if (!is_dot && !object.rims.empty())
      surface.rims.push_back(object.rims[i]);
    if (is_dot)
      small.back().radius *= growth;
  }
  surface.material = object.material;
  dots.material.ambient = 1.0;
  dots.material.diffuse = dots.material.specular = 0.0;
  surface.splats = pcl::make_shared<pcl::PointCloud<PointSplat>>(std::move(covering));
  dots.splats = pcl::make_shared<pcl::PointCloud<PointSplat>>(std::move(small));
  for (SplatObject* const part : {&surface, &dots}) {
    part->two_sided = object.two_sided;
    if (!part->splats->empty())
      scene.splats.push_back(std::move(*part));
  }
}

} // namespace pcl_uvol
