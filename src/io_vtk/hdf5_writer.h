// SPDX-License-Identifier: BSD-3-Clause
// Writes files of HDF5 by the library that VTK uses.
#pragma once

#include "io_vtk/hdf5_column.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Groups, tables and attributes of a new file, as versions from 1.8 on read
 * them. The same calls write the same bytes. */
class Hdf5Writer {
public:
  /** Bytes of rows of a table, one behind the other, in the order of this machine. */
  using MakeRows = std::function<std::string(std::uint64_t first, std::uint64_t count)>;

  /** \param file that is there, and is written from its start
   * \param path the name that errors give
   * \throws IOError, as all other functions */
  Hdf5Writer(const std::string& file, std::string path);
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer&
  operator=(const Hdf5Writer&) = delete;
  ~Hdf5Writer();

  /** \brief A group within one that was added before, or within "". */
  void
  addGroup(const std::string& name);

  /** \brief Numbers within a group that was added before.
   * \param datatype of pcl::PCLPointField
   * \param components 1: a list, more: a table of so many columns */
  void
  addTable(const std::string& name,
           std::uint8_t datatype,
           std::uint64_t rows,
           std::uint64_t components,
           const MakeRows& make);

  /** Attributes of something that was added before. @{ */
  void
  addAttribute(const std::string& object,
               const std::string& name,
               const std::string& text);
  void
  addAttribute(const std::string& object,
               const std::string& name,
               const std::vector<std::int64_t>& numbers);
  /** @} */

  /** \brief Complete the file. Without it nothing is known of what was written. */
  void
  close();

private:
  struct Target;

  [[noreturn]] void
  fail() const;
  void
  check(herr_t result) const;
  Handle
  checked(hid_t id) const;
  void
  addAttribute(const std::string& object,
               const std::string& name,
               hid_t type,
               hid_t space,
               const void* value) const;

  std::string path_;
  std::unique_ptr<Target> target_;
  Handle driver_, names_, group_, table_, file_;
};

} // namespace io
} // namespace pcl_uvol
