// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/surface/splat_generation.h>

#include <pcl/impl/pcl_base.hpp>

#include <utility>

namespace pcl_uvol {

template <typename PointT>
void
SplatGeneration<PointT>::compute(pcl::PointCloud<PointSplat>& splats)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("SplatGeneration has no input cloud: call setInputCloud.");
  startReport();
  const CloudView cloud = viewOf(*this->input_);
  detail::checkIndices(*this->indices_, cloud.count, "SplatGeneration");
  const std::vector<std::uint32_t> use(this->indices_->begin(), this->indices_->end());
  Splats generated = detail::generateSplats(cloud, use, parameters_, threads_, report_);
  splats = std::move(generated.cloud);
  splats.header = this->input_->header;
  sources_ = std::move(generated.sources);
  this->deinitCompute();
}

} // namespace pcl_uvol
