// SPDX-License-Identifier: BSD-3-Clause
// Pictures with letters over them as PDF, by cairo.
#pragma once

#include "charts/drawing.h"
#include <pcl_uvol/io/image_file.h>

#include <string>
#include <vector>

namespace uvol_tools {

/** \brief A page of the size of a picture, with its pixels and text over them, in fonts
 * of this machine that the page holds.
 * \param texts kept as the subject of the file
 * \param dots_per_inch 0: as on a screen, 96
 * \throws IOError */
std::string
makePdf(const pcl_uvol::Image& image,
        const std::vector<TextLine>& lines,
        const std::vector<pcl_uvol::ImageText>& texts,
        double dots_per_inch);

} // namespace uvol_tools
