// SPDX-License-Identifier: BSD-3-Clause
// The isopoints around one of them.
#pragma once

#include "neighbors/nearest_finder.h"
#include <pcl_uvol/common/point_types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Finds the nearest isopoints of one after another; one object per thread. */
class IsopointSearch {
public:
  /** \param places isopoints in the stretched space; they outlive the search
   * \param count of neighbours, an isopoint among its own */
  IsopointSearch(const SampleSet& places, std::size_t count)
      : places_(places)
      , finder_(places, count)
  {
  }

  /** \return indices into the cloud of the isopoints; valid until the next call */
  const std::vector<std::uint32_t>&
  find(const PointIso& point)
  {
    const auto row =
        finder_.find(places_.getUnit().apply({{point.x, point.y, point.z}}), 1.0f);
    around_.clear();
    for (std::size_t i = 0; i < row.size; ++i)
      around_.push_back(places_.getInputIndex(row.samples[i]));
    return around_;
  }

private:
  const SampleSet& places_;
  NearestFinder finder_;
  std::vector<std::uint32_t> around_;
};

} // namespace pcl_uvol
