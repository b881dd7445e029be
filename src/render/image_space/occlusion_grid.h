// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion in image space: the cells of the picture that it is found for, and
// where each of them looks for what stands in its light. All backends agree on them.
#pragma once

#include "render/image_space/frame.h"

#include <vector>

namespace pcl_uvol {

/** \brief A cell is a square of pixels, of which the one in the middle is looked at.
 * The higher the surface around it rises over its tangent plane, the less light it
 * gets: below the angle of elevation a lies the part sin a of the sky in a direction,
 * whose largest one counts, as in horizon-based occlusion (Bavoil, Sainz and Dimitrov
 * 2008). Surfaces from a radius on do not count, as rays have it. */
struct PCL_UVOL_EXPORTS OcclusionGrid {
  /** Directions, and steps in each, closer together near the cell: 4 steps miss walls
   * that are seen at a flat angle (RMS to rays 0.09 instead of 0.07). */
  static constexpr int directions = 8, steps = 6;

  /** Sines up to this one are taken for the roughness of discs and normals. */
  static constexpr float least_sine = 0.1f;

  /** Where a direction's step leads, in cells; steps of a direction lie side by side.
   */
  struct Offset {
    int column, row;
  };

  int cell = 0;              ///< pixels
  float per_cell = 0.0f;     ///< one by that
  int columns = 0, rows = 0; ///< cells that cover the buffers
  /** In parts of the distance along the line of sight: as many pixels everywhere. */
  float radius = 0.0f;
  /** In parts of a depth: pixels take no light from cells whose surface lies farther
   * before or behind their own. */
  float tolerance = 0.0f;
  /** How far discs of one surface lie above each other at most, a length. */
  float roughness = 0.0f;
  std::vector<Offset> offsets; ///< empty: the pass is left out

  /** \brief For the buffers of a frame: without offsets where its settings want no
   * occlusion, or where the cloud is too small on the screen. */
  explicit OcclusionGrid(const Frame& frame);

  bool
  isEmpty() const
  {
    return offsets.empty();
  }

  /** \brief Cells that an offset leads aside at most. */
  int
  reach() const;

  /** \brief The pixel in the middle of a cell, in a row or column of the buffers. */
  int
  middle(int index) const
  {
    return index * cell + cell / 2;
  }
};

} // namespace pcl_uvol
