// SPDX-License-Identifier: BSD-3-Clause
// Isosurface extraction from points that need not fit into memory.
#pragma once

#include "common/point_source.h"
#include "distributed/run_stage.h"
#include "isosurface/piece_isopoints.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/point_cloud.h>

#include <cstdint>

namespace pcl_uvol {

/** \brief What IsosurfaceExtraction gives, with the samples it rests on. */
struct PCL_UVOL_EXPORTS OutOfCoreIsosurface {
  pcl::PointCloud<PointIso> isopoints;
  IsoEdges edges;              ///< their ends as indices into samples
  pcl::PCLPointCloud2 samples; ///< the points of the source that edges end at
  StageSamples read;           ///< all points
  SurfaceTally tally;
};

/** \brief The least bound in bytes that extractOutOfCore() takes for that many samples
 * and isovalues. */
PCL_UVOL_EXPORTS std::uint64_t
leastOutOfCoreMemory(std::uint64_t samples, std::size_t isovalues);

/** \brief Extract the isosurface of a field of a source of points, within a bound of
 * memory.
 *
 * The points go to scratch files, and through memory piece by piece, see runOutOfCore.
 * Isopoints are those of IsosurfaceExtraction, byte for byte and in that order. The
 * bound holds for the whole process as long as the isosurface itself is small beside
 * it.
 * \param report gets the counts and times of IsosurfaceExtraction and of runOutOfCore
 * \throws InvalidArgument for an unknown field, a bound that is too small, and without
 * a usable sample
 * \throws IOError for a source that breaks off and a scratch folder that is full or
 * takes no files */
PCL_UVOL_EXPORTS OutOfCoreIsosurface
extractOutOfCore(PointSource& points,
                 const IsosurfaceParameters& settings,
                 const OutOfCoreSettings& out_of_core,
                 Report& report);

/** \brief IsosurfacePipeline within a bound of memory.
 *
 * An empty field is filled in; level sets, an automatic scale and candidates of a
 * Voronoi grid, which need all samples at once, are refused.
 * \param points read from the front
 * \throws as extractOutOfCore and IsosurfacePipeline */
PCL_UVOL_EXPORTS IsosurfaceResult
runPipelineOutOfCore(PointSource& points,
                     const IsosurfacePipelineParameters& parameters,
                     const OutOfCoreSettings& out_of_core,
                     const ProgressCallback& progress);

} // namespace pcl_uvol
