// SPDX-License-Identifier: BSD-3-Clause
// Texts in files of XML.
#pragma once

#include <pcl_uvol/common/export.h>

#include <string>

namespace pcl_uvol {
namespace io {

/** \brief A text as the value of an attribute. Bytes that are no UTF-8 are taken for
 * Latin-1; control characters, which XML cannot hold, become '_'. */
PCL_UVOL_EXPORTS std::string
escapeAttribute(const std::string& text);

} // namespace io
} // namespace pcl_uvol
