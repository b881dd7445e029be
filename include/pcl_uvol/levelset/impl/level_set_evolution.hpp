// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/levelset/level_set_evolution.h>

#include <pcl/impl/pcl_base.hpp>

#include <utility>

namespace pcl_uvol {

template <typename PointT>
LevelSet
LevelSetEvolution<PointT>::evolveInput()
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("LevelSetEvolution has no input cloud: call setInputCloud.");
  startReport();
  summary_ = LevelSetSummary();
  LevelSet level_set = detail::evolveLevelSet(viewOf(*this->input_),
                                              *this->indices_,
                                              parameters_,
                                              snapshot_steps_,
                                              snapshot_,
                                              threads_,
                                              report_);
  summary_ = level_set.summary;
  sources_ = level_set.sources;
  return level_set;
}

template <typename PointT>
void
LevelSetEvolution<PointT>::evolve(std::vector<float>& phi)
{
  phi = evolveInput().phi;
  this->deinitCompute();
}

template <typename PointT>
void
LevelSetEvolution<PointT>::evolve(pcl::PCLPointCloud2& cloud)
{
  const LevelSet level_set = evolveInput();
  cloud = detail::addPhi(
      viewOf(*this->input_), *this->indices_, level_set.phi, threads_, report_);
  cloud.header = this->input_->header;
  this->deinitCompute();
}

} // namespace pcl_uvol
