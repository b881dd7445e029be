// SPDX-License-Identifier: BSD-3-Clause
// Which of several tables with names hold the coordinates.
#pragma once

#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Fields of more numbers per point are left out. */
constexpr std::uint64_t most_table_components = 64;

/** \brief A table of numbers, a row per point. */
struct NumberTable {
  std::string name;
  std::uint64_t rows, components;
};

/** \brief The table of positions, three numbers a row, or the three tables of x, y and
 * z of one length, by usual names; none if they are not there. */
PCL_UVOL_EXPORTS std::vector<std::size_t>
findPositionTables(const std::vector<NumberTable>& tables);

/** \brief "x, y, z or Coordinates, positions, pos". */
extern const char* const usual_position_names;

} // namespace io
} // namespace pcl_uvol
