// SPDX-License-Identifier: BSD-3-Clause
#include "uvol_isosurface/result_facts.h"

#include "common/number_range.h"
#include "common/numbers.h"
#include "shared/isosurface_options.h"
#include "shared/level_set.h"
#include "shared/sampling_fact.h"
#include "shared/scale_option.h"

#include <cmath>
#include <optional>
#include <string>

namespace uvol_tools {

namespace {

/** Median, 95 % and maximum of the estimated errors. */
Fact
describeErrors(const std::optional<pcl_uvol::ErrorSummary>& errors)
{
  if (!errors)
    return {"estimated error", "not estimated", Fact::Members()};
  FactText text;
  text.precision(3);
  text << "median " << errors->median << ", 95 % within " << errors->percentile_95
       << ", largest " << errors->largest;
  return {"estimated error",
          text.str(),
          Fact::Members{{"median", {errors->median}},
                        {"percentile_95", {errors->percentile_95}},
                        {"largest", {errors->largest}}}};
}

std::string
describeShares(const pcl_uvol::ClassShares& shares, std::size_t count)
{
  FactText text;
  text.precision(3);
  text << 100.0 * shares.predicted << " % correct of " << count << " (nearest sample "
       << 100.0 * shares.nearest << " %, majority class " << 100.0 * shares.base
       << " %)";
  return text.str();
}

/** The cross-validation of one isovalue. */
Facts
describeValidation(const pcl_uvol::ValidationScore& score,
                   const std::string& of_isovalue)
{
  FactText beyond;
  beyond.precision(3);
  beyond << 100.0 * score.side_beyond_error << " % correct of " << score.beyond_error;
  const auto number = [](auto value) {
    return Fact::Numbers{static_cast<double>(value)};
  };
  FactText near;
  near << "; "
       << std::lround(100.0 * static_cast<double>(score.covered) /
                      static_cast<double>(score.tested))
       << " % of the held-out samples are near the surface";
  return {
      Fact("held-out side" + of_isovalue,
           score.covered == 0 ? "none of " + std::to_string(score.tested) +
                                    " held-out samples is near the surface"
                              : describeShares(score.side, score.covered) + near.str())
          .withoutJson(),
      Fact("held-out class" + of_isovalue, describeShares(score.field, score.tested))
          .withoutJson(),
      Fact("held-out side beyond the error" + of_isovalue,
           score.beyond_error == 0 ? std::string("no samples") : beyond.str())
          .withoutJson(),
      Fact("validation" + of_isovalue,
           "",
           Fact::Members{{"tested", number(score.tested)},
                         {"near", number(score.covered)},
                         {"side", number(score.side.predicted)},
                         {"side_of_nearest", number(score.side.nearest)},
                         {"side_base", number(score.side.base)},
                         {"side_error", number(score.side_error)},
                         {"side_of_field", number(score.side_of_field)},
                         {"side_everywhere", number(score.side_everywhere)},
                         {"class", number(score.field.predicted)},
                         {"class_of_nearest", number(score.field.nearest)},
                         {"class_base", number(score.field.base)},
                         {"beyond_error", number(score.beyond_error)},
                         {"side_beyond_error", number(score.side_beyond_error)}})};
}

Facts
describeGaps(const pcl_uvol::GapFilling& gaps)
{
  FactText text;
  text.precision(3);
  if (gaps.predicted == 0)
    text << "none filled: " << gaps.unfilled;
  else
    text << gaps.predicted << " samples predicted by kriging, spacing " << gaps.spacing
         << " (gaps " << gaps.width << " wide), within the range " << gaps.range
         << " of a spherical variogram (nugget " << gaps.nugget << ", partial sill "
         << gaps.psill << ")";
  const std::vector<Fact> members{{"predicted", static_cast<double>(gaps.predicted)},
                                  {"width", gaps.width},
                                  {"spacing", gaps.spacing},
                                  {"range", gaps.range},
                                  {"nugget", gaps.nugget},
                                  {"psill", gaps.psill},
                                  {"unfilled", gaps.unfilled}};
  return {Fact("gaps", text.str()).withoutJson(), Fact("gaps", members)};
}

/** Triangles, pieces with their genus and boundary loops, and the smallest angle. */
Facts
describeMesh(const pcl_uvol::IsosurfaceResult& result, bool is_measured)
{
  constexpr std::size_t most_shown = 6;
  FactText text;
  Fact::Numbers isovalues, triangles, genus, rims;
  for (const pcl_uvol::SurfacePiece& piece : result.pieces) {
    if (isovalues.size() < most_shown) {
      text << (isovalues.empty() ? "" : "; ") << piece.triangles << " triangles, genus "
           << piece.genus;
      if (piece.rims > 0)
        text << ", "
             << pcl_uvol::describeCount(piece.rims, "boundary loop", "boundary loops");
    }
    isovalues.push_back(piece.isovalue);
    triangles.push_back(piece.triangles);
    genus.push_back(piece.genus);
    rims.push_back(piece.rims);
  }
  if (result.pieces.size() > most_shown)
    text << "; and " << result.pieces.size() - most_shown << " more";
  FactText angle;
  angle.precision(3);
  angle << result.smallest_angle << " degrees";
  const Fact pieces("pieces",
                    text.str(),
                    Fact::Members{{"isovalue", isovalues},
                                  {"triangles", triangles},
                                  {"genus", genus},
                                  {"rims", rims}});
  return {is_measured ? pieces.withoutJson() : pieces,
          {"smallest angle", angle.str(), result.smallest_angle}};
}

} // namespace

Facts
describeSurface(const pcl_uvol::IsosurfaceResult& result,
                const pcl_uvol::IsosurfacePipelineParameters& parameters,
                bool is_measured)
{
  const auto& isovalues = parameters.isosurface.isovalues;
  Facts facts = {
      {"field", result.field},
      {"isovalues", joined(isovalues), isovalues},
      {"isopoints per isovalue", toNumbers(result.isopoints)},
  };
  append(facts, describe({result.scale, parameters.rotation}, result.scale_choice));
  facts.emplace_back("interpolation", toWord(result.interpolation));
  facts.push_back(describeErrors(result.errors));
  if (result.sampling)
    facts.push_back(describeSampling(*result.sampling));
  if (result.gaps)
    for (Fact& fact : describeGaps(*result.gaps))
      facts.push_back(std::move(fact));
  if (parameters.mesh)
    append(facts, describeMesh(result, is_measured));
  return facts;
}

Facts
describeModels(const pcl_uvol::IsosurfaceResult& result,
               const pcl_uvol::IsosurfacePipelineParameters& parameters)
{
  const auto& isovalues = parameters.isosurface.isovalues;
  const auto of_isovalue = [&](std::size_t i) {
    return isovalues.size() > 1 ? " at " + pcl_uvol::describeNumbers({isovalues[i]})[0]
                                : "";
  };
  Facts facts;
  for (std::size_t i = 0; i < result.level_sets.size(); ++i)
    append(facts,
           describe(result.level_sets[i], !parameters.level_set.mu, of_isovalue(i)));
  for (std::size_t i = 0; i < result.validation.size(); ++i)
    append(facts, describeValidation(result.validation[i], of_isovalue(i)));
  return facts;
}

} // namespace uvol_tools
