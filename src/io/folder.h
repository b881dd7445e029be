// SPDX-License-Identifier: BSD-3-Clause
// What lies in a folder.
#pragma once

#include <pcl_uvol/common/export.h>

#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Names of the files and folders in a folder, in no order; none of one that
 * cannot be read.
 * \throws std::bad_alloc, where iterators of std::filesystem end the program */
PCL_UVOL_EXPORTS std::vector<std::string>
listFolder(const std::string& path);

} // namespace io
} // namespace pcl_uvol
