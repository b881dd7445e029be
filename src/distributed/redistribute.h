// SPDX-License-Identifier: BSD-3-Clause
// Samples on their way to the processes that own their pieces.
#pragma once

#include "distributed/decomposition.h"
#include "distributed/samples.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>

#include <cstddef>
#include <map>

namespace pcl_uvol {

/** \brief Which process owns a piece: groups of processes in a row own as many pieces
 * each, and so do, as nearly as possible, the processes of a group. */
class PCL_UVOL_EXPORTS PieceOwners {
public:
  /** \param groups as many as processes or fewer; a divisor of the pieces */
  PieceOwners(std::size_t pieces, std::size_t ranks, std::size_t groups = 1)
      : pieces_(pieces / groups)
      , ranks_(ranks)
      , groups_(groups)
  {
  }

  std::size_t
  getOwner(std::size_t piece) const
  {
    const std::size_t group = piece / pieces_;
    return getFirstRank(group) +
           piece % pieces_ * (getFirstRank(group + 1) - getFirstRank(group)) / pieces_;
  }

  /** \brief The first process of a group. */
  std::size_t
  getFirstRank(std::size_t group) const
  {
    return group * ranks_ / groups_;
  }

  /** \brief The group of a process. */
  std::size_t
  getGroup(std::size_t rank) const;

private:
  std::size_t pieces_, ranks_, groups_; // pieces of a group
};

/** \brief The samples of all processes, each where its piece is. */
struct Redistribution {
  Decomposition decomposition;
  PieceOwners owners;
  std::map<std::size_t, Samples> samples; ///< by own piece, in any order
};

/** \brief Groups by which as many processes best redistribute samples in two steps; 1:
 * one step is better. */
PCL_UVOL_EXPORTS std::size_t
chooseGroups(std::size_t ranks, int levels);

/** \brief Decompose the samples of all processes, and send them to the owners of their
 * pieces.
 *
 * With groups this takes two steps: samples are sent to the group that owns their part
 * of the first levels, evenly to its processes, and each group does the rest by itself.
 * Every process then looks at its samples for nodes of its group only, of which it
 * draws more positions, and waits for fewer messages; the result is the same.
 * \param levels of the decomposition
 * \param groups a power of two up to 2^levels, at most as many as processes
 * \param report gets the times of "decomposition" and "exchange" and the count
 * "bytes_redistributed"
 * \throws InvalidArgument unless there are as many samples as pieces */
PCL_UVOL_EXPORTS Redistribution
redistribute(Samples&& samples,
             int levels,
             std::size_t groups,
             Communicator& communicator,
             unsigned threads,
             Report& report);

} // namespace pcl_uvol
