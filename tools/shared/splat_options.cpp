// SPDX-License-Identifier: BSD-3-Clause
#include "shared/splat_options.h"

namespace uvol_tools {

void
SplatOptions::declare(Options& options)
{
  options.number("delta",
                 parameters_.delta,
                 1e-12,
                 1.0,
                 "largest distance of a point to its splat, relative to the longest "
                 "side of the bounding box without outliers");
  options.number("delta-abs",
                 length_,
                 1e-30,
                 1e15,
                 "largest distance of a point to its splat as a length");
  options.number("lambda",
                 parameters_.lambda,
                 0.0,
                 1.0,
                 "proportion of a splat's radius in which no other splat starts");
}

pcl_uvol::SplatParameters
SplatOptions::parameters(const Options& options) const
{
  pcl_uvol::SplatParameters parameters = parameters_;
  if (!options.given("delta-abs"))
    return parameters;
  if (options.given("delta"))
    throw UsageError("-delta and -delta-abs both give the error bound: give one of "
                     "them.");
  parameters.delta = length_;
  parameters.delta_is_length = true;
  return parameters;
}

bool
SplatOptions::isGiven(const Options& options) const
{
  return options.given("delta") || options.given("delta-abs") ||
         options.given("lambda");
}

} // namespace uvol_tools
