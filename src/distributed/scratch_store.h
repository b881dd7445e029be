// SPDX-License-Identifier: BSD-3-Clause
// Pieces on disk: what is in memory is one of them, or one block of one.
#pragma once

#include "distributed/block_store.h"
#include "distributed/run_stage.h"
#include "distributed/sample_files.h"
#include "distributed/scratch_memory.h"

#include <memory>
#include <optional>

namespace pcl_uvol {

/** \brief The pieces of a process that is alone. Blocks are subtrees of pieces, so that
 * parts in which nothing is found are not looked at again. */
class ScratchStore : public BlockStore {
public:
  /** \param log of all samples
   * \param stage, settings, report must outlive the store */
  ScratchStore(std::unique_ptr<SampleLog> log,
               const PieceStage& stage,
               const OutOfCoreSettings& settings,
               Report& report);

  Communicator&
  getCommunicator() override
  {
    return alone_;
  }

  void
  redistribute() override;

  const Decomposition&
  getDecomposition() const override
  {
    return *decomposition_;
  }

  std::vector<std::size_t>
  getOwnPieces() const override;

  Samples
  takeSamples(std::size_t piece) override;

  void
  putBack(std::size_t piece, Samples&& samples) override;

  void
  put(std::size_t piece, Piece&& built) override;

  void
  append(std::size_t piece, Samples&& samples) override;

  void
  makeBlocks(Report& report) override;

  std::size_t
  countBatches() const override
  {
    return blocks_->size();
  }

  std::map<std::size_t, Piece>&
  openBatch(std::size_t batch, const PieceStage& stage) override;

  void
  fetchGhosts(const std::map<std::size_t, std::vector<Ball>>& balls) override;

  void
  keepRecords(const PieceStage& stage,
              std::size_t list,
              const void* records,
              std::size_t count) override;

  void
  returnToOwner(PieceStage& stage) override;

private:
  /** The bricks of a block and those that touch it. */
  struct Bricks {
    std::vector<Brick> own, around;
  };

  Bricks
  findTouching(std::size_t block) const;

  Samples
  load(std::uint64_t begin, std::uint64_t count) const;

  /** Copies of bricks for a block.
   * \param samples of it, with the ghosts it has */
  std::vector<GhostBrick>
  loadGhosts(const std::vector<Brick>& bricks, std::uint64_t samples) const;

  const OutOfCoreSettings& settings_;
  Report& report_;
  ScratchMemory memory_;
  SelfCommunicator alone_;
  std::unique_ptr<SampleLog> log_;
  std::unique_ptr<PieceFile> file_;
  std::optional<Decomposition> decomposition_, blocks_;
  std::vector<BrickTable> bricks_; // by piece
  std::map<std::size_t, Piece> open_;

  /** Records of one list that follow each other. */
  struct Run {
    std::uint64_t begin, size; // bytes
  };
  ScratchFile records_;                // they wait on disk while there are blocks
  std::vector<std::vector<Run>> runs_; // by list
};

} // namespace pcl_uvol
