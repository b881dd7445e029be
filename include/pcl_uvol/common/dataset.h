// SPDX-License-Identifier: BSD-3-Clause
// A cloud as files and other programs give it: every field under its own name and type,
// and an origin in double precision. And triangle meshes.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/message.h>

#include <pcl/PCLPointCloud2.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Names of the values of fields, by the name of the field: the value 0 means
 * the first name, 1 the second one. The names differ, and are in ascending order of
 * their bytes. */
using LabelNames = std::map<std::string, std::vector<std::string>>;

/** \brief What a file gives and takes.
 *
 * Positions are float in PCL; coordinates that float cannot hold (UTM, astronomical)
 * keep their digits because the origin is subtracted in double when they are read and
 * added back when they are written. */
struct PCL_UVOL_EXPORTS Dataset {
  /** Fields x, y, z are float32, relative to the origin; all others as in the file.
   * Height is 1, padding fields ("_") are removed, x, y, z come first and the others
   * follow without gaps; point_step is a multiple of 4, so that viewOf() takes it. */
  pcl::PCLPointCloud2 cloud;
  /** Added to x, y, z when the dataset is written; multiples of a power of two, or 0.
   */
  std::array<double, 3> origin{{0.0, 0.0, 0.0}};
  /** The coordinates came in double: they are written in double. */
  bool double_coordinates = false;
  /** False: the file has none, and x, y, z are 0; see LoadOptions. */
  bool has_coordinates = true;
  /** Sides of the box that the file names, 0: none. Whether it repeats the user knows,
   * see IsosurfacePipelineParameters::periodic. */
  std::array<double, 3> box{{0.0, 0.0, 0.0}};
  /** Columns of names: int32 fields of the cloud, -1 where a point has no name. Fields
   * that are not there, and values beyond the names, are passed over. */
  LabelNames labels;
  /** What reading had to decide (columns taken as coordinates, list
   * properties left out, ...). */
  std::vector<Message> notes;
  /** Data that the cells of a file of VTK have and that were left out, by name: the
   * centres of cells have them, see LoadOptions::cells. */
  std::vector<std::string> cell_fields;
};

/** \brief Put float32 x, y, z relative to a common origin into a dataset, in front of
 * its other fields, from coordinates in double; double_coordinates stays as it is.
 *
 * The origin of an axis is 0 if float represents every coordinate to 1e-7 of the extent
 * of that axis. For an axis along which the cloud is flat, the extent is that of the
 * cloud.
 * \param xyz three numbers per point
 * \param dataset gets the fields
 * \throws InvalidArgument unless there are three per point, or if all points have
 * coordinates beyond float; a few that have count as points without a position */
PCL_UVOL_EXPORTS void
setCoordinates(Dataset& dataset, const std::vector<double>& xyz);

/** \brief Add a field of single numbers behind the others, or replace the one of that
 * name.
 * \param values one per point
 * \param dataset gets the field
 * \param name of the field
 * \throws InvalidArgument for another number of values, and for x, y and z @{ */
PCL_UVOL_EXPORTS void
setField(Dataset& dataset, const std::string& name, const std::vector<float>& values);
PCL_UVOL_EXPORTS void
setField(Dataset& dataset, const std::string& name, const std::vector<double>& values);
PCL_UVOL_EXPORTS void
setField(Dataset& dataset,
         const std::string& name,
         const std::vector<std::int32_t>& values);
/** @} */

/** \brief Indices of vertices, counter-clockwise as seen from outside. */
using Triangle = std::array<std::uint32_t, 3>;

/** \brief Vertices and triangles. */
struct Mesh {
  std::vector<std::array<float, 3>> vertices;
  std::array<double, 3> origin{{0.0, 0.0, 0.0}}; ///< to be added to the vertices
  std::vector<Triangle> triangles;
};

/** \brief Unit normals of the vertices: means of their triangles', weighted by area; 0
 * for a vertex without any.
 * \param mesh whose triangles name vertices that it has */
PCL_UVOL_EXPORTS std::vector<std::array<float, 3>>
computeVertexNormals(const Mesh& mesh);

} // namespace pcl_uvol
