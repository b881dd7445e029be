// SPDX-License-Identifier: BSD-3-Clause
// Surfaces around clusters of points, from their distance fields (thesis 2.6, Figures
// 2.22 to 2.24).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/stage.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief What encloses a cluster. */
enum class ClusterSurfaceKind {
  Distance,    ///< all places at one distance from its points (Figure 2.23 b)
  Hull,        ///< its outer points, connected by triangles (Figure 2.23 c)
  HullDistance ///< all places at one distance from its hull (Figure 2.23 d)
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<ClusterSurfaceKind>, 3>
listWords(ClusterSurfaceKind)
{
  return {{{ClusterSurfaceKind::Distance, "distance"},
           {ClusterSurfaceKind::Hull, "hull"},
           {ClusterSurfaceKind::HullDistance, "hull-distance"}}};
}

/** \brief Parameters of ClusterSurfaceGeneration. */
struct PCL_UVOL_EXPORTS ClusterSurfaceParameters {
  ClusterSurfaceKind kind = ClusterSurfaceKind::Distance;
  /** Cells along the longest side of the box of all that lies within the distance. */
  std::uint32_t cells = 128;
  /** In units of the coordinates; 0 (default): the longest edge of the points' minimum
   * spanning tree and one cell, so that the surface is of one piece. */
  double distance = 0.0;
  /** Factors per axis, > 0: distances are measured in the stretched space. */
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f};
  /** Turns the axes that these factors belong to, see
   * InterpolationParameters::rotation. */
  Eigen::Array3d rotation{0.0, 0.0, 0.0};

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = ClusterSurfaceParameters;
    return std::make_tuple(Member{"kind", &Own::kind},
                           Member{"cells", &Own::cells},
                           Member{"distance", &Own::distance},
                           Member{"scale", &Own::scale},
                           Member{"rotation", &Own::rotation});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static ClusterSurfaceParameters
  fromJson(const std::string& text);
};

/** \brief A closed mesh around a cluster. */
struct ClusterSurface {
  Mesh mesh;
  /** Index of the point that is a vertex, for a hull; else empty. */
  std::vector<std::uint32_t> points;
  double distance = 0.0; ///< that was used
};

namespace detail {

/** \brief The kernel of ClusterSurfaceGeneration for any cloud. */
PCL_UVOL_EXPORTS ClusterSurface
encloseCluster(const CloudView& cloud,
               const pcl::Indices& members,
               const ClusterSurfaceParameters& parameters,
               unsigned threads,
               Report& report);

} // namespace detail

/** \brief Encloses points, those of a cluster say, by a closed mesh.
 *
 * \code
 * pcl_uvol::ClusterSurfaceGeneration<pcl::PointXYZ> generation;
 * generation.setInputCloud(cloud);
 * generation.setIndices(members);
 * generation.setKind(pcl_uvol::ClusterSurfaceKind::Hull);
 * pcl_uvol::ClusterSurface surface;
 * generation.compute(surface);
 * \endcode
 * Distances are those of a discrete Voronoi diagram; the surface is a contour of its
 * grid, or shrunk from it to the points.
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class ClusterSurfaceGeneration : public CloudStage<PointT>,
                                 public ParameterStage<ClusterSurfaceParameters> {
public:
  using Ptr = std::shared_ptr<ClusterSurfaceGeneration<PointT>>;
  using ConstPtr = std::shared_ptr<const ClusterSurfaceGeneration<PointT>>;

  /** \brief Default: ClusterSurfaceKind::Distance. */
  void
  setKind(ClusterSurfaceKind kind)
  {
    parameters_.kind = kind;
  }

  /** \return What kind of surface is made. */
  ClusterSurfaceKind
  getKind() const
  {
    return parameters_.kind;
  }

  /** \brief In units of the coordinates; 0, the default: see ClusterSurfaceParameters.
   */
  void
  setDistance(double distance)
  {
    parameters_.distance = distance;
  }

  /** \return The distance, in units of the coordinates; 0: it is chosen. */
  double
  getDistance() const
  {
    return parameters_.distance;
  }

  /** \brief Enclose the points of the indices. Points that are not finite are left out.
   *
   * Counts of the report: members, non_finite, vertices, triangles, with a hull
   * split_pieces.
   * \param surface vertices and triangles
   * \throws InvalidArgument without an input cloud, without a finite point, and for a
   * distance or scale that is not finite or negative. Also for a distance too small for
   * the grid, one point without a distance, too many cells, and a hull without
   * triangles. surface is then untouched */
  void
  compute(ClusterSurface& surface);
};

template <typename PointT>
void
ClusterSurfaceGeneration<PointT>::compute(ClusterSurface& surface)
{
  this->withInput("ClusterSurfaceGeneration",
                  [&](const CloudView& cloud, const pcl::Indices& indices) {
                    startReport();
                    surface = detail::encloseCluster(
                        cloud, indices, parameters_, threads_, report_);
                  });
}

} // namespace pcl_uvol
