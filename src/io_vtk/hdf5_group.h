// SPDX-License-Identifier: BSD-3-Clause
// Tables of one length in a group of HDF5, as points.
#pragma once

#include "io_vtk/hdf5_file.h"

#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief The columns of the tables in a group. */
class Hdf5Group {
public:
  Hdf5Group(const Hdf5File& file, const std::string& group)
      : file_(file)
      , group_(group)
  {
  }

  /** Tables x, y, z by their names, or one of them.
   * \throws IOError unless they are coordinates */
  void
  takeCoordinates(const std::vector<std::string>& names);

  /** \return false if the group has no table with a usual name */
  bool
  findCoordinates();

  /** All other tables of as many rows. */
  void
  takeFields(const std::string& group);

  std::unique_ptr<ColumnSource>
  open(std::vector<Message> notes)
  {
    notes.insert(notes.end(), notes_.begin(), notes_.end());
    return std::make_unique<ColumnSource>(rows_, std::move(columns_), std::move(notes));
  }

  std::uint64_t
  getRows() const
  {
    return rows_;
  }

  std::vector<NamedColumn>&
  getColumns()
  {
    return columns_;
  }

private:
  void
  add(const std::vector<std::string>& names,
      const std::string& dataset,
      const Hdf5Shape& shape);

  const Hdf5File& file_;
  std::string group_;
  std::uint64_t rows_ = 0;
  std::vector<std::string> taken_;
  std::vector<NamedColumn> columns_;
  std::vector<Message> notes_;
};

/** \brief The particles of a snapshot of Phantom, with their density rho; null for a
 * file that is none.
 *
 * \param particles kind that was chosen, by its name or number; "": all that are not
 * dead (h <= 0)
 *
 * \throws IOError */
std::unique_ptr<RecordSource>
openPhantom(const Hdf5File& file, const std::string& particles);

/** \brief The points of a group of VTKHDF with their data; null for a group that says
 * no type of VTK.
 *
 * PolyData and UnstructuredGrid give their points, of several times those of the first
 * one, ImageData the places of its lattice. Cells are not looked at.
 *
 * \throws IOError */
std::unique_ptr<RecordSource>
openVtkHdf(const Hdf5File& file, const std::string& group);

} // namespace io
} // namespace pcl_uvol
