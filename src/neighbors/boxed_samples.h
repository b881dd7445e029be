// SPDX-License-Identifier: BSD-3-Clause
// Samples in the box that they repeat in, and the images that neighbours need: for
// those who hold all samples, and for those who hold a part.
#pragma once

#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl_uvol {

/** \brief An image of a sample: how many sides away, per axis. */
struct PeriodicImage {
  std::uint32_t sample;
  std::array<std::int8_t, 3> shift;
};

/** \brief How many samples there are in a box, and how far they spread. */
struct SampleSpread {
  std::uint64_t count = 0;
  SampleExtents extents;
};

/** \brief Samples in their box, whose images are wanted. */
class PCL_UVOL_EXPORTS BoxedSamples {
public:
  /** \param use samples that get images; those without a finite place get none */
  BoxedSamples(const CloudView& cloud,
               const std::vector<std::uint32_t>& use,
               const PeriodicBox& box,
               const Position& scale);

  /** \brief Samples that get images. */
  const std::vector<std::uint32_t>&
  getUsed() const
  {
    return use_;
  }

  /** \brief The place of a sample in the box, counted from its low corner, and that of
   * an image of one. @{ */
  const Position&
  getPlace(std::size_t sample) const
  {
    return places_[sample];
  }

  Position
  getPlace(const PeriodicImage& image) const;
  /** @} */

  /** \brief Distance from a sample to the nearest face, in the stretched space. */
  float
  getDepth(std::uint32_t sample) const;

  /** \brief Measure the spread of the samples that get images. */
  SampleSpread
  measureSpread() const;

  /** \brief Mean spacing in the stretched space.
   *
   * \param spread of all samples, where these are a part */
  double
  getSpacing(const SampleSpread& spread) const;

  /** \brief The shortest side in the stretched space: images reach no farther. */
  double
  getShortestSide() const;

  /** \brief The images that lie no farther from the box than a reach, in the order of
   * their samples. */
  std::vector<PeriodicImage>
  findImages(double reach, unsigned threads) const;

  /** \brief Samples with these images. */
  PeriodicSamples
  addImages(const Dataset& samples, double reach, unsigned threads) const;

private:
  /** Infinite where the box does not repeat. */
  double
  getSide(std::size_t axis) const;

  void
  appendImages(std::uint32_t sample,
               double reach,
               std::vector<PeriodicImage>& found) const;

  PeriodicBox box_;
  Position scale_;
  std::vector<Position> places_;
  std::vector<std::uint32_t> use_;
};

/** \brief How far images reach beyond the faces: some spacings at first, and farther
 * until all neighbours that are asked for are there, to a whole box at most.
 *
 * \param spread of all samples, of which these may be a part
 *
 * \param measure_need how far beyond the faces neighbours lie where images have that
 * reach; more than the reach where they do not suffice */
PCL_UVOL_EXPORTS double
findReach(const BoxedSamples& samples,
          const SampleSpread& spread,
          const PeriodicReach& reach,
          const std::function<double(double reach)>& measure_need);

} // namespace pcl_uvol
