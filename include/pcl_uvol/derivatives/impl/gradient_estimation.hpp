// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/derivatives/gradient_estimation.h>

#include <pcl/impl/pcl_base.hpp>

namespace pcl_uvol {

template <typename PointInT, typename PointOutT>
void
GradientEstimation<PointInT, PointOutT>::compute(pcl::PointCloud<PointOutT>& output)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("GradientEstimation has no input cloud: call setInputCloud.");
  startReport();
  const auto gradients = detail::estimateGradients(
      viewOf(*this->input_), *this->indices_, parameters_, search_, threads_, report_);
  output.resize(gradients.size());
  const bool organized = gradients.size() == this->input_->size();
  output.width =
      organized ? this->input_->width : static_cast<std::uint32_t>(gradients.size());
  output.height = organized ? this->input_->height : 1;
  output.header = this->input_->header;
  output.is_dense = report_.getCount("non_finite") == 0 &&
                    report_.getCount("no_value") == 0 &&
                    report_.getCount("samples") > 1;
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    output[i].gradient_x = gradients[i].gradient_x;
    output[i].gradient_y = gradients[i].gradient_y;
    output[i].gradient_z = gradients[i].gradient_z;
    if constexpr (pcl::traits::has_field<PointOutT, pcl::fields::mean_curvature>::value)
      output[i].mean_curvature = gradients[i].mean_curvature;
  }
  this->deinitCompute();
}

} // namespace pcl_uvol
