// SPDX-License-Identifier: BSD-3-Clause
// What an isosurface is extracted from, and how: options of the tools that do.
#pragma once

#include "common/options.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/piece_isopoints.h>

#include <sstream>
#include <string>
#include <vector>

namespace uvol_tools {

struct IsosurfaceOptions {
  std::string field, where, scale, outside = "lower", criterion = "kept",
                                   interpolation = "smooth";
  std::vector<double> isovalues, xyz;

  /** \brief -iso, -field, -where, -scale, -xyz, -outside.
   * \param automatic -scale takes auto */
  void
  declareSamples(Options& options, bool automatic = true);

  /** \brief -criterion, -interpolation. */
  void
  declareMethod(Options& options);

  /** \throws UsageError without an isovalue */
  void
  check() const;

  /** \throws UsageError for columns that are none */
  pcl_uvol::LoadOptions
  makeLoadOptions() const;

  /** \brief But for the field and the scale, which depend on the samples. */
  pcl_uvol::IsosurfaceSettings
  makeSettings() const;
};

/** \brief Numbers between commas. */
template <typename T>
std::string
joined(const T& numbers)
{
  std::ostringstream text;
  for (const auto& number : numbers)
    text << (text.tellp() > 0 ? "," : "") << number;
  return text.str();
}

} // namespace uvol_tools
