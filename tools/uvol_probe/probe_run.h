// SPDX-License-Identifier: BSD-3-Clause
// Asks a field at the places of the command line and writes the answers.
#pragma once

#include "interpolation/answer_summary.h"
#include "shared/options.h"
#include "uvol_probe/probe_picture.h"
#include "uvol_probe/query_options.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/interpolation/field_interpolation.h>

#include <array>
#include <optional>
#include <string>

namespace uvol_tools {

/** \brief Samples, the model of their fields, and what it is asked for. */
struct Probe {
  const Options& options;
  const QueryOptions& queries;
  const std::optional<pcl_uvol::detail::Slice>& lattice; ///< none for points
  const ProbePicture& picture;
  PictureSeries* series; ///< that draws slices; null: there is none
  std::string input, output;
  pcl_uvol::LoadOptions load; ///< of the samples and of points like them
  bool ascii;
  const pcl_uvol::Dataset& samples;
  /** The sides of the box that they repeat in, which begins where coordinates do; 0:
   * none. */
  std::array<double, 3> sides;
  const pcl_uvol::InterpolationParameters& parameters;
  const pcl_uvol::detail::FieldInterpolator& interpolator;
};

/** \brief True if the answers go into a file that is written part by part, so that
 * memory does not grow with them. */
bool
isWrittenInParts(const QueryOptions& queries, const std::string& output);

/** \brief Answer all queries, write the file and draw the picture.
 * \param summary gets all answers
 * \return what to tell of the file
 * \throws IOError, InvalidArgument */
Facts
runProbe(const Probe& probe,
         pcl_uvol::detail::AnswerSummary& summary,
         pcl_uvol::Report& report);

} // namespace uvol_tools
