// SPDX-License-Identifier: BSD-3-Clause
// Pieces in the memory of processes: each is a block, and all are taken in one batch.
#pragma once

#include "distributed/block_store.h"
#include "distributed/redistribute.h"

#include <optional>
#include <set>
#include <utility>

namespace pcl_uvol {

/** \brief The pieces of one of the processes. */
class RankStore : public BlockStore {
public:
  /** \param samples of this process
   * \param communicator, report must outlive the store */
  RankStore(Samples&& samples,
            Communicator& communicator,
            unsigned threads,
            Report& report);

  Communicator&
  getCommunicator() override
  {
    return communicator_;
  }

  void
  redistribute() override;

  const Decomposition&
  getDecomposition() const override
  {
    return parted_->decomposition;
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
    return 1;
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
  class GhostMessages;

  Communicator& communicator_;
  unsigned threads_;
  Report& report_;
  Samples samples_;                      // those without a piece
  std::optional<Redistribution> parted_; // samples of the pieces that are not built
  std::map<std::size_t, Piece> pieces_;
  std::map<std::size_t, BrickTable> bricks_;             // of these
  std::set<std::pair<std::size_t, std::uint64_t>> sent_; // ghosts: piece, brick
  std::vector<std::vector<Bytes>> records_;              // by owner and list
};

} // namespace pcl_uvol
