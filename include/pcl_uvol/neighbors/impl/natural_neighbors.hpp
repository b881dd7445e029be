// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>

#include <pcl/impl/pcl_base.hpp>

namespace pcl_uvol {

namespace detail {

/** \brief The non-template part of NaturalNeighbors::compute. */
PCL_UVOL_EXPORTS NeighborGraph
computeNaturalNeighbors(const CloudView& cloud,
                        const std::vector<std::uint32_t>& use,
                        const NaturalNeighborParameters& parameters,
                        unsigned threads,
                        Report& report);

} // namespace detail

template <typename PointT>
void
NaturalNeighbors<PointT>::compute(NeighborGraph& graph)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("NaturalNeighbors has no input cloud: call setInputCloud.");
  startReport();
  const CloudView cloud = viewOf(*this->input_);
  detail::checkIndices(*this->indices_, cloud.count, "NaturalNeighbors");
  const std::vector<std::uint32_t> use(this->indices_->begin(), this->indices_->end());
  graph = detail::computeNaturalNeighbors(cloud, use, parameters_, threads_, report_);
  this->deinitCompute();
}

} // namespace pcl_uvol
