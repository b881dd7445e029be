// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

namespace pcl_uvol {

template <typename PointT>
void
LevelSetEvolution<PointT>::evolve(std::vector<float>& phi)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("LevelSetEvolution has no input cloud: call setInputCloud.");
  report_ = Report();
  report_.progress = progress_;
  summary_ = LevelSetSummary();
  phi = evolveLevelSet(viewOf(*this->input_),
                       *this->indices_,
                       field_,
                       isovalue_,
                       parameters_,
                       snapshot_,
                       snapshot_steps_,
                       summary_,
                       report_);
  this->deinitCompute();
}

} // namespace pcl_uvol
