// SPDX-License-Identifier: BSD-3-Clause
// The run of uvol_isosurface: samples through the pipeline, in memory or from disk.
#pragma once

#include "shared/facts.h"
#include "uvol_isosurface/pipeline_options.h"
#include <pcl_uvol/pipeline/isosurface_result.h>

namespace uvol_tools {

/** \brief Extract with all samples in memory, and measure the surface where that is
 * asked for.
 *
 * \param arguments get what loadSamples() fills in
 *
 * \param[out] figures of the box that repeats, and of the surface
 *
 * \throws IOError, InvalidArgument, NotEnoughMemory; this names -max-memory if it
 * helps */
pcl_uvol::IsosurfaceResult
runInMemory(const Options& options,
            PipelineOptions& arguments,
            pcl_uvol::Report& report,
            Facts& figures);

/** \brief Extract within -max-memory, while samples wait on disk.
 *
 * \throws IOError, InvalidArgument */
pcl_uvol::IsosurfaceResult
runFromDisk(const Options& options,
            const PipelineOptions& arguments,
            pcl_uvol::Report& report);

} // namespace uvol_tools
