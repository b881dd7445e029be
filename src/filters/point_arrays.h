// SPDX-License-Identifier: BSD-3-Clause
// What conversion to a cloud makes of each array of VTK data.
#pragma once

#include <pcl_uvol/common/dataset.h>

#include <vtkAbstractArray.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <vector>

class vtkDataSet;

namespace pcl_uvol {

/** \brief An array of numbers, and the first of its fields in the cloud: one field, or
 * three for normals. */
struct PointArray {
  vtkSmartPointer<vtkAbstractArray> array;
  std::size_t first_field;
  std::size_t fields;
};

/** \brief Points of VTK data with their arrays. */
struct PointArrays {
  Dataset dataset; ///< notes tell of arrays that nothing can be made of
  std::vector<PointArray> numbers;
  /** Strings and variants, one tuple per point, which no cloud can hold. */
  std::vector<vtkSmartPointer<vtkAbstractArray>> others;
};

/** \brief See toPointCloud. */
PointArrays
collectPoints(vtkDataSet& data);

} // namespace pcl_uvol
