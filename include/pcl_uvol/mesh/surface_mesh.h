// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of scattered samples as closed, oriented triangle meshes, straight from
// the cells of the kd-tree: no grid, no Delaunay tetrahedra.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/PolygonMesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief What becomes of the triangles between the cells. */
enum class Remeshing {
  Even, ///< vertices glide along the surface, short edges vanish, others turn (default)
  None  ///< they stay as the cells make them: many, and of any angle
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<Remeshing>, 2>
listWords(Remeshing)
{
  return {{{Remeshing::Even, "even"}, {Remeshing::None, "none"}}};
}

/** \brief How a mesh is made of an isosurface. */
struct PCL_UVOL_EXPORTS MeshingParameters {
  Remeshing remesh = Remeshing::Even;
  /** With Remeshing::Even: length that edges get, about, in units of the coordinates;
   * 0: that of the local spacing. Not below the local spacing, because samples do not
   * resolve more. */
  double edge_length = 0.0;
  /** Leave the surface open where it reaches the border of the samples' box, instead of
   * closing it by caps along the sides of the box. */
  bool open = false;
  /** Leave out connected pieces of fewer triangles. */
  std::size_t drop_pieces = 0;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = MeshingParameters;
    return std::make_tuple(Member{"remesh", &Own::remesh},
                           Member{"edge_length", &Own::edge_length},
                           Member{"open", &Own::open},
                           Member{"drop_pieces", &Own::drop_pieces});
  }
};

/** \brief Parameters of SurfaceMesh. */
struct PCL_UVOL_EXPORTS SurfaceMeshParameters {
  /** A mesh depends on the field, the isovalues, the side and the scale: vertices lie
   * on fits, between touching cells of the tree. */
  IsosurfaceParameters isosurface;
  MeshingParameters meshing;

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = SurfaceMeshParameters;
    return std::make_tuple(Member{"isosurface", &Own::isosurface},
                           Member{"meshing", &Own::meshing});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static SurfaceMeshParameters
  fromJson(const std::string& text);
};

/** \throws InvalidArgument as checkParameters(IsosurfaceParameters), for linear
 * interpolation, for neighbours of a Voronoi diagram, and for a length that is negative
 * or no number
 * \param parameters to be checked before samples are there */
PCL_UVOL_EXPORTS void
checkParameters(const SurfaceMeshParameters& parameters);

/** \brief A connected part of a mesh. */
struct SurfacePiece {
  double isovalue;
  std::uint32_t vertices, triangles;
  std::uint32_t rims;  ///< closed lines along which it is open; 0: it is closed
  std::uint32_t genus; ///< handles; those of the surface whose rims are filled by discs
};

/** \brief A triangle mesh of one or several isosurfaces, one after another. */
struct PCL_UVOL_EXPORTS SurfaceTriangles {
  /** As isopoints; on a cap the normal is that of the box, and support is Rim. Where
   * the surface meets a cap, vertices lie on both, and are isopoints. */
  pcl::PointCloud<PointIso> vertices;
  IsoEdges edges; ///< between points of the input, one per vertex
  /** Counter-clockwise as seen from outside. */
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> piece_of; ///< by vertex, among pieces
  /** 1 for each vertex that closes the box and is not on the surface, else 0: triangles
   * with such a vertex are the caps. */
  std::vector<std::uint8_t> is_on_cap;
  /** They are sorted by isovalue in their order, then by falling number of triangles.
   */
  std::vector<SurfacePiece> pieces;
  double smallest_angle = 180.0; ///< of all triangles, in degrees
  double cap_part = 0.0;         ///< of the area, in caps
  /** Triangles that are inverted relative to the normals of their vertices, and those
   * with an angle below 5 degrees. @{ */
  std::uint64_t folds = 0, slivers = 0;
  /** @} */
  SurfaceTally tally; ///< of the isosurfaces

  /** \brief Add another mesh behind this one.
   * \param other whose indices and pieces are shifted behind those here */
  void
  append(const SurfaceTriangles& other);
};

