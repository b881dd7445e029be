// SPDX-License-Identifier: BSD-3-Clause
// The attributes of samples as a table: points of a space of many dimensions
// (thesis 2.6).
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief One row per point that has a finite value of every attribute. */
struct AttributeTable {
  std::vector<std::string> names;    ///< of the columns
  std::vector<float> values;         ///< row by row
  std::vector<std::uint32_t> points; ///< index in the cloud, per row
  /** Per column what was subtracted from the field, and what it was then divided by:
   * 0 and 1 unless standardized. @{ */
  std::vector<double> means{}, units{};
  /** @} */

  std::size_t
  rows() const
  {
    return points.size();
  }

  std::size_t
  columns() const
  {
    return names.size();
  }

  const float*
  row(std::size_t index) const
  {
    return &values[index * columns()];
  }
};

/** \brief Read attributes of a cloud.
 *
 * Attributes that are the same everywhere are left out with a warning, since nothing
 * can be told apart by them. Points that lack one of the others (NaN, infinite) are
 * left out and counted as "missing_values".
 * \param use indices of the points to take
 * \param names fields as in ScalarField: `rho`, `vel[1]`, `|vel|`; `x`, `y`, `z` are
 * attributes as well
 * \param is_standardized subtract the mean of every attribute and divide by its
 * standard deviation, so that units do not count
 * \throws InvalidArgument for an unknown or repeated name, for no names at all, and if
 * no attribute or no point is left */
PCL_UVOL_EXPORTS AttributeTable
readAttributes(const CloudView& cloud,
               const std::vector<std::uint32_t>& use,
               const std::vector<std::string>& names,
               bool is_standardized,
               unsigned threads,
               Report& report);

} // namespace pcl_uvol
