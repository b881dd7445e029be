// SPDX-License-Identifier: BSD-3-Clause
// What the passes draw into.
#pragma once

#include "gl/objects.h"
#include "render/image_space/frame.h"
#include "render/image_space/pixel_box.h"

namespace pcl_uvol {

/** \brief Pixels along a side of the largest image that OpenGL has textures and
 * viewports for. */
int
findLargestImage(const GlFunctions& gl);

/** \brief Textures for one size of image, and framebuffers over them. Two of a kind
 * are read and written in turn. */
class Canvas {
public:
  /** What not every frame needs. */
  struct Options {
    bool normals, discs;
  };

  /** \throws GlError if the driver has no textures of this size */
  Canvas(const GlFunctions& gl, const View& view, const Options& options);

  /** \brief True if it serves for a frame as well as a new one. */
  bool
  fits(const View& view, const Options& options) const
  {
    return view.width == image_width_ && view.height == image_height_ &&
           (options_.normals || !options.normals) && (options_.discs || !options.discs);
  }

  int
  getWidth() const
  {
    return width_;
  }

  int
  getHeight() const
  {
    return height_;
  }

  /** \brief Texels of the buffers; those around them stay background. */
  PixelBox
  getBuffers() const;

  /** \brief Everything is background. */
  void
  clear() const;

  /** \brief Draw into the buffers of a framebuffer of this size.
   * \param targets colour attachments */
  void
  bind(const GlName& framebuffer, int targets = 1) const;

  GlName depth;           ///< of the projection
  GlName states[2];       ///< of every pixel: bits of the depth, index of the point
  GlName row_changes;     ///< one texel per row of a tile
  GlName changes;         ///< one texel per tile
  GlName blended_normals; ///< sums over discs, and of their weights
  GlName blended_colors;  ///< sums over discs
  GlName colors[2];       ///< premultiplied; opacity
  GlName normals[2];      ///< and depth
  GlName silhouettes;     ///< strength
  GlName image;           ///< of the size of the image
  // Framebuffers
  GlName projected; ///< states[0], depth
  GlName filled[2]; ///< states
  GlName compared;  ///< row_changes
  GlName collected; ///< changes
  GlName blended;   ///< blended_normals, blended_colors
  GlName shaded[2]; ///< colors, normals
  GlName outlined;  ///< silhouettes
  GlName finished;  ///< image

private:
  const GlFunctions& gl_;
  int image_width_, image_height_;
  int width_, height_; // texels
  Options options_;
};

} // namespace pcl_uvol
