// SPDX-License-Identifier: BSD-3-Clause
// Samples within closed surfaces, and integrals of their fields over what is enclosed.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/mesh/surface_measures.h>

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A closed mesh as its samples see it. */
struct ClosedMesh {
  std::vector<Eigen::Vector3d> places; ///< of vertices, in the samples' coordinates
  const std::vector<Triangle>& triangles;
  const std::vector<std::int32_t>& piece_of; ///< by vertex
};

/** \brief Fill in `samples` and `inside` of closed pieces; open ones are left as they
 * are.
 * \param pieces with `volume` and `on_surface`, whose means fields have at the surface
 * \param report gets the counts "non_finite" and "duplicates" of the samples and the
 * time of "inside" */
PCL_UVOL_EXPORTS void
measureInside(const ClosedMesh& mesh,
              const CloudView& samples,
              unsigned threads,
              std::vector<PieceMeasures>& pieces,
              Report& report);

/** \brief Add the samples and the inner integrals of a piece to those of several. */
PCL_UVOL_EXPORTS void
addInside(const PieceMeasures& piece, PieceMeasures& all);

} // namespace pcl_uvol::detail
