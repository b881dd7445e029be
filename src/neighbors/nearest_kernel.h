// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of NearestFinder. Plain arrays, no library headers: the file is
// compiled once per instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_uvol {

/** Arrays that a kernel writes have room for that many elements more than it keeps. */
constexpr std::size_t kernel_room = 16;

/** \brief Samples, coordinate by coordinate. */
struct CopiedSamples {
  float *x, *y, *z;
  std::uint32_t* indices;
};

/** \brief One instruction set's versions. */
struct NearestKernels {
  /** \brief Append those of the positions begin to end (x, y, z one after another) that
   * lie within a squared distance of a closed box.
   * \return their number */
  std::size_t (*keepNear)(const float* positions,
                          std::uint32_t begin,
                          std::uint32_t end,
                          const float* low,
                          const float* high,
                          float sq_limit,
                          const CopiedSamples& kept);

  /** \brief sq_dist[i] = squared distance of (x, y, z)[i] to the point. */
  void (*measure)(const float* x,
                  const float* y,
                  const float* z,
                  std::size_t count,
                  const float* point,
                  float* sq_dist);

  /** \brief The same of the positions begin to end (x, y, z one after another). */
  void (*measureRun)(const float* positions,
                     std::uint32_t begin,
                     std::uint32_t end,
                     const float* point,
                     float* sq_dist);

  /** \brief Number of values up to a limit. */
  std::size_t (*countWithin)(const float* values, std::size_t count, float limit);

  /** \brief Copy values up to a limit, and the index beside each, in their order;
   * returns their number. */
  std::size_t (*keepWithin)(const float* values,
                            const std::uint32_t* indices,
                            std::size_t count,
                            float limit,
                            float* kept_values,
                            std::uint32_t* kept_indices);
};

namespace baseline {
extern const NearestKernels nearest_kernels;
}
namespace avx2 {
extern const NearestKernels nearest_kernels;
}
namespace avx512 {
extern const NearestKernels nearest_kernels;
}

} // namespace pcl_uvol
