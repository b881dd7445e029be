// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/multivariate/density_clustering.h>

#include <pcl/impl/pcl_base.hpp>

#include <utility>

namespace pcl_uvol {

template <typename PointT>
void
DensityClustering<PointT>::compute(std::vector<int>& labels)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("DensityClustering has no input cloud: call setInputCloud.");
  startReport();
  const CloudView cloud = viewOf(*this->input_);
  detail::checkIndices(*this->indices_, cloud.count, "DensityClustering");
  const std::vector<std::uint32_t> use(this->indices_->begin(), this->indices_->end());
  Clustering clustering =
      detail::clusterCloud(cloud, use, parameters_, threads_, report_);
  labels.assign(clustering.labels.begin(), clustering.labels.end());
  probabilities_ = std::move(clustering.probabilities);
  tree_ = std::move(clustering.tree);
  this->deinitCompute();
}

} // namespace pcl_uvol
