// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/redistribute.h"

#include "common/parallel.h"
#include "distributed/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace pcl_uvol {

namespace {

using SamplesOfPieces = std::map<std::size_t, Samples>;

/** Samples that a thread takes at once. */
constexpr std::size_t sent_block = 1u << 14;

/** With fewer processes, sending the samples twice costs more than it saves (the model
 * in tests/benchmarks/README.md). */
constexpr std::size_t least_ranks_in_groups = 64;

/** Samples by piece.
 * \param samples empty afterwards */
std::vector<Samples>
partSamples(Samples& samples, const Decomposition& decomposition, unsigned threads)
{
  std::vector<std::uint32_t> piece_of(samples.size());
  parallelBlocks(samples.size(), sent_block, threads, [&](auto begin, auto end) {
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

Decomposition
decompose(const Samples& samples,
          const std::function<Decomposition(const PositionSource&)>& make,
          Report& report)
{
  const StepTimer timer(report, "decomposition");
  const auto positions = [&](std::uint64_t begin, std::size_t, Position*) {
    return samples.positions.data() + begin;
  };
  return make({samples.size(), positions});
}

/** Send samples to the owners of their pieces.
 * \param samples empty afterwards */
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
      const SampleSpan all = parts[piece].span(0, parts[piece].size());
      Bytes& message = messages[owner];
      message.reserve(message.size() + sizeof(piece) + countBytes(all));
      ByteWriter writer(message);
      writer.put(piece);
      putSamples(writer, all);
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

/** Send samples to the groups that own the pieces of a decomposition: each of them to
 * all processes of its group, evenly, whatever this process holds. */
Samples
sendToGroups(Samples& samples,
             const Decomposition& decomposition,
             const PieceOwners& owners,
             Communicator& communicator,
             unsigned threads,
             Report& report)
{
  const StepTimer timer(report, "exchange");
  std::vector<Samples> parts = partSamples(samples, decomposition, threads);
  std::vector<Bytes> messages(communicator.size());
  for (std::size_t group = 0; group < parts.size(); ++group) {
    const std::size_t first = owners.getFirstRank(group),
                      ranks = owners.getFirstRank(group + 1) - first;
    for (std::size_t share = 0; share < ranks; ++share) {
      // Shares differ by one: each process begins with another one.
      Bytes& message = messages[first + (communicator.rank() + share) % ranks];
      const std::size_t begin = parts[group].size() * share / ranks,
                        end = parts[group].size() * (share + 1) / ranks;
      const SampleSpan span = parts[group].span(begin, end - begin);
      message.reserve(countBytes(span));
      ByteWriter writer(message);
      putSamples(writer, span);
    }
    parts[group] = {};
  }
  auto received =
      send(std::move(messages), "bytes_redistributed", communicator, report);
  std::size_t count = 0;
  for (const Bytes& bytes : received)
    count += ByteReader(bytes).get<std::size_t>(); // what putSamples begins with
  Samples own;
  own.reserve(count);
  for (Bytes& bytes : received) {
    ByteReader reader(bytes);
    getSamples(reader, own);
    bytes = {};
  }
  return own;
}

Redistribution
redistributeInGroups(Samples& samples,
                     int levels,
                     std::size_t groups,
                     Communicator& communicator,
                     unsigned threads,
                     Report& report)
{
  int top_levels = 0;
  while (std::size_t(1) << top_levels < groups)
    ++top_levels;
  const PieceOwners owners(std::size_t(1) << levels, communicator.size(), groups);
  const auto make_top = [&](const PositionSource& positions) {
    return Decomposition(positions, top_levels, communicator, threads);
  };
  const Decomposition top = decompose(samples, make_top, report);
  if (top.getSampleCount() >> levels == 0)
    throw InvalidArgument("more_levels_than_samples",
                          {{"samples", top.getSampleCount()}, {"levels", levels}});
  samples = sendToGroups(samples, top, owners, communicator, threads, report);

  const std::size_t own = owners.getGroup(communicator.rank());
  const auto group = communicator.split(own);
  const auto make_subtree = [&](const PositionSource& positions) {
    return Decomposition(top, own, positions, levels - top_levels, *group, threads);
  };
  const Decomposition subtree = decompose(samples, make_subtree, report);
  SamplesOfPieces parted = sendToOwners(
      samples, subtree, {subtree.size(), group->size()}, *group, threads, report);
  Redistribution all{
      Decomposition(top, subtree, group->rank() == 0, communicator), owners, {}};
  for (auto& [piece, part] : parted)
    all.samples.emplace(own * subtree.size() + piece, std::move(part));
  return all;
}

} // namespace

std::size_t
PieceOwners::getGroup(std::size_t rank) const
{
  std::size_t group = 0;
  while (getFirstRank(group + 1) <= rank)
    ++group;
  return group;
}

std::size_t
chooseGroups(std::size_t ranks, int levels)
{
  if (ranks < least_ranks_in_groups)
    return 1;
  const int half =
      static_cast<int>(std::lround(0.5 * std::log2(static_cast<double>(ranks))));
  return half < levels ? std::size_t(1) << half : 1; // few samples have few levels
}

Redistribution
redistribute(Samples&& samples,
             int levels,
             std::size_t groups,
             Communicator& communicator,
             unsigned threads,
             Report& report)
{
  if (groups == 0 || (groups & (groups - 1)) != 0 || groups > communicator.size() ||
      (levels >= 0 && groups >> levels > 1))
    throw InvalidArgument("bad_groups_of_ranks", {{"groups", groups}});
  if (groups > 1)
    return redistributeInGroups(samples, levels, groups, communicator, threads, report);
  const auto make = [&](const PositionSource& positions) {
    return Decomposition(positions, levels, communicator, threads);
  };
  Redistribution all{decompose(samples, make, report),
                     {std::size_t(1) << levels, communicator.size()},
                     {}};
  all.samples = sendToOwners(
      samples, all.decomposition, all.owners, communicator, threads, report);
  return all;
}

} // namespace pcl_uvol
