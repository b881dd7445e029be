// SPDX-License-Identifier: BSD-3-Clause
// The samples that may bound the Voronoi cell of a place.
#pragma once

#include "neighbors/query.h"
#include "neighbors/sample_set.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

struct NearestKernels;

namespace detail {

/** \brief Samples around one place after another, for those who cut out its cell. */
class CellSearch {
public:
  static constexpr std::uint32_t no_sample = 0xffffffffu;

  /** \brief Nearest samples to begin with: of random ones all that bound a cell are
   * nearly always among them, and none farther out has to be ruled out. */
  static constexpr std::size_t usual_near = 64;

  /** \param samples must outlive the search */
  explicit CellSearch(const SampleSet& samples);

  /** \brief Begin with a place.
   * \param own the sample at the place, or no_sample
   * \param near samples to begin with, at least one */
  void
  start(const Query& place,
        std::uint32_t own,
        const std::uint32_t* near,
        std::size_t count);

  /** \brief The samples to begin with, nearest first, but for rounding to float. */
  const std::vector<std::uint32_t>&
  getNear() const
  {
    return near_;
  }

  /** \brief No other sample than the near ones has a smaller squared distance. */
  double
  getSqKnown() const
  {
    return sq_known_;
  }

  /** \brief Half the side of a cube about the place that is far larger than all cells
   * but those next to the convex hull. */
  double
  getHalfSide() const;

  /** \brief A sample seen from the place. */
  Eigen::Vector3d
  offsetOf(std::uint32_t sample) const;

  /** \brief Find the sample nearest to a vertex of the cell, relative to the place, if
   * one is nearer than the place: it cuts the vertex off. */
  bool
  findInBall(const Eigen::Vector3d& vertex, std::uint32_t& found) const;

private:
  const SampleSet& samples_;
  const NearestKernels* kernels_;
  Query place_{};
  std::uint32_t own_ = no_sample;
  std::vector<std::uint64_t> by_distance_; ///< distances before samples, as bits
  std::vector<std::uint32_t> near_;
  double sq_known_ = 0.0;
};

} // namespace detail

} // namespace pcl_uvol
