// SPDX-License-Identifier: BSD-3-Clause
// Where pieces, their bricks and what is found in them are: in the memory of processes,
// or on a disk. The functions that say so are called by all processes, in one order.
#pragma once

#include "distributed/piece_stage.h"
#include <pcl_uvol/distributed/communicator.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace pcl_uvol {

/** \brief The range of no values. */
inline constexpr NodeRanges::Range no_range{std::numeric_limits<float>::infinity(),
                                            -std::numeric_limits<float>::infinity()};

/** \brief The samples of all processes in pieces, and these in blocks, which a stage
 * works on. */
class BlockStore {
public:
  BlockStore() = default;
  BlockStore(const BlockStore&) = delete;
  BlockStore&
  operator=(const BlockStore&) = delete;
  virtual ~BlockStore();

  virtual Communicator&
  getCommunicator() = 0;

  /** \brief Decompose the samples that were appended, and bring them to the processes
   * that own their pieces. By all processes. */
  virtual void
  redistribute() = 0;

  virtual const Decomposition&
  getDecomposition() const = 0;

  /** \brief Pieces of this process, ascending. */
  virtual std::vector<std::size_t>
  getOwnPieces() const = 0;

  /** \brief Get the samples of an own piece, as they lie there; they go back by one of
   * the three functions below. */
  virtual Samples
  takeSamples(std::size_t piece) = 0;

  /** \brief Put back the samples of a piece as they were. */
  virtual void
  putBack(std::size_t piece, Samples&& samples) = 0;

  /** \brief Put back the samples of a piece in leaf order. */
  virtual void
  put(std::size_t piece, Piece&& built) = 0;

  /** \brief Put back samples without their piece, to be redistributed again. */
  virtual void
  append(std::size_t piece, Samples&& samples) = 0;

  /** \brief Once all pieces are in leaf order: make blocks of them. */
  virtual void
  makeBlocks(Report& report) = 0;

  /** \brief Batches in which the blocks of all processes are taken, in turn. */
  virtual std::size_t
  countBatches() const = 0;

  /** \brief Bring those blocks of a batch into memory in which a stage can find
   * something, with the ghosts that touch them; those of the batch before are gone. By
   * all processes. */
  virtual std::map<std::size_t, Piece>&
  openBatch(std::size_t batch, const PieceStage& stage) = 0;

  /** \brief Give blocks of the open batch all ghosts that meet balls of theirs. By all
   * processes. */
  virtual void
  fetchGhosts(const std::map<std::size_t, std::vector<Ball>>& balls) = 0;

  /** \brief Keep records of a stage. */
  virtual void
  keepRecords(const PieceStage& stage,
              std::size_t list,
              const void* records,
              std::size_t count) = 0;

  /** \brief Bring all records to the stage of the process that owns the piece in which
   * they lie. By all processes. */
  virtual void
  returnToOwner(PieceStage& stage) = 0;
};

} // namespace pcl_uvol
