// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <utility>

namespace pcl_uvol {

template <typename PointT>
void
LevelSetEvolution<PointT>::evolve(std::vector<float>& phi)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("LevelSetEvolution has no input cloud: call setInputCloud.");
  startReport();
  parameters_.threads = threads_;
  summary_ = LevelSetSummary();
  LevelSet level_set = evolveLevelSet(
      viewOf(*this->input_), *this->indices_, field_, isovalue_, parameters_, report_);
  phi = std::move(level_set.phi);
  summary_ = std::move(level_set.summary);
  this->deinitCompute();
}

} // namespace pcl_uvol
