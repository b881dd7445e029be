// SPDX-License-Identifier: BSD-3-Clause
// What the sampling of a cloud is like: samples all around, sheets, lines, or each
// alone; and how far apart they are.
#pragma once

#include <array>
#include <cstdint>

namespace pcl_uvol {

/** \brief What the samples around a sample fill. */
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
