// SPDX-License-Identifier: BSD-3-Clause
// A stage that works piece by piece, as whoever drives it over the pieces of many
// processes or of a disk sees it.
#pragma once

#include "distributed/piece.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace pcl_uvol {

/** \brief Takes records that a stage found, of one of its lists. */
using RecordSink =
    std::function<void(std::size_t list, const void* records, std::size_t count)>;

/** \brief What a stage does with one piece. */
class PCL_UVOL_EXPORTS PieceTask {
public:
  PieceTask() = default;
  PieceTask(const PieceTask&) = delete;
  PieceTask&
  operator=(const PieceTask&) = delete;
  virtual ~PieceTask();

  /** \brief Balls around records that may rest on samples beyond the piece: it needs
   * all bricks that meet them, as ghosts. In the stretched space. */
  virtual std::vector<Ball>
  getPendingBalls() const = 0;

  /** \brief Go on with these records, now that the piece has the ghosts; to be repeated
   * until no ball is pending. */
  virtual void
  resolvePending() = 0;

  /** \brief Hand out what was found. */
  virtual void
  giveRecords(const RecordSink& sink) const = 0;
};

/** \brief A stage whose results are lists of records, plain values of one size, each
 * found from the samples around one place. */
class PCL_UVOL_EXPORTS PieceStage {
public:
  PieceStage() = default;
  PieceStage(const PieceStage&) = delete;
  PieceStage&
  operator=(const PieceStage&) = delete;
  virtual ~PieceStage();

  /** \brief Factors by which the positions of samples are stretched. */
  virtual Position
  getScale() const = 0;

  /** \brief Lists of records: one per isovalue, say. */
  virtual std::size_t
  countLists() const = 0;

  /** \brief Bytes of a record. */
  virtual std::size_t
  getRecordSize() const = 0;

  /** \brief Look at the values of all samples before any piece is worked on. */
  virtual void
  checkValues(const NodeRanges::Range& range, Report& report) const = 0;

  /** \brief False if nothing is found among samples with these values. */
  virtual bool
  canFindIn(const NodeRanges::Range& range) const = 0;

  /** \brief Begin to work on a piece.
   * \param piece has the ghosts that touch its cell, or at least those that touch
   * bricks of it which, with the bricks around them, something can be found in. It
   * outlives the task, as the stage and the report do. */
  virtual std::unique_ptr<PieceTask>
  start(const Piece& piece, unsigned threads, Report& report) = 0;

  /** \brief The place of a record in the stretched space: it belongs to the piece in
   * whose cell that lies. */
  virtual Position
  findPlace(const void* record) const = 0;

  /** \brief Take the records of one list from all pieces; called once for each list.
   * They come in any order, and some may come twice.
   * \param read copies all of them to where it is told */
  virtual void
  receive(std::size_t list,
          std::size_t count,
          const std::function<void(void* records)>& read,
          unsigned threads,
          Report& report) = 0;
};

} // namespace pcl_uvol
