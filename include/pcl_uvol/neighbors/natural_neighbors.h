// SPDX-License-Identifier: BSD-3-Clause
// Approximate natural neighbours of every sample: candidates of the kd-tree (thesis
// 2.2) or a discrete Voronoi diagram (2.1), thinned by the angle criterion (2.3).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>

namespace pcl_uvol {

/** \brief Where candidates for neighbours come from. */
enum class NeighborSource {
  KdTree,  ///< touching cells of the kd-tree (thesis 2.2), about 11 of them (default)
  Voronoi, ///< adjacent regions of a discrete Voronoi diagram (2.1)
  Exact    ///< faces of the exact Voronoi cells, which both approximate: about 15.5 of
           ///< random samples; some 25 microseconds each
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<NeighborSource>, 3>
listWords(NeighborSource)
{
  return {{{NeighborSource::KdTree, "kdtree"},
           {NeighborSource::Voronoi, "voronoi"},
           {NeighborSource::Exact, "exact"}}};
}

/** \brief Which closer candidates can remove a farther one; Table 2.4 leaves it open.
 */
enum class AngleCriterion {
  Kept, ///< only those kept so far: about 5.1 neighbours, more isopoints (default)
  All,  ///< also those that were removed: about 4.7 neighbours, shorter edges
  None  ///< none can: all candidates are neighbours
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<AngleCriterion>, 3>
listWords(AngleCriterion)
{
  return {{{AngleCriterion::Kept, "kept"},
           {AngleCriterion::All, "all"},
           {AngleCriterion::None, "none"}}};
}

/** \brief Parameters of NaturalNeighbors. */
struct PCL_UVOL_EXPORTS NaturalNeighborParameters {
  NeighborSource source = NeighborSource::KdTree;
  /** Cells of the diagram along the longest side; 0: 4 samples to a cell. */
  std::uint32_t voronoi_cells = 0;
  AngleCriterion criterion = AngleCriterion::Kept;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = NaturalNeighborParameters;
    return std::make_tuple(Member{"source", &Own::source},
                           Member{"voronoi_cells", &Own::voronoi_cells},
                           Member{"criterion", &Own::criterion});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static NaturalNeighborParameters
  fromJson(const std::string& text);
};

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
