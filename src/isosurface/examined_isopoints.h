// SPDX-License-Identifier: BSD-3-Clause
// Isopoints that stay on their edges, of which some are fitted all the same: what the
// samples around these are like tells what the surface rests on.
#pragma once

#include "common/sketch.h"
#include "neighbors/sample_set.h"
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Linear roots of isopoints to choose from. Those that are chosen are the same
 * ones in whatever parts the isopoints were found, and however many fell together. */
class ExaminedCandidates {
public:
  void
  add(const Position& root)
  {
    sketch_.add({root[0], root[1], root[2]});
  }

  /** \brief Add those that may be chosen of other candidates.
   * \param roots from list() */
  void
  add(const std::vector<Position>& roots);

  /** \brief Those that may be chosen. */
  std::vector<Position>
  list() const;

private:
  Sketch<3> sketch_;
};

/** \brief Tells which isopoints are examined: 1024, or all of fewer. They tell shares
 * to 3 %, in the time that the edges of as many samples take. */
class ExaminedIsopoints {
public:
  explicit ExaminedIsopoints(const ExaminedCandidates& candidates);

  bool
  contain(const Position& root) const;

private:
  std::vector<Position> roots_; // in order
};

/** \brief Count those that were examined, those in gaps and those on rims.
 * \param supports one per isopoint that was examined
 * \param tally gets the numbers
 * \param report gets them as "examined", "examined_bridged" and "examined_rim" */
void
countExamined(const std::vector<std::uint8_t>& supports,
              SurfaceTally& tally,
              Report& report);

} // namespace pcl_uvol
