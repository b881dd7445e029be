// SPDX-License-Identifier: BSD-3-Clause
// The options of uvol_cluster.
#pragma once

#include "shared/attribute_options.h"
#include "shared/options.h"
#include "shared/scale_option.h"

#include <cstdint>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief What the command line asks for. */
struct ClusterOptions {
  ScaleOption scale;
  std::string input, output, label, tree, surface, probability, smoothing;
  AttributeOptions attributes;
  InputOptions reading;
  std::uint64_t k = 10, min_size = 0, grid = 128;
  double cut = 0.0, distance = 0.0;
  std::vector<double> cluster;
  bool single = false, ascii = false;

  void
  declare(Options& options);

  /** \brief Check the combination, once the options are parsed.
   *
   * \throws UsageError for what is not allowed
   *
   * \throws IOError for an output that cannot be written */
  void
  finish(const Options& options);

  /** \brief Whether the surface of the cluster is made of triangles. */
  bool
  isMesh() const
  {
    return !surface.empty() && surface != "membership";
  }
};

} // namespace uvol_tools
