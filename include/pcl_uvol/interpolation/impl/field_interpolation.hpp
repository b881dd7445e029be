// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/interpolation/field_interpolation.h>

#include <pcl/impl/pcl_base.hpp>

namespace pcl_uvol {

template <typename PointT>
void
FieldInterpolation<PointT>::interpolateAt(
    const std::vector<std::array<double, 3>>& queries, InterpolatedFields& result)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("FieldInterpolation has no input cloud: call setInputCloud.");
  startReport();
  if (!interpolator_ || cloud_ != this->input_ || used_ != *this->indices_ ||
      made_for_ != parameters_) {
    interpolator_.reset();
    Report made;
    made.progress = report_.progress;
    interpolator_ = std::make_unique<detail::FieldInterpolator>(
        viewOf(*this->input_), *this->indices_, parameters_, threads_, made);
    cloud_ = this->input_;
    used_ = *this->indices_;
    made_for_ = parameters_;
    report_.merge(made);
    made_ = made;
    made_.milliseconds.clear();
  }
  else
    report_.merge(made_);
  result = interpolator_->interpolate(queries, threads_, report_);
  this->deinitCompute();
}

} // namespace pcl_uvol
