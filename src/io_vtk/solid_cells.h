// SPDX-License-Identifier: BSD-3-Clause
// The three-dimensional cells of VTK's data, without fields.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <string>
#include <vector>

class vtkDataSet;
class vtkPolyData;

namespace pcl_uvol {
namespace io {

/** \brief Solid cells of a mesh and its points, all of them. */
struct SolidCells {
  vtkSmartPointer<vtkDataSet> mesh; ///< null: there are no points
  vtkIdType samples = 0;            ///< cells whose centres takeCellCenters() gives
};

/** \brief The cells of three dimensions that are not hidden, a copy of another part's,
 * or refined by a finer level. Lattices without such cells stay lattices; other meshes
 * have the array CellLocator::sample_array. Cells without a fixed number of corners
 * become tetrahedra. */
SolidCells
takeSolidCells(vtkDataSet& data);

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
