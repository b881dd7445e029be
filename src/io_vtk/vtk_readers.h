// SPDX-License-Identifier: BSD-3-Clause
// Points and images of VTK's files, read here: VTK's own readers believe the counts of
// damaged files.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/message.h>

#include <vtkSmartPointer.h>

#include <cstddef>
#include <string>
#include <vector>

class vtkDataSet;

namespace pcl_uvol {
namespace io {

/** \brief What a file holds, and what is left out. */
struct VtkContent {
  vtkSmartPointer<vtkDataSet> data;
  std::vector<Message> notes;
};

/** \brief The points of a .vtp, .vtu or .vts with their data, or the image of a .vti;
 * cells are not looked at.
 * \throws IOError */
VtkContent
readVtkXml(const std::string& path);

/** \brief Hold what a .vtp, .vtu, .vts, .vti or .vtr promises of its points, its cells
 * and their data against the bytes that are there, before VTK's reader believes it.
 * \throws IOError */
PCL_UVOL_EXPORTS void
checkVtkXml(const std::string& path);

/** \brief The same of a .vtk: images and rectilinear grids as such.
 * \throws IOError */
VtkContent
readVtkLegacy(const std::string& path);

/** \brief Hold what a .vtk promises against the bytes that are there, as far as its
 * points are read here.
 * \throws IOError */
PCL_UVOL_EXPORTS void
checkVtkLegacy(const std::string& path);

/** \brief Arrays that points or cells of VTK's files have at most, read or written: VTK
 * compares the name of each with those of all others, which takes 4 s with so many. */
constexpr std::size_t most_vtk_arrays = 20000;

/** \throws IOError for more arrays of a file that is read */
void
checkArrayCount(const std::string& path, std::size_t arrays);

/** \brief The note on an array that holds no numbers. */
Message
describeTexts(const std::string& name);

/** \throws IOError for a lattice without numbers at its points: nothing but memory
 * bounds how many points it has */
void
checkLattice(const std::string& path, vtkDataSet& data);

/** \brief What stands behind DATASET in a .vtk, in lower case.
 * \throws IOError if it is none */
std::string
findLegacyKind(const std::string& path);

} // namespace io
} // namespace pcl_uvol
