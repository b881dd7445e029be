// SPDX-License-Identifier: BSD-3-Clause
// Cells whose corners are the samples of a file, in formats that we read ourselves.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Which samples are the corners of cells. */
struct SampleTopology {
  std::uint64_t points = 0; ///< of the file: as many samples

  /** Numbers of samples of lattices, one after another, the first axis fastest. */
  std::vector<std::array<std::uint64_t, 3>> lattices;

  /** \brief Or a list of cells by VTK's types, where each ends in corners, and the
   * samples at these. @{ */
  std::vector<unsigned char> types;
  std::vector<std::uint64_t> ends, corners;
  /** @} */
};

/** \brief The cells of UnstructuredGrid, of the first time, and the lattice of
 * ImageData; none of another type of VTKHDF.
 * \param path of the file, behind which a group may be named
 * \throws IOError */
SampleTopology
readVtkHdfTopology(const std::string& path);

} // namespace io
} // namespace pcl_uvol
