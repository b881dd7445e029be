// SPDX-License-Identifier: BSD-3-Clause
// Points as records of bytes: what readers hand over.
#pragma once

#include "coordinate_range.h"
#include <pcl_uvol/common/scalar_field.h>
#include <pcl_uvol/io/dataset.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

using Fields = std::vector<pcl::PCLPointField>;

/** \brief Bytes of a field in a point. */
std::size_t
fieldBytes(const pcl::PCLPointField& field);

/** \brief Append a field behind the others. */
void
appendField(Fields& fields,
            const std::string& name,
            std::uint8_t datatype,
            std::size_t count = 1);

/** \brief End of the last field. */
std::size_t
recordBytes(const Fields& fields);

/** \throws IOError if PCL cannot count that many points, or bytes of a point */
void
checkSize(const std::string& path, std::uint64_t count, std::uint64_t step);

/** \brief A cloud of that many records; the data is sized and zero.
 * \throws IOError if PCL cannot count that many */
pcl::PCLPointCloud2
makeRecords(const std::string& path, Fields fields, std::uint64_t count);

/** \brief 0, 1, 2 for x, y, z, and -1. */
int
axisOf(const std::string& name);

/** \brief Bytes of no meaning, which PCL calls "_". */
bool
isPadding(const pcl::PCLPointField& field);

/** \brief Bytes that go from one layout of a point to another. */
struct Run {
  std::size_t from, to, bytes;
};

/** \brief Append a run, or make the last one longer. */
void
appendRun(std::vector<Run>& runs, const Run& run);

/** \brief The same points with x, y, z (float32) in front, the other fields packed
 * behind them and the step a multiple of four, so that coordinates are aligned.
 * \param with_xyz false leaves the bytes of x, y, z zero */
pcl::PCLPointCloud2
repack(const pcl::PCLPointCloud2& cloud, bool with_xyz);

/** \brief What a file says of its records besides their bytes. */
struct RecordInfo {
  Fields fields;
  std::uint64_t count = 0;
  std::vector<std::string> notes;
  std::optional<bool> double_coordinates; ///< unset: the types of x, y, z tell
  bool has_coordinates = true;
  std::optional<std::array<double, 3>> origin; ///< unset: the coordinates tell
};

/** \brief From records as they lie in a file, in native byte order, to the points of a
 * dataset: coordinates of any type become float32 relative to the origin, padding goes,
 * equal names are told apart. */
class RecordLayout {
public:
  /** \throws IOError without x, y, z */
  RecordLayout(const std::string& path, const RecordInfo& info);

  /** \brief The dataset without its points. */
  const Dataset&
  getHeader() const
  {
    return header_;
  }

  /** \brief True if the records are points as they are. */
  bool
  isIdentity() const;

  /** \brief True as long as the coordinates must be seen for their origin. */
  bool
  needsOrigin() const
  {
    return needs_origin_;
  }

  void
  setOrigin(const std::array<double, 3>& origin);

  /** \brief Add the coordinates of records. */
  void
  addTo(CoordinateRange& range, const std::uint8_t* records, std::size_t count) const;

  /** \param[out] points gets as many points, of the header's point_step */
  void
  convert(const std::uint8_t* records, std::size_t count, std::uint8_t* points) const;

private:
  Dataset header_;
  std::vector<Run> runs_;
  std::size_t record_bytes_;
  std::size_t point_bytes_; ///< without what aligns the next point
  std::array<FieldComponent, 3> axes_{};
  bool floats_ = true; ///< x, y, z are copied as they are
  bool needs_origin_ = false;
};

/** \brief Write a coordinate to the front of a point. */
inline void
putCoordinate(double relative, std::size_t axis, std::uint8_t* point)
{
  const auto single = static_cast<float>(relative);
  std::memcpy(point + axis * sizeof(single), &single, sizeof(single));
}

/** \brief Give a cloud with fields that many points; those that are new are zero. */
void
resizePoints(pcl::PCLPointCloud2& cloud, std::size_t count);

/** \brief The dataset that records make. \throws IOError without x, y, z
 * \throws InvalidArgument for a coordinate beyond float */
Dataset
makeDataset(const std::string& path,
            const RecordInfo& info,
            pcl::PCLPointCloud2&& records);

/** \brief Give three scalar fields other names, if all three are there and the other
 * names are free. */
void
renameFields(Fields& fields, const char* const (&from)[3], const char* const (&to)[3]);

/** \brief Append _2, _3, ... to names that came before. */
void
makeUnique(std::vector<std::string>& names);

} // namespace io
} // namespace pcl_uvol
