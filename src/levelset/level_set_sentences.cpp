// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/level_set_sentences.h"

#include "common/number_range.h"
#include "common/numbers.h"

#include <sstream>

namespace pcl_uvol {

std::string
adviseStability(const LevelSetParameters& parameters)
{
  if (parameters.scheme == FitScheme::Linear)
    return "use the quadratic scheme";
  if (parameters.bound == StepBound::Cfl)
    return "bound the steps by the stencils";
  if (parameters.reinitialization == Reinitialization::Diffusion)
    return "reinitialise by distance";
  if (parameters.initial.kind != InitialKind::Values)
    return "start from the values";
  return "give a larger mu, or extract the isosurface without smoothing";
}

std::string
describeVanished(const LevelSetParameters& parameters)
{
  return "The level set of " + parameters.field + " at the isovalue " +
         describeNumbers({parameters.isovalue})[0] + " has vanished: " +
         (parameters.initial.kind == InitialKind::Values
              ? "smoothing took the whole surface away. A larger mu keeps it."
              : "the values drew the whole start away. They lie on its other sides, if "
                "the wrong side is the outside.");
}

std::string
describeTies(double isovalue, double share)
{
  std::ostringstream text;
  text.precision(2);
  text << "Of the values next to the isovalue " << describeNumbers({isovalue})[0] << ' '
       << 100.0 * share
       << " % are the same: values in steps, or at a limit, do not tell how noisy they "
          "are, and nothing was smoothed. -mu 0.1 smooths them.";
  return text.str();
}

std::string
describeStepLimit(const LevelSetParameters& parameters,
                  const LevelSetSummary& summary,
                  std::optional<double> chosen_mu)
{
  std::ostringstream text;
  text.precision(2);
  text << "The level set at " << describeNumbers({parameters.isovalue})[0]
       << " has not converged after "
       << describeCount(summary.steps.size(), "step", "steps") << ": it still moves by "
       << summary.steps.back().change << " spacings per unit of time.";
  if (chosen_mu)
    text << " It ended at mu " << summary.mu << ", where " << *chosen_mu
         << " was chosen.";
  return text.str();
}

std::string
describeLostFeatures(double isovalue, std::size_t lost, double mu)
{
  std::ostringstream text;
  text.precision(2);
  text << "Smoothing has taken features away: "
       << describeCount(lost, "sample that lies", "samples that lie")
       << " farther from the isovalue " << describeNumbers({isovalue})[0]
       << " than noise explains " << (lost == 1 ? "is" : "are")
       << " on the other side of the surface now. A larger mu "
          "than "
       << mu << " keeps more of them.";
  return text.str();
}

} // namespace pcl_uvol
