// SPDX-License-Identifier: BSD-3-Clause
// Samples for tests of values near a surface.
#pragma once

#include "src/common/random.h"
#include "src/neighbors/sample_set.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace uvol_test {

/** \brief Random samples of the unit cube, with their heights over its middle. */
struct CubeSamples {
  pcl_uvol::SampleSet::ConstPtr samples;
  std::vector<float> heights;

  explicit CubeSamples(std::size_t count)
  {
    std::vector<pcl_uvol::Position> places(count);
    for (std::size_t i = 0; i < count; ++i)
      for (int axis = 0; axis < 3; ++axis)
        places[i][axis] = static_cast<float>(
            pcl_uvol::uniformAt(3, i, static_cast<std::uint64_t>(axis)));
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    pcl_uvol::Report report;
    samples = pcl_uvol::SampleSet::build(
        places[0].x, 3, all, pcl_uvol::Position{{1.0f, 1.0f, 1.0f}}, 1, report);
    const float factor = samples->getUnit().factor;
    for (const pcl_uvol::Position& place : samples->getPositions())
      heights.push_back(place[2] / factor - 0.5f);
  }
};

} // namespace uvol_test
