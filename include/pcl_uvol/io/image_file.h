// SPDX-License-Identifier: BSD-3-Clause
// Pictures as files.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/image.h>

#include <string>

namespace pcl_uvol {

/** \brief Write the colours of an image as PNG, with opacity where a pixel is not
 * opaque. The file appears whole or not at all.
 * \param path ends in .png
 * \param image with its colours
 * \throws IOError */
PCL_UVOL_EXPORTS void
savePng(const std::string& path, const Image& image);

/** \brief Throw IOError unless the name ends in .png and its folder can be written to:
 * to be called before work whose result would be lost.
 * \param path as savePng() will get it */
PCL_UVOL_EXPORTS void
checkPngPath(const std::string& path);

} // namespace pcl_uvol
