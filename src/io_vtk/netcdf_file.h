// SPDX-License-Identifier: BSD-3-Clause
// What a file of NetCDF holds, in both of its formats, by its library.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief A variable: a table of numbers over some dimensions. */
struct NetcdfVariable {
  int id = 0;
  std::string name;
  std::uint8_t datatype = 0; ///< pcl::PCLPointField; 64-bit integers become double
  bool is_text = false;      ///< of characters, which flags of quality are
  std::vector<int> dimensions;
};

/** \brief A file opened for reading. Groups within it are not looked at. */
class NetcdfFile {
public:
  /** \throws IOError for what is no file of NetCDF */
  explicit NetcdfFile(const std::string& path);

  const std::string&
  getPath() const
  {
    return path_;
  }

  /** \brief Those of numbers and characters, in their order. */
  const std::vector<NetcdfVariable>&
  getVariables() const
  {
    return variables_;
  }

  std::uint64_t
  sizeOf(int dimension) const;

  std::string
  readName(int dimension) const;

  /** \brief Product of the sizes of its dimensions. */
  std::uint64_t
  countNumbers(const NetcdfVariable& variable) const;

  /** \brief The text of an attribute; "" if there is none. */
  std::string
  readText(const NetcdfVariable& variable, const std::string& attribute) const;

  /** \brief The numbers of an attribute; none if it is not there. */
  std::vector<double>
  readNumbers(const NetcdfVariable& variable, const std::string& attribute) const;

  /** \brief Numbers as they are in the file, the last dimension running fastest; of
   * texts the characters.
   *
   * \throws IOError */
  void
  read(const NetcdfVariable& variable,
       std::uint64_t first,
       std::size_t count,
       double* numbers) const;

private:
  void
  check(int status) const;

  void
  readSlab(const NetcdfVariable& variable,
           const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& counts,
           std::size_t count,
           double* numbers) const;

  std::string path_;
  std::shared_ptr<const int> file_;  ///< closes it
  std::vector<std::uint64_t> sizes_; ///< by dimension
  std::vector<NetcdfVariable> variables_;
};

} // namespace io
} // namespace pcl_uvol
