// SPDX-License-Identifier: BSD-3-Clause
// Samples within closed surfaces, and integrals of their fields over what is enclosed.
#pragma once

#include "common/scalar_field.h"
#include "mesh/box_closure.h"
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
  /** Of the box that it was cut at, and this box in the samples' coordinates; null and
   * with sides of 0 without a box. @{ */
  const BoxClosure* closure = nullptr;
  PeriodicBox box;
  /** @} */
};

/** \brief Count the samples that are beyond the isovalue of each surface, and add up
 * their fields.
 * \param field of the samples that the surfaces are isosurfaces of
 * \param isovalues those without an isovalue are left as they are */
void
sumBeyond(const CloudView& samples,
          const ScalarField& field,
          Outside outside,
          std::vector<PieceMeasures>& isovalues);

/** \brief Fill in `samples` and `inside` of closed pieces; open ones are left as they
 * are.
 * \param pieces with `volume` and `on_surface`, whose means fields have at the surface
 * \param report gets the counts "non_finite" and "duplicates" of the samples and the
 * time of "inside"
 * \return the same of the whole box, if there is one that is periodic along all axes */
PCL_UVOL_EXPORTS PieceMeasures
measureInside(const ClosedMesh& mesh,
              const CloudView& samples,
              unsigned threads,
              std::vector<PieceMeasures>& pieces,
              Report& report);

/** \brief Add the samples and the inner integrals of a piece to those of several.
 * \param times how often */
PCL_UVOL_EXPORTS void
addInside(const PieceMeasures& piece, PieceMeasures& all, int times = 1);

} // namespace pcl_uvol::detail
