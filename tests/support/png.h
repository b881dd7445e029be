// SPDX-License-Identifier: BSD-3-Clause
// Pictures read back.
#pragma once

#include <pcl_uvol/render/renderer.h>

#include <string>

namespace uvol_test {

/** \brief The colours of a PNG file, opaque where it has no opacity; an empty image for
 * anything else.
 * \param channels set to those of the file */
pcl_uvol::Image
readPng(const std::string& path, int& channels);

} // namespace uvol_test
