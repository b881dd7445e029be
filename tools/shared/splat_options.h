// SPDX-License-Identifier: BSD-3-Clause
// How splats are made, on the command line.
#pragma once

#include "shared/options.h"
#include <pcl_uvol/surface/splat_generation.h>

#include <limits>

namespace uvol_tools {

/** \brief -delta, -delta-abs and -lambda. */
class SplatOptions {
public:
  void
  declare(Options& options);

  /** \brief
   * \throws UsageError if both bounds are given */
  pcl_uvol::SplatParameters
  parameters(const Options& options) const;

  /** \brief True if the command line has one of them. */
  bool
  isGiven(const Options& options) const;

private:
  pcl_uvol::SplatParameters parameters_;
  double length_ = std::numeric_limits<double>::infinity();
};

} // namespace uvol_tools
