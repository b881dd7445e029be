// SPDX-License-Identifier: BSD-3-Clause
// What a file of HDF5 holds, by the library that VTK uses: the serial one, whose calls
// come one at a time.
#pragma once

#include "io/column_source.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief A table of numbers. */
struct Hdf5Shape {
  std::uint64_t rows;
  std::uint64_t components; ///< product of all further sizes
  std::uint8_t datatype;    ///< pcl::PCLPointField, as it is read
};

/** \brief A file opened for reading. Names are paths within it: "/PartType0/Masses".
 * Links to other files are not followed. */
class Hdf5File {
public:
  /** \throws IOError for what is no file of HDF5 */
  explicit Hdf5File(const std::string& path);

  const std::string&
  getPath() const
  {
    return path_;
  }

  bool
  hasGroup(const std::string& name) const;

  /** \brief Names within a group, sorted; none where there is no such group. */
  std::vector<std::string>
  list(const std::string& group) const;

  /** \brief Nothing for what is no table of numbers. */
  std::optional<Hdf5Shape>
  findShape(const std::string& dataset) const;

  /** \brief The numbers of an attribute; empty if it is not there, or holds none. */
  std::vector<double>
  readAttribute(const std::string& object, const std::string& name) const;

  /** \brief The text of an attribute; "" if it is not there, or holds none. */
  std::string
  readText(const std::string& object, const std::string& name) const;

  /** \brief The numbers of a small table; empty if it is not there, or holds none.
   * \throws IOError for chunks that are damaged */
  std::vector<double>
  readNumbers(const std::string& dataset) const;

  /** \throws IOError where the file holds less than it promises */
  std::unique_ptr<FileColumn>
  openColumn(const std::string& dataset) const;

private:
  std::string path_;
  std::shared_ptr<const std::int64_t> file_;
};

} // namespace io
} // namespace pcl_uvol
