// SPDX-License-Identifier: BSD-3-Clause
// Isopoints or a mesh, of samples as they are or of level sets.
#pragma once

#include "pipeline/pipeline_input.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_parameters.h>
#include <pcl_uvol/mesh/surface_mesh.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <memory>
#include <optional>
#include <vector>

namespace pcl_uvol {

/** \brief Isopoints, which are vertices without triangles, or a mesh. */
struct ExtractedSurface {
  std::shared_ptr<const Dataset> samples; ///< that edges have the indices of
  SurfaceTriangles triangles;
  std::vector<LevelSetSummary> level_sets; ///< with `smooth`: one per isovalue
  SamplingSummary sampling;
};

/** \brief Extract one isovalue after the other.
 * \param input with the field and the scale that are taken
 * \param extraction of its samples, which keeps its tree
 * \param sampling where it is known already
 * \param threads 0: all cores
 * \param report gets what IsosurfaceExtraction, SurfaceMesh and LevelSetEvolution tell
 * \throws InvalidArgument as these, Diverged as LevelSetEvolution */
ExtractedSurface
extractSurface(const PipelineInput& input,
               IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction,
               const std::optional<SamplingSummary>& sampling,
               unsigned threads,
               Report& report);

} // namespace pcl_uvol
