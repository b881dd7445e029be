// SPDX-License-Identifier: BSD-3-Clause
// The three-dimensional cells of VTK's data, without fields.
#pragma once

#include <pcl_uvol/common/export.h>

#include <vtkSmartPointer.h>
#include <vtkType.h>

class vtkDataSet;

namespace pcl_uvol {

/** \brief Whether a cell is hidden, a copy of another part's, or refined by a finer
 * level.
 * \param ghost its number in vtkGhostType */
PCL_UVOL_EXPORTS bool
isLeftOut(unsigned char ghost);

/** \brief Solid cells of a mesh and its points, all of them. */
struct SolidCells {
  vtkSmartPointer<vtkDataSet> mesh; ///< null: there are no points
  vtkIdType samples = 0;            ///< cells whose centres takeCellCenters() gives
};

/** \brief The cells of three dimensions that are not hidden, a copy of another part's,
 * or refined by a finer level. Lattices without such cells stay lattices; other meshes
 * have the array CellLocator::sample_array. Cells without a fixed number of corners
 * become tetrahedra. */
PCL_UVOL_EXPORTS SolidCells
takeSolidCells(vtkDataSet& data);

} // namespace pcl_uvol
