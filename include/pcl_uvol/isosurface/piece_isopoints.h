// SPDX-License-Identifier: BSD-3-Clause
// The isopoints of one piece of a decomposed data set, exactly as an extraction from
// all samples at once gives them.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/distributed/piece.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

struct IsopointInput;

/** \brief What IsosurfaceExtraction is told by its setters. */
struct IsosurfaceSettings {
  std::string field; ///< see ScalarField
  std::vector<double> isovalues;
  Outside outside = Outside::Lower;
  Interpolation interpolation = Interpolation::Smooth;
  AngleCriterion criterion = AngleCriterion::Kept;
  Position scale{{1.0f, 1.0f, 1.0f}};
};

/** \throws InvalidArgument without an isovalue, for one that is not finite in float and
 * for factors that are not finite and positive */
PCL_UVOL_EXPORTS void
checkSettings(const IsosurfaceSettings& settings);

/** \brief Warn of an isovalue that no edge can cross, with the values there are. */
PCL_UVOL_EXPORTS void
warnIfOutside(double isovalue,
              const std::string& field,
              const NodeRanges::Range& range,
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

/** \brief Isopoints of all edges from the samples of a piece; those to other pieces are
 * found there as well. */
class PCL_UVOL_EXPORTS PieceIsopoints {
public:
  /** \param piece with all bricks that touch one of its own which an edge that is
   * crossed may begin in: all that touch its cell are enough; must outlive this object
   * \param settings must outlive it; its scale is that of the piece
   * \param report gets the times of IsosurfaceExtraction */
  PieceIsopoints(const Piece& piece,
                 const IsosurfaceSettings& settings,
                 unsigned threads,
                 Report& report);

  /** \brief Balls around isopoints that are not settled, since their fits may rest on
   * samples beyond the piece: the piece needs all bricks that meet them. In the
   * stretched space. They are small at first, and grow as long as the nearest samples
   * may lie beyond them: a far one may turn out not to matter. */
  std::vector<Ball>
  getPendingBalls() const;

  /** \brief Fit again, now that the piece has these bricks; to be repeated until no
   * ball is open. */
  void
  resolvePending();

  /** \brief Per isovalue. */
  std::vector<std::vector<GlobalIsopoint>>&&
  take() &&
  {
    return std::move(found_);
  }

private:
  /** An isopoint that is not settled. */
  struct Open {
    std::size_t isovalue, index;
    Ball ball; ///< that is asked for
  };

  /** The linear isopoints of one isovalue. */
  void
  find(const IsopointInput& input, std::size_t isovalue);

  /** Fit some of them; those that are not settled by it join the open ones.
   * \param known radii of balls around them all samples of which the piece has */
  void
  fit(const IsopointInput& input,
      std::size_t isovalue,
      const std::vector<std::size_t>& indices,
      const std::vector<float>& known);

  const Piece& piece_;
  const IsosurfaceSettings& settings_;
  unsigned threads_;
  Report& report_;
  std::vector<std::vector<GlobalIsopoint>> found_;
  std::vector<Open> open_;
};

/** \brief Order isopoints of one isovalue, found in several pieces, leave one for each
 * edge, and of those that coincide the first.
 * \param report gets the counts "edges", "coincident" and, with smooth interpolation,
 * those of the roots, see IsosurfaceExtraction */
PCL_UVOL_EXPORTS void
mergeIsopoints(std::vector<GlobalIsopoint>& isopoints,
               Interpolation interpolation,
               unsigned threads,
               Report& report);

} // namespace pcl_uvol
