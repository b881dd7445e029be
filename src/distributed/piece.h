// SPDX-License-Identifier: BSD-3-Clause
// A piece of a decomposed data set: a subtree of the kd-tree over all samples, and its
// ghosts, copies of samples of the pieces around it.
#pragma once

#include "distributed/decomposition.h"
#include "distributed/samples.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace pcl_uvol {

/** \brief A subtree of some hundred samples, the unit in which pieces get ghosts from
 * each other. */
struct Brick {
  std::uint64_t begin; ///< its first sample in the leaf order of all samples
  std::uint32_t count; ///< samples
  std::int32_t depth;  ///< of its root
  CellKey cell;
  NodeRanges::Range range; ///< of its values
};

/** \brief The planes of a piece's tree down to its bricks, and the ranges of their
 * values. Memory: about 1/4 byte per sample. */
class PCL_UVOL_EXPORTS BrickTable {
public:
  /** \brief Largest number of samples in a brick. */
  static constexpr std::uint32_t most_samples = 256;

  BrickTable() = default;

  /** \param tree of a piece, over the positions from 0 on
   * \param begin, cell of the piece among all samples */
  BrickTable(const KdTree& tree,
             const std::vector<Position>& positions,
             const std::vector<float>& values,
             std::uint64_t begin,
             const CellKey& cell);

  /** \brief The plane of a node with more samples than a brick, by its number below
   * the piece. */
  const PlaneKey&
  getPlane(std::size_t node) const
  {
    return planes_[node];
  }

  /** \brief Call found for each brick whose cell is accepted, ascending; cells around
   * bricks are asked first. */
  void
  find(const std::function<bool(const CellKey&)>& accepts,
       const std::function<void(const Brick&)>& found) const;

  /** \brief Call found for each brick that meets one of the balls, ascending. */
  void
  find(const std::vector<Ball>& balls,
       const std::function<void(const Brick&)>& found) const;

private:
  /** Visit the bricks below a node, with what is left of a criterion. */
  template <typename Criterion>
  void
  visit(const KdNode& node,
        CellKey& cell,
        const Criterion& criterion,
        const std::function<void(const Brick&)>& found) const;

  AxisCycle axes_{};
  KdNode root_{1, 0, 0, 0};
  std::uint64_t begin_ = 0;
  CellKey cell_;
  std::vector<PlaneKey> planes_; // by number, of nodes with more samples than a brick
  std::vector<NodeRanges::Range> ranges_; // by number, of bricks
};

/** \brief A copy of a brick with its samples, for another piece. */
struct GhostBrick {
  Brick brick;
  Samples samples;
};

/** \brief The samples of one piece with their tree, and the ghosts that it was given.
 * Memory: 32 to 40 bytes per sample, 28 more while it is built, 24 more while it gets
 * ghosts. */
class PCL_UVOL_EXPORTS Piece {
public:
  /** \brief Samples that a piece may have; with its ghosts it may hold twice as many.
   */
  static constexpr std::uint32_t most_samples = 1u << 31;

  /** \brief Build the subtree of a piece.
   * \param samples all of the piece, in any order
   * \param scale by which the positions are stretched
   * \return nothing, and the samples stay, if some coincide, or if there are none
   * because some coincide in other pieces: mergeDuplicates settles it
   * \throws InvalidArgument for more than most_samples */
  static std::optional<Piece>
  build(const Decomposition& decomposition,
        std::size_t piece,
        Samples&& samples,
        const Position& scale,
        unsigned threads,
        Report& report);

  /** \brief Own samples and ghosts, in one leaf order. */
  const SampleSet&
  getSamples() const
  {
    return *samples_;
  }

  /** \brief One entry per sample. @{ */
  const std::vector<float>&
  getValues() const
  {
    return values_;
  }
  std::uint64_t
  getSource(std::uint32_t sample) const
  {
    return sources_[sample];
  }
  /** @} */

  const CellKey&
  getCell() const
  {
    return runs_[own_].cell;
  }

  /** \brief Index in the leaf order of all samples, and the way back.
   * \throws InvalidArgument for a sample that the piece does not have @{ */
  std::uint64_t
  toGlobal(std::uint32_t sample) const;
  std::uint32_t
  toLocal(std::uint64_t sample) const;
  /** @} */

  /** \brief Bricks of the own samples, before there are ghosts. */
  BrickTable
  makeBricks() const;

  /** \brief A copy of a brick of this piece. */
  GhostBrick
  makeGhost(const Brick& brick) const;

  /** \brief All own samples, in leaf order. */
  SampleSpan
  getOwnSamples() const
  {
    return getSpan(getFirst(runs_[own_]), runs_[own_].count);
  }

  /** \brief True for a brick of the piece and a ghost of it. */
  bool
  holds(const Brick& brick) const;

  /** \brief Add ghosts; those that are there already are left out. If it throws, the
   * piece is lost.
   * \throws InvalidArgument if own samples and ghosts are too many
   * \return how many are new */
  std::size_t
  addGhosts(std::vector<GhostBrick>&& bricks, unsigned threads);

private:
  /** Consecutive samples: the own ones, or those of a brick. */
  struct Run {
    std::uint64_t begin; // in the leaf order of all
    std::uint32_t count;
    CellKey cell;
  };

  /** Values of the samples, in leaf order. */
  Piece(const Decomposition& decomposition,
        std::size_t piece,
        Samples&& samples,
        KdTree&& tree,
        const Position& scale);

  /** The last one that begins with or before a sample in the leaf order of all. */
  std::vector<Run>::const_iterator
  findRun(std::uint64_t sample) const;

  std::uint32_t
  getFirst(const Run& run) const;

  SampleSpan
  getSpan(std::uint32_t first, std::uint32_t count) const;

  void
  join(const std::vector<GhostBrick>& bricks, std::vector<KdTree>&& trees);

  std::unique_ptr<SampleSet> samples_;
  std::vector<float> values_;
  std::vector<std::uint64_t> sources_;
  std::vector<Run> runs_; // ascending, one per tree of samples_
  std::size_t own_ = 0;
  AxisCycle axes_;
};

} // namespace pcl_uvol
