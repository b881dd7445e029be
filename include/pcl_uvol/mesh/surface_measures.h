// SPDX-License-Identifier: BSD-3-Clause
// Measures of surfaces: area, volume, centroid, axes, genus, integrals of fields, and
// what samples lie inside.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace pcl_uvol {

/** \brief Parameters of SurfaceMeasures. */
struct PCL_UVOL_EXPORTS SurfaceMeasuresParameters {
  /** Bend triangles according to the normals of their vertices. Flat ones are cut off
   * the surface: area and volume are short by about (edge length / radius of
   * curvature)^2 / 8 of themselves. */
  bool curved = true;
  /** Look for triangles that go through one another, or touch without a vertex in
   * common; takes about as long as all the rest. */
  bool find_intersections = false;
  /** Leave out pieces whose area and volume have errors as large as themselves, as
   * those around debris. They have no piece number, and do not count in the area. */
  bool drop_uncertain = false;
  /** The field of the samples that the surface is an isosurface of: samples beyond the
   * isovalue are then counted and summed. Empty, the default: it is not known. */
  std::string field;
  /** The outside of the isosurface, see IsosurfaceParameters::outside. */
  Outside outside = Outside::Lower;
  /** Sides of the periodic box that a mesh was cut at, in units of length; 0, the
   * default: not periodic along that axis. The box is found by the samples, or without
   * them by the vertices, see IsosurfacePipelineParameters::periodic. */
  Eigen::Array3d periodic{0.0, 0.0, 0.0};

  /** \return The members under the names that JSON has for them. */
  static auto
  listMembers()
  {
    using Own = SurfaceMeasuresParameters;
    return std::make_tuple(Member{"curved", &Own::curved},
                           Member{"find_intersections", &Own::find_intersections},
                           Member{"drop_uncertain", &Own::drop_uncertain},
                           Member{"field", &Own::field},
                           Member{"outside", &Own::outside},
                           Member{"periodic", &Own::periodic});
  }

  /** \return All parameters as an object of JSON. */
  std::string
  toJson() const;

  /** \brief Parameters that the text does not name have their defaults.
   * \param text an object of JSON, as toJson() writes it
   * \throws InvalidArgument for an unknown name or a value of another type */
  static SurfaceMeasuresParameters
  fromJson(const std::string& text);
};

/** \brief A figure and how far from the truth it may be; NaN: not known. */
struct Measure {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();
};

/** \brief A field on a surface. Vertices without a value are left out. */
struct SurfaceFieldMeasures {
  std::string name;
  double mean;      ///< by area
  Measure integral; ///< over the area: field times length^2
};

/** \brief A field of the samples in what a surface encloses. */
struct InnerFieldMeasures {
  std::string name;
  Measure integral; ///< over the volume: field times length^3
  double mean;      ///< by volume
  double sum;       ///< over the samples inside: of masses, their mass
};

/** \brief The sum of a field over some samples. */
struct SampleSum {
  std::string name;
  double sum;
};

/** \brief Measures of a surface or a piece of it, in units of the coordinates. */
struct PCL_UVOL_EXPORTS PieceMeasures {
  double isovalue; ///< NaN where the vertices have no field of that name
  std::uint32_t vertices = 0, triangles = 0;
  /** Closed lines along which it is open; of points: 1 where it is open. */
  std::uint32_t rims = 0;
  /** Handles, of several pieces together; none given for points. */
  std::optional<std::uint32_t> genus;
  Measure area;
  double cap_area = 0.0; ///< of it, of the caps that close the surface
  /** Enclosed, negative for a piece that looks inwards, as the wall of a cavity does;
   * NaN where it is open. In a periodic box, the faces of the box close a piece that
   * they cut. Its volume is that of the part of the box inside, or minus that of the
   * part outside, whichever is smaller. For all pieces together it is the volume
   * inside. A negative volume no larger than what the errors of vertices make is 0. */
  Measure volume;
  double capped_volume = 0.0; ///< of it, of pieces that caps close
  /** Centre and axes of the enclosed volume, or of the area where that is open or 0. @{
   */
  Eigen::Vector3d centroid;
  Eigen::Matrix3d axes;      ///< columns: principal axes, the longest first
  Eigen::Vector3d half_axes; ///< of the ellipsoid, or ellipsoidal shell, of the same
                             ///< second moments
  /** @} */
  std::array<double, 3> low, high; ///< bounds of the vertices
  std::vector<SurfaceFieldMeasures> on_surface;
  std::int64_t samples = 0; ///< inside; those in a cavity count for its wall as -1
  std::vector<InnerFieldMeasures> inside; ///< with samples, of closed surfaces
  /** Of an isovalue, with samples and their field: the samples whose value is at the
   * isovalue or on its inner side, wherever they are, and the sums of their fields. @{
   */
  std::optional<std::int64_t> samples_beyond;
  std::vector<SampleSum> sums_beyond;
  /** @} */
};

/** \brief Two triangles, by their indices, that go through one another, and where. */
struct TriangleIntersection {
  std::uint32_t first, second;
  Eigen::Vector3d place; ///< the middle of the first one
};

