// SPDX-License-Identifier: BSD-3-Clause
// Where a field is asked for, on the command line.
#pragma once

#include "interpolation/query_lattice.h"
#include "shared/options.h"
#include <pcl_uvol/io/dataset.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief -points, -line, -plane, -grid and their sizes. */
class QueryOptions {
public:
  enum class Kind { None, Points, Line, Plane, Grid };

  void
  declare(Options& options);

  /** \brief Check what was given: to be called before any file is read.
   * \throws UsageError */
  void
  finish(const Options& options);

  Kind
  getKind() const
  {
    return kind_;
  }

  /** \brief The file of -points. */
  const std::string&
  getPoints() const
  {
    return points_;
  }

  /** \brief Whether cells of the input, where it has any, say where its data are. */
  bool
  usesCells() const
  {
    return kind_ != Kind::None && has_cell_mask_;
  }

  /** \brief The lattice of -line, -plane or -grid, in coordinates without an origin
   * taken off; its picture's axes are those of makeSlice().
   * \param data box of the samples
   * \throws InvalidArgument for a plane that misses the data */
  pcl_uvol::detail::Slice
  makeLattice(const pcl_uvol::detail::Bounds& data) const;

private:
  void
  parsePlane();
  void
  parseSize();
  void
  parseGrid();

  Kind kind_ = Kind::None;
  bool has_cell_mask_ = true;
  std::string points_, plane_text_, grid_text_, size_text_ = "512";
  std::vector<double> line_, box_;
  std::uint64_t line_points_ = 500;
  pcl_uvol::detail::Plane plane_;
  std::array<std::size_t, 2> size_{};
  std::vector<std::size_t> grid_;
};

} // namespace uvol_tools
