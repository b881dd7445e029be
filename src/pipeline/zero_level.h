// SPDX-License-Identifier: BSD-3-Clause
// The surface of a level set, with errors of where it is: fits to phi alone tell how
// well they follow phi.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/levelset/level_set_parameters.h>
#include <pcl_uvol/mesh/surface_mesh.h>

#include <optional>
#include <vector>

namespace pcl_uvol {

/** \brief The zero level of a level-set function of samples.
 * \param samples as LevelSetEvolution got them
 * \param phi one per point of the cloud, see LevelSetEvolution
 * \param deviations one per point, see LevelSetEvolution::getDeviations(); without any,
 * errors are NaN: fits to phi know nothing of what became of the samples' noise
 * \param parameters of the isosurface that phi stands for; the surface has its first
 * isovalue
 * \param mesh none: isopoints without triangles
 * \param threads 0: all cores
 * \param report gets the counts and times of IsosurfaceExtraction or SurfaceMesh */
PCL_UVOL_EXPORTS SurfaceTriangles
extractZeroLevel(const CloudView& samples,
                 const std::vector<float>& phi,
                 const std::vector<float>& deviations,
                 const IsosurfaceParameters& parameters,
                 const std::optional<MeshingParameters>& mesh,
                 unsigned threads,
                 Report& report);

/** \brief The zero level of a level set that is not done, with all fields of the
 * samples. Errors are NaN: it is not yet where it will be.
 * \param periodic sides of a box that repeats, whose images are among the samples; 0
 * along axes on which it does not */
PCL_UVOL_EXPORTS Dataset
extractSnapshot(const Dataset& samples,
                const LevelSetParameters& parameters,
                const Eigen::Array3d& periodic,
                const std::vector<float>& phi,
                unsigned threads);

} // namespace pcl_uvol
