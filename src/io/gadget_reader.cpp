// SPDX-License-Identifier: BSD-3-Clause
// Binary snapshots of Gadget, formats 1 and 2 (Springel, User guide for GADGET-2,
// section 6): records of Fortran, in the byte order of the machine that wrote them.
#include "common/printable.h"
#include "common/scalar_field.h"
#include "io/column_source.h"
#include "io/formats.h"
#include "io/little_endian.h"
#include "io/snapshot.h"

#include <pcl/PCLPointField.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

namespace pcl_uvol {
namespace io {
namespace {

using Type = pcl::PCLPointField;

constexpr std::size_t kinds = 6;
constexpr std::uint32_t header_bytes = 256;
/** A field of more numbers per particle is none that stages could use. */
constexpr std::uint64_t most_components = 64;

/** How the file of a snapshot is laid out, as its first record tells. */
struct Layout {
  bool swapped = false;
  bool has_labels = false; ///< format 2
};

template <typename T>
T
numberAt(const std::uint8_t* bytes, bool swapped)
{
  std::array<std::uint8_t, sizeof(T)> copy;
  std::copy_n(bytes, sizeof(T), copy.begin());
  if (swapped)
    std::reverse(copy.begin(), copy.end());
  T value;
  std::memcpy(&value, copy.data(), sizeof(T));
  return value;
}

std::uint32_t
markerAt(const InputFile& file, std::uint64_t offset, bool swapped)
{
  std::uint8_t bytes[4];
  file.read(offset, bytes, sizeof(bytes));
  return numberAt<std::uint32_t>(bytes, swapped);
}

/** Nothing for what is no snapshot. */
std::optional<Layout>
findLayout(const InputFile& file)
{
  if (file.getSize() < header_bytes + 8)
    return std::nullopt;
  for (const bool swapped : {false, true}) {
    const std::uint32_t first = markerAt(file, 0, swapped);
    if (first == header_bytes &&
        markerAt(file, header_bytes + 4, swapped) == header_bytes)
      return Layout{swapped, false};
    if (first != 8 || file.getSize() < header_bytes + 24 ||
        markerAt(file, 12, swapped) != 8 ||
        markerAt(file, 16, swapped) != header_bytes ||
        markerAt(file, header_bytes + 20, swapped) != header_bytes)
      continue;
    return Layout{swapped, true};
  }
  return std::nullopt;
}

struct Header {
  std::array<std::uint64_t, kinds> here{}, total{};
  std::array<double, kinds> masses{};
  double time = 0.0, redshift = 0.0, box = 0.0, omega = 0.0, hubble = 0.0;
  std::uint32_t files = 1;
};

Header
readHeader(const InputFile& file, const Layout& layout)
{
  std::array<std::uint8_t, header_bytes> bytes{};
  file.read(layout.has_labels ? 20 : 4, bytes.data(), bytes.size());
  const auto count = [&](std::size_t at) {
    return numberAt<std::uint32_t>(bytes.data() + at, layout.swapped);
  };
  const auto real = [&](std::size_t at) {
    return numberAt<double>(bytes.data() + at, layout.swapped);
  };
  Header header;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    header.here[kind] = count(4 * kind);
    header.masses[kind] = real(24 + 8 * kind);
    header.total[kind] = count(96 + 4 * kind) | std::uint64_t(count(168 + 4 * kind))
                                                    << 32;
  }
  header.time = real(72);
  header.redshift = real(80);
  header.files = std::max(count(124), 1u);
  header.box = real(128);
  header.omega = real(136);
  header.hubble = real(152);
  if (header.files == 1)
    header.total = header.here;
  return header;
}

/** A record of a file. */
struct Block {
  std::string label; ///< "" in format 1
  std::uint64_t offset, bytes;
};

/** The record of that marker; those beyond 4 GB have the low bits of their size. */
Block
measureRecord(const InputFile& file,
              const std::string& path,
              std::uint64_t marker_offset,
              bool swapped)
{
  const std::uint64_t low = markerAt(file, marker_offset, swapped);
  for (std::uint64_t bytes = low; marker_offset + bytes + 8 <= file.getSize();
       bytes += std::uint64_t(1) << 32)
    if (markerAt(file, marker_offset + 4 + bytes, swapped) == low)
      return {"", marker_offset + 4, bytes};
  throwUnreadable(
      path, {"truncated_part", "the record at byte " + std::to_string(marker_offset)});
}

/** Labels of format 1, by the order of the blocks. */
constexpr const char* first_labels[] = {"POS", "VEL", "ID"};
constexpr const char* gas_labels[] = {"U", "RHO", "HSML"};

std::vector<Block>
listBlocks(const InputFile& file,
           const std::string& path,
           const Layout& layout,
           bool has_masses)
{
  std::vector<Block> blocks;
  const std::uint64_t start = header_bytes + (layout.has_labels ? 24 : 8);
  for (std::uint64_t at = start; at < file.getSize();) {
    if (file.getSize() - at < 8)
      throwUnreadable(path, {"truncated_part", "a record"});
    std::string label;
    if (layout.has_labels) {
      const Block name = measureRecord(file, path, at, layout.swapped);
      if (name.bytes != 8 || file.getSize() - at < 24)
        throwUnreadable(
            path,
            {"invalid_part", "the label of the block at byte " + std::to_string(at)});
      label.resize(4);
      file.read(name.offset, label.data(), label.size());
      label.erase(std::find_if(label.begin(),
                               label.end(),
                               [](char c) { return c == ' ' || c == '\0'; }),
                  label.end());
      at += 16;
    }
    else {
      std::size_t place = blocks.size();
      if (place >= std::size(first_labels) && !has_masses)
        ++place;
      const std::size_t gas = std::size(first_labels) + 1;
      if (place < std::size(first_labels))
        label = first_labels[place];
      else if (place + 1 == gas)
        label = "MASS";
      else if (place - gas < std::size(gas_labels))
        label = gas_labels[place - gas];
      else
        label = "BLOCK_" + std::to_string(blocks.size() + 1);
    }
    Block block = measureRecord(file, path, at, layout.swapped);
    block.label = label;
    at = block.offset + block.bytes + 4;
    blocks.push_back(block);
  }
  return blocks;
}

/** Makes the columns of one kind of particles of a file. */
class SnapshotFile {
public:
  SnapshotFile(const std::string& path, std::size_t kind)
      : path_(path)
      , kind_(kind)
      , file_(std::make_shared<InputFile>(path))
      , layout_(findLayout(*file_).value_or(Layout()))
      , header_(readHeader(*file_, layout_))
  {
  }

