// SPDX-License-Identifier: BSD-3-Clause
#include "io_vtk/hdf5_column.h"

#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/little_endian.h"
#include "io_vtk/vtk_arrays.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <zlib.h>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

/** Behind a chunk, where it is asked for. */
constexpr std::size_t checksum_bytes = 4;

hid_t
nativeType(std::uint8_t datatype)
{
  switch (datatype) {
  case Type::INT8:
    return H5T_NATIVE_INT8;
  case Type::UINT8:
    return H5T_NATIVE_UINT8;
  case Type::INT16:
    return H5T_NATIVE_INT16;
  case Type::UINT16:
    return H5T_NATIVE_UINT16;
  case Type::INT32:
    return H5T_NATIVE_INT32;
  case Type::UINT32:
    return H5T_NATIVE_UINT32;
  case Type::INT64:
    return H5T_NATIVE_INT64;
  case Type::UINT64:
    return H5T_NATIVE_UINT64;
  case Type::FLOAT32:
    return H5T_NATIVE_FLOAT;
  default:
    return H5T_NATIVE_DOUBLE;
  }
}

/** How a table lies in its file. */
struct Storage {
  std::size_t number_bytes = 0;
  bool is_plain = false; ///< the type is a native one, or turned
  bool swapped = false;
  bool is_contiguous = false;
  bool is_packed = false;
  bool can_unpack = false;           ///< by the filters known here
  std::vector<H5Z_filter_t> filters; ///< in the order of packing
  /** Sizes of the table and of a chunk, at least two: a list has one column. @{ */
  std::vector<hsize_t> sizes{0, 1}, chunk{0, 1};
  /** @} */

  std::uint64_t
  chunkBytes() const
  {
    return std::accumulate(chunk.begin(),
                           chunk.end(),
                           std::uint64_t{number_bytes},
                           std::multiplies<std::uint64_t>());
  }

  /** Whether so many bytes can be those of the chunks of a table that no filter packs.
   * The library reads as many as an index says, which damage may change. */
  bool
  mayHold(std::uint64_t bytes) const
  {
    std::uint64_t chunks = 1;
    for (std::size_t axis = 0; axis < sizes.size(); ++axis)
      chunks *= (sizes[axis] + chunk[axis] - 1) / chunk[axis];
    return bytes % chunkBytes() == 0 && bytes / chunkBytes() <= chunks;
  }
};

Storage
describeStorage(hid_t dataset, const Hdf5Shape& shape)
{
  Storage storage;
  const Handle type = own(H5Dget_type(dataset)), space = own(H5Dget_space(dataset)),
               properties = own(H5Dget_create_plist(dataset));
  const Handle turned = own(H5Tcopy(nativeType(shape.datatype)));
  H5Tset_order(*turned,
               H5Tget_order(*turned) == H5T_ORDER_LE ? H5T_ORDER_BE : H5T_ORDER_LE);
  storage.number_bytes = H5Tget_size(*type);
  storage.swapped = H5Tequal(*type, *turned) > 0;
  storage.is_plain = storage.swapped || H5Tequal(*type, nativeType(shape.datatype)) > 0;
  storage.is_contiguous = H5Pget_layout(*properties) == H5D_CONTIGUOUS;
  const int rank = H5Sget_simple_extent_ndims(*space);
  const int filters = H5Pget_nfilters(*properties);
  storage.is_packed = filters > 0;
  if (H5Pget_layout(*properties) != H5D_CHUNKED || !storage.is_plain)
    return storage;
  storage.sizes.resize(std::max<std::size_t>(static_cast<std::size_t>(rank), 2), 1);
  storage.chunk.resize(storage.sizes.size(), 1);
  H5Sget_simple_extent_dims(*space, storage.sizes.data(), nullptr);
  H5Pget_chunk(*properties, rank, storage.chunk.data());
  for (int i = 0; i < filters; ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    storage.filters.push_back(H5Pget_filter2(*properties,
                                             static_cast<unsigned>(i),
                                             &flags,
                                             &values,
                                             nullptr,
                                             0,
                                             nullptr,
                                             nullptr));
  }
  storage.can_unpack =
      storage.filters.size() < 32 &&
      std::all_of(storage.filters.begin(), storage.filters.end(), [](H5Z_filter_t id) {
        return id == H5Z_FILTER_DEFLATE || id == H5Z_FILTER_SHUFFLE ||
               id == H5Z_FILTER_FLETCHER32;
      });
  return storage;
}

