// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
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

void
checkParameters(const InterpolationParameters& parameters)
{
  for (const float factor : parameters.scale)
    if (!std::isfinite(factor) || factor <= 0.0f)
      throw InvalidArgument("The scale " + std::to_string(factor) +
                            " is not allowed: it must be finite and positive.");
  const ShepardParameters& shepard = parameters.shepard;
  if (shepard.k == 0)
    throw InvalidArgument(
        "The number of samples of a weighted mean is 0: it must be at "
        "least 1.");
  if (!std::isfinite(shepard.power) || shepard.power <= 0.0)
    throw InvalidArgument("The power of the inverse distance is " +
                          std::to_string(shepard.power) +
                          ": it must be finite and positive.");
}

} // namespace pcl_uvol
