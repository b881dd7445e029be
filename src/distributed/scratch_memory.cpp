// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/scratch_memory.h"

#include "common/memory.h"
#include "distributed/piece.h"
#include "distributed/run_stage.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pcl_uvol {

namespace {

/** Bytes that a process takes besides samples: libraries and buffers. */
constexpr double fixed_bytes = 120e6;

/** Bytes per sample, whether they are in memory or not: tables of bricks. */
constexpr double table_bytes = 0.5;

/** Per sample of a piece while its tree is built: as read (24), as sorted (16 and 12),
 * and planes (up to 16). */
constexpr double piece_bytes = 72.0;

/** Records of a list as multiples of samples^(2/3): a surface that crosses the cloud
 * twice. Whether there are more is checked as they are found. */
constexpr double expected_records = 4.0;

/** Bytes of a record while lists are merged, or a point with the samples that it rests
 * on. */
constexpr double merging_copies = 2.0;

/** With fewer samples in a piece, other bytes outweigh its own. */
constexpr std::uint64_t least_piece = 1u << 14;
constexpr int most_levels = 12;

/** Bytes but those of pieces and records. */
double
computeBesides(std::uint64_t samples)
{
  return fixed_bytes + table_bytes * static_cast<double>(samples);
}

/** Bytes of pieces as small as they may be. */
int
findMostLevels(std::uint64_t samples)
{
  int levels = 0;
  while (levels < most_levels && samples >> (levels + 1) >= least_piece)
    ++levels;
  return levels;
}

} // namespace

/** What is drawn for the decomposition is less. */
double
ScratchMemory::computeBytes(double samples, double piece) const
{
  const double records = expected_records * list_count_ * std::pow(samples, 2.0 / 3.0);
  return fixed_bytes + table_bytes * samples +
         std::max(piece_bytes * piece, merging_copies * record_size_ * records);
}

int
ScratchMemory::chooseLevels(std::uint64_t samples) const
{
  const auto count = static_cast<double>(samples);
  for (int levels = 0; levels <= findMostLevels(samples); ++levels) {
    const double piece = std::ldexp(count, -levels);
    if (piece <= Piece::most_samples && computeBytes(count, piece) <= max_memory_)
      return levels;
  }
  throw InvalidArgument(
      "memory_for_pieces",
      {{"samples", samples},
       {"least", formatBytes(static_cast<double>(computeLeast(samples)))},
       {"allowed", formatBytes(max_memory_)}});
}

std::uint64_t
ScratchMemory::computeLeast(std::uint64_t samples) const
{
  const auto count = static_cast<double>(samples);
  return static_cast<std::uint64_t>(
      std::ceil(computeBytes(count, std::ldexp(count, -findMostLevels(samples)))));
}

bool
ScratchMemory::fits(std::uint64_t samples, std::uint64_t total) const
{
  return computeBesides(total) + piece_bytes * static_cast<double>(samples) <=
         max_memory_;
}

void
ScratchMemory::checkPiece(std::uint64_t samples, std::uint64_t total) const
{
  if (!fits(samples, total))
    throw InvalidArgument(
        "memory_for_piece",
        {{"samples", samples}, {"allowed", formatBytes(max_memory_)}});
}

void
ScratchMemory::checkBlock(std::uint64_t samples, std::uint64_t total) const
{
  if (samples > most_around_block && !fits(samples, total))
    throw InvalidArgument(
        "memory_for_block",
        {{"samples", samples}, {"allowed", formatBytes(max_memory_)}});
}

void
ScratchMemory::checkRecords(std::uint64_t bytes, std::uint64_t total) const
{
  const double needed =
      computeBesides(total) + merging_copies * static_cast<double>(bytes);
  if (needed > max_memory_)
    throw InvalidArgument(
        "memory_for_result",
        {{"needed", formatBytes(needed)}, {"allowed", formatBytes(max_memory_)}});
}

std::uint64_t
computeLeastMemory(std::uint64_t samples,
                   std::size_t list_count,
                   std::size_t record_size)
{
  return ScratchMemory(0, list_count, record_size).computeLeast(samples);
}

} // namespace pcl_uvol
