// SPDX-License-Identifier: BSD-3-Clause
// The first pass: points into pixels (thesis 4.3.1).
#pragma once

#include "render/image_space/pixel_buffer.h"

namespace pcl_uvol {

/** \brief One frame's points on their way into the pixels. Bands of rows are filled by
 * one thread each, so that neither the result nor the order of sums depends on their
 * number. */
class Projector {
public:
  /** \param buffer has the size of the frame's view */
  Projector(const Frame& frame, PixelBuffer& buffer);

  /** \brief Clear the buffer and project all points into it, as pixels and as discs;
   * blocks of points that the image does not show are left out. Sets the buffer's
   * bounds.
   * \param step of the rows of the buffer */
  void
  project(StepTimer& step);

  /** \brief Blend the discs that project() found, where they are seen or nearly so.
   * \param step of the rows of the buffer */
  void
  blend(StepTimer& step);

private:
  struct BlockPlan;

  PixelBand
  bandOf(std::size_t begin, std::size_t end) const;

  /** How the blocks are drawn. */
  std::vector<BlockPlan>
  planBlocks() const;

  /** Project points into a band, the nearest blocks first: what they hide of others is
   * not drawn.
   * \return the discs to be blended, in the order of the points */
  std::vector<std::uint32_t>
  projectBand(const std::vector<BlockPlan>& plans, const PixelBand& band) const;

  /** Project the points of a block.
   * \param discs where those to be blended are appended */
  void
  projectBlock(const BlockPlan& plan,
               const PixelBand& band,
               const float* deepest,
               std::vector<std::uint32_t>& discs) const;

  const Frame& frame_;
  PixelBuffer& buffer_;
  Projection projection_;
  ProjectedPoints points_;
  ProjectionKernel project_;
  const DiscKernels& disc_kernels_;
  std::vector<std::vector<std::uint32_t>> discs_; // to be blended, by band
};

} // namespace pcl_uvol
