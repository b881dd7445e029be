// SPDX-License-Identifier: BSD-3-Clause
// Points as records of bytes: what readers hand over.
#pragma once

#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/memory_need.h>

#include <cstddef>
#include <cstdint>
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

/** \brief A cloud of that many records; the data is sized and zero.
 * \throws IOError if PCL cannot count that many */
pcl::PCLPointCloud2
makeRecords(const std::string& path, Fields fields, std::uint64_t count);

/** \brief A dataset from records as they lie in a file, native byte order: coordinates
 * of any type become float32 relative to the origin, padding goes, equal names are told
 * apart. \throws IOError without x, y, z */
Dataset
makeDataset(const std::string& path, pcl::PCLPointCloud2&& records);

/** \brief What makeDataset needs and makes of such records.
 * \param beside bytes that lie beside the records while they are made and converted */
PromisedCloud
promiseOf(const Fields& fields, std::uint64_t count, double beside);

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

/** \brief Give three scalar fields other names, if all three are there and the other
 * names are free. */
void
renameFields(Fields& fields, const char* const (&from)[3], const char* const (&to)[3]);

/** \brief Append _2, _3, ... to names that came before. */
void
makeUnique(std::vector<std::string>& names);

} // namespace io
} // namespace pcl_uvol