/** \brief What SurfaceMeasures computes. */
struct PCL_UVOL_EXPORTS SurfaceFigures {
  /** All pieces of an isovalue together, in the order of the vertices. */
  std::vector<PieceMeasures> isovalues;
  /** They are sorted by isovalue, then by falling number of triangles. */
  std::vector<PieceMeasures> pieces;
  std::vector<double> vertex_areas;   ///< shares of the vertices in the area, length^2
  std::vector<std::int32_t> piece_of; ///< by vertex, among pieces; -1 without triangle
  std::vector<TriangleIntersection> intersections; ///< if asked for: ascending
};

/** \brief Area, volume, moments and integrals of meshes, and of points with normals.
 *
 * \code
 * pcl_uvol::SurfaceMeasures measures;
 * measures.setInputSurface(vertices, triangles); // as loadMesh() or a pipeline gives
 * measures.setInputSamples(samples);             // to look inside
 * const double volume = measures.compute().isovalues[0].volume.value;
 * \endcode
 * Vertices may have the fields normal_x, normal_y and normal_z, which bend the
 * triangles; `error`, their estimated distance to the surface; `cap`, not 0 where they
 * close the surface at the border of the samples; `isovalue`. Integrals are over
 * quadratic triangles, see Dunavant, Int. J. Num. Meth. Eng. 21 (1985), and Vlachos et
 * al., Curved PN Triangles, I3D 2001; those over the enclosed space follow by Gauss's
 * theorem. The error of a measure is the sum of two parts: the errors of all vertices,
 * as if all were to the same side, and the error of the curved triangles. The second
 * part is the larger one without normals.
 *
 * Without triangles a surface is measured by those that its points would have in a
 * Delaunay triangulation of their tangent planes, of which each counts its Voronoi
 * cell: within 2e-5 on spheres and tori of 15,000 isopoints, and within 5e-4 of 2,500.
 * The inside is not measured, and handles are not counted. A mesh is more accurate.
 *
 * In a periodic box a mesh ends at the faces. It is closed there through the box for
 * volumes and for samples inside, whether or not it is welded; a welded mesh has pieces
 * that go through the faces. Centroids and axes of pieces that are cut are those of
 * their area in the box.
 *
 * Near small clumps of samples the surface is smoother than the samples: some of those
 * beyond the isovalue are outside of it. Where the sum over samples is what you want,
 * use sums_beyond, which does not depend on the surface.
 *
 * Where a surface ends, or meets a cap, the errors of its vertices along the surface
 * count as an error of the area. Of points at the end of a surface, and of isopoints in
 * gaps of the samples or at their border (see IsoSupport), all of the area is its
 * error.
 *
 * A field of the samples is integrated over the space inside as the sum over the
 * samples there of value times volume of the kd-tree's cell (thesis 2.2.1); where cells
 * and surface enclose different volumes, the difference has the field's mean on the
 * surface. Time and memory go with the triangles, and with the samples, if there are
 * any. */
class PCL_UVOL_EXPORTS SurfaceMeasures
    : public ParameterStage<SurfaceMeasuresParameters> {
public:
  using Ptr = std::shared_ptr<SurfaceMeasures>;
  using ConstPtr = std::shared_ptr<const SurfaceMeasures>;

  /** \brief The surface; no default.
   * \param vertices points, with the fields that the class names
   * \param triangles of the vertices; empty: the surface is one of points */
  void
  setInputSurface(const std::shared_ptr<const Dataset>& vertices,
                  const std::vector<Triangle>& triangles)
  {
    vertices_ = vertices;
    triangles_ = triangles;
  }

  /** \return The vertices of the surface; null before they are set. */
  const std::shared_ptr<const Dataset>&
  getInputVertices() const
  {
    return vertices_;
  }

  /** \return The triangles of the surface; empty: it is one of points. */
  const std::vector<Triangle>&
  getInputTriangles() const
  {
    return triangles_;
  }

  /** \brief The samples that the surface lies in; null, the default: none. */
  void
  setInputSamples(const std::shared_ptr<const Dataset>& samples)
  {
    samples_ = samples;
  }

  /** \return The samples that the surface lies in; null: none. */
  const std::shared_ptr<const Dataset>&
  getInputSamples() const
  {
    return samples_;
  }

  /** \brief Measure all pieces.
   *
   * Warnings of the report name open pieces, whose volume is unknown, measures with
   * large errors, a surface whose normals point inwards, and triangles that intersect.
   * \throws InvalidArgument without a surface, for a vertex of a triangle that is not
   * finite or does not exist, and for triangles that are not an oriented manifold. Also
   * for more than 10 million pairs of triangles that intersect, if these are requested,
   * and for sides of a box that are negative or not finite. Without triangles, also for
   * points that have no normals, and for samples without a field */
  SurfaceFigures
  compute();

private:
  std::shared_ptr<const Dataset> vertices_, samples_;
  std::vector<Triangle> triangles_;
};

} // namespace pcl_uvol
