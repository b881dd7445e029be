// SPDX-License-Identifier: BSD-3-Clause
// Records at fixed places, and records found by those before them.
#include "io/record_source.h"

#include "common/scalar_field.h"
#include "io/formats.h"
#include "io/little_endian.h"
#include "io/memory_need.h"

#include <algorithm>

namespace pcl_uvol {
namespace io {
namespace {

/** Records from one mark to the next: passing them takes milliseconds, and marks of
 * 10^9 records a megabyte. */
constexpr std::uint64_t mark_spacing = 1u << 14;
/** Records that are handled again while they are in the cache. */
constexpr std::size_t cached_bytes = std::size_t(1) << 18;
/** Records between two looks at the progress: text takes milliseconds. */
constexpr std::size_t records_per_report = 1u << 14;

void
swapRecords(const Fields& fields, std::size_t step, std::uint8_t* at, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i, at += step)
    for (const auto& field : fields)
      swapBytes(at + field.offset,
                datatypeSize(field.datatype),
                fieldBytes(field) / datatypeSize(field.datatype));
}

} // namespace

void
throwNoStream(const std::string& path, const std::string& what)
{
  const InputFile exists(path); // a missing file matters more than its format
  throwUnreadable(path, {"not_streamable", what});
}

FixedSource::FixedSource(const std::string& path,
                         RecordInfo info,
                         std::uint64_t offset,
                         bool swapped)
    : file_(path)
    , offset_(offset)
    , step_(recordBytes(info.fields))
    , swapped_(swapped)
{
  info_ = std::move(info);
}

void
FixedSource::seek(std::uint64_t record)
{
  next_ = record;
}

void
FixedSource::read(std::size_t count, std::uint8_t* records)
{
  const std::size_t block = swapped_ ? cached_bytes / step_ + 1 : count;
  for (std::size_t done = 0; done < count; done += block) {
    const std::size_t now = std::min(block, count - done);
    std::uint8_t* const to = records + done * step_;
    file_.read(offset_ + next_ * step_, to, now * step_);
    if (swapped_)
      swapRecords(info_.fields, step_, to, now);
    next_ += now;
  }
}

SequentialSource::SequentialSource(const std::string& path,
                                   std::unique_ptr<FileCursor> cursor,
                                   RecordInfo info)
    : path_(path)
    , cursor_(std::move(cursor))
    , marks_{cursor_->tell()}
{
  info_ = std::move(info);
}

/** The next record counts as taken. */
void
SequentialSource::pass()
{
  if (next_ / mark_spacing == marks_.size())
    marks_.push_back(cursor_->tell());
  ++next_;
}

void
SequentialSource::seek(std::uint64_t record)
{
  const std::uint64_t mark =
      std::min<std::uint64_t>(record / mark_spacing, marks_.size() - 1);
  if (record < next_ || mark * mark_spacing > next_) {
    cursor_->seek(marks_[mark]);
    next_ = mark * mark_spacing;
  }
  while (next_ < record) {
    pass();
    skipRecord();
  }
}

void
SequentialSource::read(std::size_t count, std::uint8_t* records)
{
  const std::size_t step = recordBytes(info_.fields);
  for (std::size_t i = 0; i < count; ++i, records += step) {
    pass();
    readRecord(records);
  }
  if (next_ == info_.count)
    finish();
}

PointReader::PointReader(std::unique_ptr<RecordSource> source)
    : source_(std::move(source))
    , layout_(source_->getInfo(), recordBytes(source_->getInfo().fields))
{
}

/** Gives the next records to take(records, count), block by block. */
template <typename Take>
void
PointReader::readRecords(std::size_t count, const Take& take)
{
  const std::size_t step = recordBytes(source_->getInfo().fields);
  const std::size_t most = std::max<std::size_t>(1, cached_bytes / step);
  records_.resize(std::min(count, most) * step);
  std::size_t done = 0;
  do { // at the end, too, where sources look at what follows
    const std::size_t now = std::min(most, count - done);
    source_->read(now, records_.data());
    take(records_.data(), now);
    done += now;
  } while (done < count);
}

void
PointReader::findOrigin()
{
  if (!layout_.needsOrigin())
    return;
  CoordinateRange range;
  readRecords(static_cast<std::size_t>(source_->getInfo().count),
              [&](const std::uint8_t* records, std::size_t count) {
                layout_.addTo(range, records, count);
              });
  layout_.setOrigin(range);
  source_->seek(0);
}

void
PointReader::read(std::size_t count, std::uint8_t* points)
{
  if (layout_.isIdentity()) {
    source_->read(count, points);
    return layout_.removeNonPlaces(count, points);
  }
  readRecords(count, [&](const std::uint8_t* records, std::size_t taken) {
    layout_.convert(records, taken, points);
    points += taken * layout_.getHeader().cloud.point_step;
  });
}

namespace {

/** Read as many points or records as a cloud has.
 * \param source PointReader or RecordSource */
template <typename Source>
void
readInParts(Source& source,
            std::size_t count,
            const ProgressCallback& progress,
            pcl::PCLPointCloud2& cloud)
{
  Report report;
  report.progress = progress;
  StepTimer step(report, "read", count);
  std::size_t done = 0;
  do { // at the end, too, where sources look at what follows
    const std::size_t now = std::min(records_per_report, count - done);
    source.read(now, cloud.data.data() + done * cloud.point_step);
    done += now;
    step.advance(now);
  } while (done < count);
}

} // namespace

namespace {

Dataset
readPoints(PointReader& reader,
           const ProgressCallback& progress,
           FileCursor::Place* end)
{
  const RecordInfo& info = reader.getSource().getInfo();
  const auto count = static_cast<std::size_t>(info.count);
  checkReading(info, 0, reader.getSource().heldBytes());
  if (reader.getLayout().needsOrigin()) {
    // Reading twice would take longer than all records take memory.
    auto records = makeRecords(info.fields, count);
    readInParts(reader.getSource(), count, progress, records);
    if (end)
      *end = reader.getSource().getEnd();
    return makeDataset(std::move(records), info);
  }
  Dataset dataset = reader.getLayout().getHeader();
  resizePoints(dataset.cloud, count);
  readInParts(reader, count, progress, dataset.cloud);
  if (end)
    *end = reader.getSource().getEnd();
  return dataset;
}

} // namespace

Dataset
readWhole(std::unique_ptr<RecordSource> source,
          const ProgressCallback& progress,
          FileCursor::Place* end)
{
  PointReader reader(std::move(source));
  Dataset dataset = readPoints(reader, progress, end);
  if (const auto& map = reader.getSource().getMap())
    setMap(dataset, *map);
  return dataset;
}

} // namespace io
} // namespace pcl_uvol
