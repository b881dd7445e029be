// SPDX-License-Identifier: BSD-3-Clause
// Points of files that VTK's own readers take, and of files that list others.
#pragma once

#include "io_vtk/packed_cells.h"
#include "io_vtk/point_joiner.h"
#include "io_vtk/vtk_readers.h"

#include <string>

namespace pcl_uvol {
namespace io {

/** \brief True for the endings of Exodus, EnSight, OpenFOAM, and of adaptive meshes and
 * octrees. */
bool
isReadByVtk(const std::string& path);

/** \brief True for the endings of adaptive meshes and octrees, whose samples are always
 * the centres of cells. */
bool
hasCellsOnly(const std::string& path);

/** \brief The points of all blocks at the last time, with the fields that all blocks
 * have; of adaptive meshes and octrees the centres of cells. Centres of cells are read
 * of VTK's XML and legacy files as well.
 *
 * VTK believes what the file says: it reads in a child process with limits.
 *
 * \throws IOError */
VtkContent
readByVtk(const std::string& path, DataPlace place);

/** \brief The solid cells of a file that VTK reads, or of all files of a list, see
 * readByVtk() and readFileList().
 * \return a mesh that is null where there are no such cells
 * \throws IOError */
SolidCells
readSolidCells(const std::string& path);

/** \brief The points of all files that a list names, with the fields that all of them
 * have; of a series over time those of the first time.
 *
 * \throws IOError for a list that names itself, and for one of its files that cannot be
 * read */
VtkContent
readFileList(const std::string& path, DataPlace place);

} // namespace io
} // namespace pcl_uvol
