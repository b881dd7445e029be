// SPDX-License-Identifier: BSD-3-Clause
// Fields at places between the samples, and how far the samples carry them.
#pragma once

#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointCloud2.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief What an interpolated value rests on. The first three are those of IsoSupport.
 */
enum class FieldSupport : std::uint8_t {
  Measured = 1, ///< samples all around
  Bridged = 2,  ///< in a gap of the sampling: samples around, but far
  Rim = 3,      ///< beside a wide cone without samples: border of a gap or of the cloud
  Outside = 4,  ///< beside such a cone and far from the samples, or beyond their convex
                ///< hull where the model ends there: no value unless extrapolated
  Reduced = 5,  ///< samples all around that do not determine the model, as on few
                ///< planes: a simpler one
  Invalid = 6   ///< no place: the coordinates are not finite, or too far out
};

/** \brief Fields at queries. */
struct PCL_UVOL_EXPORTS InterpolatedFields {
  std::vector<std::string> names; ///< of the fields
  std::size_t size = 0;           ///< queries
  std::vector<double> values;     ///< [field][query], in units of the field; NaN: none
  std::vector<double> errors;     ///< [field][query], standard errors of the values;
                                  ///< NaN where the model tells none; empty if not
                                  ///< asked for
  std::vector<double> gradients;  ///< [field][query][axis], field / length; empty if
                                  ///< not asked for
  std::vector<FieldSupport> support; ///< [query]

  /** \brief A value, in units of the field; NaN: none.
   * \param field index into names
   * \param query below size */
  double
  getValue(std::size_t field, std::size_t query) const
  {
    return values[field * size + query];
  }

  /** \brief A standard error, in units of the field; NaN where the model
   * tells none. Errors must have been asked for.
   * \param field index into names
   * \param query below size */
  double
  getError(std::size_t field, std::size_t query) const
  {
    return errors[field * size + query];
  }

  /** \brief A gradient, in units of the field per length. Gradients must
   * have been asked for.
   * \param field index into names
   * \param query below size */
  std::array<double, 3>
  getGradient(std::size_t field, std::size_t query) const
  {
    const double* const gradient = &gradients[3 * (field * size + query)];
    return {gradient[0], gradient[1], gradient[2]};
  }
};

/** \brief Append interpolated fields to the points they were asked for: `rho`
 * (float64), `rho_error` (float64), `rho_gradient` (3 x float64), as far as there are,
 * and `support` (uint8, a FieldSupport). Where the points have a field of such a name
 * already, `rho_2`, `rho_2_error` and so on are appended.
 * \param fields as interpolate() gives them
 * \param points those that were asked for, in their order
 * \return the names of the appended fields
 * \throws InvalidArgument unless there is a value per point */
PCL_UVOL_EXPORTS std::vector<std::string>
appendFields(const InterpolatedFields& fields, pcl::PCLPointCloud2& points);

} // namespace pcl_uvol
