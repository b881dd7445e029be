// SPDX-License-Identifier: BSD-3-Clause
// A block of random samples about the plane z = 0, as the kernels of level sets take
// them.
#pragma once

#include "src/levelset/band.h"
#include "src/levelset/data_term.h"

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace uvol_test {

/** \brief Samples of about spacing 1, and the band around those next to the plane. */
struct PlaneBand {
  pcl_uvol::SampleSet::ConstPtr samples;
  pcl_uvol::Band band;
  double unit;    ///< length 1 in the unit of the samples
  double spacing; ///< in that unit

  /** \param width of the band; 0: all samples
   * \param stretch of the samples' space: places are those in the stretched one */
  PlaneBand(const Eigen::Vector3d& half_sides,
            double width,
            pcl_uvol::FitScheme scheme,
            const pcl_uvol::Position& stretch = {{1.0f, 1.0f, 1.0f}})
  {
    constexpr std::size_t neighbors = 26;
    std::mt19937_64 engine(4);
    const auto count = static_cast<std::size_t>(8.0 * half_sides.prod());
    std::vector<pcl_uvol::Position> places(count);
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    for (pcl_uvol::Position& place : places)
      for (int axis = 0; axis < 3; ++axis)
        place[axis] = static_cast<float>(
            half_sides[axis] * (static_cast<double>(engine() % 65536) / 32768.0 - 1.0) /
            static_cast<double>(stretch[axis]));
    pcl_uvol::Report report;
    samples = pcl_uvol::SampleSet::build(places.front().x, 3, all, stretch, 1, report);
    unit = samples->getScale()[0] / stretch[0];
    std::vector<std::uint32_t> crossing;
    for (std::uint32_t i = 0; i < samples->size(); ++i)
      if (std::abs(place(i)[2]) < 0.8)
        crossing.push_back(i);
    spacing = pcl_uvol::medianSpacing(*samples, crossing, neighbors, 1);
    band = pcl_uvol::makeBand(
        *samples, crossing, width * unit, scheme, neighbors, 1, report);
  }

  /** \brief The place of a sample, in spacings of about 1. */
  Eigen::Vector3d
  place(std::uint32_t sample) const
  {
    const pcl_uvol::Position& x = samples->getPositions()[sample];
    return Eigen::Vector3d(x[0], x[1], x[2]) / unit;
  }

  /** \brief The place of a centre. */
  Eigen::Vector3d
  center(std::size_t i) const
  {
    return place(band.centers[i]);
  }

  /** \brief A function at all samples, in units of length. */
  template <typename Function>
  std::vector<float>
  bySample(const Function& function) const
  {
    std::vector<float> values;
    values.reserve(samples->size());
    for (std::uint32_t i = 0; i < samples->size(); ++i)
      values.push_back(static_cast<float>(unit * function(place(i))));
    return values;
  }

  template <typename Function>
  std::vector<float>
  byPlace(const Function& function) const
  {
    std::vector<float> values(band.places(), 0.0f);
    band.forPlaces([&](std::size_t at, std::uint32_t sample) {
      values[at] = static_cast<float>(unit * function(place(sample)));
    });
    return values;
  }
};

} // namespace uvol_test
