// SPDX-License-Identifier: BSD-3-Clause
#include "shared/sampling_fact.h"

#include <cmath>

namespace uvol_tools {

Fact
describeSampling(const pcl_uvol::SamplingSummary& sampling)
{
  constexpr const char* names[] = {"isolated", "lines", "sheets", "all around"};
  const auto most = static_cast<std::size_t>(sampling.most);
  FactText text;
  text.precision(3);
  text << names[most] << ", spacing " << sampling.along;
  if (sampling.most != pcl_uvol::LocalDimension::Isolated &&
      std::isfinite(sampling.across))
    text << (sampling.most == pcl_uvol::LocalDimension::Volume ? " to " : " along, ")
         << sampling.across
         << (sampling.most == pcl_uvol::LocalDimension::Volume ? "" : " across");
  text << " (" << std::round(100.0 * sampling.shares[most]) << " % of the samples)";
  const auto& shares = sampling.shares;
  return {"sampling",
          text.str(),
          Fact::Members{{"isolated", {shares[0]}},
                        {"line", {shares[1]}},
                        {"sheet", {shares[2]}},
                        {"volume", {shares[3]}},
                        {"along", {sampling.along}},
                        {"across", {sampling.across}}}};
}

} // namespace uvol_tools
