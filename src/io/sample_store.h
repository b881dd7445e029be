// SPDX-License-Identifier: BSD-3-Clause
// Samples on disk: as they come, and in pieces.
#pragma once

#include "scratch_file.h"
#include <pcl_uvol/neighbors/piece.h>

#include <functional>
#include <vector>

namespace pcl_uvol {
namespace io {

/** \brief Samples in the order in which they came; positions can be read alone. */
class SampleLog {
public:
  explicit SampleLog(const std::string& folder);

  void
  append(const Samples& samples);

  std::uint64_t
  size() const
  {
    return positions_.size() / sizeof(Position);
  }

  std::uint64_t
  bytes() const
  {
    return positions_.size() + rest_.size();
  }

  /** \brief Call block for all positions. */
  void
  scan(const std::function<void(const Position*, std::size_t)>& block) const;

  /** \brief Call block for all samples. */
  void
  scanSamples(const std::function<void(const Samples&)>& block) const;

private:
  ScratchFile positions_, rest_;
};

/** \brief Samples by piece, one piece behind the other. */
class PieceStore {
public:
  /** \brief Part the samples of a log. */
  PieceStore(const SampleLog& log,
             const Decomposition& decomposition,
             const std::string& folder,
             unsigned threads);

  std::uint64_t
  bytes() const
  {
    return file_.size() + planes_.size();
  }

  std::uint64_t
  count(std::size_t piece) const
  {
    return begins_[piece + 1] - begins_[piece];
  }

  Samples
  load(std::size_t piece) const;

  /** \brief Put a piece back, in leaf order; one after the other. */
  void
  save(std::size_t piece, const Piece& built);

  /** \brief That piece again. */
  Piece
  restore(const Decomposition& decomposition,
          std::size_t piece,
          const Position& scale) const;

  /** \brief Samples of a piece here and there, once they were put back in leaf order.
   * \param begin of the piece in the leaf order of all samples */
  LentBrick
  lend(std::size_t piece, std::uint64_t begin, const Brick& brick) const;

private:
  /** Sample begin + i of the file. */
  void
  read(std::uint64_t begin, std::size_t count, Samples& samples) const;

  void
  write(std::uint64_t begin, const Samples& samples);

  ScratchFile file_, planes_;
  std::vector<std::uint64_t> begins_;       // by piece, and the end
  std::vector<std::uint64_t> plane_begins_; // by piece, and the end, of those saved
};

} // namespace io
} // namespace pcl_uvol
