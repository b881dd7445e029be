// SPDX-License-Identifier: BSD-3-Clause
// Blocks of VTK's data as one: their points, the centres of their cells, or their
// cells.
#pragma once

#include "io_vtk/packed_cells.h"
#include "io_vtk/vtk_readers.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <set>
#include <string>
#include <vector>

class vtkDataObject;

namespace pcl_uvol {
namespace io {

/** \brief What is read: points, the centres of cells, or solid cells without fields. */
enum class DataPlace { Points, Cells, Solids };

/** \brief All points, or centres of cells, or cells, behind one another. */
class PointJoiner {
public:
  PointJoiner(const std::string& path, DataPlace place);

  /** \brief Add data, or all blocks of them.
   * \throws IOError for cells that are damaged */
  void
  add(vtkDataObject& object);

  /** \brief Add points that were made of a file. */
  void
  addPoints(vtkPolyData& points);

  bool
  isEmpty() const
  {
    return blocks_.empty() && solids_.empty();
  }

  /** \return cells packed, see packCells()
   * \throws IOError without a point */
  VtkContent
  join() const;

private:
  std::string path_;
  DataPlace place_;
  std::vector<vtkSmartPointer<vtkPolyData>> blocks_;
  std::vector<SolidCells> solids_;
  std::set<std::string> names_;
};

} // namespace io
} // namespace pcl_uvol
