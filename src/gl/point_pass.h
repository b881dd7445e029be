// SPDX-License-Identifier: BSD-3-Clause
// Points to pixels (thesis 4.3.1).
#pragma once

#include "gl/canvas.h"
#include "gl/programs.h"
#include "gl/visible_points.h"

#include <cstdint>

namespace pcl_uvol {

/** \brief Keeps a cloud on the graphics card and projects it. */
class PointPass {
public:
  PointPass(const GlFunctions& gl, Programs& programs);

  bool
  holds(const SurfaceCloud& cloud) const
  {
    return revision_ == cloud.getRevision();
  }

  /** \throws GlError if the cloud has more points than a texture may have texels */
  void
  upload(const SurfaceCloud& cloud);

  /** \brief Choose which discs are drawn as one point: those whose middle may lie
   * beside the canvas and still in the largest viewport there is. To be called before
   * the others, whenever the canvas has changed. */
  void
  fitTo(const Canvas& canvas);

  VisiblePoints
  findVisible(const Frame& frame) const
  {
    return findVisiblePoints(frame, largest_reach_);
  }

  /** \brief The nearest point of every pixel, into the canvas.states[0] of a cleared
   * canvas. */
  void
  draw(const Frame& frame, const VisiblePoints& visible, const Canvas& canvas);

  /** \brief Blend the discs that overlap where they are seen, into canvas.blended.
   * \param states of the pixels, filled */
  void
  blend(const Frame& frame,
        const VisiblePoints& visible,
        const GlName& states,
        const Canvas& canvas);

  /** \brief Packed normal and colour of every point, as a buffer texture. */
  const GlName&
  getLooks() const
  {
    return looks_texture_;
  }

private:
  /** Draw into a framebuffer, with room around it for points in the middle of discs. */
  void
  bind(const Canvas& canvas, const GlName& framebuffer, int targets);

  /** Consecutive attributes from a point on. */
  void
  bindAttributes(std::uint32_t first, GLuint divisor) const;

  /** The radii of the discs that are drawn next. */
  void
  chooseRadii(const GlName& radii);

  /** A program in use, for this frame. */
  const Program&
  use(const shaders::Pass& pass, const std::string& defines, const Frame& frame) const;

  void
  drawPoints(const std::vector<PointRange>& ranges) const;

  void
  drawLargeDiscs(const Program& program, const std::vector<PointRange>& ranges) const;

  void
  drawDiscs(const Frame& frame, const VisibleRanges& ranges, double back) const;

  const GlFunctions& gl_;
  Programs& programs_;
  float usual_reach_;          // of discs that may be drawn as one point, pixels
  float largest_reach_ = 0.0f; // of those that are, on this canvas
  int largest_viewport_;
  PixelBox viewport_{0, 0, 0, 0};
  GlName coordinates_[3], footprints_, fillers_, bends_, rims_,
      looks_;                          // buffers
  const GlName* radii_ = &footprints_; // of the discs drawn next
  GlName looks_texture_, footprints_texture_;
  GlName points_array_, discs_array_;
  bool has_footprints_ = false;
  std::uint64_t revision_ = 0;
};

/** \brief Set those of the uniforms about the camera that a program in use has. */
void
setView(const Program& program, const View& view);

} // namespace pcl_uvol