namespace detail {

/** \brief SurfaceMesh on any cloud.
 * \param shown_isovalues what vertices, pieces and warnings call the isovalues, if the
 * field is a level-set function of another field */
PCL_UVOL_EXPORTS SurfaceTriangles
makeSurfaceMesh(const CloudView& cloud,
                const pcl::Indices& indices,
                const SurfaceMeshParameters& parameters,
                const std::vector<double>& shown_isovalues,
                unsigned threads,
                Report& report);

} // namespace detail

/** \brief The mesh in PCL's own type, with every field of the samples, see
 * interpolateFields().
 * \param samples that it was made of
 * \param report gets a warning for every field of the samples that is replaced
 * \param surface as extract() gives it
 * \param threads 0: all cores */
PCL_UVOL_EXPORTS pcl::PolygonMesh
toPolygonMesh(const SurfaceTriangles& surface,
              const CloudView& samples,
              unsigned threads,
              Report& report);

/** \brief Isosurfaces of a scalar field given at scattered points, as meshes.
 *
 * \code
 * pcl_uvol::SurfaceMesh<pcl::PointXYZI> mesher;
 * mesher.setInputCloud(cloud);
 * pcl_uvol::SurfaceMeshParameters parameters;
 * parameters.isosurface.isovalues = {0.5};
 * mesher.setParameters(parameters);
 * pcl::PolygonMesh mesh;
 * mesher.extract(mesh);
 * \endcode
 * Every sample has a separate cell of the kd-tree (thesis 2.2.1). At most three cells
 * meet along an edge and four in a corner. So the border between cells on different
 * sides of the isovalue is a closed, oriented surface without branches, for any
 * samples. A cell is on the side that the local polynomial fit (the one of
 * IsosurfaceExtraction) gives the centre of its box. Vertices lie between touching
 * cells of different sides and are moved onto the zero level of fits made there, which
 * give normal, curvature, error and support, as for isopoints. The mesh is checked
 * before it is returned. It is the same for any order of the points and any number of
 * threads.
 *
 * Sheets and gaps thinner than about 2.5 spacings of the samples are not resolved:
 * handles join them.
 * Memory: about 60 bytes per sample besides the cloud, and about 1 kB per vertex.
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class SurfaceMesh : public CloudStage<PointT>,
                    public ParameterStage<SurfaceMeshParameters> {
public:
  using Ptr = std::shared_ptr<SurfaceMesh<PointT>>;
  using ConstPtr = std::shared_ptr<const SurfaceMesh<PointT>>;

  /** \brief Make the meshes of all isovalues.
   *
   * \param surface the meshes, one behind the other
   * \throws InvalidArgument as IsosurfaceExtraction::extract and checkParameters(); the
   * mesh is then untouched
   *
   * Counts of the report: those of the samples and of the fits, as for
   * IsosurfaceExtraction, crossing_samples, spikes, band_cells, vertices, triangles,
   * pieces, dropped_pieces, handles, rim_edges and cap_vertices. Also folds (inverted
   * triangles) and slivers (triangles with an angle below 5 degrees). */
  void
  extract(SurfaceTriangles& surface)
  {
    this->withInput(
        "SurfaceMesh", [&](const CloudView& cloud, const pcl::Indices& indices) {
          this->startReport();
          surface = detail::makeSurfaceMesh(cloud,
                                            indices,
                                            parameters_,
                                            parameters_.isosurface.isovalues,
                                            threads_,
                                            report_);
          surface.vertices.header = this->input_->header;
        });
  }

  /** \brief The same in PCL's own type, see toPolygonMesh().
   * \param mesh what is found */
  void
  extract(pcl::PolygonMesh& mesh)
  {
    SurfaceTriangles surface;
    extract(surface);
    mesh = toPolygonMesh(surface, viewOf(*this->input_), threads_, report_);
  }
};

} // namespace pcl_uvol
