// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

namespace pcl_uvol {

template <typename PointT>
void
IsosurfaceExtraction<PointT>::extract(pcl::PointCloud<PointIso>& isopoints)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument(
        "IsosurfaceExtraction has no input cloud: call setInputCloud.");
  extractFrom(viewOf(*this->input_), *this->indices_, isopoints);
  isopoints.header = this->input_->header;
  this->deinitCompute();
}

} // namespace pcl_uvol
