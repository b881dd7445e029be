// SPDX-License-Identifier: BSD-3-Clause
// The samples of uvol_isosurface, with every field that its options ask for.
#pragma once

#include "uvol_isosurface/pipeline_options.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/stage.h>

#include <memory>

namespace uvol_tools {

/** \brief Read the samples, and add densities, formulas and an outer layer.
 *
 * \param arguments get the name of the field that is taken, and the box of samples that
 * repeat
 *
 * \throws IOError, InvalidArgument */
std::shared_ptr<pcl_uvol::Dataset>
loadSamples(const Options& options,
            PipelineOptions& arguments,
            pcl_uvol::Report& report);

/** \brief Check whether the output can hold the fields, before work whose result would
 * be lost.
 *
 * \throws IOError */
void
checkOutput(const PipelineOptions& arguments, const pcl_uvol::Dataset& samples);

} // namespace uvol_tools
