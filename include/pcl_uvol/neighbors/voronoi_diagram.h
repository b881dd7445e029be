// SPDX-License-Identifier: BSD-3-Clause
// Discrete Voronoi diagrams of clouds: the nearest filled cell of every cell of a
// regular grid (thesis 2.1).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief A cell by its place along x, y and z. */
using GridCell = std::array<std::uint16_t, 3>;

/** \brief A regular grid of box-shaped cells (Definition 2.1). Cells are numbered with
 * x running fastest, then y, then z. */
struct PCL_UVOL_EXPORTS GridShape {
  static constexpr std::uint32_t largest_side = 16384;

  std::array<std::uint32_t, 3> cells{{1, 1, 1}};  ///< per axis, in [1, largest_side]
  std::array<double, 3> origin{{0.0, 0.0, 0.0}};  ///< lower corner of the first cell
  std::array<double, 3> spacing{{1.0, 1.0, 1.0}}; ///< sides of a cell, > 0

  /** \brief Cubes, so many along the longest side of a box, and so many more on each
   * side as a margin; along the other axes as many as cover the box.
   * \param low lower corner of the box
   * \param high upper corner of the box
   * \param cells_of_longest along its longest side, >= 1
   * \param margin further cells at each side
   * \throws InvalidArgument for a box that is not finite, or more cells than
   * largest_side along an axis */
  static GridShape
  cubes(const std::array<double, 3>& low,
        const std::array<double, 3>& high,
        std::uint32_t cells_of_longest,
        std::uint32_t margin = 0);

  /** \brief Exactly so many cells, whatever their sides become.
   * \param low lower corner of the box
   * \param high upper corner of the box
   * \param cells along each axis, >= 1
   * \throws InvalidArgument as cubes() */
  static GridShape
  boxes(const std::array<double, 3>& low,
        const std::array<double, 3>& high,
        const std::array<std::uint32_t, 3>& cells);

  /** \brief Number of cells. */
  std::uint64_t
  size() const
  {
    return std::uint64_t{cells[0]} * cells[1] * cells[2];
  }

  /** \brief The number of a cell.
   * \param cell along each axis, below cells */
  std::uint64_t
  indexOf(const GridCell& cell) const
  {
    return (std::uint64_t{cell[2]} * cells[1] + cell[1]) * cells[0] + cell[0];
  }

  /** \brief The cell of a number.
   * \param index number of the cell, below size() */
  GridCell
  cellOf(std::uint64_t index) const
  {
    const std::uint64_t row = index / cells[0];
    return {{static_cast<std::uint16_t>(index % cells[0]),
             static_cast<std::uint16_t>(row % cells[1]),
             static_cast<std::uint16_t>(row / cells[1])}};
  }

  /** \brief The centre of a cell.
   * \param cell along each axis, below cells */
  std::array<double, 3>
  centerOf(const GridCell& cell) const
  {
    return {{origin[0] + (cell[0] + 0.5) * spacing[0],
             origin[1] + (cell[1] + 0.5) * spacing[1],
             origin[2] + (cell[2] + 0.5) * spacing[2]}};
  }

  /** \brief The cell of a place; places outside are taken to the border.
   * \param place in the coordinates of the points */
  GridCell
  cellAt(const std::array<double, 3>& place) const;

  /** \brief Between the centres of two cells, in units of the coordinates.
   * \param a a cell
   * \param b another cell */
  double
  distance(const GridCell& a, const GridCell& b) const;
};

/** \brief Marks cells of a grid without any site. */
constexpr std::uint32_t no_site = std::numeric_limits<std::uint32_t>::max();

/** \brief A way to find the nearest site of every cell. */
class PCL_UVOL_EXPORTS NearestSites {
public:
  NearestSites() = default;
  NearestSites(const NearestSites&) = delete;
  NearestSites&
  operator=(const NearestSites&) = delete;
  virtual ~NearestSites() = default;

  /** \brief Index of the site of every cell, by the distance between the centres of
   * cells; no_site everywhere if sites is empty.
   * \param sites distinct cells in the order of their numbers
   * \param report gets times
   * \param shape the grid
   * \param threads 0: all cores */
  virtual std::vector<std::uint32_t>
  find(const GridShape& shape,
       const std::vector<GridCell>& sites,
       unsigned threads,
       Report& report) = 0;
};

/** \brief The exact transform, axis by axis (Felzenszwalb and Huttenlocher 2012,
 * Meijster et al. 2000): of equally far sites the lower one. The cost is that of the
 * cells, whatever the number of sites. Squares of the spacings are rounded to the
 * 65,536th part of the smallest one, to coarser parts where 64 bits (128 where cells
 * are flatter than 1 : 100,000) do not hold squared distances; then all is exact.
 * Memory: 4 bytes per cell. */
class PCL_UVOL_EXPORTS FeatureTransform : public NearestSites {
public:
  std::vector<std::uint32_t>
  find(const GridShape& shape,
       const std::vector<GridCell>& sites,
       unsigned threads,
       Report& report) override;
};

/** \brief The discrete Voronoi diagram of samples (Definition 2.2): sites are the cells
 * that hold samples. Memory: 4 bytes per cell and 8 per sample. */
class PCL_UVOL_EXPORTS VoronoiGrid {
public:
  /** \brief Sort samples into the cells and find the nearest filled one of every cell.
   * \param xyz first coordinate of point 0; point i starts stride floats further on
   * \param use indices of the points to take; those with a non-finite coordinate are
   * left out and counted as "non_finite"
   * \param way how the nearest sites are found, say FeatureTransform
   * \param shape the grid
   * \param stride floats from one point to the next, >= 3
   * \param threads 0: all cores
   * \throws InvalidArgument for a grid with more than 2^32 - 2 cells or a bad shape,
   * and if no point is left
   * \param report gets the counts "cells" and "sites", and times */
  VoronoiGrid(const GridShape& shape,
              const float* xyz,
              std::size_t stride,
              const std::vector<std::uint32_t>& use,
              NearestSites& way,
              unsigned threads,
              Report& report);

  /** \return Numbers, sides and place of the cells. */
  const GridShape&
  getShape() const
  {
    return shape_;
  }

  /** \brief Filled cells, in the order of their numbers. */
  const std::vector<GridCell>&
  getSites() const
  {
    return sites_;
  }

  /** \brief The points in the cell of each site, ascending. */
  const NeighborGraph&
  getMembers() const
  {
    return members_;
  }

  /** \brief Site of every cell: the Voronoi regions. */
  const std::vector<std::uint32_t>&
  getNearest() const
  {
    return nearest_;
  }

  /** \brief The distance field: per cell the distance to its site, between the centres
   * of cells, in units of the coordinates.
   * \param threads 0: all cores */
  std::vector<float>
  computeDistances(unsigned threads) const;

  /** \brief Sites whose Voronoi regions share a point, cell against cell: a row per
   * site, ascending, without the site itself.
   * \param threads 0: all cores */
  NeighborGraph
  findAdjacentRegions(unsigned threads) const;

private:
  GridShape shape_;
  std::vector<GridCell> sites_;
  NeighborGraph members_;
  std::vector<std::uint32_t> nearest_;
};

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

  /** \return The number of cells along each axis; 0 along y and z: cubes, so many along
   * the longest side. */
  std::array<std::uint32_t, 3>
  getCells() const
  {
    return {parameters_.cells_x, parameters_.cells_y, parameters_.cells_z};
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
