// SPDX-License-Identifier: BSD-3-Clause
// Isopoints between samples some of which kriging has predicted.
#include "common/median.h"
#include "common/scalar_field.h"
#include "isosurface/iso_edges.h"
#include "pipeline/gap_filling.h"
#include "pipeline/gap_widths.h"
#include "pipeline/kriged_slopes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl_uvol::detail {

namespace {

/** Spacings of predicted samples: an edge between measured samples that is longer
 * reaches across a gap. */
constexpr double longest_edge = 2.0;

/** Spacings of predicted samples that an isopoint may lie off the kriged surface: in a
 * gap, where it is put onto it, and on a line of measured samples, where it stays.
 * There a field that goes up and down within a spacing crosses the isovalue in places
 * that no surface can be followed from. */
constexpr double farthest_in_gap = 1.0, farthest_on_line = 0.5;

/** Share of the variance: where less is explained, most of a value is chance. */
constexpr float least_confidence = 0.5f;

/** Median of the errors between predicted samples over that of fits across gaps: beyond
 * it fits make the better surface. It is 25 to 180 on stretched cells of CFD, which
 * look like lines, 170 on casts of a smooth field, where deviations are 80 times as
 * large; up to 8 where waves are as long as gaps are wide. */
constexpr float much_worse = 16.0f;

using Eigen::Array3d;

Array3d
rootOf(const CloudView& cloud, const IsoEdge& edge)
{
  const auto at = [&](std::uint32_t sample) {
    return Array3d(Eigen::Map<const Eigen::Array3f>(cloud.xyz(sample)).cast<double>());
  };
  return at(edge.first) +
         static_cast<double>(edge.t) * (at(edge.second) - at(edge.first));
}

/** Isopoints that were found in gaps, and how many of them kriging explains nothing of,
 * which are gone. */
struct FoundInGaps {
  std::size_t all = 0, unexplained = 0;
};

/** Says so where fits to the measured samples tell much more than kriging does.
 * \param measured median of their errors across gaps; infinite if there are none */
void
warnOfWorse(const pcl::PointCloud<PointIso>& isopoints, float measured, Report& report)
{
  std::vector<float> errors;
  for (const PointIso& point : isopoints)
    if (point.support == static_cast<std::uint8_t>(IsoSupport::Predicted))
      errors.push_back(point.error);
  if (errors.empty())
    return;
  const float median = computeMedian(errors);
  if (median > much_worse * measured)
    report.warn("worse_in_gaps", {{"predicted", median}, {"measured", measured}});
}

/** Says so where the samples explain less than half of the variance at most isopoints
 * between predicted ones, or where none of these is left. */
void
warnOfUncertainGaps(const pcl::PointCloud<PointIso>& isopoints,
                    const std::vector<float>& confidence,
                    const FoundInGaps& found,
                    Report& report)
{
  std::vector<float> of_predicted;
  for (std::size_t i = 0; i < isopoints.size(); ++i)
    if (isopoints[i].support == static_cast<std::uint8_t>(IsoSupport::Predicted))
      of_predicted.push_back(confidence[i]);
  if (of_predicted.empty() && found.all > 0)
    report.warn("no_isopoints_in_gaps",
                {{"found", found.all},
                 {"unexplained", found.unexplained},
                 {"off_surface", found.all - found.unexplained}});
  if (of_predicted.empty())
    return;
  const float median = computeMedian(of_predicted);
  if (!(median >= least_confidence))
    report.warn("unconstrained_gaps", {{"percent", static_cast<int>(100.0f * median)}});
}

} // namespace

void
FilledGaps::addLatticeIsopoints(const IsosurfaceParameters& parameters,
                                pcl::PointCloud<PointIso>& isopoints,
                                IsoEdges& edges,
                                IsopointChoice& choice) const
{
  const CloudView cloud = viewOf(filled_->cloud);
  const ScalarField field(filled_->cloud.fields, parameters.field);
  pcl::PointCloud<PointIso> all;
  IsoEdges all_edges;
  IsopointChoice of_all;
  const auto add = [&](const PointIso& point,
                       const IsoEdge& edge,
                       IsoMethod method,
                       IsoOrientation orientation) {
    all.push_back(point);
    all_edges.push_back(edge);
    of_all.method.push_back(method);
    of_all.orientation.push_back(orientation);
  };
  std::size_t i = 0;
  for (const double isovalue : parameters.isovalues) {
    const auto rounded = static_cast<float>(isovalue);
    for (; i < isopoints.size() && isopoints[i].isovalue == rounded; ++i)
      add(isopoints[i], edges[i], choice.method[i], choice.orientation[i]);
    for (const auto& [first, second] : lattice_edges_) {
      const double a = field.read(cloud.point(first)),
                   b = field.read(cloud.point(second));
      if ((a >= isovalue) == (b >= isovalue))
        continue;
      const IsoEdge edge{first, second, static_cast<float>((isovalue - a) / (b - a))};
      PointIso point;
      point.isovalue = rounded;
      point.getArray3fMap() = rootOf(cloud, edge).cast<float>();
      point.edge_length = (Eigen::Map<const Eigen::Vector3f>(cloud.xyz(second)) -
                           Eigen::Map<const Eigen::Vector3f>(cloud.xyz(first)))
                              .norm();
      add(point, edge, IsoMethod::Kriging, IsoOrientation::Kriging);
    }
  }
  isopoints.swap(all);
  edges.swap(all_edges);
  choice = std::move(of_all);
}

