// SPDX-License-Identifier: BSD-3-Clause
#include "sample_store.h"

#include <pcl_uvol/common/parallel.h>

#include <algorithm>

namespace pcl_uvol {
namespace io {

namespace {

/** Samples that are read at once: some megabytes. */
constexpr std::size_t block_samples = 1u << 18;

/** Samples that a thread takes at once. */
constexpr std::size_t thread_samples = 1u << 14;

/** Samples that wait to be written, of all pieces. */
constexpr std::size_t buffered_samples = 1u << 20;

/** What follows a position. */
struct Rest {
  float value;
  std::uint32_t source[2]; // halves: eight bytes would not lie on an even address
};

Rest
restOf(const Samples& samples, std::size_t i)
{
  return {samples.values[i],
          {static_cast<std::uint32_t>(samples.sources[i]),
           static_cast<std::uint32_t>(samples.sources[i] >> 32)}};
}

std::uint64_t
sourceOf(const Rest& rest)
{
  return rest.source[0] | static_cast<std::uint64_t>(rest.source[1]) << 32;
}

struct Record {
  Position position;
  Rest rest;
};

} // namespace

SampleLog::SampleLog(const std::string& folder)
    : positions_(folder)
    , rest_(folder)
{
}

void
SampleLog::append(const Samples& samples)
{
  positions_.append(samples.positions.data(), samples.size() * sizeof(Position));
  std::vector<Rest> rest;
  for (std::size_t i = 0; i < samples.size(); ++i)
    rest.push_back(restOf(samples, i));
  rest_.append(rest.data(), rest.size() * sizeof(Rest));
}

void
SampleLog::scan(const std::function<void(const Position*, std::size_t)>& block) const
{
  std::vector<Position> positions(std::min<std::uint64_t>(size(), block_samples));
  for (std::uint64_t begin = 0; begin < size(); begin += positions.size()) {
    const std::size_t count = std::min<std::uint64_t>(size() - begin, positions.size());
    positions_.read(
        begin * sizeof(Position), positions.data(), count * sizeof(Position));
    block(positions.data(), count);
  }
}

void
SampleLog::scanSamples(const std::function<void(const Samples&)>& block) const
{
  std::uint64_t begin = 0;
  std::vector<Rest> rest;
  scan([&](const Position* positions, std::size_t count) {
    rest.resize(count);
    rest_.read(begin * sizeof(Rest), rest.data(), count * sizeof(Rest));
    begin += count;
    Samples samples;
    samples.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
      samples.push(positions[i], rest[i].value, sourceOf(rest[i]));
    block(samples);
  });
}

PieceStore::PieceStore(const SampleLog& log,
                       const Decomposition& decomposition,
                       const std::string& folder,
                       unsigned threads)
    : file_(folder)
    , planes_(folder)
    , begins_(decomposition.size() + 1)
    , plane_begins_{0}
{
  std::vector<std::uint32_t> pieces;
  const auto find_pieces = [&](const Position* positions, std::size_t count) {
    pieces.resize(count);
    parallelBlocks(count, thread_samples, threads, [&](auto begin, auto end) {
      for (std::size_t i = begin; i < end; ++i)
        pieces[i] = static_cast<std::uint32_t>(decomposition.pieceOf(positions[i]));
    });
  };
  // Counted, since of equal samples all go to one piece.
  log.scan([&](const Position* positions, std::size_t count) {
    find_pieces(positions, count);
    for (const std::uint32_t piece : pieces)
      ++begins_[piece + 1];
  });
  for (std::size_t piece = 0; piece < decomposition.size(); ++piece)
    begins_[piece + 1] += begins_[piece];

  std::vector<std::uint64_t> next(begins_.begin(), begins_.end() - 1);
  std::vector<Samples> buffers(decomposition.size());
  const std::size_t most = std::max<std::size_t>(buffered_samples / buffers.size(), 1);
  const auto flush = [&](std::size_t piece) {
    write(next[piece], buffers[piece]);
    next[piece] += buffers[piece].size();
    buffers[piece] = {};
  };
  log.scanSamples([&](const Samples& samples) {
    find_pieces(samples.positions.data(), samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      Samples& buffer = buffers[pieces[i]];
      buffer.push(samples.positions[i], samples.values[i], samples.sources[i]);
      if (buffer.size() == most)
        flush(pieces[i]);
    }
  });
  for (std::size_t piece = 0; piece < buffers.size(); ++piece)
    flush(piece);
}

void
PieceStore::read(std::uint64_t begin, std::size_t count, Samples& samples) const
{
  samples.reserve(samples.size() + count);
  std::vector<Record> records(std::min(count, block_samples));
  for (std::size_t done = 0; done < count; done += records.size()) {
    const std::size_t now = std::min(count - done, records.size());
    file_.read((begin + done) * sizeof(Record), records.data(), now * sizeof(Record));
    for (std::size_t i = 0; i < now; ++i)
      samples.push(
          records[i].position, records[i].rest.value, sourceOf(records[i].rest));
  }
}

void
PieceStore::write(std::uint64_t begin, const Samples& samples)
{
  std::vector<Record> records;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    records.push_back({samples.positions[i], restOf(samples, i)});
    if (records.size() == block_samples || i + 1 == samples.size()) {
      file_.write((begin + i + 1 - records.size()) * sizeof(Record),
                  records.data(),
                  records.size() * sizeof(Record));
      records.clear();
    }
  }
}

Samples
PieceStore::load(std::size_t piece) const
{
  Samples samples;
  read(begins_[piece], count(piece), samples);
  return samples;
}

void
PieceStore::save(std::size_t piece, const Piece& built)
{
  write(begins_[piece], built.getOwnSamples());
  const auto& planes = built.getPlanes();
  planes_.append(planes.data(), planes.size() * sizeof(SplitPlane));
  plane_begins_.push_back(planes_.size());
}

Piece
PieceStore::restore(const Decomposition& decomposition,
                    std::size_t piece,
                    const Position& scale) const
{
  std::vector<SplitPlane> planes((plane_begins_[piece + 1] - plane_begins_[piece]) /
                                 sizeof(SplitPlane));
  planes_.read(plane_begins_[piece], planes.data(), planes.size() * sizeof(SplitPlane));
  return Piece::restore(decomposition, piece, load(piece), std::move(planes), scale);
}

LentBrick
PieceStore::lend(std::size_t piece, std::uint64_t begin, const Brick& brick) const
{
  LentBrick lent{brick, {}};
  read(begins_[piece] + (brick.begin - begin), brick.count, lent.samples);
  return lent;
}

} // namespace io
} // namespace pcl_uvol
