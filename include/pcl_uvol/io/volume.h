// SPDX-License-Identifier: BSD-3-Clause
// Regular scalar volumes, to be resampled at scattered positions as the thesis did
// (2.5).
#pragma once

#include <pcl_uvol/common/export.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Values at the points of an axis-aligned grid. */
struct PCL_UVOL_EXPORTS Volume {
  std::array<std::size_t, 3> dims{};              ///< points per axis
  std::array<double, 3> origin{{0.0, 0.0, 0.0}};  ///< position of point (0, 0, 0)
  std::array<double, 3> spacing{{1.0, 1.0, 1.0}}; ///< distance of points, positive
  std::vector<float> values;                      ///< x runs fastest, then y, then z
  std::string name = "intensity";                 ///< of the scalar

  /** \brief Trilinear interpolation; positions outside are taken to the border.
   * \param position x, y, z in the coordinates of the volume */
  double
  sample(const std::array<double, 3>& position) const;

  /** \brief Position of the last point. */
  std::array<double, 3>
  upper() const;
};

/** \brief True if loadVolume is the one to read that file: by the ending of its name
 * (any case), for .vtk by its header as well.
 * \param path of the file
 * \throws IOError for a .vtk file that cannot be opened */
PCL_UVOL_EXPORTS bool
isVolumeFile(const std::string& path);

/** \brief Read a scalar volume: .nrrd and .nhdr (raw, ascii, gzip), .mha and .mhd (raw,
 * ascii, zipped), both with their data attached, beside them or in slices, .vti, and
 * structured points in .vtk. Axes that descend are turned.
 * \param path of the file
 * \throws IOError in one sentence that names the file, also where the axes are not
 * parallel to x, y and z */
PCL_UVOL_EXPORTS Volume
loadVolume(const std::string& path);

} // namespace pcl_uvol
