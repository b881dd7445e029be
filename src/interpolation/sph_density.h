// SPDX-License-Identifier: BSD-3-Clause
// Densities of particles that come without one.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/interpolation/interpolation_parameters.h>

#include <array>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Smoothing lengths h of particles, as Price (2012) has them: the cubic spline
 * ends at 2 h. */
struct SphLengths {
  double constant = 0.0; ///< of all particles, in units of length; 0: by the field
  double factor = 1.0;   ///< of the numbers in the field, where a code means another h
};

/** \brief Density at every particle, the sum of m_j W(|x_i - x_j|, h_i) over all of
 * them (Price 2012, equation 1, with the length of the particle itself), in masses per
 * cube of the unit of length; not a number where the position is not finite.
 *
 * Coinciding particles count with the sum of their masses.
 *
 * \param parameters kernel, fields of masses and lengths, and k
 *
 * \param report gets the counts and times of the samples
 *
 * \throws InvalidArgument for an unknown field, and for a cloud without a finite point
 */
PCL_UVOL_EXPORTS std::vector<double>
computeSphDensity(const CloudView& cloud,
                  const SphParameters& parameters,
                  const SphLengths& lengths,
                  unsigned threads,
                  Report& report);

/** \brief The fields of masses and smoothing lengths among those of a cloud, by the
 * names that are usual in files; "" for one that is not there. */
PCL_UVOL_EXPORTS SphParameters
findSphFields(const std::vector<pcl::PCLPointField>& fields);

/** \brief What the numbers of a field of that name are times: Gadget, AREPO and GIZMO
 * (HSML, SmoothingLength) give the end of the kernel, SWIFT (SmoothingLengths) a length
 * of which the cubic spline ends at 1.825742 (Dehnen and Aly 2012). */
PCL_UVOL_EXPORTS double
lengthFactorOf(const std::string& field);

/** \brief Add the field sph_density to a dataset, of the fields of masses and lengths
 * with usual names. Without masses it counts particles per volume, and warns of that.
 *
 * \param length one smoothing length of all particles, in units of length; 0: by the
 * field, else by neighbours
 *
 * \param sides of the box that the samples repeat in, 0 along an axis for none
 *
 * \param report gets the step "density" and warnings
 *
 * \throws InvalidArgument for a length that is negative or not finite, if there is a
 * field of that name, and as computeSphDensity does */
PCL_UVOL_EXPORTS void
addSphDensity(Dataset& dataset,
              double length,
              unsigned threads,
              Report& report,
              const std::array<double, 3>& sides = {});

} // namespace pcl_uvol