/** Unpacks chunks here: the library reads behind those that are shorter than they
 * should be. */
class ChunkedColumn : public FileColumn {
public:
  ChunkedColumn(std::string path,
                std::string name,
                Handle dataset,
                const Hdf5Shape& shape,
                Storage storage)
      : path_(std::move(path))
      , name_(std::move(name))
      , dataset_(std::move(dataset))
      , components_(static_cast<std::size_t>(shape.components))
      , storage_(std::move(storage))
      , chunk_bytes_(storage_.chunkBytes())
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    const std::size_t step = components_ * storage_.number_bytes;
    while (count > 0) {
      const std::uint64_t band = first / storage_.chunk[0];
      if (band_ != band)
        fillBand(band);
      const std::uint64_t within = first - band * storage_.chunk[0];
      const auto now = static_cast<std::size_t>(
          std::min<std::uint64_t>(count, storage_.chunk[0] - within));
      std::copy_n(rows_.data() + within * step, now * step, tuples);
      first += now;
      count -= now;
      tuples += now * step;
    }
  }

  std::uint64_t
  heldBytes() const override
  {
    return 3 * storage_.chunk[0] * components_ * storage_.number_bytes;
  }

private:
  void
  fillBand(std::uint64_t band);
  bool
  readChunk(const std::vector<hsize_t>& place);
  void
  copyChunk(const std::vector<hsize_t>& place, std::size_t rows);
  void
  unpack(std::uint32_t mask);
  void
  inflateChunk();
  void
  unshuffle();
  [[noreturn]] void
  throwDamaged() const
  {
    throwUnreadable(path_, {"invalid_part", "a chunk of " + quoteText(name_)});
  }

  std::string path_, name_;
  Handle dataset_;
  std::size_t components_;
  Storage storage_;
  std::uint64_t chunk_bytes_;
  std::optional<std::uint64_t> band_; ///< of chunks beside each other, in rows_
  std::vector<std::uint8_t> rows_, chunk_, other_;
};

/** The next of the places between 0 and ends, the last axis fastest.
 * \param first axis that changes
 * \return false behind the last one, and the first one */
bool
advance(std::vector<hsize_t>& place,
        const std::vector<hsize_t>& ends,
        const std::vector<hsize_t>& steps,
        std::size_t first)
{
  for (std::size_t axis = place.size(); axis-- > first;) {
    place[axis] += steps[axis];
    if (place[axis] < ends[axis])
      return true;
    place[axis] = 0;
  }
  return false;
}

/** Rows that one or more chunks beside each other hold. */
void
ChunkedColumn::fillBand(std::uint64_t band)
{
  const std::size_t size = storage_.number_bytes, step = components_ * size;
  std::vector<hsize_t> place(storage_.sizes.size(), 0);
  place[0] = band * storage_.chunk[0];
  const auto rows = static_cast<std::size_t>(
      std::min<std::uint64_t>(storage_.chunk[0], storage_.sizes[0] - place[0]));
  band_.reset();
  rows_.assign(rows * step, 0);
  do
    if (readChunk(place))
      copyChunk(place, rows);
  while (advance(place, storage_.sizes, storage_.chunk, 1));
  if (storage_.swapped)
    swapBytes(rows_.data(), size, rows * components_);
  band_ = band;
}

/** Run by run along the last axis, from a chunk to the rows.
 * \param rows of the chunk that the table has */
