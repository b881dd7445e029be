// SPDX-License-Identifier: BSD-3-Clause
// Where the samples of a file of NetCDF are: which variables tell, over which
// dimensions, and how places on the globe become coordinates.
#pragma once

#include "io/netcdf_file.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief The variables that tell x, y and z, null for one that none tells. */
struct PlaceVariables {
  std::array<const NetcdfVariable*, 3> axes{};
  bool is_global = false; ///< the first two are longitude and latitude, in degrees
};

/** \brief By standard names, units, axes and usual names, as CF has them.
 *
 * \throws IOError where there are none */
PlaceVariables
findPlaces(const NetcdfFile& file);

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
  std::shared_ptr<const std::map<int, std::vector<std::uint64_t>>> keep_;
};

/** \brief The samples: all combinations of indices along some dimensions. Profiles
 * that stand behind one another (CF 9.3.3, contiguous and indexed ragged arrays) have
 * dimensions of their own, whose index each sample knows. */
class SampleSpace {
public:
  SampleSpace(const std::shared_ptr<const NetcdfFile>& file,
              const PlaceVariables& places);

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
  findDimensions(const PlaceVariables& places);

  std::shared_ptr<const NetcdfFile> file_;
  std::vector<int> dimensions_;
  std::uint64_t size_ = 1;
  /** By dimension of profiles: the dimension of their samples. */
  std::map<int, int> samples_of_;
  std::shared_ptr<std::map<int, std::vector<std::uint64_t>>> instances_;
};

/** \brief From numbers of a variable to a coordinate. */
struct AxisMap {
  double origin = 0.0, factor = 1.0;
  bool is_longitude = false; ///< the difference is that of the shorter way

  double
  apply(double number) const;
};

/** \brief The maps of all axes: longitude and latitude become kilometres, of less than
 * 100 of them metres, to the east and north of the middle; depths and pressures count
 * downwards.
 *
 * \param notes get a sentence that says so */
std::array<AxisMap, 3>
mapPlaces(const SampleSpace& space,
          const PlaceVariables& places,
          std::vector<std::string>& notes);

} // namespace io
} // namespace pcl_uvol
