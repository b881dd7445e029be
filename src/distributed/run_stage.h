// SPDX-License-Identifier: BSD-3-Clause
// A stage over samples that no memory holds all of: those of many processes, or of a
// disk.
#pragma once

#include "distributed/piece_stage.h"
#include "distributed/samples.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pcl_uvol {

/** \brief What a stage ran on. */
struct StageSamples {
  /** What the samples of all processes are like, in their unit, as far as pieces tell,
   * whose ends see neighbours on one side only; the same on all processes. */
  SamplingSummary sampling;
  std::uint64_t samples = 0; ///< of the pieces of this process
  /** Samples of this process that became one with others, and those that such a one
   * stands for although their values differ. @{ */
  std::uint64_t duplicates = 0, conflicting = 0;
  /** @} */
};

/** \brief Run a stage on the samples of all processes.
 *
 * The first levels of the kd-tree part the samples into pieces, which are redistributed
 * to the processes: as many pieces as processes, or at least four times as many where
 * these are no power of two. Pieces exchange ghosts, bricks of some hundred samples,
 * along the cuts and around records close to them: what is sent after the
 * redistribution grows with the cuts, not with the samples. The stage of each process
 * receives the records that lie in the process's pieces.
 * \param samples of this process; there may be none
 * \param report gets the counts and times of the stage for this process, the counts
 * "duplicates", "conflicting_duplicates", "pieces", "samples", "bytes_redistributed"
 * and "bytes_exchanged", and the times of "decomposition", "tree" and "exchange"
 * \throws InvalidArgument on all processes if there is no sample at all
 * \throws NotEnoughMemory on all processes if one of them has not 130 bytes for each of
 * its samples */
PCL_UVOL_EXPORTS StageSamples
runOnRanks(PieceStage& stage,
           Samples&& samples,
           Communicator& communicator,
           unsigned threads,
           Report& report);

/** \brief checkMemoryOf() by all processes together: one that threw alone would leave
 * the others waiting.
 * \throws NotEnoughMemory on all of them if one has too little */
PCL_UVOL_EXPORTS void
checkMemoryTogether(const std::string& task,
                    std::size_t points,
                    double bytes,
                    Communicator& communicator);

/** \brief Where samples go that memory does not hold. */
struct OutOfCoreSettings {
  std::uint64_t max_memory = 0;     ///< bytes that the process may take
  std::string scratch_folder = "."; ///< 24 bytes per sample lie there at a time
  unsigned threads = 0;             ///< 0 = all cores
};

class SampleLog;

/** \brief Samples on disk, in files without a name: they are gone with the process. */
class PCL_UVOL_EXPORTS ScratchSamples {
public:
  /** \param scale factors by which positions are stretched
   * \throws IOError if the folder takes no files */
  ScratchSamples(const OutOfCoreSettings& settings, const Position& scale);
  ScratchSamples(ScratchSamples&&) noexcept;
  ScratchSamples&
  operator=(ScratchSamples&&) noexcept;
  ~ScratchSamples();

  /** \throws IOError, naming the folder, if the disk is full */
  void
  append(const Samples& samples);

  std::uint64_t
  size() const;

  /** \brief Bring all samples into one unit, once they are there.
   * \param report gets the count "far_points" and a warning of what is left out */
  LengthUnit
  normalize(Report& report);

  /** \brief What a store of pieces goes on with. */
  std::unique_ptr<SampleLog>
  takeLog() &&;

private:
  OutOfCoreSettings settings_;
  Position scale_;
  MagnitudeCounts magnitudes_;
  std::unique_ptr<SampleLog> log_;
};

/** \brief Run a stage on samples on disk, within a bound of memory.
 *
 * The samples are parted into pieces by the first levels of the kd-tree, which are
 * taken through memory piece by piece, to be ordered; the stage then works on those
 * blocks of the pieces in which something can be found, with the ghosts that these
 * need. On a file system that cannot shorten files at their beginning samples take
 * twice the room. The bound holds for the whole process as long as the records are few
 * beside the samples; pieces are made that small.
 * \param report as of runOnRanks, with the count "scratch_bytes" (records apart) and
 * the time of "scratch" instead of what is sent
 * \throws InvalidArgument without a sample, for a bound that is too small
 * \throws IOError if the disk is full */
PCL_UVOL_EXPORTS StageSamples
runOutOfCore(PieceStage& stage,
             ScratchSamples&& samples,
             const OutOfCoreSettings& settings,
             Report& report);

/** \brief The least bound in bytes that runOutOfCore() takes for that many samples.
 * \param list_count, record_size of the stage */
PCL_UVOL_EXPORTS std::uint64_t
computeLeastMemory(std::uint64_t samples,
                   std::size_t list_count,
                   std::size_t record_size);

} // namespace pcl_uvol
