// SPDX-License-Identifier: BSD-3-Clause
// Samples seen along the axes that their space is stretched along.
#pragma once

#include "common/stretch_axes.h"
#include "pipeline/pipeline_input.h"
#include <pcl_uvol/pipeline/isosurface_result.h>

namespace pcl_uvol {

/** \brief Turns the samples of a pipeline, and its surface back. */
class TurnedAxes {
public:
  /** \param input gets turned samples and no rotation, if it has one */
  explicit TurnedAxes(PipelineInput& input);

  /** \brief Turn the surface back. */
  void
  leave(IsosurfaceResult& result) const;

private:
  detail::StretchAxes axes_;
};

} // namespace pcl_uvol
