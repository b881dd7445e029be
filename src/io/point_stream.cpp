// SPDX-License-Identifier: BSD-3-Clause
// Records of a file and their layout as points, together.
#include "io/point_stream.h"

#include "io/formats.h"
#include "io/globe_places.h"
#include "io/record_source.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

namespace pcl_uvol {
namespace {

/** Points that one reading for some of them spans at most. */
constexpr std::uint64_t row_span = 256;

[[noreturn]] void
throwNoPoint(std::uint64_t point, std::uint64_t size)
{
  throw InvalidArgument("no_such_point", {{"point", point}, {"points", size}});
}

} // namespace

PointStream::PointStream(const std::string& path, const LoadOptions& options)
{
  const io::FileFormat format = io::findFormat(path, options);
  io::reading(path, [&] {
    auto source = io::openRecords(path, format, options);
    if (!source)
      io::throwNoStream(path, "VTK's files");
    if (options.map)
      source = io::mapRecords(std::move(source), *options.map);
    reader_ = std::make_unique<io::PointReader>(std::move(source));
    reader_->findOrigin();
    header_ = reader_->getLayout().getHeader();
    if (const auto& map = reader_->getSource().getMap())
      setMap(header_, *map);
  });
}

PointStream::~PointStream() = default;

const Dataset&
PointStream::getHeader() const
{
  return header_;
}

std::uint64_t
PointStream::size() const
{
  return reader_->getSource().getInfo().count;
}

std::uint64_t
PointStream::tell() const
{
  return reader_->getSource().tell();
}

void
PointStream::seek(std::uint64_t point)
{
  if (point > size())
    throwNoPoint(point, size());
  reader_->getSource().seek(point);
}

std::size_t
PointStream::read(std::size_t count, pcl::PCLPointCloud2& block)
{
  const auto& cloud = getHeader().cloud;
  count = static_cast<std::size_t>(
      std::min<std::uint64_t>({count, size() - tell(), most_points}));
  block.header = cloud.header;
  block.fields = cloud.fields;
  block.point_step = cloud.point_step;
  resizePoints(block, count);
  reader_->read(count, block.data.data());
  return count;
}

void
PointStream::readRows(const std::vector<std::uint64_t>& points,
                      pcl::PCLPointCloud2& rows)
{
  if (!std::is_sorted(points.begin(), points.end()))
    throw InvalidArgument("unsorted_points", {});
  if (!points.empty() && points.back() >= size())
    throwNoPoint(points.back(), size());
  const std::size_t step = getHeader().cloud.point_step;
  read(0, rows);
  resizePoints(rows, points.size());
  std::uint8_t* to = rows.data.data();
  pcl::PCLPointCloud2 block;
  for (auto first = points.begin(); first != points.end();) {
    // Points that lie close together come by one reading.
    const auto last = std::lower_bound(first, points.end(), *first + row_span);
    seek(*first);
    read(static_cast<std::size_t>(*(last - 1) - *first + 1), block);
    for (const std::uint64_t start = *first; first != last; ++first, to += step)
      std::copy_n(block.data.data() + (*first - start) * step, step, to);
  }
}

} // namespace pcl_uvol
