// SPDX-License-Identifier: BSD-3-Clause
// What a fit through the samples around an isopoint is worth, and the isopoint that it
// makes.
#pragma once

#include "derivatives/fit_kernel.h"
#include "derivatives/planar_fit.h"
#include "isosurface/isopoints.h"
#include "isosurface/smooth_roots.h"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Values around an isopoint. */
struct ValueSpan {
  double lowest, highest; ///< of the fitted samples
  double edge[2];         ///< at the ends of the isopoint's edge

  double
  range() const
  {
    return highest - lowest;
  }

  /** The part of the range between the ends of the edge. */
  double
  partOfEdge() const
  {
    return std::abs(edge[1] - edge[0]) / range();
  }
};

/** \brief The neighbourhood of one isopoint, beside what the fit is made from. Lengths
 * are those of the stretched space. */
struct Surroundings {
  double edge_length;
  double radius; ///< of the support
  ValueSpan values;
  Position center; ///< the linear root
  IsoSupport support;
  bool has_steps;           ///< the values are labels
  bool is_wide_gap = false; ///< see wide_gap
};

/** \brief Directions from an isopoint to samples, which the call makes unit vectors. */
struct NeighborDirections {
  float *x, *y, *z;
  std::size_t count; ///< a multiple of cone_lanes
};

/** \brief Share of the radius of the support: where no sample is nearer, no fit can
 * tell what the values are in the middle, since it has nothing there. */
constexpr float wide_gap = 0.8f;

/** \brief Whether samples have two values only, or few that are whole numbers.
 * \param values of all samples */
bool
areLabels(const std::vector<float>& values,
          const std::uint32_t* neighbors,
          std::size_t count);

/** \brief What samples around an isopoint tell of a gap there.
 * \param nearest distance of the nearest one */
IsoSupport
judgeSupport(const Surroundings& surroundings,
             double nearest,
             const NeighborDirections& directions);

/** \brief The same where samples lie on a plane that the surface crosses.
 * \param count the first ones of the lane, the nearest ones first
 * \param axes of the plane */
IsoSupport
supportInPlane(const Surroundings& surroundings,
               const FitSample* samples,
               std::size_t count,
               std::size_t lane,
               const PlaneAxes& axes);

/** \brief Whether a lane's fit serves, and if not, why. */
RootOutcome
judge(const FitResult& result, std::size_t lane, const Surroundings& surroundings);

/** \brief Error of the zero level of a fit that has not failed, in radii of the
 * support. */
double
errorOfFit(const FitResult& result, std::size_t lane);

/** \brief Whether an edge slips between samples, as through the channels of a lattice:
 * it is longer than those around are far, and they tell of no surface there, as they
 * have a fit without one, or lie on one side of it.
 * \param outcome what the fit is worth
 * \param samples that it is made from */
bool
goesPastSamples(const FitResult& result,
                std::size_t lane,
                RootOutcome outcome,
                const Surroundings& surroundings,
                const std::vector<FitSample>& samples);

/** \brief Whether a fit in another metric moves its isopoint far from a jump: a short
 * way in a metric may be a long one beside the edge it starts from.
 * \param edge_length in the samples' own space */
bool
isFarFromJump(const FitResult& result,
              std::size_t lane,
              const Surroundings& surroundings,
              double edge_length);

/** \brief Turn the result of a lane back from a metric, to the space it was made in. */
void
leaveMetric(const Eigen::Matrix3d& metric, std::size_t lane, FitResult& result);

/** \brief How far an isopoint may be moved by float holding its coordinates. */
double
computeRounding(const PointIso& point);

/** \brief Leave an isopoint on its edge across a wide gap. */
void
keepInGap(const IsoEdge& edge, PointIso& point);

/** \brief Let the error of an isopoint be that of its edge, if this is larger. */
void
raiseErrorToEdge(const IsoEdge& edge, PointIso& point);

/** \brief Make an isopoint what its fit says; one that the fit does not serve stays
 * where it is.
 * \param is_smooth whether it serves */
void
setIsopoint(const IsopointInput& input,
            const FitResult& result,
            std::size_t lane,
            const Surroundings& surroundings,
            bool is_smooth,
            const IsoEdge& edge,
            PointIso& point);

} // namespace pcl_uvol
