// SPDX-License-Identifier: BSD-3-Clause
// -periodic x,y,z|header: the box that samples repeat in.
#pragma once

#include "shared/facts.h"
#include "shared/options.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

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

  /** \brief The sides of the box of a file, 0 without the option.
   *
   * \throws InvalidArgument for header where the file names none */
  std::array<double, 3>
  findSides(const pcl_uvol::Dataset& samples) const;

private:
  std::string text_;
};

/** \brief Tell of the box, for a report. */
Fact
describeBox(const pcl_uvol::SampleBox& box);

} // namespace uvol_tools
