// SPDX-License-Identifier: BSD-3-Clause
// Files of points, and what is promised of those that are read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace uvol_fuzz {

/** \brief A file of that name in a folder of this thread, which goes at its end. */
std::string
fileNamed(const std::string& name);

/** \brief Bytes as the file of that name.
 * \return its path */
std::string
writeFile(const std::string& name, const std::uint8_t* bytes, std::size_t size);

/** \brief Each open file takes half a megabyte, which the library of HDF5 else gives
 * back and fetches anew: a quarter of the time. Within an Hdf5Session. */
void
keepMemoryOfHdf5();

/** \brief Reads points, whole and as a stream.
 * \param path of the file, which may name something within it
 * \throws BrokenPromise */
void
readPoints(const std::string& path, bool has_stream);

/** \brief Reads a mesh, whose triangles have vertices.
 * \throws BrokenPromise */
void
readMesh(const std::string& path);

/** \brief Reads a volume, which has a value per point.
 * \throws BrokenPromise */
void
readVolume(const std::string& path);

} // namespace uvol_fuzz
