// SPDX-License-Identifier: BSD-3-Clause
// Which side of which surface pixels show: discs of others are not blended into them.
// Plain arrays, no library headers: the file is compiled once per instruction set.
#pragma once

#include "render/image_space/projection_kernel.h"

namespace pcl_uvol {

/** Bits of a side: it looks away; and, of a pixel, its point is seen nearly edge-on, as
 * at outlines. @{ */
constexpr std::uint8_t looks_away_bit = 1, edge_on_bit = 2;
/** @} */

/** \brief Side and surface in one byte. Surfaces whose numbers differ by a multiple of
 * 64 are taken for one.
 * \param color of a look: its opacity is the number of the surface */
constexpr std::uint8_t
sideOf(std::uint32_t color, bool looks_away)
{
  return static_cast<std::uint8_t>(color >> 24 << 2 |
                                   (looks_away ? looks_away_bit : 0u));
}

/** \brief Find the sides of the pixels of a band; those of points that look away and
 * are seen nearly edge-on have that bit as well.
 * \param looks of all points: packed normal, then colour
 * \param sides laid out as the keys; of background any number */
using SideKernel = void (*)(const Projection& projection,
                            const std::uint32_t* looks,
                            const PixelBand& band,
                            std::uint8_t* sides);

namespace baseline {
void
findSides(const Projection&, const std::uint32_t*, const PixelBand&, std::uint8_t*);
}
namespace avx2 {
void
findSides(const Projection&, const std::uint32_t*, const PixelBand&, std::uint8_t*);
}
namespace avx512 {
void
findSides(const Projection&, const std::uint32_t*, const PixelBand&, std::uint8_t*);
}

} // namespace pcl_uvol
