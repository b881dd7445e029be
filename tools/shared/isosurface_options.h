// SPDX-License-Identifier: BSD-3-Clause
// What an isosurface is extracted from, and how: options of the tools that do.
#pragma once

#include "shared/options.h"
#include "shared/point_files.h"
#include "shared/scale_option.h"
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief Options that fill the parameters of the pipeline. */
struct IsosurfaceOptions {
  pcl_uvol::IsosurfacePipelineParameters parameters;

  /** \brief -iso, -field, -where, -scale, -rotate, -xyz, -particles, -cells,
   * -outside.
   *
   * \param automatic -scale finds factors, and there is -rotate
   *
   * \param need when -iso is needed */
  void
  declareSamples(Options& options,
                 bool automatic = true,
                 const std::string& need = "required");

  /** \brief -criterion, -interpolation. */
  void
  declareMethod(Options& options);

  /** \brief Complete the parameters by what has been parsed.
   * \throws UsageError without an isovalue, and for a scale that is none */
  void
  finish(const Options& options);

  /** \brief Complete the parameters by what is found from the places of samples. */
  void
  resolveSpacing(const pcl_uvol::Dataset& samples);

  const ScaleOption&
  getScale() const
  {
    return scale_;
  }

  /** \throws UsageError for columns that are none */
  pcl_uvol::LoadOptions
  makeLoadOptions() const;

  const std::string&
  getWhere() const
  {
    return input_files_.getWhere();
  }

private:
  ScaleOption scale_;
  InputOptions input_files_;
};

/** \brief Numbers between commas, with the digits that a double keeps of a text. */
template <typename T>
std::string
joined(const T& numbers)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::digits10);
  for (const auto& number : numbers)
    text << (text.tellp() > 0 ? "," : "") << number;
  return text.str();
}

} // namespace uvol_tools
