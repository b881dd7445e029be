// SPDX-License-Identifier: BSD-3-Clause
// All passes of image-space rendering, one after the other (thesis 4.3).
#pragma once

#include "gl/fill_pass.h"
#include "gl/gl_backend.h"
#include "gl/occlusion_pass.h"
#include "gl/point_pass.h"
#include "render/image_space/pixel_box.h"

#include <memory>

namespace pcl_uvol {

/** \brief draw() makes colour, opacity and the states of all pixels; what becomes of
 * them is up to finish() or compose(), for the same frame. Times of the passes go to
 * the reports. */
class ImagePasses {
public:
  explicit ImagePasses(const GlFunctions& gl);

  void
  draw(const Frame& frame, Report& report);

  /** \brief Lay it over the background and read it back. */
  void
  finish(const Frame& frame, Image& image, Report& report);

  /** \brief Draw it into somebody's framebuffer. */
  void
  compose(const Frame& frame, const GlFramebuffer& target, Report& report);

  /** \brief Draw an image with depths into somebody's framebuffer, instead of draw()
   * and compose().
   * \param factor by which it is coarser than the view */
  void
  paste(const View& view,
        int factor,
        const Image& image,
        const GlFramebuffer& target,
        Report& report);

private:
  void
  prepareState() const;

  void
  prepareCanvas(const Frame& frame);

  VisiblePoints
  project(const Frame& frame, Report& report);

  void
  fill(const Frame& frame, Report& report);

  /** True if the frame wants light to be occluded. */
  bool
  occlude(const Frame& frame, Report& report);

  void
  shade(const Frame& frame, bool is_occluded);

  void
  uploadLights(const Frame& frame);

  void
  smooth(const ImageSpaceSettings& settings);

  void
  drawLines(const ImageSpaceSettings& settings);

  void
  antiAlias(const ImageSpaceSettings& settings);

  void
  drawOutput(const Frame& frame);

  /** Draw colours and depths of the program that is in use.
   * \param box the part of the view where there are any */
  void
  drawOver(const Program& program,
           const View& view,
           const PixelBox& box,
           const GlFramebuffer& target) const;

  void
  readBack(const Frame& frame, Image& image) const;

  /** Draw the tiles with a surface, and those beside them. */
  void
  paint(const Program& program, const GlName& framebuffer, int targets = 1) const;

  const GlFunctions& gl_;
  Programs programs_;
  PointPass points_;
  FillPass fills_;
  OcclusionPass occlusion_;
  TilePainter painter_;
  GlName full_screen_array_; // without attributes
  NumberTable lights_;
  std::unique_ptr<Canvas> canvas_;
  // of the frame
  TileSet surface_; // tiles with a surface, and those beside them
  int state_ = 0, color_ = 0, normal_ = 0; // which of the canvas's two is valid
  bool with_normals_ = false, with_discs_ = false;
};

} // namespace pcl_uvol
