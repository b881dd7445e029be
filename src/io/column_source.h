// SPDX-License-Identifier: BSD-3-Clause
// Points of files that hold one field behind the other: snapshots, arrays.
#pragma once

#include "io/record_source.h"
#include <pcl_uvol/common/export.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief One field of a file, a tuple of numbers per point. */
class FileColumn {
public:
  FileColumn() = default;
  FileColumn(const FileColumn&) = delete;
  FileColumn&
  operator=(const FileColumn&) = delete;
  virtual ~FileColumn() = default;

  /** \brief Tuples one behind the other, native byte order.
   * \throws IOError */
  virtual void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) = 0;

  /** \brief Bytes that are held from one call to the next. */
  virtual std::uint64_t
  heldBytes() const
  {
    return 0;
  }
};

/** \brief A column and the fields of a point that it fills. */
struct NamedColumn {
  /** One name: a field of so many numbers; several: that many fields of one. */
  std::vector<std::string> names;
  std::uint8_t datatype = 0;
  std::size_t components = 1;
  std::unique_ptr<FileColumn> column;
};

/** \brief Tuples that lie in a file as they are.
 * \param swapped the byte order is not the native one */
PCL_UVOL_EXPORTS std::unique_ptr<FileColumn>
openStored(std::shared_ptr<const InputFile> file,
           std::uint64_t offset,
           std::uint8_t datatype,
           std::size_t components,
           bool swapped);

/** \brief The same number for every point. */
PCL_UVOL_EXPORTS std::unique_ptr<FileColumn>
makeConstant(double value);

/** \brief Records of columns of the same length. */
class PCL_UVOL_EXPORTS ColumnSource : public NumberedSource {
public:
  ColumnSource(std::uint64_t count,
               std::vector<NamedColumn> columns,
               std::vector<Message> notes);

  void
  read(std::size_t count, std::uint8_t* records) override;

  std::uint64_t
  heldBytes() const override;

private:
  std::vector<NamedColumn> columns_;
  std::vector<std::uint8_t> tuples_;
};

/** \brief The records of several files behind one another; one file is open at a time.
 */
class PCL_UVOL_EXPORTS PartsSource : public NumberedSource {
public:
  using Open = std::function<std::unique_ptr<RecordSource>(std::size_t part)>;

  /** \param name of a part, for errors
   * \throws IOError where the parts do not have the same fields */
  PartsSource(std::size_t parts,
              Open open,
              const std::function<std::string(std::size_t part)>& name);

  void
  read(std::size_t count, std::uint8_t* records) override;

  std::uint64_t
  heldBytes() const override
  {
    return held_;
  }

private:
  Open open_;
  std::vector<std::uint64_t> ends_; ///< records up to the end of each part
  std::unique_ptr<RecordSource> part_;
  std::size_t open_part_ = 0;
  std::uint64_t held_ = 0;
};

/** \brief Some records of another source. */
class PCL_UVOL_EXPORTS SelectedSource : public NumberedSource {
public:
  /** \param rows those that are kept, ascending */
  SelectedSource(std::unique_ptr<RecordSource> source, std::vector<std::uint64_t> rows);

  void
  read(std::size_t count, std::uint8_t* records) override;

  std::uint64_t
  heldBytes() const override
  {
    return source_->heldBytes() + rows_.size() * sizeof(rows_[0]);
  }

private:
  std::unique_ptr<RecordSource> source_;
  std::vector<std::uint64_t> rows_;
  std::vector<std::uint8_t> block_;
};

} // namespace io
} // namespace pcl_uvol
