// SPDX-License-Identifier: BSD-3-Clause
// Places among samples that are none themselves.
#pragma once

#include "neighbors/kd_tree.h"

namespace pcl_uvol::detail {

/** \brief A place in the space of the samples. */
struct Query {
  double x[3];

  /** \brief The nearest place in float. */
  Position
  toPosition() const
  {
    return {
        {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])}};
  }
};

/** \brief Squared distance of a query from a sample. */
inline double
sqDistance(const Query& query, const Position& sample)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = query.x[axis] - static_cast<double>(sample[axis]);
    sum += along * along;
  }
  return sum;
}

} // namespace pcl_uvol::detail
