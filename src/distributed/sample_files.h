// SPDX-License-Identifier: BSD-3-Clause
// Samples on disk: as they come, and in pieces.
#pragma once

#include "distributed/piece.h"
#include "distributed/scratch_file.h"

#include <functional>
#include <vector>

namespace pcl_uvol {

/** \brief Samples by number, in files of one array each, which are read and written at
 * the same time. */
class SampleFile {
public:
  SampleFile(const std::string& folder, unsigned threads);

  std::uint64_t
  bytes() const
  {
    return positions_.size() + values_.size() + sources_.size();
  }

  /** \brief Samples that follow each other here and there. */
  struct Run {
    std::uint64_t to;       ///< number of the first one in the file
    std::size_t from, size; ///< among those given
  };

  void
  write(const SampleSpan& samples, const std::vector<Run>& runs);

  /** \param samples get those from begin on, in place of what they were */
  void
  read(std::uint64_t begin, std::size_t count, Samples& samples) const;

  void
  readPositions(std::uint64_t begin, std::size_t count, Position* positions) const
  {
    positions_.read(begin * sizeof(Position), positions, count * sizeof(Position));
  }

  /** \brief Samples that are not read again. */
  void
  release(std::uint64_t begin, std::size_t count);

private:
  unsigned threads_;
  ScratchFile positions_, values_, sources_;
};

/** \brief Samples in the order in which they came. */
class SampleLog {
public:
  SampleLog(const std::string& folder, unsigned threads);

  void
  append(const Samples& samples);

  std::uint64_t
  size() const
  {
    return size_;
  }

  /** \brief Positions come out in a unit in which all of them are those of samples. */
  void
  setUnit(const LengthUnit& unit)
  {
    unit_ = unit;
  }

  /** \brief All positions; the log must outlive them. */
  PositionSource
  getPositions() const;

  /** \brief Call block for all samples, which then are gone. */
  void
  take(const std::function<void(Samples&)>& block);

private:
  SampleFile file_;
  std::uint64_t size_ = 0;
  LengthUnit unit_;
};

/** \brief Samples by piece, one piece behind the other. */
class PieceFile {
public:
  /** \brief Part the samples of a log, which then are gone from there. */
  PieceFile(SampleLog&& log,
            const Decomposition& decomposition,
            const std::string& folder,
            unsigned threads);

  std::uint64_t
  bytes() const
  {
    return file_.bytes();
  }

  /** \brief Consecutive samples, of one piece or, once all were put back in leaf order,
   * of any. */
  Samples
  load(std::uint64_t begin, std::uint64_t count) const;

  /** \brief Samples that are not read again. */
  void
  release(std::uint64_t begin, std::size_t count)
  {
    file_.release(begin, count);
  }

  /** \brief Put the samples of a piece back, in leaf order. */
  void
  save(std::uint64_t begin, const SampleSpan& samples);

private:
  SampleFile file_;
};

} // namespace pcl_uvol
