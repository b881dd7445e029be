// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of samples, and drafts of them.
#pragma once

#include "viewer/surface_worker.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <memory>
#include <string>

namespace uvol_tools {

/** \brief Extracts isosurfaces of all samples or of some. Trees and values are kept for
 * the next one: of all samples, and of the last number of them. */
class DraftingPipeline {
public:
  DraftingPipeline(const std::shared_ptr<const pcl_uvol::Dataset>& samples,
                   const std::string& field,
                   unsigned threads);

  /** \param thinning one of so many samples is taken, at random; 1: all */
  pcl_uvol::IsosurfaceResult
  run(const SurfaceRequest& request,
      unsigned thinning,
      const pcl_uvol::ProgressCallback& progress);

private:
  pcl_uvol::IsosurfacePipeline&
  pipelineOf(unsigned thinning);

  std::string field_;
  pcl_uvol::IsosurfacePipeline whole_;
  pcl_uvol::IsosurfacePipeline draft_;
  unsigned thinning_ = 1; ///< of draft_; 1: it has no samples yet
};

} // namespace uvol_tools