void
FilledGaps::judge(const IsosurfacePipelineParameters& parameters,
                  unsigned threads,
                  pcl::PointCloud<PointIso>& isopoints,
                  IsoEdges& edges,
                  IsopointChoice& choice,
                  Report& report) const
{
  const bool on_lattice = summary_.predicted > 0 && takesLattice(parameters);
  if (on_lattice)
    addLatticeIsopoints(parameters.isosurface, isopoints, edges, choice);
  choice.confidence.assign(isopoints.size(), 1.0f);
  if (summary_.predicted == 0)
    return;
  const CloudView cloud = viewOf(filled_->cloud);
  const bool is_auto = returnsToEdges(parameters);
  const Array3d scale = parameters.isosurface.scale.cast<double>();
  std::vector<std::array<double, 3>> roots;
  for (std::size_t i = 0; i < isopoints.size(); ++i) {
    const Array3d root = is_auto ? rootOf(cloud, edges[i])
                                 : Array3d(isopoints[i].getArray3fMap().cast<double>());
    roots.push_back({root[0], root[1], root[2]});
  }
  Report own;
  own.progress = report.progress;
  const auto slopes = findKrigedSlopes(
      *field_, roots, slope_step * summary_.spacing, scale, threads, report.progress);
  const auto is_reliable = reliable_fits_->find(roots, threads);
  const auto support = nearest_->interpolate(roots, threads, own).support;
  const auto thin = findThin(roots, threads, nullptr);
  const double variance = summary_.nugget + summary_.psill;
  const std::size_t measured = samples_->cloud.width;
  const PointIso* const first = isopoints.data();
  std::vector<std::uint8_t> stays(isopoints.size(), 1);
  FoundInGaps found;
  for (std::size_t i = 0; i < isopoints.size(); ++i) {
    PointIso& point = isopoints[i];
    const IsoEdge& edge = edges[i];
    const bool is_predicted = edge.first >= measured || edge.second >= measured;
    const Eigen::Map<const Eigen::Array3f> a(cloud.xyz(edge.first)),
        b(cloud.xyz(edge.second));
    if (!is_predicted && is_reliable[i] != 0)
      continue;
    const bool is_in_gap =
        is_predicted || ((b - a).cast<double>() * scale).matrix().norm() >
                            longest_edge * summary_.spacing;
    if (!is_in_gap && thin[i] == 0 && support[i] == FieldSupport::Measured)
      continue;
    const KrigedSlope& slope = slopes[i];
    if (!(slope.length > 0.0))
      continue;
    const Array3d covector = slope.direction * scale;
    if (is_in_gap) {
      point.support = static_cast<std::uint8_t>(IsoSupport::Predicted);
      point.error = static_cast<float>(slope.findError(scale));
      choice.confidence[i] = static_cast<float>(
          std::clamp(1.0 - slope.deviation * slope.deviation / variance, 0.0, 1.0));
    }
    if (!is_auto)
      continue;
    found.all += is_in_gap;
    found.unexplained += !(choice.confidence[i] > 0.0f);
    const double shift = slope.findOffset(static_cast<double>(point.isovalue));
    const double offset = std::abs(shift) / summary_.spacing;
    if (is_in_gap)
      stays[i] = (is_predicted || !on_lattice) && offset <= farthest_in_gap &&
                 choice.confidence[i] > 0.0f;
    else
      stays[i] = !on_lattice || offset <= farthest_on_line;
    Array3d place(roots[i][0], roots[i][1], roots[i][2]);
    if (is_in_gap)
      place += shift * slope.direction / scale;
    else
      point.error = std::max(edge.t, 1.0f - edge.t) * point.edge_length;
    point.getArray3fMap() = place.cast<float>();
    if (is_in_gap &&
        !hull_->contains(measured_->getUnit().apply({{point.x, point.y, point.z}})))
      stays[i] = 0;
    point.mean_curvature = std::numeric_limits<float>::quiet_NaN();
    choice.method[i] = is_in_gap ? IsoMethod::Kriging : IsoMethod::Linear;
    if (parameters.normals != NormalMethod::Auto)
      continue;
    const double side = parameters.isosurface.outside == Outside::Lower ? -1.0 : 1.0;
    point.getNormalVector3fMap() =
        (side * covector.matrix().normalized()).cast<float>();
    choice.orientation[i] = IsoOrientation::Kriging;
  }
  const auto keep = [&](const PointIso& point) {
    return stays[static_cast<std::size_t>(&point - first)] != 0;
  };
  choice.filter(isopoints, keep);
  report.count("off_prediction", filterIsopoints(isopoints, edges, keep));
  warnOfWorse(isopoints, measured_error_, report);
  warnOfUncertainGaps(isopoints, choice.confidence, found, report);
}

} // namespace pcl_uvol::detail
