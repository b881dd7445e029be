// SPDX-License-Identifier: BSD-3-Clause
// Pictures as files.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/renderer.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief A keyword of at most 79 characters, such as "Software", and its text. */
using ImageText = std::pair<std::string, std::string>;

/** \brief The bytes of an image as a PNG file, with opacity where a pixel is not
 * opaque.
 * \param image with its colours
 * \param texts kept in it, for those who ask where the picture is from
 * \param dots_per_inch that the file says it is printed with; 0: it says nothing
 * \throws InvalidArgument for an image without pixels, or dots per inch that are not 0
 * and not 1 to 1e6 */
PCL_UVOL_EXPORTS std::vector<std::uint8_t>
encodePng(const Image& image,
          const std::vector<ImageText>& texts = {},
          double dots_per_inch = 0.0);

/** \brief Write the colours of an image as PNG, with opacity where a pixel is not
 * opaque. The file appears whole or not at all.
 * \param path ends in .png
 * \param image with its colours
 * \param texts kept in the file, for those who ask where the picture is from
 * \param dots_per_inch that the file says it is printed with; 0: it says nothing
 * \throws IOError, and InvalidArgument as encodePng() */
PCL_UVOL_EXPORTS void
savePng(const std::string& path,
        const Image& image,
        const std::vector<ImageText>& texts = {},
        double dots_per_inch = 0.0);

/** \brief Throw IOError unless the name ends in .png and its folder can be written to:
 * to be called before work whose result would be lost.
 * \param path as savePng() will get it */
PCL_UVOL_EXPORTS void
checkPngPath(const std::string& path);

} // namespace pcl_uvol
