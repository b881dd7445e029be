// SPDX-License-Identifier: BSD-3-Clause
// The samples of one of several processes, with images of them where their box repeats.
#pragma once

#include "distributed/run_stage.h"
#include "isosurface/piece_isopoints.h"
#include "neighbors/periodic_box.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_uvol {

/** \brief The points of a process: its samples, and behind them their images, if the
 * box repeats.
 *
 * There are two ways to number those of all processes. As sources of samples all
 * samples come first and all images follow, as on one process: of samples that coincide
 * the same one stands for all then. As points those of a process lie together, so that
 * fetchPoints() finds them. Without images both are the same. */
class PartInBox {
public:
  /** \param part samples of this process
   *
   * \param parameters with the field that is taken
   *
   * \param report gets the count "images" of this process, and what findPeriodicBox()
   * and addPeriodicImages() tell */
  PartInBox(const std::shared_ptr<const Dataset>& part,
            const IsosurfacePipelineParameters& parameters,
            Communicator& communicator,
            unsigned threads,
            Report& report);

  const Dataset&
  getPoints() const
  {
    return *points_;
  }

  /** \brief The number of the first point of this process. */
  std::uint64_t
  getFirstPoint() const
  {
    return own_firsts_[rank_] + image_firsts_[rank_];
  }

  /** \brief From sources to points. */
  void
  numberByPoints(std::vector<std::vector<GlobalIsopoint>>& isopoints) const;

  /** \brief The samples that the points make, see readSamples(). */
  Samples
  readSamples(const ScalarField& field,
              const ValueFrame& frame,
              unsigned threads,
              Report& report) const;

  /** \brief Bring a surface of these points back to the box of the samples, and leave
   * images out of the counts. All processes call it together.
   * \param read samples and images of this process */
  void
  finish(const StageSamples& read,
         Communicator& communicator,
         IsosurfaceResult& result) const;

private:
  /** How many places the images of all processes lie in. */
  std::uint64_t
  countAllPlaces(Communicator& communicator) const;

  std::uint64_t
  toSource(std::uint64_t point) const;

  std::uint64_t
  toPoint(std::uint64_t source) const;

  std::shared_ptr<const Dataset> part_, points_;
  PeriodicBox box_, cut_; ///< of the samples, and of the points
  std::size_t rank_;
  /** Numbers of the first ones of each process, see findFirstIndices. */
  std::vector<std::uint64_t> own_firsts_, image_firsts_;
};

} // namespace pcl_uvol
