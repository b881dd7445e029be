// SPDX-License-Identifier: BSD-3-Clause
// What most of a surface rests on: samples around it, their border, or nothing between
// lines of samples.
#pragma once

#include "neighbors/periodic_box.h"
#include "pipeline/isopoint_choice.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>
#include <pcl_uvol/pipeline/isosurface_pipeline_parameters.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl_uvol {

/** \brief What a surface stands for, and is said of it where it is not constrained. */
enum class SurfaceRole {
  Isosurface,
  ClusterBorder ///< between the samples of a cluster and the others
};

/** \brief How many isopoints rest on what, of those whose support was examined. */
struct SupportCounts {
  std::size_t examined = 0;
  std::size_t at_border = 0; ///< on a rim, on good fits: no line of samples is there
  /** On other rims, or in gaps that good fits bridge: where samples lie all around, at
   * their border. */
  std::size_t beside_gaps = 0;
  std::size_t unconstrained =
      0;                ///< bridged otherwise, or oriented across a line of samples
  std::size_t thin = 0; ///< of all of these: see findThinParts()
};

/** \brief What isopoints rest on.
 * \param edges of isopoints, with indices into the samples
 *
 * \param is_on_cap 1 for each vertex that closes a mesh, which rests on nothing; empty:
 * there are none
 * \param box outside of which isopoints are images of others */
SupportCounts
findSupportCounts(const pcl::PointCloud<PointIso>& isopoints,
                  const IsoEdges& edges,
                  const IsopointChoice& choice,
                  const std::vector<std::uint8_t>& is_on_cap,
                  const PeriodicBox& box);

/** \brief What those rest on that were examined. */
PCL_UVOL_EXPORTS SupportCounts
findSupportCounts(const SurfaceTally& tally);

/** \brief What the isopoints of all processes rest on. By all of them. */
SupportCounts
addTogether(const SupportCounts& own, Communicator& communicator);

/** \brief A message where most isopoints do not rest on samples around them; else none.
 * \param sampling where samples lie all around, rims are the border of these
 * \param message what to say of a surface that is not constrained, less the "percent"
 * \param have_border false of samples in a box that repeats along all axes:
 * their rims are gaps */
PCL_UVOL_EXPORTS std::optional<Message>
describeWeakSupport(const SupportCounts& counts,
                    const std::optional<SamplingSummary>& sampling,
                    Message message,
                    bool have_border = true);

/** \brief The same of the border of a cluster, which lies somewhere between its samples
 * and the others. */
std::optional<Message>
describeWeakBorder(const SupportCounts& counts);

/** \brief Whether "scale" and "gaps" may help where samples leave much open: what was
 * not asked for. */
std::vector<MessageValue>
listRemedies(const IsosurfacePipelineParameters& parameters);

} // namespace pcl_uvol
