// SPDX-License-Identifier: BSD-3-Clause
// What memory a run through scratch files takes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_uvol {

/** \brief Samples that a stage works on at once: with four times as many, most of them
 * would lie far from any surface; with fewer, there would be more ghosts. */
constexpr std::uint64_t samples_per_block = 1u << 15;

/** \brief As many with their ghosts, elsewhere than in the sparse parts beside a
 * cluster; they count among the fixed bytes. */
constexpr std::uint64_t most_around_block = 4 * samples_per_block;

/** \brief A bound of memory and what it leaves for the samples and records of a run. */
class ScratchMemory {
public:
  /** \param list_count, record_size of the stage */
  ScratchMemory(std::uint64_t max_memory,
                std::size_t list_count,
                std::size_t record_size)
      : max_memory_(static_cast<double>(max_memory))
      , list_count_(static_cast<double>(list_count))
      , record_size_(static_cast<double>(record_size))
  {
  }

  /** \brief The fewest levels of pieces that fit.
   * \throws InvalidArgument if none do */
  int
  chooseLevels(std::uint64_t samples) const;

  /** \brief The least bound for which there are levels that fit. */
  std::uint64_t
  computeLeast(std::uint64_t samples) const;

  /** \brief Throw InvalidArgument unless the trees of that many samples of a piece fit
   * at a time.
   * \param total samples of all pieces */
  void
  checkPiece(std::uint64_t samples, std::uint64_t total) const;

  /** \brief The same for a block with its ghosts. */
  void
  checkBlock(std::uint64_t samples, std::uint64_t total) const;

  /** \brief The same for all records.
   * \param bytes of records found so far */
  void
  checkRecords(std::uint64_t bytes, std::uint64_t total) const;

private:
  /** Bytes of a run in pieces of that many samples. */
  double
  computeBytes(double samples, double piece) const;

  bool
  fits(std::uint64_t samples, std::uint64_t total) const;

  double max_memory_, list_count_, record_size_;
};

} // namespace pcl_uvol
