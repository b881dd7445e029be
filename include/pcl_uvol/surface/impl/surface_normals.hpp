// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/surface/surface_normals.h>

#include <pcl/impl/pcl_base.hpp>

namespace pcl_uvol {

template <typename PointInT, typename PointOutT>
void
SurfaceNormalEstimation<PointInT, PointOutT>::compute(
    pcl::PointCloud<PointOutT>& output)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument(
        "SurfaceNormalEstimation has no input cloud: call setInputCloud.");
  startReport();
  const CloudView cloud = viewOf(*this->input_);
  detail::checkIndices(*this->indices_, cloud.count, "SurfaceNormalEstimation");
  const std::vector<std::uint32_t> use(this->indices_->begin(), this->indices_->end());
  const auto normals = detail::estimateSurfaceNormals(
      cloud, use, parameters_, search_, threads_, report_);
  output.resize(normals.size());
  const bool organized =
      normals.size() == std::size_t(this->input_->width) * this->input_->height;
  output.width =
      organized ? this->input_->width : static_cast<std::uint32_t>(normals.size());
  output.height = organized ? this->input_->height : 1;
  output.header = this->input_->header;
  output.is_dense = report_.getCount("non_finite") == 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    output[i].normal_x = normals[i].normal[0];
    output[i].normal_y = normals[i].normal[1];
    output[i].normal_z = normals[i].normal[2];
    output[i].curvature = normals[i].curvature;
  }
  this->deinitCompute();
}

} // namespace pcl_uvol
