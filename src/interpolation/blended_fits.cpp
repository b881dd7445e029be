// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/blended_fits.h"

#include "interpolation/polynomial_sum.h"
#include "interpolation/support_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pcl_uvol::detail {

namespace {

/** Queries share the search for fits while these come from no more buckets. */
constexpr std::size_t most_buckets = 32;

/** Weights that sum up to less are joined by those of balls that much larger. */
constexpr double thin_weight = 0.1, wide_ball = 2.0;

/** Share of the radius of a fit's support: farther out the fit is continued straight
 * on. */
constexpr double farthest_offset = 1.3;

/** Samples whose fits may have a weight for some queries, ascending. */
struct Candidates {
  std::vector<double> x[3], per_sq_reach;
  std::vector<std::uint32_t> bucket, place; ///< in the bucket

  void
  clear()
  {
    for (auto& coordinate : x)
      coordinate.clear();
    per_sq_reach.clear();
    bucket.clear();
    place.clear();
  }

  std::size_t
  size() const
  {
    return bucket.size();
  }
};

/** The answers to the queries of a block. */
class BlockBlender {
public:
  BlockBlender(const SampledFields& sampled,
               const std::vector<Position>& sparse,
               const SampleFits& fits,
               const Query* queries,
               const Estimates& estimates)
      : sampled_(sampled)
      , sparse_(sparse)
      , fits_(fits)
      , queries_(queries)
      , estimates_(estimates)
      , sum_(sampled.fields)
  {
  }

  /** Answer consecutive queries, together if few buckets matter to them. */
  void
  answer(std::size_t begin, std::size_t end)
  {
    const auto [low, high] = boxOf(begin, end);
    buckets_.clear();
    const std::size_t most =
        end - begin == 1 ? std::numeric_limits<std::size_t>::max() : most_buckets;
    if (!fits_.getBalls().findReaching(low, high, 1.0, most, buckets_)) {
      const std::size_t middle = begin + (end - begin) / 2;
      answer(begin, middle);
      answer(middle, end);
      return;
    }
    collect(low, high, 1.0, candidates_);
    for (std::size_t i = begin; i < end; ++i)
      answer(i);
  }

private:
  using Corner = std::array<double, 3>;

  std::pair<Corner, Corner>
  boxOf(std::size_t begin, std::size_t end) const
  {
    Corner low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [least, largest] = std::minmax_element(
          queries_ + begin, queries_ + end, [&](const Query& a, const Query& b) {
            return a.x[axis] < b.x[axis];
          });
      low[axis] = least->x[axis];
      high[axis] = largest->x[axis];
    }
    return {low, high};
  }

  /** The samples of the buckets found whose balls, their radius times a factor, reach
   * into a box. */
  void
  collect(const Corner& low, const Corner& high, double factor, Candidates& candidates)
  {
    const std::vector<Position>& positions = sampled_.samples->getPositions();
    candidates.clear();
    for (const std::uint32_t bucket : buckets_) {
      const BallTree::Bucket& samples = fits_.getBalls().getBuckets()[bucket];
      const BucketFits& fits = fits_.getFits(bucket);
      // The bound that the bucket was found by is a loose one.
      if (!(sqGap(low, high, samples.box) < factor * factor * fits.largest_sq_reach))
        continue;
      for (std::size_t i = 0; i < fits.radius.size(); ++i) {
        const Position& center = positions[samples.begin + i];
        double sq_gap = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double x = center[static_cast<int>(axis)];
          const double gap = std::max({low[axis] - x, x - high[axis], 0.0});
          sq_gap += gap * gap;
        }
        const double sq_reach = factor * factor * fits.sq_reach[i];
        if (!(sq_gap < sq_reach))
          continue;
        for (int axis = 0; axis < 3; ++axis)
          candidates.x[axis].push_back(center[axis]);
        candidates.per_sq_reach.push_back(1.0 / sq_reach);
        candidates.bucket.push_back(bucket);
        candidates.place.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }

  void
  answer(std::size_t i)
  {
    const Query& query = queries_[i];
    bool is_inner = true, is_reduced = false;
    sum_.clear();
    add(query, candidates_, 1.0, {0.0, 0.0, 0.0}, is_inner, is_reduced);
    const double weight = sum_.getWeight();
    const bool is_thin = weight < thin_weight;
    if (is_thin) {
      addWide(query, is_reduced);
      if (!(sum_.getWeight() > 0.0))
        continueNearest(query, is_reduced);
    }
    sum_.finish(i, estimates_);
    estimates_.support[i] =
        is_inner && !is_thin ? FieldSupport::Measured : findSupport(query);
    if (is_reduced && estimates_.support[i] == FieldSupport::Measured)
      estimates_.support[i] = FieldSupport::Reduced;
  }

  /** Add the fits whose balls hold the query, their weights times a factor that has a
   * gradient itself. */
  void
  add(const Query& query,
      const Candidates& candidates,
      double factor,
      const Corner& factor_gradient,
      bool& is_inner,
      bool& is_reduced)
  {
    parts_.resize(candidates.size());
    for (std::size_t j = 0; j < candidates.size(); ++j) {
      const double dx = query.x[0] - candidates.x[0][j],
                   dy = query.x[1] - candidates.x[1][j],
                   dz = query.x[2] - candidates.x[2][j];
      parts_[j] = (dx * dx + dy * dy + dz * dz) * candidates.per_sq_reach[j];
    }
    for (std::size_t j = 0; j < candidates.size(); ++j) {
      if (!(parts_[j] < 1.0))
        continue;
      const double rest = 1.0 - parts_[j];
      const double slope = -4.0 * rest * candidates.per_sq_reach[j] * factor;
      const std::size_t place = candidates.place[j];
      const BucketFits& fits = fits_.getFits(candidates.bucket[j]);
      const double weight = rest * rest;
      PolynomialSum::Part part{polynomialOf(fits, place), weight * factor, {}, {}};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double along = query.x[axis] - candidates.x[axis][j];
        part.offset[axis] = along / fits.radius[place];
        part.weight_gradient[axis] = slope * along + weight * factor_gradient[axis];
      }
      sum_.add(part);
      is_inner = is_inner && fits.is_inner[place];
      is_reduced = is_reduced || fits.is_reduced[place];
    }
  }

