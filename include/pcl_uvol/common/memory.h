// SPDX-License-Identifier: BSD-3-Clause
// Refuse work that does not fit into memory before it begins.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstdint>
#include <string>

namespace pcl_uvol {

/** \brief Bytes that can be taken without swapping; the largest number where the system
 * does not tell. */
PCL_UVOL_EXPORTS std::uint64_t
availableMemory();

/** \brief "1.6 GB": two digits, in powers of 1000. */
PCL_UVOL_EXPORTS std::string
formatBytes(double bytes);

/** \brief \param what as a subject: "A grid of 9 x 9 x 9 cells"
 * \throws InvalidArgument with both figures if more is needed than is available */
PCL_UVOL_EXPORTS void
checkMemory(const std::string& what, double bytes);

} // namespace pcl_uvol
