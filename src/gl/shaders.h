// SPDX-License-Identifier: BSD-3-Clause
// The passes of image-space rendering in GLSL 3.30.
//
// Textures are larger than the buffers of a view by a margin of one texel, which stays
// background, so that every pixel has eight neighbours. Row 0 is the top of the image.
#pragma once

#include <array>

namespace pcl_uvol::shaders {

/** Texels around the buffers. */
constexpr int margin = 1;

/** \brief Parts of a shader, one after the other; null if there are fewer. */
using Source = std::array<const char*, 4>;

/** \brief A vertex and a fragment shader. */
struct Pass {
  Source vertex, fragment;
};

/** What goes before every shader: the above, and how numbers are packed. */
extern const char* const prelude;

/** \brief Vertex shaders: boxes of tiles, one triangle over everything. @{ */
extern const char* const tiles;
extern const char* const full_screen;
/** @} */

// point_shaders.cpp. Nearest point of every pixel: bits of the depth, index.
extern const Pass points;      ///< without discs
extern const Pass small_discs; ///< and all other points. WITH_PIXELS
extern const Pass large_discs;
// Sums over discs near what is seen: normal, weight; colour. BLENDED
extern const Pass blend_small;
extern const Pass blend_large;

// fill_shaders.cpp. OCCLUDED: surfaces behind others, else background.
extern const Pass fill;
/** One texel per row of a tile, per tile: has an iteration changed it? TILE: its size.
 */
extern const Pass row_changes;
extern const Pass tile_changes;

// shading_shaders.cpp. Colour, opacity; WITH_NORMALS: normal, depth as well. LIT,
// WITH_DISCS, WITH_OCCLUSION.
extern const Pass shade;

// occlusion_shaders.cpp. By cells: position and depth, normal; openness and depth.
extern const Pass place_cells;
extern const Pass open_cells;
extern const char* const occlusion_constants;

// filter_shaders.cpp
extern const Pass smooth; ///< WITH_NORMALS
extern const Pass silhouettes;
extern const Pass lines; ///< WITH_SILHOUETTES, WITH_FEATURES
extern const Pass anti_alias;

// output_shaders.cpp
extern const Pass output;    ///< IS_TRANSPARENT
extern const Pass composite; ///< OF_IMAGE: of colours and depths of an image

} // namespace pcl_uvol::shaders
