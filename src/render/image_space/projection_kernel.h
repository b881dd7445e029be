// SPDX-License-Identifier: BSD-3-Clause
// Projection of points into the pixels of a band (thesis 4.3.1). Plain arrays, no
// library headers: the file is compiled once per instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_uvol {

/** Depth and point of a pixel: the bits of the depth, a positive float, in the upper
 * half, the point's index in the lower. Of two keys the smaller one is in front. */
using PixelKey = std::int64_t;

/** Infinitely far, no point. */
constexpr PixelKey background_key = 0x7f800000ffffffff;

/** The pixels of some rows of the buffers. */
struct PixelBand {
  PixelKey* keys;        ///< of the first row of the buffers
  std::ptrdiff_t stride; ///< keys from row to row
  int width;
  int first_row, last_row; ///< half-open range
};

/** The points of a SurfaceCloud. */
struct ProjectedPoints {
  const float* x[3];
  const std::uint32_t* normals;
  const float* radii;         ///< of their discs; null: no footprints
  const float* footprints;    ///< radii where these are too large for a filler
  const std::uint32_t* bends; ///< of the surface over the footprints, packed
  const std::uint32_t* rims;  ///< lines where footprints end, packed
  float stretch;              ///< discs may reach so many of their radii
  float smallest_cover;       ///< larger discs replace the pixel of a point, in pixels
};

/** A view, and which points are seen. */
struct Projection {
  float rotation[9], translation[3];
  float eye[3]; ///< in the coordinates of the points
  float focal, center_x, center_y, near, per_far;
  bool cull_back_faces;
  bool two_sided;   ///< normals are turned to the eye
  float outward;    ///< factor that makes normals look outwards
  bool has_sides;   ///< discs that look away are others
  float away_depth; ///< how much deeper these are drawn, in radii
  /** Discs that look to the eye over points that look away, lie behind them and are
   * seen under a smaller cosine: their weight, and how far they reach, in parts of what
   * others do. @{ */
  float edge_on_cosine, facing_weight, facing_reach;
  /** @} */
  float smallest_footprint, largest_filler, smallest_bend,
      smallest_turn; ///< in pixels: see frame.h
};

/** Points that projectPoints takes at once, at most. */
constexpr std::size_t projected_points = 256;

/** \brief Put points into their own pixels.
 * \param deepest what is seen in each cell of the band so far, where all of it shows
 * something, as DiscKernels::findDeepest gives it; null: nothing yet
 * \param discs indices of those that are discs and may be seen; room for
 * projected_points
 * \return their number */
using ProjectionKernel = std::size_t (*)(const Projection& projection,
                                         const ProjectedPoints& points,
                                         std::uint32_t begin,
                                         std::uint32_t end,
                                         const PixelBand& band,
                                         const float* deepest,
                                         std::uint32_t* discs);

namespace baseline {
std::size_t
projectPoints(const Projection&,
              const ProjectedPoints&,
              std::uint32_t,
              std::uint32_t,
              const PixelBand&,
              const float*,
              std::uint32_t*);
}
namespace avx2 {
std::size_t
projectPoints(const Projection&,
              const ProjectedPoints&,
              std::uint32_t,
              std::uint32_t,
              const PixelBand&,
              const float*,
              std::uint32_t*);
}
namespace avx512 {
std::size_t
projectPoints(const Projection&,
              const ProjectedPoints&,
              std::uint32_t,
              std::uint32_t,
              const PixelBand&,
              const float*,
              std::uint32_t*);
}

} // namespace pcl_uvol
