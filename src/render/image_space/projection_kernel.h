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
  const float* spacings; ///< null: no footprints
};

/** Numbers per pixel that overlapping discs are blended into: weighted sums of normal
 * and colour (0 to 255), the sum of the weights, and one to fill a power of two. */
constexpr int blended_values = 8;

/** A view, and which points are seen. */
struct Projection {
  float rotation[9], translation[3];
  float eye[3]; ///< in the coordinates of the points
  float focal, center_x, center_y, near, per_far;
  bool cull_back_faces;
  bool two_sided; ///< normals are turned to the eye
  float footprint_radius, smallest_footprint, smallest_blended; ///< see backend.h
};

/** Points that projectPoints takes at once, at most. */
constexpr std::size_t projected_points = 256;

/** \brief One instruction set's versions. */
struct ProjectionKernels {
  /** \brief Put points into their own pixels.
   * Small discs are drawn as well.
   * \param discs indices of those that are larger discs; room for projected_points
   * \return their number */
  std::size_t (*projectPoints)(const Projection& projection,
                               const ProjectedPoints& points,
                               std::uint32_t begin,
                               std::uint32_t end,
                               const PixelBand& band,
                               std::uint32_t* discs);

  /** \brief Put a disc into all pixels whose centre it covers. */
  void (*drawDisc)(const Projection& projection,
                   const ProjectedPoints& points,
                   std::uint32_t point,
                   const PixelBand& band);

  /** \brief Add a disc to all pixels it covers where it lies in front of, or at most
   * its radius behind, what is seen there. \param color of the point, packed
   * \param blended of the pixel of the band's first key, in the band's stride */
  void (*blendDisc)(const Projection& projection,
                    const ProjectedPoints& points,
                    std::uint32_t point,
                    std::uint32_t color,
                    const PixelBand& band,
                    float* blended);
};

namespace baseline {
extern const ProjectionKernels projection_kernels;
}
namespace avx2 {
extern const ProjectionKernels projection_kernels;
}
namespace avx512 {
extern const ProjectionKernels projection_kernels;
}

} // namespace pcl_uvol
