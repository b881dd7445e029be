// SPDX-License-Identifier: BSD-3-Clause
#include "io/position_tables.h"

#include <algorithm>

namespace pcl_uvol {
namespace io {
namespace {

constexpr const char* position_names[] = {"Coordinates",
                                          "Positions",
                                          "Position",
                                          "positions",
                                          "position",
                                          "pos",
                                          "xyz",
                                          "Points",
                                          "points"};
constexpr const char* split_names[][3] = {
    {"x", "y", "z"}, {"X", "Y", "Z"}, {"px", "py", "pz"}};

} // namespace

const char* const usual_position_names = "x, y, z or Coordinates, positions, pos";

std::vector<std::size_t>
findPositionTables(const std::vector<NumberTable>& tables)
{
  const auto find = [&](const char* name, std::uint64_t components) {
    const auto found =
        std::find_if(tables.begin(), tables.end(), [&](const NumberTable& table) {
          return table.name == name && table.components == components;
        });
    return static_cast<std::size_t>(found - tables.begin());
  };
  for (const char* const name : position_names)
    if (const std::size_t table = find(name, 3); table < tables.size())
      return {table};
  for (const auto& names : split_names) {
    std::vector<std::size_t> found;
    for (const char* const name : names)
      found.push_back(find(name, 1));
    if (std::all_of(found.begin(), found.end(), [&](std::size_t table) {
          return table < tables.size() && tables[table].rows == tables[found[0]].rows;
        }))
      return found;
  }
  return {};
}

} // namespace io
} // namespace pcl_uvol
