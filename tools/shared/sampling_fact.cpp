// SPDX-License-Identifier: BSD-3-Clause
#include "shared/sampling_fact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace uvol_tools {

namespace {

constexpr const char* names[] = {"isolated", "lines", "sheets", "all around"};

/** The shares in percent, the largest first; those below half a percent are left out.
 */
std::string
listShares(const std::array<double, 4>& shares)
{
  std::array<std::size_t, 4> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return shares[a] > shares[b];
  });
  FactText text;
  for (const std::size_t dimension : order)
    if (const double percent = std::round(100.0 * shares[dimension]); percent > 0.0)
      text << (text.tellp() > 0 ? ", " : "") << names[dimension] << ' ' << percent
           << " %";
  return text.str();
}

std::string
describeSpacing(const pcl_uvol::SamplingSummary& sampling)
{
  const auto most = static_cast<std::size_t>(sampling.most);
  const bool is_volume = sampling.most == pcl_uvol::LocalDimension::Volume;
  FactText text;
  text.precision(3);
  text << "spacing " << sampling.along;
  if (sampling.most != pcl_uvol::LocalDimension::Isolated &&
      std::isfinite(sampling.across))
    text << (is_volume ? " to " : " along, ") << sampling.across
         << (is_volume ? "" : " across");
  if (std::round(100.0 * sampling.shares[most]) < 100.0)
    text << " (" << names[most] << ")";
  return text.str();
}

} // namespace

Fact
describeSampling(const pcl_uvol::SamplingSummary& sampling)
{
  const auto& shares = sampling.shares;
  const bool is_known = std::any_of(
      shares.begin(), shares.end(), [](double share) { return share > 0.0; });
  return {"sampling",
          is_known ? listShares(shares) + "; " + describeSpacing(sampling)
                   : "one position, no spacing",
          Fact::Members{{"isolated", {shares[0]}},
                        {"line", {shares[1]}},
                        {"sheet", {shares[2]}},
                        {"volume", {shares[3]}},
                        {"along", {sampling.along}},
                        {"across", {sampling.across}}}};
}

} // namespace uvol_tools
