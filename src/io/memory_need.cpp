// SPDX-License-Identifier: BSD-3-Clause
#include "io/memory_need.h"

#include "common/memory.h"
#include "io/formats.h"
#include "io/record_source.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

namespace pcl_uvol {
namespace {

/** The memory of a stream, as PointStream says. */
constexpr double stream_bytes = 2e6;

/** As of checkReading(). */
CloudHeader
peekRecords(const RecordInfo& info,
            std::uint64_t packed_bytes,
            std::uint64_t held_bytes)
{
  const RecordLayout layout(info, recordBytes(info.fields));
  CloudHeader cloud;
  cloud.points = info.count;
  cloud.time = info.time;
  cloud.point_step = layout.getHeader().cloud.point_step;
  checkSize(cloud.points, cloud.point_step);
  const auto points = static_cast<double>(cloud.points);
  const double records = static_cast<double>(recordBytes(info.fields)) * points;
  const double kept = static_cast<double>(cloud.point_step) * points;
  if (packed_bytes > 0) // packed, unpacked and sorted into records; then as points
    cloud.reading_bytes =
        records + std::max(records + static_cast<double>(packed_bytes), kept);
  else {
    cloud.reading_bytes = kept + stream_bytes + static_cast<double>(held_bytes);
    if (layout.needsOrigin()) // all records are held, until it is known
      cloud.reading_bytes += records;
  }
  return cloud;
}

} // namespace

std::optional<CloudHeader>
peekHeader(const std::string& path, const LoadOptions& options)
{
  try {
    const io::FileFormat format = io::findFormat(path, options);
    if (format == io::FileFormat::Text)
      return std::nullopt;
    if (format == io::FileFormat::Pcd)
      if (const auto compressed = io::findCompressed(path))
        return peekRecords(compressed->info, compressed->packed_bytes, 0);
    const auto source = io::openRecords(path, format, options);
    if (!source)
      return std::nullopt;
    return peekRecords(source->getInfo(), 0, source->heldBytes());
  }
  catch (const Exception&) {
    return std::nullopt;
  }
}

void
io::checkReading(const RecordInfo& info,
                 std::uint64_t packed_bytes,
                 std::uint64_t held_bytes)
{
  const CloudHeader cloud = peekRecords(info, packed_bytes, held_bytes);
  checkMemoryOf("Reading", cloud.points, cloud.reading_bytes);
}

} // namespace pcl_uvol
