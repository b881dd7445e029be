// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "common/stretch_axes.h"
#include <pcl_uvol/interpolation/interpolation_parameters.h>

#include <cmath>

namespace pcl_uvol {

std::string
InterpolationParameters::toJson() const
{
  return writeJson(*this);
}

InterpolationParameters
InterpolationParameters::fromJson(const std::string& text)
{
  return readJson<InterpolationParameters>(text);
}

namespace {

/** \param is_allowed for a number that is not finite as well */
void
check(bool is_allowed, const char* name, double value, const char* allowed)
{
  if (!is_allowed)
    throw InvalidArgument("interpolation_number",
                          {{"number", name}, {"value", value}, {"allowed", allowed}});
}

void
check(const KrigingParameters& kriging)
{
  constexpr std::size_t most = 512;
  constexpr const char* level = "finite and not negative";
  const auto isLevel = [](double value) {
    return std::isnan(value) || (std::isfinite(value) && value >= 0.0);
  };
  check(isLevel(kriging.nugget), "nugget", kriging.nugget, level);
  check(isLevel(kriging.psill), "partial sill", kriging.psill, level);
  check(std::isnan(kriging.range) ||
            (std::isfinite(kriging.range) && kriging.range > 0.0),
        "range of the variogram",
        kriging.range,
        "finite and positive");
  for (const float ratio : kriging.ratios)
    check(std::isfinite(ratio) && ratio > 0.0f,
          "ratio of ranges",
          static_cast<double>(ratio),
          "finite and positive");
  for (const float angle : kriging.rotation)
    check(std::isfinite(angle),
          "rotation of the anisotropy",
          static_cast<double>(angle),
          "finite");
  check(kriging.k >= 1 && kriging.k <= most,
        "number of samples of a neighbourhood",
        static_cast<double>(kriging.k),
        "1 to 512");
  for (const float side : kriging.block)
    check(std::isfinite(side) && side >= 0.0f,
          "side of a block",
          static_cast<double>(side),
          level);
  check(kriging.trend >= 0 && kriging.trend <= 2, "trend", kriging.trend, "0, 1 or 2");
}

} // namespace

void
checkParameters(const InterpolationParameters& parameters)
{
  for (const float factor : parameters.scale)
    check(std::isfinite(factor) && factor > 0.0f,
          "scale",
          static_cast<double>(factor),
          "finite and positive");
  const detail::StretchAxes axes(parameters.rotation);
  const ShepardParameters& shepard = parameters.shepard;
  check(shepard.k >= 1,
        "number of samples of a weighted mean",
        static_cast<double>(shepard.k),
        "at least 1");
  check(std::isfinite(shepard.power) && shepard.power > 0.0,
        "power of the inverse distance",
        shepard.power,
        "finite and positive");
  check(parameters.kriging);
  check(parameters.sph.k >= 1,
        "number of the neighbour at which a kernel ends",
        static_cast<double>(parameters.sph.k),
        "at least 1");
}

} // namespace pcl_uvol
