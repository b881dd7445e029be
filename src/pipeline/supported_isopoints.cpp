// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/supported_isopoints.h"

#include "common/scalar_field.h"
#include "pipeline/gap_widths.h"
#include "pipeline/stretched_edges.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace pcl_uvol {

namespace {

/** Part of an edge that an isopoint's error must not exceed for max_error to keep it
 * when it is automatic. An edge alone, whose ends lie on both sides of the surface,
 * tells as much or less: errors of isopoints without a fit begin there. Of 64,000 dense
 * samples with known truth, also clustered or in cells of 1:100, it keeps 99.7 % or
 * more of the isopoints, of noisy ones after a level set 93 %; between lines of
 * samples what deviates little from those around: 19 % on the drill holes. A quarter
 * leaves 56 % of the smoothed ones, and the whole edge keeps nearly everything. */
constexpr float known_part = 0.5f;

/** Rounding of lengths that are parts of another. */
constexpr float rounding = 1e-5f;

bool
has(IsoSupport support, const PointIso& point)
{
  return point.support == static_cast<std::uint8_t>(support);
}

/** Values that many of the samples beside an isovalue have. */
class CommonValues {
public:
  CommonValues(const CloudView& samples,
               const ScalarField& field,
               const IsoEdges& edges,
               std::size_t first,
               std::size_t last)
      : samples_(samples)
      , field_(field)
  {
    std::vector<std::uint32_t> beside;
    for (std::size_t i = first; i < last; ++i)
      beside.insert(beside.end(), {edges[i].first, edges[i].second});
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    for (const std::uint32_t sample : beside)
      ++counts_[read(sample)];
    least_ = common_share * static_cast<double>(beside.size());
  }

  /** Whether both ends of an edge have one, and neither lies far beyond the isovalue,
   * as the code of a missing value does. */
  bool
  contain(const IsoEdge& edge) const
  {
    const auto is_common = [&](std::uint32_t end) {
      return static_cast<double>(counts_.at(read(end))) >= least_;
    };
    return std::min(edge.t, 1.0f - edge.t) >= least_part && is_common(edge.first) &&
           is_common(edge.second);
  }

private:
  /** Share of the samples that have a common value: of two materials it is a half.
   * Outliers are fewer than the samples around them: of one in thirty it is 0.07. */
  static constexpr double common_share = 0.15;

  /** Of the edge, from either end to the root. */
  static constexpr float least_part = 0.01f;

  double
  read(std::uint32_t sample) const
  {
    return field_.read(samples_.point(sample));
  }

  const CloudView& samples_;
  ScalarField field_;
  double least_ = 0.0;
  std::map<double, std::size_t> counts_;
};

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

SupportedIsopoints::SupportedIsopoints(const CloudView& samples,
                                       const IsosurfaceParameters& parameters,
                                       const std::optional<SamplingSummary>& sampling,
                                       const GapFilling* gaps)
    : samples_(samples)
    , field_(parameters.field)
    , scale_(parameters.scale)
    , lies_all_around_(sampling && sampling->most == LocalDimension::Volume)
{
  if (gaps && gaps->predicted > 0)
    longest_ = half_gap_ = static_cast<float>(detail::half_gap * gaps->spacing);
  else if (sampling && (sampling->most == LocalDimension::Line ||
                        sampling->most == LocalDimension::Sheet))
    longest_ = std::min(static_cast<float>(detail::crossing_edge) * sampling->along,
                        0.5f * sampling->across);
}

std::vector<std::uint8_t>
SupportedIsopoints::find(const pcl::PointCloud<PointIso>& isopoints,
                         const IsoEdges& edges) const
{
  std::vector<std::uint8_t> jumps(isopoints.size());
  if (lies_all_around_)
    for (std::size_t first = 0, last = 0; first < isopoints.size(); first = last) {
      while (last < isopoints.size() &&
             isopoints[last].isovalue == isopoints[first].isovalue)
        ++last;
      const CommonValues common(
          samples_, ScalarField(samples_.fields, field_), edges, first, last);
      for (std::size_t i = first; i < last; ++i)
        jumps[i] = common.contain(edges[i]);
    }
  std::vector<std::uint8_t> known(isopoints.size());
  for (std::size_t i = 0; i < isopoints.size(); ++i)
    known[i] = contain(isopoints[i], edges[i], jumps[i] != 0);
  return known;
}

bool
SupportedIsopoints::contain(const PointIso& point,
                            const IsoEdge& edge,
                            bool is_jump) const
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
         (is_jump && point.error <= (1.0f + rounding) * errorOnEdge(point, edge));
}

} // namespace pcl_uvol
