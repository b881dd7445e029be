// SPDX-License-Identifier: BSD-3-Clause
// Whether neighbours lie on all sides of a point, or leave a wide cone empty, as they
// do beside the border of a cloud or of a gap in it.
#pragma once

#include "neighbors/empty_cone_kernel.h"

namespace pcl_uvol {

/** \brief Looks for the widest cone without neighbours. */
class EmptyCone {
public:
  EmptyCone();

  /** \brief Whether some cone of 57 degrees to its axis holds no neighbour: uniform
   * samples leave no such cone among 40 at 99.8 % of all places.
   * \param x, y, z, count see EmptyConeKernel */
  bool
  isEmpty(float* x, float* y, float* z, std::size_t count) const;

private:
  EmptyConeKernel kernel_;
};

} // namespace pcl_uvol