  std::unique_ptr<RecordSource>
  open(std::vector<Message> notes);

private:
  struct Rows {
    std::uint64_t before, all; ///< particles in front of the kind; in the block
  };
  std::optional<Rows>
  findRows(const Block& block) const;
  std::uint64_t
  countHere(const std::vector<std::size_t>& some) const;
  bool
  addBlock(const Block& block);

  const std::string& path_;
  std::size_t kind_;
  std::shared_ptr<const InputFile> file_;
  Layout layout_;
  Header header_;
  std::size_t real_bytes_ = 4;
  std::vector<NamedColumn> columns_;
};

std::uint64_t
SnapshotFile::countHere(const std::vector<std::size_t>& some) const
{
  std::uint64_t sum = 0;
  for (const std::size_t kind : some)
    sum += header_.here[kind];
  return sum;
}

/** The rows of a block, by the kinds that have it; nothing if the kind has none. */
std::optional<SnapshotFile::Rows>
SnapshotFile::findRows(const Block& block) const
{
  std::vector<std::size_t> all{0, 1, 2, 3, 4, 5}, owners = all;
  const auto is_one_of = [&](std::initializer_list<const char*> labels) {
    return std::find(labels.begin(), labels.end(), block.label) != labels.end();
  };
  if (block.label == "MASS")
    owners.erase(
        std::remove_if(owners.begin(),
                       owners.end(),
                       [&](std::size_t k) { return header_.masses[k] != 0.0; }),
        owners.end());
  else if (is_one_of({"U", "RHO", "HSML", "NE", "NH", "SFR", "ENDT"}))
    owners = {0};
  else if (is_one_of({"AGE"}))
    owners = {4};
  else if (is_one_of({"Z"}))
    owners = {0, 4};
  else if (!is_one_of({"POS", "VEL", "ID"})) {
    // What other blocks belong to only their size tells: gas, else all.
    const std::uint64_t gas = header_.here[0];
    if (gas > 0 && block.bytes % (gas * real_bytes_) == 0 &&
        block.bytes / (gas * real_bytes_) <= 3)
      owners = {0};
  }
  if (std::find(owners.begin(), owners.end(), kind_) == owners.end())
    return std::nullopt;
  std::vector<std::size_t> before = owners;
  before.erase(std::remove_if(before.begin(),
                              before.end(),
                              [&](std::size_t k) { return k >= kind_; }),
               before.end());
  return Rows{countHere(before), countHere(owners)};
}

/** \return false for a block that cannot be shared among its particles */
bool
SnapshotFile::addBlock(const Block& block)
{
  const auto rows = findRows(block);
  if (!rows || rows->all == 0)
    return true;
  const std::uint64_t bytes = block.bytes / rows->all;
  const bool is_id = block.label == "ID";
  std::uint64_t size = is_id ? bytes : real_bytes_;
  if (block.label == "POS")
    size = bytes / 3;
  if (block.bytes % rows->all != 0 || (size != 4 && size != 8) || bytes % size != 0 ||
      bytes / size > most_components)
    return false;
  NamedColumn column;
  column.names = {block.label};
  column.components = static_cast<std::size_t>(bytes / size);
  column.datatype =
      static_cast<std::uint8_t>(is_id       ? (size == 4 ? Type::UINT32 : Type::UINT64)
                                : size == 4 ? Type::FLOAT32
                                            : Type::FLOAT64);
  if (block.label == "POS") {
    if (column.components != 3)
      return false;
    column.names = {"x", "y", "z"};
    real_bytes_ = static_cast<std::size_t>(size);
  }
  column.column = openStored(file_,
                             block.offset + rows->before * bytes,
                             column.datatype,
                             column.components,
                             layout_.swapped);
  columns_.push_back(std::move(column));
  return true;
}

std::unique_ptr<RecordSource>
SnapshotFile::open(std::vector<Message> notes)
{
  bool has_masses = false;
  for (std::size_t kind = 0; kind < kinds; ++kind)
    has_masses = has_masses || (header_.here[kind] > 0 && header_.masses[kind] == 0.0);
  for (const Block& block : listBlocks(*file_, path_, layout_, has_masses))
    if (!addBlock(block)) {
      if (block.label == "POS")
        throwUnreadable(
            path_,
            {"invalid_part",
             "the block of positions with " + std::to_string(block.bytes) + " bytes"});
      notes.push_back({"unfitting_block", {{"block", shortenText(block.label)}}});
    }
  if (header_.here[kind_] > 0 && columns_.empty())
    throwUnreadable(path_, {"missing_part", "the block of positions"});
  if (header_.masses[kind_] != 0.0)
    columns_.push_back(
        {{"MASS"}, Type::FLOAT64, 1, makeConstant(header_.masses[kind_])});
  return std::make_unique<ColumnSource>(
      header_.here[kind_], std::move(columns_), std::move(notes));
}

} // namespace

bool
isGadget(const std::string& path)
{
  return findLayout(InputFile(path)).has_value();
}

std::unique_ptr<RecordSource>
openGadget(const std::string& path, const LoadOptions& options)
{
  const InputFile file(path);
  const auto layout = findLayout(file);
  if (!layout)
    throwUnreadable(path, {"wrong_start", "a Gadget snapshot", "a header"});
  const Header header = readHeader(file, *layout);
  std::vector<Message> notes;
  const std::vector<std::string> parts = listSnapshotFiles(path, header.files);
  std::vector<std::uint64_t> counts(header.total.begin(), header.total.end());
  const std::size_t kind =
      chooseKind(path, listGadgetKinds(counts), options.particles, notes);
  if (header.omega > 0.0)
    noteHeader({header.redshift, header.hubble}, notes);
  std::unique_ptr<RecordSource> source;
  if (parts.size() == 1)
    source = SnapshotFile(path, kind).open(notes);
  else
    source = std::make_unique<PartsSource>(
        parts.size(),
        [parts, kind, notes](std::size_t i) {
          return SnapshotFile(parts[i], kind).open(notes);
        },
        [&](std::size_t i) { return parts[i]; });
  source->setBox(toBox({header.box}));
  source->setTime(header.time);
  return source;
}

} // namespace io
} // namespace pcl_uvol
