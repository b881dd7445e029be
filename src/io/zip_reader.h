// SPDX-License-Identifier: BSD-3-Clause
// What lies in a zip (PKWARE, APPNOTE.TXT 6.3): stored as it is or packed by deflate.
#pragma once

#include "io/files.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief A file in a zip: bytes of the zip itself, or of a temporary file where it was
 * packed. */
struct ZipPart {
  std::string name;
  std::shared_ptr<const InputFile> file;
  std::uint64_t offset, bytes;
};

/** \brief The files with that ending in a zip.
 *
 * \throws IOError */
std::vector<ZipPart>
openZip(const std::string& path, const std::string& ending);

} // namespace io
} // namespace pcl_uvol
