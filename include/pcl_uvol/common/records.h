// SPDX-License-Identifier: BSD-3-Clause
// Points as records of bytes, and the layout of their fields: what clouds of fields
// that are known at run time only are made of.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_uvol {

using Fields = std::vector<pcl::PCLPointField>;

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

/** \brief A cloud of that many records; the data is sized and zero.
 * \throws InvalidArgument if PCL cannot count that many */
PCL_UVOL_EXPORTS pcl::PCLPointCloud2
makeRecords(Fields fields, std::uint64_t count);

/** \brief A dataset from records as they lie in a file, native byte order: coordinates
 * of any type become float32 relative to the origin, padding goes, equal names are told
 * apart. \throws InvalidArgument without x, y, z, or for one that is beyond float */
PCL_UVOL_EXPORTS Dataset
makeDataset(pcl::PCLPointCloud2&& records);

/** \brief \throws InvalidArgument unless there are as many bytes as points need, and
 * every field lies within its point */
PCL_UVOL_EXPORTS void
checkComplete(const pcl::PCLPointCloud2& cloud);

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

/** \brief Give three scalar fields other names, if all three are there and the other
 * names are free. */
PCL_UVOL_EXPORTS void
renameFields(Fields& fields, const char* const (&from)[3], const char* const (&to)[3]);

/** \brief Append _2, _3, ... to names that came before. */
PCL_UVOL_EXPORTS void
makeUnique(std::vector<std::string>& names);

} // namespace pcl_uvol
