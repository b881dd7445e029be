// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/impl/pcl_base.hpp>

namespace pcl_uvol {

template <typename PointT>
template <typename OutputT>
void
IsosurfaceExtraction<PointT>::extractAs(OutputT& isopoints)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument(
        "IsosurfaceExtraction has no input cloud: call setInputCloud.");
  if (this->input_ != extracted_)
    forgetSamples();
  extracted_ = this->input_;
  extractFrom(viewOf(*this->input_), *this->indices_, isopoints);
  isopoints.header = this->input_->header;
  this->deinitCompute();
}

template <typename PointT>
void
IsosurfaceExtraction<PointT>::extract(pcl::PointCloud<PointIso>& isopoints)
{
  extractAs(isopoints);
}

template <typename PointT>
void
IsosurfaceExtraction<PointT>::extract(pcl::PCLPointCloud2& isopoints)
{
  extractAs(isopoints);
}

} // namespace pcl_uvol
