// SPDX-License-Identifier: BSD-3-Clause
// A level set from a data set to the samples with phi: what every front end runs.
#pragma once

#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/interpolation/cross_validation.h>
#include <pcl_uvol/levelset/level_set_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

namespace pcl_uvol {

/** \brief What is asked for. */
struct LevelSetRequest {
  /** An empty field stands for the only candidate. Shapes to start from have the
   * coordinates that Dataset::origin counts in. */
  LevelSetParameters level_set;
  std::array<double, 3> periodic{}; ///< sides of the box that repeats; 0: it does not
  bool automatic_scale = false;     ///< by how fast the field changes, see chooseScale
  std::size_t snapshots = 0;        ///< steps from one to the next; 0: there are none

  /** \return What is the job's and not the level set's, for options. */
  static auto
  listMembers()
  {
    using Own = LevelSetRequest;
    return std::make_tuple(
        Member{"snapshots",
               &Own::snapshots,
               {"write the zero level every so many steps, as out_00010.ply", 1, 1e6}});
  }
};

/** \brief What comes of it. */
struct PCL_UVOL_EXPORTS SmoothedSamples {
  Dataset samples;          ///< those that were taken, with the field phi
  LevelSetParameters taken; ///< as asked for, with the field and the scale
  LevelSetSummary summary;
  SamplingSummary sampling;
  std::optional<ScaleChoice> scale_choice;
  std::optional<SampleBox> box; ///< that the samples repeat in
  Report report;                ///< of LevelSetEvolution, and with a box "images"
};

/** \brief Gets the surface after some steps, with all fields of the samples. */
using SurfaceCallback = std::function<void(std::size_t steps, Dataset surface)>;

/** \brief Check what can be checked without samples.
 * \throws InvalidArgument for a box that repeats and a rotation */
PCL_UVOL_EXPORTS void
checkRequest(const LevelSetRequest& request);

/** \brief Find the field and the scale, give samples in a box images, evolve the level
 * set, and warn where its surface lies between lines of samples.
 * \param use points to take; null: all. With a box that repeats it is null.
 * \param show_surface called after every request.snapshots steps
 * \throws InvalidArgument as checkRequest(), for fields of names, and as
 * LevelSetEvolution
 * \throws Diverged as LevelSetEvolution */
PCL_UVOL_EXPORTS SmoothedSamples
runLevelSet(const std::shared_ptr<const Dataset>& samples,
            const pcl::IndicesPtr& use,
            const LevelSetRequest& request,
            const SurfaceCallback& show_surface,
            unsigned threads,
            const ProgressCallback& progress);

} // namespace pcl_uvol
