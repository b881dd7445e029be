// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>

namespace pcl_uvol {

/** \brief The non-template part of NaturalNeighbors::compute. */
PCL_UVOL_EXPORTS NeighborGraph
computeNaturalNeighbors(const CloudView& cloud,
                        const std::vector<std::uint32_t>& use,
                        const std::optional<VoronoiCandidateSettings>& voronoi,
                        AngleCriterion criterion,
                        unsigned threads,
                        Report& report);

template <typename PointT>
void
NaturalNeighbors<PointT>::compute(NeighborGraph& graph)
{
  if (!this->input_ || !this->initCompute())
    throw InvalidArgument("NaturalNeighbors has no input cloud: call setInputCloud.");
  startReport();
  const std::vector<std::uint32_t> use(this->indices_->begin(), this->indices_->end());
  graph = computeNaturalNeighbors(
      viewOf(*this->input_), use, voronoi_, criterion_, threads_, report_);
  this->deinitCompute();
}

} // namespace pcl_uvol