  PolynomialSum::Polynomial
  polynomialOf(const BucketFits& fits, std::size_t place) const
  {
    return {&fits.coefficients[place * sampled_.fields * polynomial_terms],
            &fits.errors[place * sampled_.fields],
            fits.radius[place]};
  }

  /** Add wide balls, the more the less weight there is. */
  void
  addWide(const Query& query, bool& is_reduced)
  {
    const Corner at{query.x[0], query.x[1], query.x[2]};
    buckets_.clear();
    fits_.getBalls().findReaching(
        at, at, wide_ball, std::numeric_limits<std::size_t>::max(), buckets_);
    collect(at, at, wide_ball, wide_);
    const double missing = 1.0 - sum_.getWeight() / thin_weight;
    Corner gradient = sum_.getWeightGradient();
    for (double& along : gradient)
      along *= -2.0 * missing / thin_weight;
    bool is_inner = true;
    add(query, wide_, missing * missing, gradient, is_inner, is_reduced);
  }

  /** Beyond all balls. */
  void
  continueNearest(const Query& query, bool& is_reduced)
  {
    NearestFinder finder(*sampled_.samples, 1);
    const std::uint32_t nearest = finder.find(query.toPosition(), 1.0f).samples[0];
    const std::size_t bucket = fits_.getBalls().bucketOf(nearest);
    const std::size_t place = nearest - fits_.getBalls().getBuckets()[bucket].begin;
    const BucketFits& fits = fits_.getFits(bucket);
    PolynomialSum::Part part{polynomialOf(fits, place), 1.0, {}, {}};
    const Position& center = sampled_.samples->getPositions()[nearest];
    for (std::size_t axis = 0; axis < 3; ++axis)
      part.offset[axis] =
          (query.x[axis] - static_cast<double>(center[static_cast<int>(axis)])) /
          fits.radius[place];
    sum_.addStraight(part, farthest_offset);
    is_reduced = is_reduced || fits.is_reduced[place];
  }

  FieldSupport
  findSupport(const Query& query)
  {
    if (!support_)
      support_.emplace(*sampled_.samples, sparse_);
    return support_->find(query);
  }

  const SampledFields& sampled_;
  const std::vector<Position>& sparse_;
  const SampleFits& fits_;
  const Query* queries_;
  const Estimates& estimates_;
  PolynomialSum sum_;
  std::vector<std::uint32_t> buckets_;
  Candidates candidates_, wide_;
  std::vector<double> parts_; ///< squared distances by squared radii
  std::optional<SupportFinder> support_;
};

} // namespace

BlendedFits::BlendedFits(const SampledFields& sampled, unsigned threads)
    : sampled_(sampled)
    , sparse_(sparseSamples(*sampled.samples))
    , fits_(sampled, threads)
{
}

void
BlendedFits::evaluate(const Query* queries,
                      std::size_t count,
                      const Estimates& estimates) const
{
  BlockBlender(sampled_, sparse_, fits_, queries, estimates).answer(0, count);
}

void
BlendedFits::tell(Report& report) const
{
  report.count("reduced_fits", fits_.countReduced());
}

} // namespace pcl_uvol::detail
