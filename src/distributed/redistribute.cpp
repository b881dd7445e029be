// SPDX-License-Identifier: BSD-3-Clause
#include "redistribute.h"

#include <pcl_uvol/common/parallel.h>

#include <utility>

namespace pcl_uvol {

namespace {

/** Samples that a thread takes at once. */
constexpr std::size_t block_samples = 1u << 14;

/** What put makes of samples and the number of their piece. */
std::size_t
countBytes(const Samples& samples)
{
  return 4 * sizeof(std::size_t) +
         samples.size() * (sizeof(Position) + sizeof(float) + sizeof(std::uint64_t));
}

/** Samples by piece. \param samples empty afterwards */
std::vector<Samples>
partSamples(Samples& samples, const Decomposition& decomposition, unsigned threads)
{
  std::vector<std::uint32_t> piece_of(samples.size());
  parallelBlocks(samples.size(), block_samples, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      piece_of[i] =
          static_cast<std::uint32_t>(decomposition.findPiece(samples.positions[i]));
  });
  std::vector<std::size_t> counts(decomposition.size());
  for (const std::uint32_t piece : piece_of)
    ++counts[piece];
  std::vector<Samples> parts(decomposition.size());
  for (std::size_t piece = 0; piece < parts.size(); ++piece)
    parts[piece].reserve(counts[piece]);
  for (std::size_t i = 0; i < samples.size(); ++i)
    parts[piece_of[i]].push(
        samples.positions[i], samples.values[i], samples.sources[i]);
  samples = {};
  return parts;
}

} // namespace

void
putSamples(ByteWriter& writer, const Samples& samples)
{
  writer.put(samples.positions);
  writer.put(samples.values);
  writer.put(samples.sources);
}

void
getSamples(ByteReader& reader, Samples& samples)
{
  reader.get(samples.positions);
  reader.get(samples.values);
  reader.get(samples.sources);
}

std::vector<Bytes>
send(std::vector<Bytes>&& messages,
     const std::string& counter,
     Communicator& communicator,
     Report& report)
{
  for (std::size_t rank = 0; rank < messages.size(); ++rank)
    if (rank != communicator.rank())
      report.count(counter, messages[rank].size());
  return communicator.allToAll(std::move(messages));
}

SamplesOfPieces
sendToOwners(Samples& samples,
             const Decomposition& decomposition,
             const PieceOwners& owners,
             Communicator& communicator,
             unsigned threads,
             Report& report)
{
  const StepTimer timer(report, "exchange");
  std::vector<Samples> parts = partSamples(samples, decomposition, threads);
  SamplesOfPieces own;
  std::vector<Bytes> messages(communicator.size());
  for (std::size_t piece = 0; piece < parts.size(); ++piece) {
    const std::size_t owner = owners.getOwner(piece);
    if (owner == communicator.rank()) {
      own[piece] = std::move(parts[piece]);
      own[piece].reserve(decomposition.getCount(piece)); // with those to come
    }
    else if (parts[piece].size() > 0) {
      Bytes& message = messages[owner];
      message.reserve(message.size() + countBytes(parts[piece]));
      ByteWriter writer(message);
      writer.put(piece);
      putSamples(writer, parts[piece]);
    }
    parts[piece] = {};
  }
  for (Bytes& bytes :
       send(std::move(messages), "bytes_redistributed", communicator, report)) {
    for (ByteReader reader(bytes); !reader.atEnd();)
      getSamples(reader, own[reader.get<std::size_t>()]);
    bytes = {};
  }
  return own;
}

} // namespace pcl_uvol
