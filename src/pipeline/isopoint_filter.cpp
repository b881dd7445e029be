// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/isopoint_filter.h"

#include "isosurface/iso_edges.h"
#include "neighbors/periodic_box.h"
#include "pipeline/periodic_surface.h"

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace pcl_uvol {

namespace {

/** Part of an edge that an isopoint's error must not exceed for max_error to keep it
 * when it is automatic. An edge alone, whose ends lie on both sides of the surface,
 * tells as much or less: errors of isopoints without a fit begin there. Of 64,000 dense
 * samples with known truth, also clustered or in cells of 1:100, it keeps 99.7 % or
 * more of the isopoints, of noisy ones after a level set 93 %; on lines of samples it
 * keeps what lies near them: 3 % on the drill holes, 4 % on the seaglider's dives. A
 * quarter leaves 56 % of the smoothed ones, and the whole edge keeps nearly everything
 * between the lines: 92 and 94 %. */
constexpr float known_part = 0.5f;

bool
isKnown(const PointIso& point)
{
  return point.error <= known_part * point.edge_length;
}

/** Share of the samples next to the surface that are spikes: of 1 % of all samples it
 * is 3 %. */
constexpr double told_spikes = 0.001;

/** Samples next to the surface whose values stand alone, as IsosurfaceExtraction and
 * SurfaceMesh count them. */
void
warnOfSpikes(const IsosurfacePipelineParameters& parameters, Report& report)
{
  const auto spikes = static_cast<double>(report.getCount("spikes")),
             crossing = static_cast<double>(report.getCount("crossing_samples"));
  if (parameters.smooth || spikes <= told_spikes * crossing)
    return;
  std::ostringstream text;
  text.precision(2);
  text << "Of the samples next to the surface " << 100.0 * spikes / crossing
       << " % have values far from those of all samples around them, which agree with "
          "one another: the isopoints around each of them show an outlier and no "
          "surface. -smooth takes the median of the neighbours instead, and -where "
          "leaves out values that cannot be.";
  report.warnings.push_back(text.str());
}

/** All isopoints that there were. */
void
warnOfNoneLeft(std::uint64_t isopoints, Report& report)
{
  const std::uint64_t by_error = report.getCount("removed_by_error"),
                      bridged = report.getCount("removed_bridged");
  if (isopoints > 0 || by_error + bridged == 0)
    return;
  const std::string options = by_error == 0  ? "-drop-bridged"
                              : bridged == 0 ? "-max-error"
                                             : "-max-error and -drop-bridged";
  const std::uint64_t removed = by_error + bridged;
  report.warnings.push_back(
      (removed == 1
           ? "The last isopoint was left out by "
           : "The last " + std::to_string(removed) + " isopoints were left out by ") +
      options + ": the samples tell of no part of the surface that well.");
}

} // namespace

std::string
adviseRemedies(const IsosurfacePipelineParameters& parameters)
{
  std::vector<std::string> remedies;
  if (!parameters.automatic_scale && (parameters.isosurface.scale == 1.0f).all())
    remedies.emplace_back("-scale");
  if (!parameters.fill_gaps)
    remedies.emplace_back("-fill-gaps");
  if (!parameters.drop_bridged)
    remedies.emplace_back("-drop-bridged");
  std::string advice;
  for (std::size_t i = 0; i < remedies.size(); ++i)
    advice += (i == 0 ? " " : i + 1 < remedies.size() ? ", " : " or ") + remedies[i];
  return remedies.empty() ? "" : advice + " may help.";
}

void
dropIsopoints(pcl::PointCloud<PointIso>& isopoints,
              IsoEdges& edges,
              IsopointChoice& choice,
              const IsosurfacePipelineParameters& parameters,
              Report& report)
{
  const auto filter = [&](const auto& keep) {
    choice.filter(isopoints, keep);
    return filterIsopoints(isopoints, edges, keep);
  };
  const auto drop = [&](const char* name, const auto& keep) {
    report.count(name, filter(keep));
  };
  const PeriodicBox box{{}, sidesOf(parameters)};
  if (isPeriodic(box.sides) && !parameters.mesh)
    filter([&](const PointIso& point) { return box.holds(point.data); });
  if (parameters.max_error)
    drop("removed_by_error",
         [&](const PointIso& point) { return point.error <= *parameters.max_error; });
  if (parameters.automatic_max_error)
    drop("removed_by_error", isKnown);
  if (parameters.drop_bridged)
    drop("removed_bridged", [](const PointIso& point) {
      return point.support != static_cast<std::uint8_t>(IsoSupport::Bridged);
    });
}

void
warnOfGuesses(const pcl::PointCloud<PointIso>& isopoints,
              const IsopointChoice& choice,
              const IsosurfacePipelineParameters& parameters,
              Report& report)
{
  std::size_t known = 0, predicted = 0, guesses = 0, at_border = 0;
  for (std::size_t i = 0; i < isopoints.size(); ++i) {
    const auto support = static_cast<IsoSupport>(isopoints[i].support);
    known += support != IsoSupport::Unknown;
    predicted += support == IsoSupport::Predicted;
    const bool is_rim = support == IsoSupport::Rim,
               is_bisector = choice.orientation[i] == IsoOrientation::Bisector;
    if (is_rim && !is_bisector && choice.method[i] == IsoMethod::Fit &&
        isKnown(isopoints[i]))
      ++at_border;
    else
      guesses += is_rim || is_bisector || support == IsoSupport::Bridged;
  }
  if (predicted > 0)
    report.count("predicted", predicted);
  const auto tell = [&](std::size_t part, const std::string& text) {
    report.warnings.push_back(std::to_string(100 * part / known) + text);
  };
  if (2 * at_border > known)
    tell(at_border,
         " % of the isopoints lie at the border of the samples: the surface may go on "
         "beyond it.");
  else if (2 * (guesses + at_border) > known)
    tell(guesses + at_border,
         " % of the isopoints lie between lines of samples or beside gaps: where the "
         "surface crosses a line is known, how it runs from there is a guess." +
             std::string(parameters.validation.folds > 0
                             ? ""
                             : " A hold-out test tells how good it is (-validate).") +
             adviseRemedies(parameters));
}

void
warnOfLosses(const IsosurfacePipelineParameters& parameters,
             std::uint64_t isopoints,
             Report& report)
{
  warnOfSpikes(parameters, report);
  warnOfNoneLeft(isopoints, report);
}

} // namespace pcl_uvol
