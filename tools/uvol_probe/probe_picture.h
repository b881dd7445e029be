// SPDX-License-Identifier: BSD-3-Clause
// The picture of a field along a line or in a plane.
#pragma once

#include "charts/axes.h"
#include "charts/paper.h"
#include "interpolation/query_lattice.h"
#include "shared/color_options.h"
#include "shared/options.h"
#include "shared/picture_series.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/stage.h>

#include <string>
#include <vector>

namespace uvol_tools {

/** \brief -png, and what it is drawn by. */
class ProbePicture {
public:
  void
  declare(Options& options);

  /** \brief To be called before any file is read.
   * \param is_plane, is_line what is drawn; of other queries there is no picture
   * \param paper of the picture
   * \throws UsageError, and IOError for a path that is none */
  void
  finish(const Options& options, bool is_plane, bool is_line, const Paper& paper);

  bool
  isAskedFor() const
  {
    return !path_.empty();
  }

  /** \brief Draw a field along a line.
   * \param distances, values, errors per point */
  void
  drawLine(const std::string& field,
           const std::vector<double>& distances,
           const std::vector<double>& values,
           const std::vector<double>& errors) const;

  /** \brief Draw a field in a plane.
   *
   * \param values in the order of the lattice
   *
   * \param of_samples range of the samples' values
   *
   * \param series that draws it with its other slices; null: it is drawn now
   *
   * \param report warns of values that have no colour */
  void
  drawSlice(const std::string& field,
            const pcl_uvol::detail::Slice& slice,
            const std::vector<float>& values,
            const AxisScale& of_samples,
            const pcl_uvol::Dataset& samples,
            PictureSeries* series,
            pcl_uvol::Report& report) const;

private:
  std::string path_, unit_;
  ColorOptions colors_;
  Paper paper_;
  std::vector<double> contours_;
  double near_ = -1.0; ///< samples so near to the plane are drawn
};

} // namespace uvol_tools
