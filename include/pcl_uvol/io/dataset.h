// SPDX-License-Identifier: BSD-3-Clause
// A cloud as files give it: every field under its own name and type, and an origin in
// double precision.
#pragma once

#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointCloud2.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pcl_uvol {

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
  /** One sentence each: what reading had to decide (columns taken as coordinates, list
   * properties left out, ...). */
  std::vector<std::string> notes;
};

/** \brief How a text file is read. */
struct PCL_UVOL_EXPORTS LoadOptions {
  /** Columns (from 0) that hold the coordinates of a text file; {-1, -1, -1} finds them
   * by name. */
  std::array<int, 3> xyz_columns{{-1, -1, -1}};
  /** False: a text file whose header names no coordinates, by x, y and z or by first
   * columns such as x_km, y_km, z_km, is taken for data without positions. */
  bool needs_coordinates = true;
};

/** \brief How a file is written. */
struct PCL_UVOL_EXPORTS SaveOptions {
  /** PCD and PLY as text instead of binary. */
  bool ascii = false;
  /** Comment lines for formats that have them (PCD, PLY, CSV has none). */
  std::vector<std::string> comments;
};

/** \brief Read points from .pcd, .ply, .csv, .txt, .xyz, .dat, .tsv, .vtk, .vtp, .vtu
 * or .vts, by the ending of the name (any case). Non-finite positions are kept. \throws
 * IOError in one sentence that names the file and, for text, the line */
PCL_UVOL_EXPORTS Dataset
loadDataset(const std::string& path, const LoadOptions& options = {});

/** \brief Write points as .pcd, .ply, .vtp or .csv, by the ending of the name. The file
 * appears whole or not at all; an empty cloud gives a valid file with zero points.
 * \throws IOError */
PCL_UVOL_EXPORTS void
saveDataset(const std::string& path,
            const Dataset& dataset,
            const SaveOptions& options = {});

/** \brief Throw IOError unless saveDataset knows the ending of that name, its folder
 * can be written to and the format holds fields of these types: to be called before
 * work whose result would be lost. */
PCL_UVOL_EXPORTS void
checkSavePath(const std::string& path,
              const std::vector<pcl::PCLPointField>& fields = {});

/** \brief Put float32 x, y, z relative to a common origin into a dataset, in front of
 * its other fields, from coordinates in double; double_coordinates stays as it is.
 *
 * The origin of an axis is 0 where float holds every coordinate to 1e-7 of the extent
 * of that axis (of the cloud, for an axis that is flat beside it).
 * \param xyz three numbers per point
 * \throws InvalidArgument unless there are three per point, none beyond float */
PCL_UVOL_EXPORTS void
setCoordinates(Dataset& dataset, const std::vector<double>& xyz);

/** \brief Add a field of single numbers behind the others, or replace the one of that
 * name. \param values one per point \throws InvalidArgument for another number of
 * values, and for x, y and z @{ */
PCL_UVOL_EXPORTS void
setField(Dataset& dataset, const std::string& name, const std::vector<float>& values);
PCL_UVOL_EXPORTS void
setField(Dataset& dataset,
         const std::string& name,
         const std::vector<std::int32_t>& values);
/** @} */

/** \brief Keep the points for which a comparison list holds, e.g. "experiment=1 &&
 * T>=4". Left of =, !=, <, <=, >, >= stands a field expression (see ScalarField), right
 * a number; NaN satisfies nothing but !=. Coordinates compare with the origin added,
 * float32 fields with the float nearest to the number.
 * \return the number of points removed
 * \throws InvalidArgument for a malformed expression or an unknown field */
PCL_UVOL_EXPORTS std::size_t
selectRows(Dataset& dataset, const std::string& where);

/** \brief Write a file so that it appears whole or not at all: the writer gets the name
 * of a temporary file beside it, which is flushed, checked and renamed when the writer
 * returns, and removed when it throws. \throws IOError naming path (not the temporary)
 * when it cannot be created or completed */
PCL_UVOL_EXPORTS void
writeAtomically(const std::string& path,
                const std::function<void(const std::string& temporary_path)>& writer);

} // namespace pcl_uvol
