// SPDX-License-Identifier: BSD-3-Clause
// The isopoints of the pieces of a decomposed data set, exactly as an extraction from
// all samples at once gives them.
#pragma once

#include "common/value_frame.h"
#include "distributed/piece_stage.h"
#include "neighbors/length_unit.h"
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief Warn of an isovalue that no edge can cross, with the values there are.
 * \param range in the frame */
PCL_UVOL_EXPORTS void
warnIfOutside(double isovalue,
              const std::string& field,
              const NodeRanges::Range& range,
              const ValueFrame& frame,
              Report& report);

/** \brief An isopoint, and what it takes to tell it from those of other pieces. */
struct GlobalIsopoint {
  std::uint64_t lower, higher; ///< ends of its edge, in the leaf order of all samples:
                               ///< isopoints are ordered by them
  std::uint64_t first, second; ///< where these samples come from
  float t;                     ///< see IsoEdge
  Position linear;             ///< root along the edge
  Position outside;            ///< unit vector along the edge
  Position position, normal;
  float mean_curvature, error, edge_length;
  std::uint8_t support, outcome;
  bool is_contradicted; ///< see OneSidedTest
};

/** \brief The order of isopoints: that of their edges. */
inline bool
isBefore(const GlobalIsopoint& a, const GlobalIsopoint& b)
{
  return std::pair(a.lower, a.higher) < std::pair(b.lower, b.higher);
}

/** \brief As a point of a cloud. */
PCL_UVOL_EXPORTS PointIso
toPointIso(const GlobalIsopoint& isopoint, double isovalue);

/** \brief The extraction as a stage that runs piece by piece, on many processes or a
 * disk; one list per isovalue. */
class PCL_UVOL_EXPORTS IsosurfaceStage : public PieceStage {
public:
  /** \param parameters of the samples' scale
   * \param unit that the samples are in
   * \param frame that their values are in
   * \throws InvalidArgument for parameters that are none, see checkParameters */
  IsosurfaceStage(const IsosurfaceParameters& parameters,
                  const LengthUnit& unit,
                  const ValueFrame& frame);

  Position
  getScale() const override
  {
    return toPosition(parameters_.scale);
  }

  std::size_t
  countLists() const override
  {
    return parameters_.isovalues.size();
  }

  std::size_t
  getRecordSize() const override
  {
    return sizeof(GlobalIsopoint);
  }

  /** \brief Warn of isovalues that no edge can cross. */
  void
  checkValues(const NodeRanges::Range& range, Report& report) const override;

  bool
  canFindIn(const NodeRanges::Range& range) const override;

  /** \brief Find the isopoints of all edges from the samples of a piece; those to other
   * pieces are found there as well.
   * \param report gets the times of IsosurfaceExtraction */
  std::unique_ptr<PieceTask>
  start(const Piece& piece, unsigned threads, Report& report) override;

  Position
  findPlace(const void* record) const override;

  /** \brief Order isopoints, leave one for each edge, and of those that coincide the
   * first.
   * \param report gets the counts "edges", "coincident", "isopoints" and, with smooth
   * interpolation, those of the roots, see IsosurfaceExtraction */
  void
  receive(std::size_t list,
          std::size_t count,
          const std::function<void(void* records)>& read,
          unsigned threads,
          Report& report) override;

  /** \brief What was received, per isovalue, ordered by edges. By all processes.
   * \param report gets the counts of those linear ones of this process that are
   * examined, see countExamined, as getTally() does */
  std::vector<std::vector<GlobalIsopoint>>
  take(Communicator& communicator, Report& report);

  /** \brief Of this process, once its isopoints are taken. */
  const SurfaceTally&
  getTally() const
  {
    return tally_;
  }

private:
  IsosurfaceParameters parameters_; // as the samples are: in their unit and frame
  std::vector<double> isovalues_;   // of the field
  ValueFrame frame_;
  std::vector<std::vector<GlobalIsopoint>> received_;
  SurfaceTally tally_;
};

} // namespace pcl_uvol
