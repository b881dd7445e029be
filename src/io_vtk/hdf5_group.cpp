// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/hdf5_group.h"

#include "common/printable.h"
#include "io/hdf5_names.h"
#include "io/position_tables.h"

#include <algorithm>

namespace pcl_uvol {
namespace io {

void
Hdf5Group::add(const std::vector<std::string>& names,
               const std::string& dataset,
               const Hdf5Shape& shape)
{
  columns_.push_back({names,
                      shape.datatype,
                      static_cast<std::size_t>(shape.components),
                      file_.openColumn(dataset)});
}

void
Hdf5Group::takeCoordinates(const std::vector<std::string>& names)
{
  const std::size_t components = names.size() == 1 ? 3 : 1;
  constexpr const char* axes[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string dataset = joinNames(group_, names[i]);
    const auto shape = file_.findShape(dataset);
    if (!shape || shape->components != components)
      throwUnreadable(file_.getPath(),
                      {"unexpected_word",
                       shortenText(dataset),
                       components == 3 ? "a table of three coordinates per point"
                                       : "a table of one coordinate per point"});
    if (i > 0 && shape->rows != rows_)
      throwUnreadable(file_.getPath(),
                      {"wrong_count", quoteText(dataset), shape->rows, "rows", rows_});
    rows_ = shape->rows;
    taken_.push_back(dataset);
    add(components == 3 ? std::vector<std::string>(std::begin(axes), std::end(axes))
                        : std::vector<std::string>{axes[i]},
        dataset,
        *shape);
  }
}

bool
Hdf5Group::findCoordinates()
{
  std::vector<NumberTable> tables;
  for (const std::string& name : file_.list(group_))
    if (const auto shape = file_.findShape(joinNames(group_, name)))
      tables.push_back({name, shape->rows, shape->components});
  std::vector<std::string> names;
  for (const std::size_t table : findPositionTables(tables))
    names.push_back(tables[table].name);
  takeCoordinates(names);
  return !names.empty();
}

void
Hdf5Group::takeFields(const std::string& group)
{
  for (const std::string& name : file_.list(group)) {
    const std::string dataset = joinNames(group, name);
    const auto shape = file_.findShape(dataset);
    if (std::find(taken_.begin(), taken_.end(), dataset) != taken_.end() || !shape ||
        shape->rows != rows_)
      continue; // a group, a table of something else
    if (shape->components > most_table_components)
      notes_.push_back(
          {"wide_table",
           {{"table", shortenText(dataset)}, {"components", shape->components}}});
    else
      add({name}, dataset, *shape);
  }
}

} // namespace io
} // namespace pcl_uvol
