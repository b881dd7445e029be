// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/supported_isopoints.h"

#include "common/parallel.h"
#include "common/scalar_field.h"
#include "neighbors/nearest_finder.h"
#include "pipeline/gap_widths.h"
#include "pipeline/stretched_edges.h"

#include <algorithm>
#include <cmath>
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
constexpr float precise_part = 0.5f;

/** Rounding of lengths that are parts of another. */
constexpr float rounding = 1e-5f;

bool
has(IsoSupport support, const PointIso& point)
{
  return point.support == static_cast<std::uint8_t>(support);
}

constexpr std::size_t spacing_block = 256;

/** The samples at the ends of edges. */
std::vector<std::uint32_t>
listEnds(const IsoEdges& edges, std::size_t first, std::size_t last)
{
  std::vector<std::uint32_t> ends;
  for (std::size_t i = first; i < last; ++i)
    ends.insert(ends.end(), {edges[i].first, edges[i].second});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
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
    const std::vector<std::uint32_t> beside = listEnds(edges, first, last);
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

/** Per edge the smaller distance from an end to the next sample at an edge, in the
 * stretched space: the spacing in a line or a sheet where the surface crosses it, as
 * samples beside it are at an edge.
 * \param first, last edges of one isovalue */
void
findSpacings(const CloudView& samples,
             const Eigen::Array3f& scale,
             const IsoEdges& edges,
             std::size_t first,
             std::size_t last,
             unsigned threads,
             std::vector<float>& spacings)
{
  Report own;
  const auto ends = SampleSet::build(samples.xyz(0),
                                     samples.stride(),
                                     listEnds(edges, first, last),
                                     toPosition(scale),
                                     threads,
                                     own);
  const LengthUnit& unit = ends->getUnit();
  parallelBlocks(last - first, spacing_block, threads, [&](auto begin, auto end) {
    NearestFinder nearest(*ends, 2);
    const auto find = [&](std::uint32_t sample) {
      const float* const xyz = samples.xyz(sample);
      const auto row = nearest.find(unit.apply({{xyz[0], xyz[1], xyz[2]}}), 1.0f);
      const float sq_distance =
          *std::max_element(row.sq_dists, row.sq_dists + row.size);
      return static_cast<float>(
          unit.toInput(std::sqrt(static_cast<double>(sq_distance))));
    };
    for (std::size_t i = first + begin; i < first + end; ++i)
      spacings[i] = std::min(find(edges[i].first), find(edges[i].second));
  });
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
isPrecise(const PointIso& point)
{
  return point.error <= precise_part * point.edge_length;
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
    longest_ = half_gap_ = 0.5f * static_cast<float>(gaps->width);
  else if (sampling && (sampling->most == LocalDimension::Line ||
                        sampling->most == LocalDimension::Sheet)) {
    along_ = sampling->along;
    longest_ = 0.5f * sampling->across;
  }
}

std::vector<std::uint8_t>
SupportedIsopoints::find(const pcl::PointCloud<PointIso>& isopoints,
                         const IsoEdges& edges,
                         unsigned threads) const
{
  std::vector<std::uint8_t> jumps(isopoints.size());
  std::vector<float> spacings(isopoints.size());
  for (std::size_t first = 0, last = 0; first < isopoints.size(); first = last) {
    while (last < isopoints.size() &&
           isopoints[last].isovalue == isopoints[first].isovalue)
      ++last;
    if (lies_all_around_) {
      const CommonValues common(
          samples_, ScalarField(samples_.fields, field_), edges, first, last);
      for (std::size_t i = first; i < last; ++i)
        jumps[i] = common.contain(edges[i]);
    }
    else if (along_ > 0.0f)
      findSpacings(samples_, scale_, edges, first, last, threads, spacings);
  }
  std::vector<std::uint8_t> is_supported(isopoints.size());
  for (std::size_t i = 0; i < isopoints.size(); ++i)
    is_supported[i] = contain(isopoints[i], edges[i], jumps[i] != 0, spacings[i]);
  return is_supported;
}

bool
SupportedIsopoints::contain(const PointIso& point,
                            const IsoEdge& edge,
                            bool is_jump,
                            float spacing) const
{
  if (has(IsoSupport::Predicted, point)) {
    // The normal is a covector: of a unit length in the stretched space it is longer by
    // what lengths along it are.
    const float stretch =
        (point.getNormalVector3fMap().array() / scale_).matrix().norm();
    return point.error <= half_gap_ * stretch;
  }
  // Lines and sheets may be sampled unevenly: the median is that of all their samples.
  float longest = longest_;
  if (along_ > 0.0f) {
    const float along = has(IsoSupport::Bridged, point) ? 0.0f : spacing;
    longest = std::min(
        static_cast<float>(detail::crossing_edge) * std::max(along_, along), longest_);
  }
  const bool is_crossing = point.error <= point.edge_length &&
                           stretchedLength(samples_, edge, scale_) <= longest;
  if (has(IsoSupport::Bridged, point))
    return is_crossing || (isPrecise(point) &&
                           point.error < (1.0f - rounding) * errorOnEdge(point, edge));
  return is_crossing || isPrecise(point) ||
         (is_jump && point.error <= (1.0f + rounding) * errorOnEdge(point, edge));
}

} // namespace pcl_uvol
