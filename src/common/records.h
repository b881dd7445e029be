// SPDX-License-Identifier: BSD-3-Clause
// Points as records of bytes, and the layout of their fields: what clouds of fields
// that are known at run time only are made of.
#pragma once

#include "common/coordinate_range.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

using Fields = std::vector<pcl::PCLPointField>;

/** \brief What PCL can number: points of a cloud, bytes of a point. */
constexpr std::uint64_t most_points = std::numeric_limits<pcl::uindex_t>::max();

/** \brief Bytes of a field in a point. */
PCL_UVOL_EXPORTS std::size_t
fieldBytes(const pcl::PCLPointField& field);

/** \brief Append a field behind the others. */
PCL_UVOL_EXPORTS void
appendField(Fields& fields,
            const std::string& name,
            std::uint8_t datatype,
            std::size_t count = 1);

/** \brief End of the last field. */
PCL_UVOL_EXPORTS std::size_t
recordBytes(const Fields& fields);

/** \throws InvalidArgument if PCL cannot count that many points, or bytes of a point */
PCL_UVOL_EXPORTS void
checkSize(std::uint64_t count, std::uint64_t step);

/** \brief A cloud of that many records; the data is sized and zero.
 * \throws InvalidArgument if PCL cannot count that many */
PCL_UVOL_EXPORTS pcl::PCLPointCloud2
makeRecords(Fields fields, std::uint64_t count);

/** \brief
 * \throws InvalidArgument unless there are as many bytes as points need, and every
 * field lies within its point */
PCL_UVOL_EXPORTS void
checkComplete(const pcl::PCLPointCloud2& cloud);

/** \brief Fields of a normal. */
inline constexpr std::array<const char*, 3> normal_names{
    {"normal_x", "normal_y", "normal_z"}};

/** \brief The fields normal_x, normal_y and normal_z, which an array of VTK called
 * Normals holds; none unless all three are there, single numbers of one type, and no
 * field is called Normals. */
PCL_UVOL_EXPORTS Fields
findNormals(const Fields& fields);

/** \brief The fields to be written: no padding, x, y, z in double if needed; offsets
 * are those in the point.
 * \throws InvalidArgument unless x, y, z are float32 and the data is complete */
PCL_UVOL_EXPORTS Fields
savedFields(const Dataset& dataset);

/** \brief 0, 1, 2 for x, y, z, and -1. */
PCL_UVOL_EXPORTS int
axisOf(const std::string& name);

/** \brief Bytes of no meaning, which PCL calls "_". */
PCL_UVOL_EXPORTS bool
isPadding(const pcl::PCLPointField& field);

/** \brief Bytes that go from one layout of a point to another. */
struct ByteRun {
  std::size_t from, to, bytes;
};

/** \brief Append a run, or make the last one longer. */
PCL_UVOL_EXPORTS void
appendRun(std::vector<ByteRun>& runs, const ByteRun& run);

/** \brief The same points with x, y, z (float32) in front, the other fields packed
 * behind them and the step a multiple of four, so that coordinates are aligned.
 * \param with_xyz false leaves the bytes of x, y, z zero */
PCL_UVOL_EXPORTS pcl::PCLPointCloud2
repack(const pcl::PCLPointCloud2& cloud, bool with_xyz);

/** \brief What is known of records besides their bytes. */
struct PCL_UVOL_EXPORTS RecordInfo {
  Fields fields;
  std::uint64_t count = 0;
  std::vector<Message> notes;
  std::optional<bool> double_coordinates; ///< unset: the types of x, y, z tell
  bool has_coordinates = true;
  bool is_global = false; ///< x and y are degrees, and points are put on a map later
  std::optional<std::array<double, 3>> origin; ///< unset: the coordinates tell
  std::array<double, 3> box{{0.0, 0.0, 0.0}};  ///< as Dataset::box
  std::optional<double> time;                  ///< of a snapshot, in the file's unit
  LabelNames labels;                           ///< as Dataset::labels
};

/** \brief From records, in native byte order, to the points of a dataset: coordinates
 * of any type become float32 relative to the origin, padding goes, equal names are told
 * apart. */
class PCL_UVOL_EXPORTS RecordLayout {
public:
  /** \param step bytes from one record to the next
   * \throws InvalidArgument without x, y, z */
  RecordLayout(const RecordInfo& info, std::size_t step);

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

  /** \brief Choose the origin of all coordinates. */
  void
  setOrigin(const CoordinateRange& range);

  /** \brief Add the coordinates of records. */
  void
  addTo(CoordinateRange& range, const std::uint8_t* records, std::size_t count) const;

  /** \brief A message about positions that rounding to float makes equal, see
   * MergedPositions; else none. */
  std::optional<Message>
  describeMerging(const std::uint8_t* records, std::size_t count) const;

  /** \param[out] points gets as many points, of the header's point_step */
  void
  convert(const std::uint8_t* records, std::size_t count, std::uint8_t* points) const;

  /** \brief Give points NaN for coordinates that are not places, see placeOrNaN().
   * \param points that float records became, as they were */
  void
  removeNonPlaces(std::size_t count, std::uint8_t* points) const;

private:
  Dataset header_;
  std::vector<ByteRun> runs_;
  std::size_t record_step_;
  std::size_t point_bytes_; ///< without what aligns the next point
  std::array<FieldComponent, 3> axes_{};
  bool floats_ = true; ///< x, y, z are copied as they are
  bool needs_origin_ = false, is_global_ = false;
};

/** \brief The origin of coordinates.
 * \param notes get a message where float rounds them so much that it matters */
PCL_UVOL_EXPORTS std::array<double, 3>
findOrigin(const CoordinateRange& range, std::vector<Message>& notes);

/** \brief Write a coordinate to the front of a point. */
inline void
putCoordinate(double relative, std::size_t axis, std::uint8_t* point)
{
  const auto single = static_cast<float>(relative);
  std::memcpy(point + axis * sizeof(single), &single, sizeof(single));
}

/** \brief Give a cloud with fields that many points; those that are new are zero. */
PCL_UVOL_EXPORTS void
resizePoints(pcl::PCLPointCloud2& cloud, std::size_t count);

/** \brief The dataset that records make.
 * \param info what else is known of them; the fields are those of the records
 * \throws InvalidArgument without x, y, z, or if all points have coordinates beyond
 * float */
PCL_UVOL_EXPORTS Dataset
makeDataset(pcl::PCLPointCloud2&& records, RecordInfo info = {});

/** \brief Give three scalar fields other names, if all three are there and the other
 * names are free. */
PCL_UVOL_EXPORTS void
renameFields(Fields& fields, const char* const (&from)[3], const char* const (&to)[3]);

/** \brief Append _2, _3, ... to names that came before. */
PCL_UVOL_EXPORTS void
makeUnique(std::vector<std::string>& names);

/** \brief The origin and the like of a dataset, for a cloud made of its own: without a
 * copy of all its points. */
PCL_UVOL_EXPORTS Dataset
withoutCloud(const Dataset& dataset);

/** \brief The names that the values of a field stand for; null where they stand for
 * none. */
PCL_UVOL_EXPORTS const std::vector<std::string>*
findLabels(const Fields& fields, const LabelNames& labels, const std::string& field);

/** \brief The name of a label; "" for a value that stands for none. */
PCL_UVOL_EXPORTS std::string
nameOfLabel(const std::vector<std::string>& names, double label);

/** \brief The fields but for those that hold labels. */
PCL_UVOL_EXPORTS Fields
listNumberFields(const Dataset& dataset);

} // namespace pcl_uvol
