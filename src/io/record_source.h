// SPDX-License-Identifier: BSD-3-Clause
// Points of a file as records, read from front to back or from any point on.
#pragma once

#include "common/records.h"
#include "io/file_cursor.h"
#include <pcl_uvol/common/map_projection.h>
#include <pcl_uvol/common/stage.h>

#include <cmath>
#include <memory>
#include <optional>

namespace pcl_uvol {
namespace io {

/** \brief The records of a file whose header has been read. */
class RecordSource {
public:
  RecordSource() = default;
  RecordSource(const RecordSource&) = delete;
  RecordSource&
  operator=(const RecordSource&) = delete;
  virtual ~RecordSource() = default;

  const RecordInfo&
  getInfo() const
  {
    return info_;
  }

  /** \brief Tell the sides of the box that the file names. */
  void
  setBox(const std::array<double, 3>& box)
  {
    info_.box = box;
  }

  /** \brief Tell the time that the file names.
   * \param time no finite number: none */
  void
  setTime(double time)
  {
    if (std::isfinite(time))
      info_.time = time;
  }

  /** \brief The map that x and y are on. */
  const std::optional<MapProjection>&
  getMap() const
  {
    return map_;
  }

  void
  setMap(const std::optional<MapProjection>& map)
  {
    map_ = map;
  }

  /** \brief The number of the record that read() begins with. */
  std::uint64_t
  tell() const
  {
    return next_;
  }

  /** \brief What follows the last record in the file; all records have been read. */
  virtual FileCursor::Place
  getEnd() const = 0;

  /** \param record 0 to the number of records
   * \throws IOError */
  virtual void
  seek(std::uint64_t record) = 0;

  /** \brief The next records one behind the other, native byte order.
   * \param count at most what follows
   * \throws IOError */
  virtual void
  read(std::size_t count, std::uint8_t* records) = 0;

  /** \brief Bytes that are held besides some blocks. */
  virtual std::uint64_t
  heldBytes() const
  {
    return 0;
  }

protected:
  RecordInfo info_;
  std::optional<MapProjection> map_;
  std::uint64_t next_ = 0;
};

/** \brief Records that are found by their numbers alone, with nothing of use behind the
 * last one. */
class NumberedSource : public RecordSource {
public:
  FileCursor::Place
  getEnd() const override
  {
    return {};
  }

  void
  seek(std::uint64_t record) override
  {
    next_ = record;
  }
};

/** \brief Records of a fixed number of bytes. */
class FixedSource : public RecordSource {
public:
  /** \param offset of the first record in the file
   * \param swapped the byte order is not the native one */
  FixedSource(const std::string& path,
              RecordInfo info,
              std::uint64_t offset,
              bool swapped);

  FileCursor::Place
  getEnd() const override
  {
    return {offset_ + info_.count * step_, 0};
  }

  void
  seek(std::uint64_t record) override;

  void
  read(std::size_t count, std::uint8_t* records) override;

private:
  const InputFile file_;
  const std::uint64_t offset_;
  const std::size_t step_;
  const bool swapped_;
};

/** \brief Records whose place in the file only those before them tell: lines, lists.
 * Places passed are kept, one of many records, so that going back costs little. */
class SequentialSource : public RecordSource {
public:
  FileCursor::Place
  getEnd() const override
  {
    return cursor_->tell();
  }

  void
  seek(std::uint64_t record) override;

  void
  read(std::size_t count, std::uint8_t* records) override;

protected:
  /** \param cursor stands in front of the first record */
  SequentialSource(const std::string& path,
                   std::unique_ptr<FileCursor> cursor,
                   RecordInfo info);

  virtual void
  readRecord(std::uint8_t* record) = 0;
  virtual void
  skipRecord() = 0;
  /** \brief Look at what follows the last record. */
  virtual void
  finish()
  {
  }

  const std::string path_;
  const std::unique_ptr<FileCursor> cursor_;

private:
  void
  pass();

  std::vector<FileCursor::Place> marks_; ///< of every mark_spacing-th record
};

/** \brief Takes records of a source as points. */
class PointReader {
public:
  /** \throws InvalidArgument without x, y, z */
  explicit PointReader(std::unique_ptr<RecordSource> source);

  RecordSource&
  getSource()
  {
    return *source_;
  }

  const RecordLayout&
  getLayout() const
  {
    return layout_;
  }

  /** \brief Look at all coordinates if their origin needs that.
   * \throws InvalidArgument if all points have coordinates beyond float
   * \throws IOError */
  void
  findOrigin();

  /** \param count at most what follows
   * \throws IOError */
  void
  read(std::size_t count, std::uint8_t* points);

private:
  template <typename Take>
  void
  readRecords(std::size_t count, const Take& take);

  std::unique_ptr<RecordSource> source_;
  RecordLayout layout_;
  std::vector<std::uint8_t> records_;
};

/** \brief The dataset of all the records of a source.
 * \param[out] end gets what follows them in the file
 * \param progress told of "read"; empty: nobody is
 * \throws IOError
 * \throws InvalidArgument without x, y, z, if all points have coordinates beyond float,
 * and for more points than PCL can number */
Dataset
readWhole(std::unique_ptr<RecordSource> source,
          const ProgressCallback& progress,
          FileCursor::Place* end = nullptr);

} // namespace io
} // namespace pcl_uvol
