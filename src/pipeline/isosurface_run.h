// SPDX-License-Identifier: BSD-3-Clause
// The steps of an isosurface, the same whether samples are in memory, on disk or on
// many processes.
#pragma once

#include "distributed/run_stage.h"
#include "pipeline/extract_surface.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <memory>

namespace pcl_uvol {

namespace detail {
class FilledGaps;
}

/** \brief Where the samples of a run are. The steps are called in this order. */
class SampleStore {
public:
  SampleStore() = default;
  SampleStore(const SampleStore&) = delete;
  SampleStore&
  operator=(const SampleStore&) = delete;
  virtual ~SampleStore() = default;

  /** \brief Find the field and the scale, and change the space of the samples.
   * \param parameters as given; get what was found
   * \throws InvalidArgument for what takes samples that are not at hand, and for a
   * field of names */
  virtual void
  enter(IsosurfacePipelineParameters& parameters, Report& report) = 0;

  /** \brief Extract the surface, in the space that was entered. */
  virtual ExtractedSurface
  extract(const IsosurfacePipelineParameters& parameters, Report& report) = 0;

  /** \brief Of those who have parts of the surface. */
  virtual Communicator&
  getCommunicator() = 0;

  /** \brief Whether isopoints in gaps that nothing locates are removed: by default
   * with Interpolation::Auto, unless a level set or a mesh keeps them.
   * \param entered parameters that were entered with */
  virtual bool
  removesUnlocated(const IsosurfacePipelineParameters& entered) const;

  /** \brief The gaps that were filled; null if none were. */
  virtual const detail::FilledGaps*
  getGaps() const
  {
    return nullptr;
  }

  /** \brief Bring the surface back from the space that was entered. */
  virtual void
  leave(const IsosurfacePipelineParameters& parameters, IsosurfaceResult& result) = 0;
};

/** \brief Enter, extract, choose isopoints and give them fields, warn, leave.
 * \param threads 0: all cores
 * \throws InvalidArgument as checkParameters, and as the store */
IsosurfaceResult
runIsosurface(SampleStore& store,
              const IsosurfacePipelineParameters& parameters,
              unsigned threads,
              Report&& report);

/** \brief Warn of samples at one place whose values differ, of all processes together.
 * By all of them. */
void
warnOfConflicts(const StageSamples& own, Communicator& communicator, Report& report);

} // namespace pcl_uvol
