// SPDX-License-Identifier: BSD-3-Clause
// Solid cells of several meshes as one, and on their way to another process.
#pragma once

#include "filters/solid_cells.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkPolyData;

namespace pcl_uvol {
namespace io {

/** \brief All cells of several meshes, their points and samples one after another. */
SolidCells
joinSolidCells(const std::vector<SolidCells>& parts);

/** \brief Cells as points with arrays in the field data, for another process. */
vtkSmartPointer<vtkPolyData>
packCells(const SolidCells& cells);

/** \brief The same cells.
 * \throws IOError where arrays contradict each other */
SolidCells
unpackCells(const std::string& path, vtkPolyData& packed);

} // namespace io
} // namespace pcl_uvol
