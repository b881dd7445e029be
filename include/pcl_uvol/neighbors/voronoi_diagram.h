// SPDX-License-Identifier: BSD-3-Clause
// Discrete Voronoi diagrams of clouds (thesis 2.1).
#pragma once

#include <pcl_uvol/common/cloud_stage.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/voronoi_grid.h>

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>

namespace pcl_uvol {

/** \brief Parameters of VoronoiDiagram: cells of the grid over the box of the points,
 * each number in [1, GridShape::largest_side]. */
struct PCL_UVOL_EXPORTS VoronoiParameters {
  /** Along x, y and z. With cells_y and cells_z 0, the default, cells are cubes, and
   * cells_x of them lie along the longest side of the box. */
  std::uint32_t cells_x = 128, cells_y = 0, cells_z = 0;
  std::uint32_t margin = 0; ///< more cubes on each side of the box

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = VoronoiParameters;
    return std::make_tuple(Member{"cells_x", &Own::cells_x},
                           Member{"cells_y", &Own::cells_y},
                           Member{"cells_z", &Own::cells_z},
                           Member{"margin", &Own::margin});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static VoronoiParameters
  fromJson(const std::string& text);
};

namespace detail {

/** \brief The kernel of VoronoiDiagram for any cloud. */
PCL_UVOL_EXPORTS std::shared_ptr<const VoronoiGrid>
computeVoronoiGrid(const CloudView& cloud,
                   const pcl::Indices& indices,
                   const VoronoiParameters& parameters,
                   NearestSites& way,
                   unsigned threads,
                   Report& report);

} // namespace detail

/** \brief Finds the nearest point to every cell of a grid over a cloud.
 *
 * \code
 * pcl_uvol::VoronoiDiagram<pcl::PointXYZ> diagram;
 * diagram.setInputCloud(cloud);
 * diagram.setCells(256);
 * const std::shared_ptr<const pcl_uvol::VoronoiGrid> grid = diagram.compute();
 * \endcode
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class VoronoiDiagram : public CloudStage<PointT>,
                       public ParameterStage<VoronoiParameters> {
public:
  using Ptr = std::shared_ptr<VoronoiDiagram<PointT>>;
  using ConstPtr = std::shared_ptr<const VoronoiDiagram<PointT>>;

  /** \brief Cubes, so many along the longest side of the box; default 128. */
  void
  setCells(std::uint32_t along_longest)
  {
    parameters_.cells_x = along_longest;
    parameters_.cells_y = parameters_.cells_z = 0;
  }

  /** \brief So many boxes along each axis. */
  void
  setCells(std::uint32_t x, std::uint32_t y, std::uint32_t z)
  {
    parameters_.cells_x = x;
    parameters_.cells_y = y;
    parameters_.cells_z = z;
  }

  /** \brief More cubes on each side of the box; default 0. */
  void
  setMargin(std::uint32_t cells)
  {
    parameters_.margin = cells;
  }

  /** \return The number of cubes beyond each side of the box. */
  std::uint32_t
  getMargin() const
  {
    return parameters_.margin;
  }

  /** \brief How the nearest sites are found; null, the default: FeatureTransform. */
  void
  setNearestSites(const std::shared_ptr<NearestSites>& way)
  {
    way_ = way;
  }

  /** \return What finds the nearest sites; null: FeatureTransform. */
  const std::shared_ptr<NearestSites>&
  getNearestSites() const
  {
    return way_;
  }

  /** \brief Compute the diagram; its members are points of the input cloud.
   *
   * Counts of the report: cells, sites, non_finite (points that are left out).
   * \throws InvalidArgument without an input cloud or a finite point, for cells out of
   * range, a margin of cells that are no cubes, more than 2^32 - 2 cells. Memory: 4
   * bytes per cell and 8 per point. */
  std::shared_ptr<const VoronoiGrid>
  compute();

private:
  std::shared_ptr<NearestSites> way_;
};

template <typename PointT>
std::shared_ptr<const VoronoiGrid>
VoronoiDiagram<PointT>::compute()
{
  std::shared_ptr<const VoronoiGrid> grid;
  this->withInput(
      "VoronoiDiagram", [&](const CloudView& cloud, const pcl::Indices& indices) {
        startReport();
        FeatureTransform transform;
        grid = detail::computeVoronoiGrid(
            cloud, indices, parameters_, way_ ? *way_ : transform, threads_, report_);
      });
  return grid;
}

} // namespace pcl_uvol
