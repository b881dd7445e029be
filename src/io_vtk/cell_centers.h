// SPDX-License-Identifier: BSD-3-Clause
// Cells of VTK's data as samples.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkDataSet;
class vtkHyperTreeGrid;

namespace pcl_uvol {
namespace io {

/** \brief Cells whose corners are points, as many as their types need, and arrays as
 * long as they have to be: VTK looks at none of it.
 * \throws IOError */
void
checkCells(const std::string& path, vtkDataSet& data);

/** \brief The centres of cells with the data of cells, without those that are hidden,
 * are copies of another part's, or are refined by a finer level of an adaptive mesh. */
vtkSmartPointer<vtkPolyData>
takeCellCenters(vtkDataSet& data);

/** \brief The same of the leaves of octrees. */
vtkSmartPointer<vtkPolyData>
takeCellCenters(vtkHyperTreeGrid& trees);

} // namespace io
} // namespace pcl_uvol
