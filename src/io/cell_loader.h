// SPDX-License-Identifier: BSD-3-Clause
// The cells of a file as what says where its data are.
#pragma once

#include "interpolation/sample_cells.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/io/dataset.h>

#include <memory>
#include <string>

namespace pcl_uvol {

/** \brief Read the three-dimensional cells of a file of VTK, Exodus, EnSight, OpenFOAM
 * or PLOT3D, or of a list of such files, without its fields.
 *
 * VTK's own readers do it, in a child process with limits; cells of PLOT3D and .vtkhdf
 * are read by ours and have the samples at their corners.
 * \param options that the samples were read with
 * \param samples of the same file
 * \return null for a file of another format, a packed one, one without such cells, and
 * samples on a map
 * \throws IOError */
PCL_UVOL_EXPORTS std::shared_ptr<const detail::SampleCells>
loadCells(const std::string& path, const LoadOptions& options, const Dataset& samples);

/** \brief The same; cells that cannot be read are null and a warning. */
PCL_UVOL_EXPORTS std::shared_ptr<const detail::SampleCells>
findCells(const std::string& path,
          const LoadOptions& options,
          const Dataset& samples,
          Report& report);

} // namespace pcl_uvol
