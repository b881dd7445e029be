// SPDX-License-Identifier: BSD-3-Clause
// What searches in a metric spend their time on. Plain arrays, no library headers: the
// file is compiled once per instruction set.
#pragma once

#include <cstddef>

namespace pcl_uvol {

/** Numbers that are compared at once: arrays of lines have a multiple of it. */
constexpr std::size_t line_lanes = 8;

/** \brief A linear map: the rows of its matrix. */
struct MetricRows {
  double row[3][3];
};

/** \brief Corners of two boxes, side by side. */
struct BoxPair {
  double low[3][2], high[3][2];
};

/** \brief What bounds of boxes are made from. */
struct MetricBounds {
  MetricRows rows;         ///< of the metric, at right angles
  double per_sq_extent[3]; ///< per axis, 1 / of the ball of radius 1 in the metric
};

/** \brief Second moments: xx, xy, xz, yy, yz, zz. */
struct MetricMoments {
  double lengths[6], directions[6];
};

/** \brief One instruction set's versions. */
struct MetricKernels {
  /** \brief Find squared distances from a point, as the images of positions (x, y, z
   * one after another) have them.
   * \return the least of them */
  double (*measure)(const float* positions,
                    std::size_t count,
                    const float* point,
                    const MetricRows& metric,
                    double* sq_dists);

  /** \brief Find squared distances that no point of a box is nearer than.
   * \param boxes as seen from the point */
  void (*findBounds)(const BoxPair& boxes,
                     const MetricBounds& metric,
                     double* sq_bounds);

  /** \brief Add the lines from one place to its natural neighbours.
   * \param x, y, z offsets to the samples
   * \param sq_lengths of them; infinite where there is none; used up
   * \param count a multiple of line_lanes
   * \param sq_cosine of the angle around a line within which there is no other */
  void (*addLines)(const float* x,
                   const float* y,
                   const float* z,
                   float* sq_lengths,
                   std::size_t count,
                   float sq_cosine,
                   MetricMoments& moments);
};

namespace baseline {
extern const MetricKernels metric_kernels;
}
namespace avx2 {
extern const MetricKernels metric_kernels;
}
namespace avx512 {
extern const MetricKernels metric_kernels;
}

} // namespace pcl_uvol
