// SPDX-License-Identifier: BSD-3-Clause
// Samples that have images while somebody works on them, and give them up afterwards.
#pragma once

#include "neighbors/periodic_box.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>

namespace pcl_uvol {

/** \brief Samples of a box that repeats, with images beyond its faces. */
class PCL_UVOL_EXPORTS SamplesInBox {
public:
  /** \brief Give samples images; nothing without a box.
   *
   * \param samples become those with images
   *
   * \param sides all 0: there is no box
   *
   * \param scale of the space that distances are measured in
   *
   * \param report gets the count "images" and what warnOfUnusedBox() and
   * findPeriodicBox() tell */
  SamplesInBox(Dataset& samples,
               const std::array<double, 3>& sides,
               const Eigen::Array3f& scale,
               unsigned threads,
               Report& report);

  /** \brief The same for samples of others, which are copied only if there is a box. */
  SamplesInBox(std::shared_ptr<const Dataset>& samples,
               const std::array<double, 3>& sides,
               const Eigen::Array3f& scale,
               unsigned threads,
               Report& report);

  /** \brief The samples that are no images come first. */
  std::size_t
  countOwn() const
  {
    return before_.cloud.width;
  }

  bool
  isPeriodic() const
  {
    return pcl_uvol::isPeriodic(images_.box.sides);
  }

  /** \brief The box, whose low corner is where coordinates begin. */
  const std::array<double, 3>&
  getSides() const
  {
    return images_.box.sides;
  }

  /** \brief The box in coordinates of the samples as they came. @{ */
  const PeriodicBox&
  getBox() const
  {
    return images_.box;
  }

  const std::array<double, 3>&
  getOrigin() const
  {
    return before_.origin;
  }
  /** @} */

  /** \brief Leave of points, one for each sample and image, those of samples, at their
   * own places. */
  void
  dropImages(Dataset& points);

private:
  Dataset before_;         ///< the samples as they came, where there is a box
  PeriodicSamples images_; ///< without the samples, which are the caller's
};

} // namespace pcl_uvol
