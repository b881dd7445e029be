// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracing/fitted_splats.h"

#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <cmath>
#include <cstddef>
#include <limits>

namespace pcl_uvol {

FittedSplats::FittedSplats(const Splats& splats,
                           const pcl::PCLPointCloud2& cloud,
                           unsigned threads)
    : cloud_(cloud)
    , threads_(threads)
    , discs_(std::size_t{cloud.width} * cloud.height,
             {std::numeric_limits<float>::quiet_NaN(), {}})
{
  for (std::size_t i = 0; i < splats.sources.size(); ++i) {
    const PointSplat& splat = splats.cloud[i];
    discs_[splats.sources[i]] = {splat.radius,
                                 {splat.normal_x, splat.normal_y, splat.normal_z}};
  }
}

FittedSplats::~FittedSplats() = default;

std::vector<FittedDisc>
FittedSplats::find(const Camera& camera, int width, int height)
{
  if (!prepared_)
    prepared_ = std::make_unique<PreparedSurface>(cloud_, threads_);
  std::vector<FittedDisc> discs = discs_;
  const auto& seen = prepared_->findFittedDiscs(camera, width, height);
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (std::isnan(seen[i].radius))
      discs[i].radius = seen[i].radius;
  return discs;
}

} // namespace pcl_uvol
