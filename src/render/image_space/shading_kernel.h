// SPDX-License-Identifier: BSD-3-Clause
// Blinn-Phong shading of the pixels of a row (thesis 4.3.1). Plain arrays, no library
// headers: the file is compiled once per instruction set.
#pragma once

#include "render/image_space/disc_kernel.h"

namespace pcl_uvol {

/** A light in the axes of the points, seen from the eye. */
struct ShadingLight {
  float position[3]; ///< of a directional light the unit direction it comes from
  float color[3];
  bool is_point;
};

/** What shading needs beside the pixels. */
struct Shading {
  const std::uint32_t* looks; ///< per point: packed normal, then colour
  float rotation[9];          ///< from the points' to the camera's directions
  float center_x, center_y, per_focal, far;
  float ambient, diffuse, specular, shininess;
  float least_base; ///< cosines below it make no highlight that can be seen
  const ShadingLight* lights;
  int light_count;
  bool is_lit; ///< false: all white
  bool two_sided;
};

/** Rows of planes to be written, one number per pixel: 0 for background, but depth 1.
 */
struct ShadedRow {
  float* color[3];
  float* opacity; ///< 1 on the surface
  float* depth;
  float* normal[3]; ///< null: not wanted
};

/** \brief Shade count pixels, a multiple of 16, of a row of the buffers from a column
 * on.
 * \param blended of the first pixel, where a segment begins; null without discs */
using ShadingKernel = void (*)(const Shading& shading,
                               const PixelKey* keys,
                               int column,
                               int row,
                               int count,
                               const BlendSums& blended,
                               const ShadedRow& shaded);

namespace baseline {
void
shadeRow(
    const Shading&, const PixelKey*, int, int, int, const BlendSums&, const ShadedRow&);
}
namespace avx2 {
void
shadeRow(
    const Shading&, const PixelKey*, int, int, int, const BlendSums&, const ShadedRow&);
}
namespace avx512 {
void
shadeRow(
    const Shading&, const PixelKey*, int, int, int, const BlendSums&, const ShadedRow&);
}

} // namespace pcl_uvol
