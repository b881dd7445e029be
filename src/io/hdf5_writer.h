// SPDX-License-Identifier: BSD-3-Clause
// Writes files of HDF5 block by block: the library opens no file that has no name yet,
// and does not survive a lack of memory.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Groups, tables and attributes of a new file, as versions from 1.8 on read
 * them. */
class Hdf5Writer {
public:
  /** Bytes of rows of a table, one behind the other, in the order of this machine. */
  using MakeRows = std::function<std::string(std::uint64_t first, std::uint64_t count)>;

  /** \param path the name that errors give */
  explicit Hdf5Writer(std::string path);

  /** \brief A group within one that was added before, or within "". */
  void
  addGroup(const std::string& name);

  /** \brief Numbers within a group that was added before.
   * \param datatype of pcl::PCLPointField
   * \param components 1: a list, more: a table of so many columns
   * \param make called by save() */
  void
  addTable(const std::string& name,
           std::uint8_t datatype,
           std::uint64_t rows,
           std::uint64_t components,
           MakeRows make);

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

  /** \brief Write all of it.
   * \throws IOError */
  void
  save(const std::string& file) const;

private:
  struct Object {
    std::string name;     ///< within its group
    std::string messages; ///< of its header, but for links and the place of numbers
    bool is_group = false;
    std::vector<std::size_t> members;
    std::uint64_t rows = 0, row_bytes = 0;
    MakeRows make;
  };

  Object&
  add(const std::string& name);
  std::uint64_t
  place(std::size_t object,
        const std::vector<std::uint64_t>& data,
        std::uint64_t start,
        std::string& headers) const;
  std::string
  makeMessage(std::uint8_t type, const std::string& body) const;
  void
  addAttribute(const std::string& object,
               const std::string& name,
               const std::string& type,
               const std::string& space,
               const std::string& value);

  std::string path_;
  std::vector<Object> objects_;
  std::map<std::string, std::size_t> known_; ///< by their whole names
};

} // namespace io
} // namespace pcl_uvol
