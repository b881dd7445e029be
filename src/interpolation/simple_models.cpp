// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/simple_models.h"

#include "interpolation/query_search.h"
#include "interpolation/support_finder.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

NearestModel::NearestModel(const SampledFields& sampled)
    : sampled_(sampled)
    , sparse_(sparseSamples(*sampled.samples))
{
}

void
NearestModel::evaluate(const Query* queries,
                       std::size_t count,
                       const Estimates& estimates) const
{
  const std::size_t fields = sampled_.fields;
  SupportFinder support(*sampled_.samples, sparse_);
  support.expect(queries, count);
  QuerySearch search(*sampled_.samples, 1, queries, count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto near = search.find(i);
    std::copy_n(
        sampled_.valuesOf(near.samples[0]), fields, estimates.values + i * fields);
    if (estimates.gradients)
      std::fill_n(estimates.gradients + 3 * i * fields, 3 * fields, 0.0);
    estimates.support[i] = support.findExpected(i);
  }
}

ShepardModel::ShepardModel(const SampledFields& sampled,
                           const ShepardParameters& parameters)
    : sampled_(sampled)
    , parameters_(parameters)
    , sparse_(sparseSamples(*sampled.samples))
{
}

void
ShepardModel::evaluate(const Query* queries,
                       std::size_t count,
                       const Estimates& estimates) const
{
  const std::size_t fields = sampled_.fields;
  const std::vector<Position>& positions = sampled_.samples->getPositions();
  SupportFinder support(*sampled_.samples, sparse_);
  support.expect(queries, count);
  QuerySearch search(*sampled_.samples, parameters_.k, queries, count);
  WeightedSum sum(fields);
  for (std::size_t i = 0; i < count; ++i) {
    const Query& query = queries[i];
    const auto near = search.find(i);
    const std::uint32_t nearest =
        *std::min_element(near.samples, near.samples + near.size, [&](auto a, auto b) {
          return sqDistance(query, positions[a]) < sqDistance(query, positions[b]);
        });
    const double sq_nearest = sqDistance(query, positions[nearest]);
    sum.start(sampled_.valuesOf(nearest));
    for (std::size_t j = 0; j < near.size; ++j) {
      // Relative to the nearest, so that no weight is infinite.
      const Position& place = positions[near.samples[j]];
      const double sq_dist = sqDistance(query, place);
      const double weight =
          sq_nearest > 0.0 ? std::pow(sq_nearest / sq_dist, 0.5 * parameters_.power)
                           : (sq_dist > 0.0 ? 0.0 : 1.0);
      const double slope =
          sq_nearest > 0.0 ? -parameters_.power * weight / sq_dist : 0.0;
      sum.add(sampled_.valuesOf(near.samples[j]),
              weight,
              {slope * (query.x[0] - static_cast<double>(place[0])),
               slope * (query.x[1] - static_cast<double>(place[1])),
               slope * (query.x[2] - static_cast<double>(place[2]))});
    }
    sum.finish(i, estimates);
    estimates.support[i] = support.findExpected(i);
  }
}

} // namespace pcl_uvol::detail
