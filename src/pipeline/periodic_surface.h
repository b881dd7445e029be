// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of samples in a box that repeats: what is extracted from samples with
// images, brought back to the box.
#pragma once

#include "neighbors/periodic_box.h"
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <pcl/pcl_base.h>

namespace pcl_uvol {

/** \brief The sides of the box that repeats. */
inline std::array<double, 3>
sidesOf(const IsosurfacePipelineParameters& parameters)
{
  const Eigen::Array3d& sides = parameters.periodic;
  return {{sides[0], sides[1], sides[2]}};
}

/** \brief Samples with the images that the stages need.
 *
 * Isopoints come from a box whose faces lie in the widest gaps between the coordinates,
 * so that they do not depend on where the samples' box was put; meshes, which are cut
 * at its faces, from that box.
 *
 * \param use null: all samples
 *
 * \param parameters with the field and the scale that are taken */
PeriodicSamples
makeImages(const Dataset& samples,
           const pcl::IndicesPtr& use,
           const PeriodicBox& box,
           const IsosurfacePipelineParameters& parameters,
           unsigned threads);

/** \brief The samples to use among those with images. */
pcl::IndicesPtr
indicesWithImages(const PeriodicSamples& images, const pcl::IndicesPtr& use);

/** \brief Bring a surface back to the box: a mesh is cut at its faces, points lie in it
 * already; coordinates and edges become those of the samples.
 *
 * \param box of the samples */
void
returnToBox(const Dataset& samples,
            const PeriodicSamples& images,
            const PeriodicBox& box,
            IsosurfaceResult& result);

} // namespace pcl_uvol
