// SPDX-License-Identifier: BSD-3-Clause
// What a camera sees of a block of points, as far as the block's bounds tell: what
// backends leave out.
#pragma once

#include "render/image_space/frame.h"
#include "render/image_space/pixel_box.h"
#include <pcl_uvol/common/export.h>

namespace pcl_uvol {

/** \brief A block as the camera sees it. Answers err on the side of what is seen. */
class PCL_UVOL_EXPORTS BlockView {
public:
  BlockView(const Frame& frame, const SurfaceBlock& block);

  /** \brief No point in front of the eye. */
  bool
  isBehindEye() const;

  /** \brief All points look away from the eye: so do those in the middle, by more than
   * the normals spread and the block extends. */
  bool
  looksAway() const;

  /** \brief The discs of the block are blended: see Frame::smallestDisc(). */
  bool
  isSparse() const;

  /** \brief Some disc may reach farther than so many pixels, or touch the eye. */
  bool
  mayHoldDiscs(float pixels) const;

  /** \brief Pixels that points and discs can reach, within the buffers. */
  PixelBox
  box() const;

  /** \brief Distance along the line of sight of the nearest point, discs left out. */
  float
  nearest() const;

private:
  const View& view_;
  float smallest_disc_;
  const SurfaceBlock& block_;
  float center_[3], distance_, disc_radius_;
};

} // namespace pcl_uvol
