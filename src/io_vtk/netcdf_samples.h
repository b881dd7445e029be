// SPDX-License-Identifier: BSD-3-Clause
// The samples of a file of NetCDF: over which dimensions they are, and the number of
// each variable that belongs to each of them.
#pragma once

#include "io_vtk/netcdf_file.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief A variable as one number for each sample. */
class SampleVariable {
public:
  /** \brief Numbers of samples: unpacked, NaN where the file has none. */
  void
  read(std::uint64_t first, std::size_t count, double* numbers) const;

  /** \brief The pcl::PCLPointField type of its numbers. Integers that are packed, or of
   * which some are missing, become double, but for flags; texts become float. */
  std::uint8_t
  getDatatype() const
  {
    return datatype_;
  }

  /** \brief Bytes of what is kept of it. */
  std::uint64_t
  heldBytes() const
  {
    return held_.size() * sizeof(double);
  }

private:
  friend class SampleSpace;

  /** How the index along a dimension follows from the number of a sample. */
  struct Axis {
    std::uint64_t below = 1, size = 1;                     ///< (sample / below) % size
    const std::vector<std::uint64_t>* instances = nullptr; ///< or by a list
    std::uint64_t stride = 1;                              ///< in the variable
  };

  void
  findPacking();

  void
  unpack(std::size_t count, double* numbers) const;

  std::shared_ptr<const NetcdfFile> file_;
  NetcdfVariable variable_;
  std::vector<Axis> axes_;
  std::vector<double> held_; ///< all numbers of a variable that repeat; else none
  bool is_held_ = false;
  std::uint8_t datatype_ = 0;
  double factor_ = 1.0, offset_ = 0.0;
  std::vector<double> missing_;
  double lowest_, highest_; ///< numbers in the file that are valid
  /** Keeps the lists that axes_ refer to. */
  std::shared_ptr<const std::map<int, std::vector<std::uint64_t>>> instances_;
};

/** \brief The samples: all combinations of indices along some dimensions. Profiles
 * that stand behind one another (CF 9.3.3, contiguous and indexed ragged arrays) have
 * dimensions of their own, whose index each sample knows. */
class SampleSpace {
public:
  /** \param places variables that tell where samples are */
  SampleSpace(const std::shared_ptr<const NetcdfFile>& file,
              const std::vector<NetcdfVariable>& places);

  /** \brief The number of samples. */
  std::uint64_t
  size() const
  {
    return size_;
  }

  const NetcdfFile&
  getFile() const
  {
    return *file_;
  }

  /** \brief Whether a variable has a number for each sample. */
  bool
  spans(const NetcdfVariable& variable) const;

  /** \param variable that spans the samples */
  SampleVariable
  open(const NetcdfVariable& variable) const;

private:
  void
  findInstances();

  void
  findDimensions(const std::vector<NetcdfVariable>& places);

  std::shared_ptr<const NetcdfFile> file_;
  std::vector<int> dimensions_;
  std::uint64_t size_ = 1;
  /** The dimension of samples, by that of their profiles. */
  std::map<int, int> samples_of_;
  std::shared_ptr<std::map<int, std::vector<std::uint64_t>>> instances_;
};

} // namespace io
} // namespace pcl_uvol
