// SPDX-License-Identifier: BSD-3-Clause
// Pictures larger than what OpenGL draws at once, part by part.
#pragma once

#include "render/image_space/frame.h"
#include "render/image_space/pixel_box.h"
#include <pcl_uvol/render/renderer.h>

#include <vector>

namespace pcl_uvol {

/** \brief A part of a picture, in its pixels: what of it is kept, and what is drawn for
 * that, since passes look around a pixel. */
struct PictureTile {
  PixelBox kept, drawn;
};

/** \brief Tiles that cover a picture.
 * \param largest pixels of a drawn side, at least 256
 * \param overlap pixels drawn beyond what is kept, inside the picture; a quarter of a
 * side at most */
std::vector<PictureTile>
splitPicture(int width, int height, int largest, int overlap);

/** \brief Pixels that the passes of a frame look around a pixel. */
int
findReach(const Frame& frame);

/** \brief The part of a view that a box of its image shows. */
View
cutView(const View& view, const PixelBox& box);

/** \brief The part of a background that a box shows.
 * \param height of the picture */
Background
cutBackground(const Background& background, const PixelBox& box, int height);

/** \brief Copy what a tile keeps of the image drawn for it into a picture whose planes
 * have their sizes. */
void
copyTile(const PictureTile& tile, const Image& drawn, Image& picture);

} // namespace pcl_uvol
