// SPDX-License-Identifier: BSD-3-Clause
// What a backend draws: a cloud as a camera sees it, and the sizes of discs that all
// backends agree on.
#pragma once

#include "render/surface_cloud.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/image_space/backend.h>
#include <pcl_uvol/render/renderer.h>

namespace pcl_uvol {

/** \brief A camera as the passes use it. Camera space: origin in the eye, x right, y
 * down, z forward, so that a point at (x, y, z) lies in the pixel
 * (floor(center_x + focal x / z), floor(center_y + focal y / z)) of the buffers. These
 * are larger than the image by a guard band on every side, so that filters find what is
 * just outside of the image. Lengths are in the unit that chooseLengthUnit() gives for
 * the cloud's bounds, as those of a SurfaceCloud are. */
struct PCL_UVOL_EXPORTS View {
  /** Width of the guard band in pixels. */
  static constexpr int guard = 8;
  /** Largest width and height of an image: buffers, and a texel around them, are
   * textures of at most 16384. */
  static constexpr int largest_size = 16384 - 2 * guard - 2;

  int width, height;        ///< of the image
  int shorter_side;         ///< of the picture, of which the image may be a part
  double unit;              ///< lengths of the cloud times this are those of the view
  float rotation[9];        ///< from cloud to camera space, row by row
  float translation[3];     ///< the cloud's centre in camera space
  float focal;              ///< pixels
  float center_x, center_y; ///< of the image in the buffers, pixels
  float near;               ///< points with a smaller z are not drawn
  float far; ///< distance to the eye with depth 1: beyond every point of the cloud

  /** \throws InvalidArgument for a size that is not in [1, largest_size] or a bad
   * camera */
  View(const Camera& camera,
       const BoundingSphere& bounds,
       int image_width,
       int image_height);

  /** \brief The same view of a part of what it was made for.
   * \param bounds that it was made for
   * \param part bounds of points among these */
  View
  ofPart(const BoundingSphere& bounds, const BoundingSphere& part) const;

  /** \brief The same view in an image whose pixels are that many times as large. Its
   * size is rounded up. */
  View
  coarser(int factor) const;

  int
  bufferWidth() const
  {
    return width + 2 * guard;
  }

  int
  bufferHeight() const
  {
    return height + 2 * guard;
  }
};

/** \brief One frame's work. */
struct PCL_UVOL_EXPORTS Frame {
  const SurfaceCloud& cloud;
  const View& view;
  const ImageSpaceSettings& settings;
  ImagePlanes planes;
  unsigned threads; ///< 0 = all cores

  /** \brief True if points may be discs. */
  bool
  hasFootprints() const
  {
    return settings.footprints && !cloud.getFootprints().empty();
  }

  /** \brief True if points that look away are left out; else they are lit as those
   * that face the eye. */
  bool
  culls() const
  {
    return settings.cull_back_faces && !cloud.isTwoSided();
  }

  /** \brief Points with a disc of a smaller radius, in pixels, are single pixels;
   * blocks of a larger mean radius are sparse: their discs are blended into each other.
   * In the other blocks discs only fill holes: they have the radius of fillers, and lie
   * deeper than their points, so that these stay sharp. */
  float
  smallestDisc() const
  {
    return static_cast<float>(settings.smallest_disc);
  }

  /** \brief True if points of two sides may be drawn side by side. */
  bool
  hasSides() const
  {
    return !culls() && !cloud.isTwoSided();
  }

  /** \brief What makes normals of points with two sides look outwards: -1 or 1. */
  float
  outward() const
  {
    return hasSides() && cloud.isInsideOut() ? -1.0f : 1.0f;
  }

  /** \brief Least distance of two layers as a depth: that of the settings, and with
   * footprints not less than two discs, as these stand out from each other: a disc must
   * not hide behind its own surface, or the layer in front of it grows over it. */
  float
  layerDistance() const;

  /** \brief Where a light is, seen from the eye and in the axes of the cloud; of a
   * directional light the direction it comes from, of any length. */
  Eigen::Vector3d
  lightVector(const Light& light) const;
};

/** \brief Give the planes that a frame wants the size of its image. */
PCL_UVOL_EXPORTS void
resizePlanes(const Frame& frame, Image& image);

/** \brief Points with a larger footprint, in pixels, have all of it where others are
 * fillers: the hole beside them is too large for one disc in its rim, which leaves it
 * half as wide, and the masks close no more than sqrt(2) around its middle. */
constexpr float largest_filler = 2.8f;

/** Discs of a larger radius, in pixels, which are blended, cover the middles of all
 * pixels that show the surface: points have no pixel of their own besides, which would
 * stand out at outlines. Half of a pixel's diagonal. */
constexpr float smallest_cover = 0.7072f;

/** \brief Discs bend as the surface about them does where pictures show it, others are
 * drawn flat, which is faster: the least distance of the surface at the rim of a disc
 * to its plane, in pixels and doubled, and the least square of the turn of its normal,
 * divided by the cosine of the angle to the eye: the outline is not far then. @{ */
constexpr float smallest_bend = 0.2f, smallest_turn = 0.0625f;
/** @} */

/** \brief Discs are blended over so many of their radii: normals and colours then
 * change smoothly from point to point, while the discs themselves stay as large as they
 * are. */
constexpr float blend_reach = 1.5f;

/** \brief How much deeper than it is a disc that looks away lies, in its radii: at
 * outlines, where discs of both sides stand out, the side that faces the eye is seen.
 */
constexpr float away_depth = 1.0f;

/** \brief The weight of a disc that looks to the eye where one is seen that looks away
 * but lies behind it: there discs are flat where the surface turns away, and what is
 * seen around is the side that faces the eye. */
constexpr float facing_weight = 1000.0f;

/** \brief A disc is seen edge-on under a smaller cosine of the angle to its normal. */
constexpr float edge_on_cosine = 0.5f;

/** \brief How far before and behind what is seen such a disc is taken to be, in parts
 * of what it is elsewhere. */
constexpr float facing_reach = 3.0f;

/** \brief How much deeper than its point a filler lies, in radii of its own. */
constexpr float filler_depth = 0.5f;

} // namespace pcl_uvol
