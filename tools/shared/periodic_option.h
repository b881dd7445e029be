// SPDX-License-Identifier: BSD-3-Clause
// -periodic x,y,z|header: the box that samples repeat in.
#pragma once

#include "neighbors/periodic_box.h"
#include "shared/facts.h"
#include "shared/options.h"
#include <pcl_uvol/common/dataset.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace uvol_tools {

/** \brief The option. */
class PeriodicOption {
public:
  void
  declare(Options& options);

  bool
  isAskedFor() const
  {
    return !text_.empty();
  }

  /** \brief Check the value before any file is read.
   *
   * \throws UsageError */
  void
  check() const;

  /** \brief The sides of the box of a file, 0 without the option. Where a file names a
   * box and the option is not given, a warning says so.
   *
   * \throws InvalidArgument for header where the file names none */
  std::array<double, 3>
  findSides(const pcl_uvol::Dataset& samples, pcl_uvol::Report& report) const;

private:
  std::string text_;
};

/** \brief Add fields to samples while images of them are there.
 *
 * \param sides all 0: without images
 *
 * \param least reach of images beyond the faces, a length */
void
addFieldsInBox(pcl_uvol::Dataset& samples,
               const std::array<double, 3>& sides,
               double least,
               unsigned threads,
               const std::function<void(pcl_uvol::Dataset&)>& add);

/** \brief Tell of the box, for a report.
 *
 * \param origin of the coordinates that the box has */
Fact
describeBox(const pcl_uvol::PeriodicBox& box, const std::array<double, 3>& origin);

/** \brief Samples that have images while a tool works on them. */
class BoxedSamples {
public:
  /** \brief Give samples images; nothing without a box.
   *
   * \param sides all 0: there is no box
   *
   * \param scale of the space that distances are measured in
   *
   * \param report gets the count "images" and what findPeriodicBox() tells */
  BoxedSamples(pcl_uvol::Dataset& samples,
               const std::array<double, 3>& sides,
               const Eigen::Array3f& scale,
               unsigned threads,
               pcl_uvol::Report& report);

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

  /** \brief Leave of points, one for each sample and image, those of samples, at their
   * own places. */
  void
  dropImages(pcl_uvol::Dataset& points);

  /** \brief Add what there is to tell of the box. */
  void
  tell(Facts& facts) const;

private:
  pcl_uvol::Dataset before_;         ///< the samples as they came, where there is a box
  pcl_uvol::PeriodicSamples images_; ///< without the samples, which are the caller's
};

} // namespace uvol_tools
