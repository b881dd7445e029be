// SPDX-License-Identifier: BSD-3-Clause
// The options of uvol_isosurface: files, and parameters of the whole pipeline.
#pragma once

#include "distributed/run_stage.h"
#include "shared/density_options.h"
#include "shared/isosurface_options.h"
#include "shared/periodic_option.h"
#include "uvol_isosurface/mesh_options.h"
#include "uvol_isosurface/surface_picture.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief What the command line asks for. */
struct PipelineOptions : IsosurfaceOptions {
  std::string input, output;
  bool ascii = false;
  SurfacePicture picture;
  DensityOptions density;
  PeriodicOption periodic;

  void
  declare(Options& options);

  /** \brief Fill in the parameters that were declared, once the options are parsed.
   * \throws UsageError for combinations that are not allowed
   * \throws IOError for an output that cannot be written */
  void
  finish(const Options& options);

  /** \brief Whether something asks for all samples at once. */
  bool
  needsAllSamples() const;

  const MeshOptions&
  getMesh() const
  {
    return mesh_;
  }

  /** \brief The bound of memory, and where samples wait.
   * \throws UsageError */
  pcl_uvol::OutOfCoreSettings
  makeOutOfCoreSettings(const Options& options) const;

private:
  /** Names of the given options that need all samples at once. */
  std::vector<std::string>
  listNeedingAllSamples() const;

  void
  checkCombinations(const Options& options) const;

  MeshOptions mesh_;
  double outside_value_ = std::numeric_limits<double>::quiet_NaN(); ///< none
  std::string max_error_, max_memory_, scratch_, validate_by_ = "random";
  std::uint64_t grid_ = 0, k_ = parameters.normal_neighbors;
};

} // namespace uvol_tools