void
ChunkedColumn::copyChunk(const std::vector<hsize_t>& place, std::size_t rows)
{
  const auto& sizes = storage_.sizes;
  const auto& chunk = storage_.chunk;
  if (std::equal(sizes.begin() + 1, sizes.end(), chunk.begin() + 1)) { // whole rows
    std::copy_n(chunk_.data(), rows_.size(), rows_.data());
    return;
  }
  const std::size_t size = storage_.number_bytes, last = sizes.size() - 1;
  std::vector<hsize_t> ends{rows};
  for (std::size_t axis = 1; axis <= last; ++axis)
    ends.push_back(std::min(chunk[axis], sizes[axis] - place[axis]));
  std::vector<hsize_t> within(last, 0);
  const std::vector<hsize_t> ones(last, 1);
  do {
    std::uint64_t from = 0, to = place[last];
    std::uint64_t from_step = chunk[last], to_step = sizes[last];
    for (std::size_t axis = last; axis-- > 0;) {
      from += within[axis] * from_step;
      to += ((axis > 0 ? place[axis] : 0) + within[axis]) * to_step;
      from_step *= chunk[axis];
      to_step *= sizes[axis];
    }
    std::copy_n(
        chunk_.data() + from * size, ends[last] * size, rows_.data() + to * size);
  } while (advance(within, ends, ones, 0));
}

/** \return false for a chunk that was never written: its numbers are 0 */
bool
ChunkedColumn::readChunk(const std::vector<hsize_t>& place)
{
  const Hdf5Session session;
  hsize_t bytes = 0;
  if (H5Dget_chunk_storage_size(*dataset_, place.data(), &bytes) < 0 || bytes == 0)
    return false;
  if (bytes > chunk_bytes_ + chunk_bytes_ / 8 + 1024) // packed numbers hardly grow
    throwDamaged();
  chunk_.resize(bytes);
  std::uint32_t mask = 0;
  if (H5Dread_chunk(*dataset_, H5P_DEFAULT, place.data(), &mask, chunk_.data()) < 0)
    throwDamaged();
  unpack(mask);
  return true;
}

/** \param mask filters that were left out */
void
ChunkedColumn::unpack(std::uint32_t mask)
{
  for (std::size_t i = storage_.filters.size(); i-- > 0;) {
    if ((mask >> i) & 1u)
      continue;
    if (storage_.filters[i] == H5Z_FILTER_DEFLATE)
      inflateChunk();
    else if (storage_.filters[i] == H5Z_FILTER_SHUFFLE)
      unshuffle();
    else if (chunk_.size() < checksum_bytes)
      throwDamaged();
    else
      chunk_.resize(chunk_.size() - checksum_bytes);
  }
  if (chunk_.size() != chunk_bytes_)
    throwDamaged();
}

void
ChunkedColumn::inflateChunk()
{
  other_.resize(chunk_bytes_ + checksum_bytes); // a checksum may be within
  uLongf bytes = other_.size();
  if (uncompress(other_.data(), &bytes, chunk_.data(), chunk_.size()) != Z_OK)
    throwDamaged();
  other_.resize(bytes);
  chunk_.swap(other_);
}

/** All first bytes of the numbers, then all second ones, ...: in order again. */
void
ChunkedColumn::unshuffle()
{
  const std::size_t size = storage_.number_bytes, count = chunk_.size() / size;
  other_ = chunk_; // what is no whole number at the end stays
  for (std::size_t byte = 0; byte < size; ++byte)
    for (std::size_t i = 0; i < count; ++i)
      other_[i * size + byte] = chunk_[byte * count + i];
  chunk_.swap(other_);
}

/** Numbers that the library converts or unpacks. */
class LibraryColumn : public FileColumn {
public:
  LibraryColumn(std::string path,
                std::string name,
                Handle dataset,
                const Hdf5Shape& shape)
      : path_(std::move(path))
      , name_(std::move(name))
      , dataset_(std::move(dataset))
      , shape_(shape)
  {
  }

  void
  read(std::uint64_t first, std::size_t count, std::uint8_t* tuples) override
  {
    const Hdf5Session session;
    const Handle file_space = own(H5Dget_space(*dataset_));
    hsize_t start[H5S_MAX_RANK] = {}, size[H5S_MAX_RANK] = {};
    const int rank = H5Sget_simple_extent_dims(*file_space, size, nullptr);
    start[0] = first;
    size[0] = count;
    if (count == 0)
      return;
    const Handle memory = own(H5Screate_simple(rank, size, nullptr));
    if (H5Sselect_hyperslab(
            *file_space, H5S_SELECT_SET, start, nullptr, size, nullptr) < 0 ||
        H5Dread(*dataset_,
                nativeType(shape_.datatype),
                *memory,
                *file_space,
                H5P_DEFAULT,
                tuples) < 0)
      throwUnread();
  }

