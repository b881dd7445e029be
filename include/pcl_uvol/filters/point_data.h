// SPDX-License-Identifier: BSD-3-Clause
// VTK data as clouds and clouds as VTK data, with every array.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointCloud2.h>
#include <vtkSmartPointer.h>

class vtkDataSet;
class vtkPolyData;

namespace pcl_uvol {

/** \brief The points of VTK data as a cloud, with every array of theirs that holds
 * numbers, under its own name, type and number of components.
 *
 * The active normals become normal_x, normal_y, normal_z; arrays without a name are
 * called array_0, array_1, ... by their place; bits become uint8. Points of images and
 * rectilinear grids are computed. Notes name what a cloud cannot hold and is left out:
 * arrays of strings or variants, or of another number of tuples.
 * \param data with points
 * \throws InvalidArgument for null, for coordinates beyond float and for more points
 * than PCL can number */
PCL_UVOL_EXPORTS Dataset
toPointCloud(vtkDataSet* data);

/** \brief A cloud as VTK data: a vertex per point, an array per field; normal_x,
 * normal_y, normal_z become the active normals, called Normals. Coordinates are double
 * if they were, or have an origin.
 * \param dataset with x, y, z as float32
 * \throws InvalidArgument unless x, y, z are float32 and the data is complete */
PCL_UVOL_EXPORTS vtkSmartPointer<vtkPolyData>
fromPointCloud(const Dataset& dataset);

/** \brief The same for a cloud of any layout; fields of equal names are renamed.
 * \param cloud with x, y, z
 * \throws InvalidArgument without x, y, z, for coordinates beyond float, and for
 * incomplete data */
PCL_UVOL_EXPORTS vtkSmartPointer<vtkPolyData>
fromPointCloud(const pcl::PCLPointCloud2& cloud);

} // namespace pcl_uvol
