// SPDX-License-Identifier: BSD-3-Clause
// The one way through the pieces, wherever these are.
#include "distributed/run_stage.h"

#include "common/memory.h"
#include "distributed/block_store.h"
#include "distributed/byte_stream.h"
#include "distributed/rank_store.h"
#include "distributed/scratch_store.h"
#include "neighbors/sampling.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace pcl_uvol {

namespace {

/** One run of a stage, as one of the processes sees it. */
class StageRun {
public:
  StageRun(PieceStage& stage, BlockStore& store, unsigned threads, Report& report)
      : stage_(stage)
      , store_(store)
      , communicator_(store.getCommunicator())
      , threads_(threads)
      , report_(report)
  {
  }

  StageSamples
  run()
  {
    store_.redistribute();
    while (!buildPieces()) {
      mergeCoincident();
      store_.redistribute();
    }
    describePieces();
    for (std::size_t batch = 0; batch < store_.countBatches(); ++batch)
      runBatch(batch);
    store_.returnToOwner(stage_);
    samples_.sampling = summarizeSampling(allGatherItems(communicator_, seen_));
    return samples_;
  }

private:
  /** Put the pieces of this process into leaf order.
   * \return false if some samples coincide, anywhere: not all pieces are in leaf order
   * then */
  bool
  buildPieces()
  {
    values_ = no_range;
    seen_.clear();
    const Decomposition& parts = store_.getDecomposition();
    std::vector<std::uint64_t> coinciding{0};
    for (const std::size_t piece : store_.getOwnPieces()) {
      Samples samples = store_.takeSamples(piece);
      auto built = Piece::build(
          parts, piece, std::move(samples), stage_.getScale(), threads_, report_);
      if (!built) {
        // NOLINTNEXTLINE(bugprone-use-after-move): null leaves them where they were
        store_.putBack(piece, std::move(samples));
        coinciding[0] = 1;
        break;
      }
      const auto& values = built->getValues();
      const auto [min, max] = std::minmax_element(values.begin(), values.end());
      values_ = values_.joined({*min, *max});
      const auto seen = lookAtSome(
          built->getSamples(), parts.getBegin(piece), parts.getSampleCount(), threads_);
      seen_.insert(seen_.end(), seen.begin(), seen.end());
      store_.put(piece, std::move(*built));
    }
    communicator_.allReduce(coinciding);
    return coinciding[0] == 0;
  }

  /** Equal samples lie in one piece: there they become one. */
  void
  mergeCoincident()
  {
    for (const std::size_t piece : store_.getOwnPieces()) {
      Samples samples = store_.takeSamples(piece);
      const MergedSamples merged = mergeDuplicates(samples, threads_);
      samples_.duplicates += merged.duplicates;
      samples_.conflicting += merged.conflicting;
      report_.count("duplicates", merged.duplicates);
      report_.count("conflicting_duplicates", merged.conflicting);
      store_.append(piece, std::move(samples));
    }
  }

  void
  describePieces()
  {
    store_.makeBlocks(report_);
    const std::vector<std::size_t> pieces = store_.getOwnPieces();
    report_.count("pieces", pieces.size());
    for (const std::size_t piece : pieces)
      samples_.samples += store_.getDecomposition().getCount(piece);
    report_.count("samples", samples_.samples);
    for (const NodeRanges::Range& range :
         allGatherItems(communicator_, std::vector<NodeRanges::Range>{values_}))
      values_ = values_.joined(range);
    stage_.checkValues(values_, report_);
  }

  void
  runBatch(std::size_t batch)
  {
    std::map<std::size_t, std::unique_ptr<PieceTask>> tasks;
    for (const auto& [block, piece] : store_.openBatch(batch, stage_))
      tasks.emplace(block, stage_.start(piece, threads_, report_));
    while (resolvePending(tasks)) {
    }
    for (const auto& [block, task] : tasks)
      task->giveRecords([&](auto list, const void* records, auto count) {
        store_.keepRecords(stage_, list, records, count);
      });
  }

  /** \return false if nothing was pending, anywhere */
  bool
  resolvePending(const std::map<std::size_t, std::unique_ptr<PieceTask>>& tasks)
  {
    std::map<std::size_t, std::vector<Ball>> balls;
    for (const auto& [block, task] : tasks) {
      auto pending = task->getPendingBalls();
      if (!pending.empty())
        balls.emplace(block, std::move(pending));
    }
    std::vector<std::uint64_t> pending{balls.size()};
    communicator_.allReduce(pending);
    if (pending[0] == 0)
      return false;
    store_.fetchGhosts(balls);
    for (const auto& [block, pending_balls] : balls)
      tasks.at(block)->resolvePending();
    return true;
  }

  PieceStage& stage_;
  BlockStore& store_;
  Communicator& communicator_;
  unsigned threads_;
  Report& report_;
  NodeRanges::Range values_ = no_range; // of the pieces built
  std::vector<LocalSampling> seen_;     // by some of their samples
  StageSamples samples_;
};

/** Bytes of a stage on many processes, per sample of a process. */
constexpr double rank_sample_bytes = 130.0;

} // namespace

BlockStore::~BlockStore() = default;
PieceTask::~PieceTask() = default;
PieceStage::~PieceStage() = default;

void
checkMemoryTogether(const std::string& task,
                    std::size_t points,
                    double bytes,
                    Communicator& communicator)
{
  std::vector<std::uint64_t> failed{0};
  std::optional<NotEnoughMemory> own;
  try {
    checkMemoryOf(task, points, bytes);
  }
  catch (const NotEnoughMemory& error) {
    own = error;
    failed[0] = 1;
  }
  communicator.allReduce(failed);
  if (own)
    throw *own;
  if (failed[0] > 0)
    throw NotEnoughMemory("memory_of_other_processes", {{"processes", failed[0]}});
}

StageSamples
runOnRanks(PieceStage& stage,
           Samples&& samples,
           Communicator& communicator,
           unsigned threads,
           Report& report)
{
  checkMemoryTogether("The part of this process",
                      samples.size(),
                      rank_sample_bytes * static_cast<double>(samples.size()),
                      communicator);
  RankStore store(std::move(samples), communicator, threads, report);
  return StageRun(stage, store, threads, report).run();
}

StageSamples
runOutOfCore(PieceStage& stage,
             ScratchSamples&& samples,
             const OutOfCoreSettings& settings,
             Report& report)
{
  ScratchStore store(std::move(samples).takeLog(), stage, settings, report);
  return StageRun(stage, store, settings.threads, report).run();
}

} // namespace pcl_uvol
