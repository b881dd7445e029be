// SPDX-License-Identifier: BSD-3-Clause
// Approximate natural neighbours of every sample: candidates of the kd-tree (thesis
// 2.2) or a discrete Voronoi diagram (2.1), thinned by the angle criterion (2.3).
#pragma once

#include <pcl_uvol/common/cloud_stage.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/natural_neighbor_parameters.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <cstdint>
#include <memory>

namespace pcl_uvol {

/** \brief Natural neighbours of every point of a cloud.
 *
 * \code
 * pcl_uvol::NaturalNeighbors<pcl::PointXYZ> natural;
 * natural.setInputCloud(cloud);
 * pcl_uvol::NeighborGraph graph;
 * natural.compute(graph);
 * \endcode
 * Points with a non-finite coordinate have no neighbours; of exact duplicates the first
 * has those of all, the others none. */
template <typename PointT>
class NaturalNeighbors : public CloudStage<PointT>,
                         public ParameterStage<NaturalNeighborParameters> {
public:
  using Ptr = std::shared_ptr<NaturalNeighbors<PointT>>;
  using ConstPtr = std::shared_ptr<const NaturalNeighbors<PointT>>;

  /** \brief Default: AngleCriterion::Kept. */
  void
  setAngleCriterion(AngleCriterion criterion)
  {
    parameters_.criterion = criterion;
  }

  /** \return Which closer candidates remove a farther one. */
  AngleCriterion
  getAngleCriterion() const
  {
    return parameters_.criterion;
  }

  /** \brief Where candidates come from. Default: NeighborSource::KdTree.
   * \param voronoi_cells of a diagram along its longest side; 0: 4 samples to a cell
   * \param source a tree of the samples or a discrete Voronoi diagram */
  void
  setNeighborSource(NeighborSource source, std::uint32_t voronoi_cells = 0)
  {
    parameters_.source = source;
    parameters_.voronoi_cells = voronoi_cells;
  }

  /** \return Where candidates come from. */
  NeighborSource
  getNeighborSource() const
  {
    return parameters_.source;
  }

  /** \brief One row per point of the input cloud, sorted by (squared distance, index),
   * indices into the input cloud.
   * \param graph the neighbours
   * \throws InvalidArgument without an input cloud or without a finite point */
  void
  compute(NeighborGraph& graph);
};

namespace detail {

/** \brief The kernel of NaturalNeighbors for any cloud. */
PCL_UVOL_EXPORTS NeighborGraph
computeNaturalNeighbors(const CloudView& cloud,
                        const pcl::Indices& indices,
                        const NaturalNeighborParameters& parameters,
                        unsigned threads,
                        Report& report);

} // namespace detail

template <typename PointT>
void
NaturalNeighbors<PointT>::compute(NeighborGraph& graph)
{
  this->withInput("NaturalNeighbors",
                  [&](const CloudView& cloud, const pcl::Indices& indices) {
                    startReport();
                    graph = detail::computeNaturalNeighbors(
                        cloud, indices, parameters_, threads_, report_);
                  });
}

} // namespace pcl_uvol
