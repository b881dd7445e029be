// SPDX-License-Identifier: BSD-3-Clause
// Files that other libraries read, in a process of its own: what ends that one is an
// error of the file.
#pragma once

#include "io_vtk/vtk_readers.h"

#include <cstdint>
#include <functional>
#include <string>

namespace pcl_uvol {
namespace io {

/** \brief Read points in a child process whose time and memory are limited in
 * proportion to the file, and which prints nothing.
 *
 * The child is a copy of the calling thread alone: it may take no locks that other
 * threads hold, and VTK uses no threads in it. Of arrays of texts only a note arrives.
 * Arrays of field data arrive as well: they are numbers.
 *
 * \param bytes of the file, or of all files that belong to it
 * \param read gives vtkPointSet
 * \throws IOError what read throws, and if the child ends by a signal or at a limit */
VtkContent
readInChild(const std::string& path,
            std::uint64_t bytes,
            const std::function<VtkContent()>& read);

} // namespace io
} // namespace pcl_uvol
