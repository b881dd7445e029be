// SPDX-License-Identifier: BSD-3-Clause
#include "shared/level_set.h"

#include "common/numbers.h"

namespace uvol_tools {

Facts
describe(const pcl_uvol::LevelSetSummary& summary,
         bool mu_is_automatic,
         const std::string& of_isovalue)
{
  const auto text = [](auto... parts) {
    FactText stream;
    stream.precision(3);
    (stream << ... << parts);
    return stream.str();
  };
  if (!(summary.spacing > 0.0))
    return {}; // there was no surface, and a warning says so
  Facts facts = {
      {"spacing" + of_isovalue,
       text(summary.spacing, " (median at the surface)"),
       summary.spacing},
      {"noise" + of_isovalue, text(summary.noise, " spacings"), summary.noise}};
  if (summary.logarithmic)
    facts.emplace_back("values" + of_isovalue, "logarithms");
  if (summary.steps.empty()) {
    facts.emplace_back(
        "level set" + of_isovalue,
        std::string("none: smoothing is not expected to reduce the error, so the "
                    "field is used unchanged") +
            (summary.smoothed ? " except for outliers" : ""),
        Fact::Members());
    return facts;
  }
  facts.emplace_back("mu" + of_isovalue,
                     text(summary.mu,
                          mu_is_automatic
                              ? " (automatic: the last of a series of decreasing "
                                "weights; -mu with this value smooths more)"
                              : ""),
                     summary.mu);
  const auto& last = summary.steps.back();
  facts.emplace_back(
      "level set" + of_isovalue,
      text(!summary.converged ? "not converged"
           : mu_is_automatic  ? "at the smallest expected error"
                              : "converged",
           " after ",
           pcl_uvol::describeCount(summary.steps.size(), "step", "steps"),
           ", moves by ",
           last.change,
           " spacings per unit of time, | |grad phi| - 1 | is ",
           last.slope_error),
      Fact::Members{{"converged", {summary.converged ? 1.0 : 0.0}},
                    {"steps", {static_cast<double>(summary.steps.size())}},
                    {"change", {last.change}},
                    {"slope_error", {last.slope_error}}});
  return facts;
}

} // namespace uvol_tools
