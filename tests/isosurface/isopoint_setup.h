// SPDX-License-Identifier: BSD-3-Clause
// Samples with values, as the kernels of isosurface extraction take them.
#pragma once

#include "neighbors/neighbor_candidates.h"
#include "src/isosurface/isopoints.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

namespace uvol_test {

/** \brief Samples at places, and the values of a function there. */
class FieldSamples {
public:
  using Function = std::function<double(const Eigen::Vector3d&)>;

  FieldSamples(const std::vector<pcl_uvol::Position>& places,
               const Function& function,
               const pcl_uvol::Position& scale = {{1.0f, 1.0f, 1.0f}})
  {
    std::vector<std::uint32_t> all(places.size());
    std::iota(all.begin(), all.end(), 0u);
    pcl_uvol::Report report;
    samples_ = pcl_uvol::SampleSet::build(places.front().x, 3, all, scale, 1, report);
    for (std::size_t i = 0; i < samples_->size(); ++i) {
      const pcl_uvol::Position& x = places[samples_->getInputIndex(i)];
      values_.push_back(static_cast<float>(function({x[0], x[1], x[2]})));
      sources_.push_back(static_cast<std::uint32_t>(i));
    }
    ranges_ = samples_->getTree().computeRanges(values_, 1);
    candidates_ = std::make_unique<pcl_uvol::TouchingCells>(*samples_);
  }

  const pcl_uvol::SampleSet&
  samples() const
  {
    return *samples_;
  }

  const std::vector<float>&
  values() const
  {
    return values_;
  }

  /** \brief Edges by sample indices. */
  const std::vector<std::uint32_t>&
  sources() const
  {
    return sources_;
  }

  pcl_uvol::IsopointInput
  input(pcl_uvol::Outside outside, pcl_uvol::Interpolation interpolation) const
  {
    return {*samples_,
            values_,
            ranges_,
            *candidates_,
            pcl_uvol::AngleCriterion::Kept,
            outside,
            interpolation,
            1};
  }

  /** \brief A sample in the coordinates that it was given in. */
  Eigen::Vector3d
  place(std::uint32_t sample) const
  {
    const pcl_uvol::Position& x = samples_->getPositions()[sample];
    const pcl_uvol::Position& scale = samples_->getScale();
    return {static_cast<double>(x[0]) / scale[0],
            static_cast<double>(x[1]) / scale[1],
            static_cast<double>(x[2]) / scale[2]};
  }

private:
  pcl_uvol::SampleSet::ConstPtr samples_;
  std::vector<float> values_;
  std::vector<std::uint32_t> sources_;
  pcl_uvol::NodeRanges ranges_;
  std::unique_ptr<pcl_uvol::TouchingCells> candidates_;
};

} // namespace uvol_test