  /** Tells of the filter that is missing, if there is one. */
  [[noreturn]] void
  throwUnread() const
  {
    static const std::map<H5Z_filter_t, const char*> names{{32000, "lzf"},
                                                           {32001, "blosc"},
                                                           {32004, "lz4"},
                                                           {32008, "bitshuffle"},
                                                           {32015, "zstd"},
                                                           {32026, "blosc2"}};
    const Handle properties = own(H5Dget_create_plist(*dataset_));
    for (int i = 0; i < H5Pget_nfilters(*properties); ++i) {
      unsigned flags = 0;
      std::size_t values = 0;
      const H5Z_filter_t id = H5Pget_filter2(*properties,
                                             static_cast<unsigned>(i),
                                             &flags,
                                             &values,
                                             nullptr,
                                             0,
                                             nullptr,
                                             nullptr);
      if (H5Zfilter_avail(id) > 0)
        continue;
      const auto known = names.find(id);
      throwUnreadable(path_,
                      {"filter_not_installed",
                       shortenText(name_),
                       known != names.end() ? known->second : "number",
                       id});
    }
    throwUnreadable(path_, {"invalid_part", "the table " + quoteText(name_)});
  }

private:
  std::string path_, name_;
  Handle dataset_;
  Hdf5Shape shape_;
};

} // namespace

std::recursive_mutex&
Hdf5Session::mutex()
{
  static std::recursive_mutex all;
  // What damaged headers have left open the library cannot close at exit, and prints
  // so.
  static const herr_t leaves_no_handler = H5dont_atexit();
  static_cast<void>(leaves_no_handler);
  return all;
}

Handle
own(hid_t id)
{
  if (id < 0)
    return nullptr;
  return {new hid_t(id), [](const hid_t* held) {
            const Hdf5Session session;
            H5Idec_ref(*held); // of any kind
            delete held;
          }};
}

std::uint8_t
hdf5Datatype(hid_t type)
{
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) == H5T_FLOAT)
    return static_cast<std::uint8_t>(size <= 4 ? Type::FLOAT32 : Type::FLOAT64);
  if (H5Tget_class(type) != H5T_INTEGER)
    return 0;
  const bool has_sign = H5Tget_sign(type) == H5T_SGN_2;
  switch (size) {
  case 1:
    return static_cast<std::uint8_t>(has_sign ? Type::INT8 : Type::UINT8);
  case 2:
    return static_cast<std::uint8_t>(has_sign ? Type::INT16 : Type::UINT16);
  case 4:
    return static_cast<std::uint8_t>(has_sign ? Type::INT32 : Type::UINT32);
  case 8:
    return static_cast<std::uint8_t>(has_sign ? Type::INT64 : Type::UINT64);
  default:
    return 0;
  }
}

std::unique_ptr<FileColumn>
openHdf5Column(const std::string& path,
               const std::string& name,
               const Handle& dataset,
               const Hdf5Shape& shape)
{
  const Storage storage = describeStorage(*dataset, shape);
  const std::uint64_t promised = shape.rows * shape.components * storage.number_bytes;
  const std::uint64_t stored = H5Dget_storage_size(*dataset);
  if (shape.rows > UINT32_MAX || std::max(promised, storage.chunkBytes()) /
                                         (storage.is_packed ? deflate_expansion : 1) >
                                     stored)
    throwUnreadable(
        path, {"truncated_data", shape.rows, "rows of " + quoteText(name), stored});
  if (storage.can_unpack && !storage.is_packed && !storage.mayHold(stored))
    throwUnreadable(
        path, {"wrong_count", quoteText(name), stored, "bytes", storage.chunkBytes()});
  if (storage.can_unpack)
    return std::make_unique<ChunkedColumn>(path, name, dataset, shape, storage);
  auto file = std::make_shared<const InputFile>(path);
  const haddr_t offset = H5Dget_offset(*dataset);
  if (storage.is_contiguous && storage.is_plain && offset != HADDR_UNDEF &&
      offset <= file->getSize() && promised <= file->getSize() - offset)
    return openStored(std::move(file),
                      offset,
                      shape.datatype,
                      static_cast<std::size_t>(shape.components),
                      storage.swapped);
  return std::make_unique<LibraryColumn>(path, name, dataset, shape);
}

} // namespace io
} // namespace pcl_uvol
