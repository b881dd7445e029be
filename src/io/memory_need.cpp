// SPDX-License-Identifier: BSD-3-Clause
#include "formats.h"
#include "record_source.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/memory_need.h>

namespace pcl_uvol {
namespace {

/** Of a stream, as PointStream says. */
constexpr double stream_bytes = 2e6;

PromisedCloud
promiseOf(io::PointReader& reader)
{
  const RecordInfo& info = reader.getSource().getInfo();
  PromisedCloud cloud;
  cloud.points = info.count;
  cloud.point_step = reader.getLayout().getHeader().cloud.point_step;
  checkSize(cloud.points, cloud.point_step);
  const auto points = static_cast<double>(cloud.points);
  cloud.reading.kept = static_cast<double>(cloud.point_step) * points;
  cloud.reading.peak = cloud.reading.kept + stream_bytes;
  if (reader.getLayout().needsOrigin()) // all records are held, until it is known
    cloud.reading.peak += static_cast<double>(recordBytes(info.fields)) * points;
  return cloud;
}

} // namespace

std::optional<PromisedCloud>
promisedCloud(const std::string& path)
{
  try {
    const io::FileFormat format = io::formatOf(path, {});
    if (format != io::FileFormat::Pcd && format != io::FileFormat::Ply)
      return std::nullopt;
    io::PointReader reader(format == io::FileFormat::Pcd ? io::openPcd(path)
                                                         : io::openPly(path));
    return promiseOf(reader);
  }
  catch (const Exception&) {
    return std::nullopt;
  }
}

} // namespace pcl_uvol
