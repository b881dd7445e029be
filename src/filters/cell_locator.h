// SPDX-License-Identifier: BSD-3-Clause
// Three-dimensional cells of VTK's data, and whether places are inside of them.
#pragma once

#include "interpolation/sample_cells.h"
#include <pcl_uvol/common/export.h>

#include <vtkSmartPointer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

class vtkDataSet;
class vtkIdTypeArray;
class vtkStaticCellLocator;

namespace pcl_uvol {

/** \brief Solid cells of a mesh, with bins that find those around a place.
 *
 * Memory: of a rectilinear grid its axes; of other meshes 140 bytes per cell besides
 * the mesh. */
class PCL_UVOL_EXPORTS CellLocator : public detail::SampleCells {
public:
  /** \brief The array of cells that has the index of the sample at their centre. Where
   * it is absent, cells are in the order of these samples. */
  static constexpr const char* sample_array = "uvol_sample";

  /** \brief What samples are to the cells. */
  enum class Samples { Corners, Centers };

  /** \param mesh at least one cell, all of them solid; its points are changed
   * \param count number of the samples; 0: whatever samples are used, all cells count
   * \param origin of the samples' coordinates */
  CellLocator(vtkSmartPointer<vtkDataSet> mesh,
              Samples samples,
              std::size_t count,
              const std::array<double, 3>& origin);
  ~CellLocator() override;

  void
  findInside(const std::array<double, 3>* places,
             std::size_t count,
             const std::vector<bool>& used,
             std::uint8_t* inside) const override;

  std::size_t
  size() const override;

private:
  struct Finder;

  void
  normalize();

  bool
  enterBounds(std::array<double, 3>& place) const;

  bool
  areUsed(std::int64_t cell, const std::vector<bool>& used, Finder& finder) const;

  vtkSmartPointer<vtkDataSet> mesh_;
  vtkSmartPointer<vtkStaticCellLocator> locator_; ///< null for rectilinear grids
  vtkSmartPointer<vtkIdTypeArray> sample_of_;     ///< null: as cells are ordered
  Samples samples_;
  std::size_t count_;
  std::array<double, 3> shift_; ///< from the samples' coordinates to the mesh's
  double scale_ = 1.0;          ///< after the shift
  double tolerance_ = 0.0;      ///< in the mesh's coordinates
  std::array<double, 6> bounds_{};
};

} // namespace pcl_uvol
