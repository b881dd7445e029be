// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/guessed_isopoints.h"

#include "pipeline/known_isopoints.h"
#include "pipeline/thin_parts.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_uvol {

namespace {

void
add(const PointIso& point,
    IsoMethod method,
    IsoOrientation orientation,
    SurfaceGrounds& grounds)
{
  const auto support = static_cast<IsoSupport>(point.support);
  const bool is_bisector = orientation == IsoOrientation::Bisector;
  ++grounds.known;
  const bool has_good_fit = method == IsoMethod::Fit && !is_bisector && isKnown(point);
  if (support == IsoSupport::Rim)
    ++(has_good_fit ? grounds.at_border : grounds.beside_gaps);
  else if (support == IsoSupport::Bridged && has_good_fit)
    ++grounds.beside_gaps;
  else
    grounds.guessed += is_bisector || support == IsoSupport::Bridged;
}

std::string
tellPart(std::size_t part, std::size_t all, const std::string& text)
{
  return std::to_string(100 * part / all) + text;
}

} // namespace

SurfaceGrounds
findGrounds(const pcl::PointCloud<PointIso>& isopoints,
            const IsoEdges& edges,
            const IsopointChoice& choice,
            const std::vector<std::uint8_t>& is_on_cap,
            const PeriodicBox& box)
{
  SurfaceGrounds grounds;
  const std::vector<std::uint8_t> is_thin = findThinParts(isopoints, edges);
  for (std::size_t i = 0; i < isopoints.size(); ++i) {
    const PointIso& point = isopoints[i];
    const bool is_cap = !is_on_cap.empty() && is_on_cap[i] != 0;
    if (!is_cap && point.support != static_cast<std::uint8_t>(IsoSupport::Unknown) &&
        (!isPeriodic(box.sides) || box.holds(point.data))) {
      add(point, choice.method[i], choice.orientation[i], grounds);
      grounds.thin += is_thin[i];
    }
  }
  return grounds;
}

SurfaceGrounds
findGrounds(const Report& linear_extraction)
{
  SurfaceGrounds grounds;
  grounds.known = linear_extraction.getCount("examined");
  grounds.beside_gaps = linear_extraction.getCount("examined_rim");
  grounds.guessed = linear_extraction.getCount("examined_bridged");
  return grounds;
}

SurfaceGrounds
addTogether(const SurfaceGrounds& own, Communicator& communicator)
{
  std::vector<std::uint64_t> counts{
      own.known, own.at_border, own.beside_gaps, own.guessed, own.thin};
  communicator.allReduce(counts);
  return {counts[0], counts[1], counts[2], counts[3], counts[4]};
}

std::string
tellGuesses(const SurfaceGrounds& grounds,
            const std::optional<SamplingSummary>& sampling,
            const std::string& advice)
{
  const bool lie_all_around = sampling && sampling->most == LocalDimension::Volume;
  const std::size_t at_border =
                        grounds.at_border + (lie_all_around ? grounds.beside_gaps : 0),
                    all = grounds.at_border + grounds.beside_gaps + grounds.guessed;
  if (2 * at_border > grounds.known)
    return tellPart(
        at_border,
        grounds.known,
        " % of the isopoints lie at the border of the samples: the surface may go "
        "on beyond it.");
  if (2 * all <= grounds.known)
    return "";
  if (lie_all_around && at_border > grounds.guessed)
    return tellPart(
        all,
        grounds.known,
        " % of the isopoints lie at the border of the samples or in gaps: the "
        "surface may go on beyond it.");
  return tellPart(
      all,
      grounds.known,
      " % of the isopoints lie between lines of samples or beside gaps: where the "
      "surface crosses a line is known, how it runs from there is a guess." +
          advice);
}

std::string
tellSmoothedGuesses(const Report& evolution, const SamplingSummary& sampling)
{
  return tellGuesses(findGrounds(evolution),
                     sampling,
                     " The isosurface through the same samples can be tested "
                     "(uvol_isosurface -validate), and its gaps filled (-fill-gaps).");
}

std::string
tellThinParts(const SurfaceGrounds& grounds)
{
  if (4 * grounds.thin <= grounds.known)
    return "";
  return tellPart(
      grounds.thin,
      grounds.known,
      " % of the isopoints are on parts or gaps that are thinner than two spacings: "
      "they are one layer of samples, which cannot tell the two sides apart, or noise. "
      "Areas and volumes there say little. If the file has cells, contour the cells "
      "instead; if the values are noisy, smooth them.");
}

std::string
tellGuessedBorder(const SurfaceGrounds& grounds)
{
  const std::size_t all = grounds.at_border + grounds.beside_gaps + grounds.guessed;
  if (2 * all <= grounds.known)
    return "";
  return tellPart(
      all,
      grounds.known,
      " % of the isopoints lie in or beside gaps between samples, and where "
      "the border of the cluster runs there is a guess.");
}

std::string
adviseRemedies(const IsosurfacePipelineParameters& parameters)
{
  std::vector<std::string> remedies;
  if (!parameters.automatic_scale && (parameters.isosurface.scale == 1.0f).all())
    remedies.emplace_back("-scale");
  if (!parameters.fill_gaps)
    remedies.emplace_back("-fill-gaps");
  std::string advice;
  for (const std::string& remedy : remedies)
    advice += (advice.empty() ? " " : " or ") + remedy;
  return remedies.empty() ? "" : advice + " may help.";
}

} // namespace pcl_uvol
