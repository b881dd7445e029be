// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/sample_files.h"

#include "common/parallel.h"

#include <algorithm>

namespace pcl_uvol {

namespace {

/** Samples that are read at once: some megabytes. */
constexpr std::size_t file_block = 1u << 19;

/** Samples that a thread takes at once. */
constexpr std::size_t thread_samples = 1u << 14;

void
runAll(unsigned threads, const std::vector<std::function<void()>>& tasks)
{
  parallelBlocks(
      tasks.size(), 1, threads, [&](std::size_t task, std::size_t) { tasks[task](); });
}

/** Runs of samples of one piece, in the order of the pieces. */
class Parting {
public:
  Parting(const Decomposition& decomposition, unsigned threads)
      : decomposition_(decomposition)
      , threads_(threads)
  {
    for (std::size_t piece = 0; piece < decomposition.size(); ++piece)
      next_.push_back(decomposition.getBegin(piece));
  }

  /** Order samples by their piece. */
  void
  part(const Samples& samples)
  {
    const std::size_t pieces = next_.size();
    const std::size_t blocks = (samples.size() + thread_samples - 1) / thread_samples;
    piece_of_.resize(samples.size());
    places_.assign(blocks * pieces, 0);
    const auto forEach = [&](const auto& visit) {
      parallelBlocks(
          samples.size(), thread_samples, threads_, [&](auto begin, auto end) {
            std::size_t* const places =
                places_.data() + begin / thread_samples * pieces;
            for (std::size_t i = begin; i < end; ++i)
              visit(i, places);
          });
    };
    forEach([&](std::size_t i, std::size_t* counts) {
      piece_of_[i] =
          static_cast<std::uint32_t>(decomposition_.findPiece(samples.positions[i]));
      ++counts[piece_of_[i]];
    });
    runs_.clear();
    std::size_t first = 0;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      const std::size_t begin = first;
      for (std::size_t block = 0; block < blocks; ++block) {
        std::size_t& place = places_[block * pieces + piece];
        const std::size_t count = place;
        place = first;
        first += count;
      }
      if (first > begin)
        runs_.push_back({next_[piece], begin, first - begin});
      next_[piece] += first - begin;
    }
    parted_.resize(samples.size());
    forEach([&](std::size_t i, std::size_t* places) {
      const std::size_t place = places[piece_of_[i]]++;
      parted_.positions[place] = samples.positions[i];
      parted_.values[place] = samples.values[i];
      parted_.sources[place] = samples.sources[i];
    });
  }

  const Samples&
  getSamples() const
  {
    return parted_;
  }

  const std::vector<SampleFile::Run>&
  getRuns() const
  {
    return runs_;
  }

private:
  const Decomposition& decomposition_;
  unsigned threads_;
  std::vector<std::uint64_t> next_; // sample in the file, by piece
  std::vector<std::uint32_t> piece_of_;
  std::vector<std::size_t> places_; // of the next sample, by block and piece
  Samples parted_;
  std::vector<SampleFile::Run> runs_;
};

} // namespace

SampleFile::SampleFile(const std::string& folder, unsigned threads)
    : threads_(threads)
    , positions_(folder)
    , values_(folder)
    , sources_(folder)
{
}

void
SampleFile::write(const SampleSpan& samples, const std::vector<Run>& runs)
{
  const auto put = [&](ScratchFile& file, const auto* array) {
    for (const Run& run : runs)
      file.write(run.to * sizeof(*array), array + run.from, run.size * sizeof(*array));
  };
  runAll(threads_,
         {[&] { put(positions_, samples.positions); },
          [&] { put(sources_, samples.sources); },
          [&] { put(values_, samples.values); }});
}

void
SampleFile::read(std::uint64_t begin, std::size_t count, Samples& samples) const
{
  const auto get = [&](const ScratchFile& file, auto& array) {
    array.resize(count);
    file.read(begin * sizeof(array[0]), array.data(), count * sizeof(array[0]));
  };
  runAll(count > thread_samples ? threads_ : 1,
         {[&] { get(positions_, samples.positions); },
          [&] { get(sources_, samples.sources); },
          [&] { get(values_, samples.values); }});
}

void
SampleFile::release(std::uint64_t begin, std::size_t count)
{
  const auto drop = [&](ScratchFile& file, std::size_t bytes) {
    file.release(begin * bytes, count * bytes);
  };
  runAll(threads_,
         {[&] { drop(positions_, sizeof(Position)); },
          [&] { drop(sources_, sizeof(std::uint64_t)); },
          [&] { drop(values_, sizeof(float)); }});
}

SampleLog::SampleLog(const std::string& folder, unsigned threads)
    : file_(folder, threads)
{
}

void
SampleLog::append(const Samples& samples)
{
  file_.write(samples.span(0, samples.size()), {{size_, 0, samples.size()}});
  size_ += samples.size();
}

PositionSource
SampleLog::getPositions() const
{
  return {size_, [this](std::uint64_t begin, std::size_t count, Position* buffer) {
            file_.readPositions(begin, count, buffer);
            for (std::size_t i = 0; i < count; ++i)
              buffer[i] = unit_.apply(buffer[i]);
            return buffer;
          }};
}

void
SampleLog::take(const std::function<void(Samples&)>& block)
{
  Samples samples;
  for (std::uint64_t begin = 0; begin < size(); begin += file_block) {
    const std::size_t count = std::min<std::uint64_t>(size() - begin, file_block);
    file_.read(begin, count, samples);
    file_.release(begin, count);
    for (Position& position : samples.positions)
      position = unit_.apply(position);
    block(samples);
  }
}

PieceFile::PieceFile(SampleLog&& log,
                     const Decomposition& decomposition,
                     const std::string& folder,
                     unsigned threads)
    : file_(folder, threads)
{
  Parting parting(decomposition, threads);
  log.take([&](const Samples& samples) {
    parting.part(samples);
    file_.write(parting.getSamples().span(0, samples.size()), parting.getRuns());
  });
}

Samples
PieceFile::load(std::uint64_t begin, std::uint64_t count) const
{
  Samples samples;
  file_.read(begin, static_cast<std::size_t>(count), samples);
  return samples;
}

void
PieceFile::save(std::uint64_t begin, const SampleSpan& samples)
{
  file_.write(samples, {{begin, 0, samples.size}});
}

} // namespace pcl_uvol
