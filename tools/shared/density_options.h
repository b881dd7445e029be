// SPDX-License-Identifier: BSD-3-Clause
// Densities of particles that come without one, as an option.
#pragma once

#include "shared/options.h"
#include <pcl_uvol/common/dataset.h>

#include <array>

namespace uvol_tools {

/** \brief -density and -density-length. */
class DensityOptions {
public:
  void
  declare(Options& options);

  bool
  isAskedFor() const
  {
    return is_asked_for_;
  }

  /** \brief Add the field sph_density, if it is asked for.
   *
   * \param periodic sides of the box that the samples repeat in, 0 along an axis for
   * none
   *
   * \throws UsageError for a length without -density */
  void
  addField(pcl_uvol::Dataset& dataset,
           unsigned threads,
           pcl_uvol::Report& report,
           const std::array<double, 3>& periodic = {}) const;

private:
  bool is_asked_for_ = false;
  double length_ = 0.0;
};

} // namespace uvol_tools
