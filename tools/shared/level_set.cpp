// SPDX-License-Identifier: BSD-3-Clause
#include "shared/level_set.h"

#include "shared/options.h"

#include <sstream>

namespace uvol_tools {

std::optional<double>
parseMu(const std::string& text)
{
  if (text == "auto")
    return std::nullopt;
  const double mu = parseNumbers("mu", text, 1).front();
  if (mu < 0.0 || mu > 1.0)
    throw UsageError("-mu takes auto or a number from 0 to 1, but got " + text + ".");
  return mu;
}

Facts
describe(const pcl_uvol::LevelSetSummary& summary, bool mu_is_automatic)
{
  const auto text = [](auto... parts) {
    std::ostringstream stream;
    stream.precision(3);
    (stream << ... << parts);
    return stream.str();
  };
  const auto& last = summary.steps.back();
  const auto steps = static_cast<double>(summary.steps.size());
  return {
      {"spacing", text(summary.spacing, " (median at the surface)"), summary.spacing},
      {"noise", text(summary.noise, " spacings"), summary.noise},
      {"mu",
       text(summary.mu,
            mu_is_automatic ? " (automatic: by the noise and what smoothing left; "
                              "1 follows the data, 0 "
                              "only smooths)"
                            : ""),
       summary.mu},
      {"level set",
       text(summary.converged ? "converged" : "not converged",
            " after ",
            summary.steps.size(),
            " steps, moves by ",
            last.change,
            " spacings per unit of time, | |grad phi| - 1 | is ",
            last.slope_error),
       Fact::Members{{"converged", {summary.converged ? 1.0 : 0.0}},
                     {"steps", {steps}},
                     {"change", {last.change}},
                     {"slope_error", {last.slope_error}}}}};
}

} // namespace uvol_tools
