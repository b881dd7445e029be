// SPDX-License-Identifier: BSD-3-Clause
// Cells of a mesh that samples are the corners or the centres of: where there are
// cells, they say where the data are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Decides which places are inside of cells. */
class SampleCells {
public:
  SampleCells() = default;
  SampleCells(const SampleCells&) = delete;
  SampleCells&
  operator=(const SampleCells&) = delete;
  virtual ~SampleCells() = default;

  /** \brief Find out which places are inside of a cell, or on its border, whose samples
   * are all used. Any number of threads may ask at once.
   * \param places in the coordinates of the samples
   * \param count of places
   * \param used by index of the samples
   * \param inside 1 or 0 per place */
  virtual void
  findInside(const std::array<double, 3>* places,
             std::size_t count,
             const std::vector<bool>& used,
             std::uint8_t* inside) const = 0;

  /** \brief Number of cells. */
  virtual std::size_t
  size() const = 0;
};

} // namespace pcl_uvol::detail
