// SPDX-License-Identifier: BSD-3-Clause
#include "io/column_source.h"

#include "common/scalar_field.h"
#include "io/little_endian.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace pcl_uvol {
namespace io {
namespace {

/** Tuples that are handled while they are in the cache. */
constexpr std::size_t cached_bytes = std::size_t(1) << 18;

class StoredColumn : public FileColumn {
public:
  StoredColumn(std::shared_ptr<const InputFile> file,
               std::uint64_t offset,
               std::uint8_t datatype,
               std::size_t components,
               bool swapped)
      : file_(std::move(file))
      , offset_(offset)
      , size_(datatypeSize(datatype))
      , components_(components)
      , swapped_(swapped)
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    const std::size_t step = size_ * components_;
    file_->read(offset_ + first * step, tuples, count * step);
    if (swapped_)
      swapBytes(tuples, size_, count * components_);
  }

private:
  std::shared_ptr<const InputFile> file_;
  std::uint64_t offset_;
  std::size_t size_, components_;
  bool swapped_;
};

class ConstantColumn : public FileColumn {
public:
  explicit ConstantColumn(double value)
      : value_(value)
  {
  }

  void
  read(std::uint64_t, std::size_t count, std::uint8_t* tuples) override
  {
    for (; count > 0; --count, tuples += sizeof(value_))
      std::memcpy(tuples, &value_, sizeof(value_));
  }

private:
  double value_;
};

std::size_t
tupleBytes(const NamedColumn& column)
{
  return datatypeSize(column.datatype) * column.components;
}

bool
haveSameLayout(const Fields& some, const Fields& others)
{
  return std::equal(some.begin(),
                    some.end(),
                    others.begin(),
                    others.end(),
                    [](const pcl::PCLPointField& a, const pcl::PCLPointField& b) {
                      return a.name == b.name && a.datatype == b.datatype &&
                             a.count == b.count;
                    });
}

/** Tuples of a size that the compiler knows are moved, not called for. */
template <std::size_t Bytes>
void
scatterTuples(const std::uint8_t* from,
              std::size_t count,
              std::uint8_t* to,
              std::size_t step)
{
  for (; count > 0; --count, from += Bytes, to += step)
    std::memcpy(to, from, Bytes);
}

void
scatter(const std::uint8_t* from,
        std::size_t bytes,
        std::size_t count,
        std::uint8_t* to,
        std::size_t step)
{
  switch (bytes) {
  case 4:
    return scatterTuples<4>(from, count, to, step);
  case 8:
    return scatterTuples<8>(from, count, to, step);
  case 12:
    return scatterTuples<12>(from, count, to, step);
  case 24:
    return scatterTuples<24>(from, count, to, step);
  default:
    for (; count > 0; --count, from += bytes, to += step)
      std::memcpy(to, from, bytes);
  }
}

} // namespace

std::unique_ptr<FileColumn>
openStored(std::shared_ptr<const InputFile> file,
           std::uint64_t offset,
           std::uint8_t datatype,
           std::size_t components,
           bool swapped)
{
  return std::make_unique<StoredColumn>(
      std::move(file), offset, datatype, components, swapped);
}

std::unique_ptr<FileColumn>
makeConstant(double value)
{
  return std::make_unique<ConstantColumn>(value);
}

ColumnSource::ColumnSource(std::uint64_t count,
                           std::vector<NamedColumn> columns,
                           std::vector<Message> notes)
    : columns_(std::move(columns))
{
  info_.count = count;
  info_.notes = std::move(notes);
  for (const NamedColumn& column : columns_)
    for (const std::string& name : column.names)
      appendField(info_.fields,
                  name,
                  column.datatype,
                  column.names.size() > 1 ? 1 : column.components);
}

void
ColumnSource::read(std::size_t count, std::uint8_t* records)
{
  const std::size_t step = recordBytes(info_.fields);
  const std::size_t block = cached_bytes / step + 1;
  for (std::size_t done = 0; done < count; done += block) {
    const std::size_t now = std::min(block, count - done);
    std::uint8_t* to = records + done * step;
    for (const NamedColumn& column : columns_) {
      const std::size_t bytes = tupleBytes(column);
      tuples_.resize(std::max(tuples_.size(), now * bytes));
      column.column->read(next_, now, tuples_.data());
      scatter(tuples_.data(), bytes, now, to, step);
      to += bytes;
    }
    next_ += now;
  }
}

std::uint64_t
ColumnSource::heldBytes() const
{
  return std::accumulate(columns_.begin(),
                         columns_.end(),
                         std::uint64_t(0),
                         [](std::uint64_t sum, const NamedColumn& column) {
                           return sum + column.column->heldBytes();
                         });
}

PartsSource::PartsSource(std::size_t parts,
                         Open open,
                         const std::function<std::string(std::size_t part)>& name)
    : open_(std::move(open))
{
  std::uint64_t count = 0;
  for (std::size_t i = parts; i-- > 0;) { // the first one stays open
    part_ = open_(i);
    const RecordInfo& info = part_->getInfo();
    held_ = std::max(held_, part_->heldBytes());
    ends_.insert(ends_.begin(), info.count);
    if (info.count == 0 && i > 0)
      continue;
    if (info_.fields.empty() || info_.count == 0)
      info_ = info;
    else if (info.count > 0 && !haveSameLayout(info.fields, info_.fields))
      throwUnreadable(name(i),
                      {"disagreeing_parts", "its fields and those of the other files"});
    info_.count = std::max(info_.count, info.count);
  }
  for (std::uint64_t& end : ends_)
    end = count += end;
  info_.count = count;
  info_.notes = part_->getInfo().notes;
}

void
PartsSource::read(std::size_t count, std::uint8_t* records)
{
  const std::size_t step = recordBytes(info_.fields);
  while (count > 0) {
    const auto part = static_cast<std::size_t>(
        std::upper_bound(ends_.begin(), ends_.end(), next_) - ends_.begin());
    if (part != open_part_) {
      part_ = open_(part);
      open_part_ = part;
    }
    const auto now =
        static_cast<std::size_t>(std::min<std::uint64_t>(count, ends_[part] - next_));
    part_->seek(next_ - (part > 0 ? ends_[part - 1] : 0));
    part_->read(now, records);
    records += now * step;
    next_ += now;
    count -= now;
  }
}

SelectedSource::SelectedSource(std::unique_ptr<RecordSource> source,
                               std::vector<std::uint64_t> rows)
    : source_(std::move(source))
    , rows_(std::move(rows))
{
  info_ = source_->getInfo();
  info_.count = rows_.size();
}

void
SelectedSource::read(std::size_t count, std::uint8_t* records)
{
  const std::size_t step = recordBytes(info_.fields);
  const std::size_t most = cached_bytes / step + 1;
  for (const std::uint64_t end = next_ + count; next_ < end;) {
    const std::uint64_t first = rows_[next_];
    const auto last =
        std::lower_bound(rows_.begin() + static_cast<std::ptrdiff_t>(next_),
                         rows_.begin() + static_cast<std::ptrdiff_t>(end),
                         first + most);
    const auto span = static_cast<std::size_t>(*(last - 1) - first + 1);
    block_.resize(std::max(block_.size(), span * step));
    source_->seek(first);
    source_->read(span, block_.data());
    for (; rows_.begin() + static_cast<std::ptrdiff_t>(next_) != last; ++next_) {
      std::copy_n(block_.data() + (rows_[next_] - first) * step, step, records);
      records += step;
    }
  }
}

} // namespace io
} // namespace pcl_uvol
