// SPDX-License-Identifier: BSD-3-Clause
// Neighbours of every sample as compressed sparse rows; and what the sampling of a
// cloud is like: samples all around, sheets, lines, or each alone, and how far apart
// they are.
#pragma once

#include <pcl_uvol/common/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Row i holds the neighbours of sample i, sorted by (squared distance, index).
 */
struct PCL_UVOL_EXPORTS NeighborGraph {
  std::vector<std::uint64_t> offsets; ///< one per sample, and the end of the last row
  std::vector<std::uint32_t> indices;

  /** \brief One row, for range-based loops. */
  struct Row {
    const std::uint32_t* first;
    const std::uint32_t* last;

    /** \return The first neighbour. */
    const std::uint32_t*
    begin() const
    {
      return first;
    }

    /** \return One behind the last neighbour. */
    const std::uint32_t*
    end() const
    {
      return last;
    }

    /** \return The number of neighbours. */
    std::size_t
    size() const
    {
      return static_cast<std::size_t>(last - first);
    }
  };

  /** \return The number of samples. */
  std::size_t
  size() const
  {
    return offsets.empty() ? 0 : offsets.size() - 1;
  }

  /** \brief The neighbours of a sample.
   * \param sample below size() */
  Row
  operator[](std::size_t sample) const
  {
    return {indices.data() + offsets[sample], indices.data() + offsets[sample + 1]};
  }
};

/** \brief Dimension of the space that the samples around a sample fill. */
enum class LocalDimension : std::uint8_t {
  Isolated = 0, ///< nothing: the nearest one is far, by its own nearest neighbour
  Line = 1,     ///< a line: a track, a profile, a drill hole
  Sheet = 2,    ///< a surface: slices, layers
  Volume = 3    ///< space
};

/** \brief What a cloud is like as a whole. */
struct SamplingSummary {
  std::array<double, 4> shares{};               ///< of samples, by LocalDimension
  LocalDimension most = LocalDimension::Volume; ///< of them
  float along = 0.0f,
        across =
            0.0f; ///< medians of those of that dimension, in units of
                  ///< the stretched space; across is infinite where nothing lies beside
};

} // namespace pcl_uvol
