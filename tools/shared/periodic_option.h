// SPDX-License-Identifier: BSD-3-Clause
// -periodic x,y,z|header: the box that samples repeat in.
#pragma once

#include "neighbors/samples_in_box.h"
#include "shared/facts.h"
#include "shared/options.h"
#include <pcl_uvol/common/dataset.h>

#include <array>
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
   * \param is_turned whether the tool turns the axes
   *
   * \return the sides as far as they are known: 0 without the option, and for header
   *
   * \throws UsageError */
  std::array<double, 3>
  check(bool is_turned = false) const;

  /** \brief The sides of the box of a file, 0 without the option. Where a file names a
   * box and the option is not given, a warning says so.
   *
   * \throws InvalidArgument for header where the file names none */
  std::array<double, 3>
  findSides(const pcl_uvol::Dataset& samples, pcl_uvol::Report& report) const;

private:
  std::string text_;
};

/** \brief Tell of the box, for a report.
 *
 * \param origin of the coordinates that the box has */
Fact
describeBox(const pcl_uvol::PeriodicBox& box, const std::array<double, 3>& origin);

/** \brief Add what there is to tell of the box of samples, if there is one. */
void
tellBox(const pcl_uvol::SamplesInBox& samples, Facts& facts);

} // namespace uvol_tools
