// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/known_isopoints.h"

#include "pipeline/gap_widths.h"
#include "pipeline/stretched_edges.h"

#include <algorithm>
#include <cstdint>

namespace pcl_uvol {

namespace {

/** Part of an edge that an isopoint's error must not exceed for max_error to keep it
 * when it is automatic. An edge alone, whose ends lie on both sides of the surface,
 * tells as much or less: errors of isopoints without a fit begin there. Of 64,000 dense
 * samples with known truth, also clustered or in cells of 1:100, it keeps 99.7 % or
 * more of the isopoints, of noisy ones after a level set 93 %; between lines of
 * samples what strays little from those around: 19 % on the drill holes. A quarter
 * leaves 56 % of the smoothed ones, and the whole edge keeps nearly everything. */
constexpr float known_part = 0.5f;

/** Rounding of lengths that are parts of another. */
constexpr float rounding = 1e-5f;

bool
has(IsoSupport support, const PointIso& point)
{
  return point.support == static_cast<std::uint8_t>(support);
}

/** The error of a place on an edge of which only its ends are known: the surface lies
 * between these. */
float
errorOnEdge(const PointIso& point, const IsoEdge& edge)
{
  return std::max(edge.t, 1.0f - edge.t) * point.edge_length;
}

} // namespace

bool
isKnown(const PointIso& point)
{
  return point.error <= known_part * point.edge_length;
}

KnownIsopoints::KnownIsopoints(const CloudView& samples,
                               const Eigen::Array3f& scale,
                               const std::optional<SamplingSummary>& sampling,
                               const GapFilling* gaps)
    : samples_(samples)
    , scale_(scale)
    , lies_all_around_(sampling && sampling->most == LocalDimension::Volume)
{
  if (gaps && gaps->predicted > 0)
    longest_ = half_gap_ = static_cast<float>(detail::half_gap * gaps->spacing);
  else if (sampling && (sampling->most == LocalDimension::Line ||
                        sampling->most == LocalDimension::Sheet))
    longest_ = std::min(static_cast<float>(detail::crossing_edge) * sampling->along,
                        0.5f * sampling->across);
}

bool
KnownIsopoints::contain(const PointIso& point, const IsoEdge& edge) const
{
  if (has(IsoSupport::Predicted, point)) {
    // The normal is a covector: of a unit length in the stretched space it is longer by
    // what lengths along it are.
    const float stretch =
        (point.getNormalVector3fMap().array() / scale_).matrix().norm();
    return point.error <= half_gap_ * stretch;
  }
  const bool is_crossing = point.error <= point.edge_length &&
                           stretchedLength(samples_, edge, scale_) <= longest_;
  if (has(IsoSupport::Bridged, point))
    return is_crossing || (isKnown(point) &&
                           point.error < (1.0f - rounding) * errorOnEdge(point, edge));
  return is_crossing || isKnown(point) ||
         (lies_all_around_ &&
          point.error <= (1.0f + rounding) * errorOnEdge(point, edge));
}

} // namespace pcl_uvol
