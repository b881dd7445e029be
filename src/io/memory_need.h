// SPDX-License-Identifier: BSD-3-Clause
// Bytes of reading a file, as far as its header tells.
#pragma once

#include "common/records.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/io/dataset.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace pcl_uvol {

/** \brief A cloud before it is read. */
struct PCL_UVOL_EXPORTS CloudHeader {
  std::uint64_t points = 0;
  std::size_t point_step = 0; ///< bytes of a point of Dataset::cloud
  double reading_bytes = 0.0; ///< of loadDataset at its peak, the cloud included
  std::optional<double> time; ///< of a snapshot, in the unit of the file
};

/** \brief What the header of a .pcd or .ply file or a snapshot promises. Nothing for
 * text and VTK's files, whose size shows when they are read, and for files that cannot
 * be read or hold less than they promise: reading says what is wrong with them. */
PCL_UVOL_EXPORTS std::optional<CloudHeader>
peekHeader(const std::string& path, const LoadOptions& options = {});

namespace io {

/** \brief Check the memory that reading all records takes, before it begins.
 * \param packed_bytes of compressed points, 0: they are read as a stream
 * \param held_bytes of the source, see RecordSource::heldBytes()
 * \throws NotEnoughMemory
 * \throws InvalidArgument for more points than PCL can number */
void
checkReading(const RecordInfo& info,
             std::uint64_t packed_bytes,
             std::uint64_t held_bytes);

} // namespace io
} // namespace pcl_uvol
