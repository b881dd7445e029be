// SPDX-License-Identifier: BSD-3-Clause
#include "interpolation/blended_fits.h"

#include "common/dispatch.h"
#include "interpolation/polynomial_sum.h"
#include "interpolation/support_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pcl_uvol::detail {

namespace {

/** Queries share the search for fits while these come from no more buckets: more make
 * the search cheaper, and the choice of those that matter to a query dearer. */
constexpr std::size_t most_buckets = 96;

/** As many queries share it at first, and twice as many where so few buckets matter. */
constexpr std::size_t usual_group = 64, few_buckets = 48;

/** Weights that sum up to less are joined by those of balls that much larger. */
constexpr double thin_weight = 0.1, wide_ball = 2.0;

/** Share of the radius of a fit's support: farther out the fit is continued straight
 * on. */
constexpr double farthest_offset = 1.3;

/** Between lines and layers, and far from samples, fits answer if their squared error
 * is at most this share of the variogram without its nugget, at the radius of their
 * balls. That error is a standard error at the samples: between them a fit can be ten
 * times farther off. In 27 tests on 11 real data sets (positions in cells, held-out
 * samples), shares of 0.03^2, 0.05^2 and 0.1^2 gave root mean square errors of at most
 * 1.3, 1.7 and 1.9 times those of kriging, and fits alone more than 100 times. To
 * measure the ratio of true errors to standard errors instead, held-out samples would
 * need a second set of fits, which is most of the time. Among samples that are evenly
 * spread, fits answer unless their error is above the whole of that difference. */
constexpr double sq_uneven_part = 0.03 * 0.03;

const KernelTable<const BlendKernels*> kernel_table{
    &baseline::blend_kernels, &avx2::blend_kernels, &avx512::blend_kernels};

/** Samples whose fits may have a weight for some queries, ascending. Rows hold what
 * kernels read behind the last one. */
class Candidates {
public:
  /** Where a fit is: the fits of its bucket, and its place among them. */
  struct Fit {
    const BucketFits* bucket;
    std::uint32_t place;
  };

  void
  clear()
  {
    fits_.clear();
  }

  /** Make room for so many more. */
  void
  reserve(std::size_t more)
  {
    const std::size_t size = fits_.size() + more + ball_padding;
    if (per_sq_reach_.size() >= size)
      return;
    for (auto& row : center_)
      row.resize(2 * size);
    per_sq_reach_.resize(2 * size);
  }

  void
  add(const BucketFits& bucket, std::uint32_t place, double sq_factor)
  {
    const std::size_t i = fits_.size();
    for (std::size_t axis = 0; axis < 3; ++axis)
      center_[axis][i] = bucket.center[axis][place];
    per_sq_reach_[i] = 1.0 / (sq_factor * bucket.sq_reach[place]);
    fits_.push_back({&bucket, place});
  }

  /** End with balls that hold nothing. */
  void
  close()
  {
    reserve(0);
    std::fill_n(per_sq_reach_.begin() + static_cast<std::ptrdiff_t>(fits_.size()),
                ball_padding,
                std::numeric_limits<double>::infinity());
  }

  std::size_t
  size() const
  {
    return fits_.size();
  }

  const Fit&
  getFit(std::size_t i) const
  {
    return fits_[i];
  }

  double
  getCenter(std::size_t i, std::size_t axis) const
  {
    return center_[axis][i];
  }

  double
  getPerSqReach(std::size_t i) const
  {
    return per_sq_reach_[i];
  }

  /** See BlendKernels::findHolding. */
  std::size_t
  findHolding(const BlendKernels& kernels,
              const Query& query,
              std::uint32_t* held,
              double* parts) const
  {
    const float* const centers[] = {
        center_[0].data(), center_[1].data(), center_[2].data()};
    return kernels.findHolding(
        centers, per_sq_reach_.data(), size(), query.x, held, parts);
  }

private:
  std::vector<float> center_[3];
  std::vector<double> per_sq_reach_;
  std::vector<Fit> fits_;
};

/** The answers to the queries of a block. */
class BlockBlender {
public:
  BlockBlender(const SampledFields& sampled,
               const std::vector<Position>& sparse,
               const SampleFits& fits,
               const KrigingModel& kriging,
               const Query* queries,
               const Estimates& estimates)
      : sampled_(sampled)
      , sparse_(sparse)
      , fits_(fits)
      , kriging_(kriging)
      , queries_(queries)
      , estimates_(estimates)
      , kernels_(*kernel_table.get())
      , sum_(sampled.fields, estimates.gradients != nullptr, kernels_)
  {
  }

  /** Answer queries, neighbours in space together as long as few buckets matter to
   * them. */
  void
  answer(std::size_t count)
  {
    std::size_t together = usual_group;
    for (std::size_t begin = 0; begin < count;) {
      together = std::min(together, count - begin);
      const auto [low, high] = findBox(begin, begin + together);
      const std::size_t most =
          together == 1 ? std::numeric_limits<std::size_t>::max() : most_buckets;
      buckets_.clear();
      if (!fits_.getBalls().findReaching(low, high, 1.0, most, buckets_)) {
        together = (together + 1) / 2;
        continue;
      }
      collect(low, high, 1.0, candidates_);
      const std::size_t end = begin + together;
      for (; begin < end; ++begin)
        answerOne(begin);
      if (buckets_.size() < few_buckets)
        together *= 2;
    }
    krigeUncertain();
  }

private:
  using Corner = std::array<double, 3>;

  std::pair<Corner, Corner>
  findBox(std::size_t begin, std::size_t end) const
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
    candidates.clear();
    for (const std::uint32_t bucket : buckets_) {
      const BallTree::Bucket& samples = fits_.getBalls().getBuckets()[bucket];
      const BucketFits& fits = fits_.getFits(bucket);
      // The bound that the bucket was found by is a loose one.
      if (!(sqGap(low, high, samples.box) < factor * factor * fits.largest_sq_reach))
        continue;
      const std::size_t count = fits.radius.size();
      found_.resize(std::max(found_.size(), count + ball_padding));
      const float* const centers[] = {
          fits.center[0].data(), fits.center[1].data(), fits.center[2].data()};
      const double sq_factor = factor * factor;
      const std::size_t found = kernels_.findReaching(centers,
                                                      fits.sq_reach.data(),
                                                      sq_factor,
                                                      count,
                                                      low.data(),
                                                      high.data(),
                                                      found_.data());
      candidates.reserve(found);
      for (std::size_t k = 0; k < found; ++k)
        candidates.add(fits, found_[k], sq_factor);
    }
    candidates.close();
  }

  void
  answerOne(std::size_t i)
  {
    const Query& query = queries_[i];
    bool is_inner = true, is_reduced = false;
    sum_.clear();
    sq_reach_ = 0.0;
    is_even_ = true;
    values_.clear();
    add(query, candidates_, 1.0, {0.0, 0.0, 0.0}, is_inner, is_reduced);
    const double weight = sum_.getWeight();
    const bool is_thin = weight < thin_weight;
    if (is_thin) {
      addWide(query, is_reduced);
      if (!(sum_.getWeight() > 0.0))
        continueNearest(query, is_reduced);
    }
    sum_.finish(i, estimates_);
    FieldSupport& support = estimates_.support[i];
    support = is_inner && !is_thin ? FieldSupport::Measured : findSupport(query);
    if (is_reduced && support == FieldSupport::Measured)
      support = FieldSupport::Reduced;
    if (support == FieldSupport::Outside && !estimates_.extrapolate)
      return;
    is_even_ = is_even_ && !is_thin && !is_reduced;
    for (std::size_t f = 0; f < sampled_.fields; ++f)
      if (isUncertain(f) || (!is_even_ && isBeyondNeighbors(i, f)))
        uncertain_.push_back(i * sampled_.fields + f);
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
    found_.resize(std::max(found_.size(), candidates.size() + ball_padding));
    parts_.resize(found_.size());
    const std::size_t found =
        candidates.findHolding(kernels_, query, found_.data(), parts_.data());
    for (std::size_t k = 0; k < found; ++k) {
      const std::size_t j = found_[k];
      const auto [fits, place] = candidates.getFit(j);
      const StretchedMetric* const metric = fits->metric[place];
      Corner from_center, outwards;
      for (std::size_t axis = 0; axis < 3; ++axis)
        from_center[axis] = query.x[axis] - candidates.getCenter(j, axis);
      outwards = from_center;
      if (metric) {
        enterMetric(*metric, from_center, outwards);
        // The ball in space is that around the one in the metric.
        parts_[k] = sqLength(from_center) * candidates.getPerSqReach(j);
        if (parts_[k] >= 1.0)
          continue;
      }
      const double rest = 1.0 - parts_[k];
      const double slope = -4.0 * rest * candidates.getPerSqReach(j) * factor;
      const double weight = rest * rest, per_radius = 1.0 / fits->radius[place];
      PolynomialSum::Part part{polynomialOf(*fits, place), weight * factor, {}, {}};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        part.offset[axis] = from_center[axis] * per_radius;
        part.weight_gradient[axis] =
            slope * outwards[axis] + weight * factor_gradient[axis];
      }
      sum_.add(part);
      sq_reach_ += part.weight * fits->sq_reach[place];
      values_.push_back(part.polynomial.coefficients);
      is_even_ = is_even_ && !metric;
      is_inner = is_inner && fits->is_inner[place];
      is_reduced = is_reduced || fits->is_reduced[place];
    }
  }

  PolynomialSum::Polynomial
  polynomialOf(const BucketFits& fits, std::size_t place) const
  {
    return {&fits.coefficients[place * sampled_.fields * cubic_terms],
            &fits.errors[place * sampled_.fields],
            fits.radius[place],
            fits.metric[place]};
  }

  static double
  sqLength(const Corner& offset)
  {
    return offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
  }

  /** \param offset in space, then in the metric
   * \param outwards half the gradient of its squared length there */
  static void
  enterMetric(const StretchedMetric& metric, Corner& offset, Corner& outwards)
  {
    Eigen::Map<Eigen::Vector3d> image(offset.data());
    image = (metric.matrix * image).eval();
    Eigen::Map<Eigen::Vector3d>(outwards.data()) = metric.matrix.transpose() * image;
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
    const std::size_t bucket = fits_.getBalls().findBucket(nearest);
    const std::size_t place = nearest - fits_.getBalls().getBuckets()[bucket].begin;
    const BucketFits& fits = fits_.getFits(bucket);
    PolynomialSum::Part part{polynomialOf(fits, place), 1.0, {}, {}};
    const Position& center = sampled_.samples->getPositions()[nearest];
    for (std::size_t axis = 0; axis < 3; ++axis)
      part.offset[axis] =
          query.x[axis] - static_cast<double>(center[static_cast<int>(axis)]);
    if (Corner outwards; fits.metric[place])
      enterMetric(*fits.metric[place], part.offset, outwards);
    for (double& along : part.offset)
      along /= fits.radius[place];
    sum_.addStraight(part, farthest_offset);
    sq_reach_ = fits.sq_reach[place];
    values_ = {part.polynomial.coefficients};
    is_reduced = is_reduced || fits.is_reduced[place];
  }

  /** Whether the error of the fits of a field is too large at the query. */
  bool
  isUncertain(std::size_t field) const
  {
    const Variogram& variogram = kriging_.findVariogram(field)->model;
    const double reach = std::sqrt(sq_reach_ / sum_.getWeight());
    const double difference = variogram.value(reach);
    const double error = sum_.computeError(field);
    // Errors of fits to few samples are infinite, and a variogram of few is 0.
    if (!std::isfinite(error) || !(difference > 0.0))
      return false;
    // Of nugget alone kriging knows no more than the mean.
    const double known = difference - variogram.nugget;
    return error * error >
           (is_even_ || !(known > 0.0) ? difference : sq_uneven_part * known);
  }

  /** Whether a value is far from those of the samples around it: a fit that swings
   * between lines of samples, where nothing holds it. The room is half of their range
   * besides its error: a linear field, which fits reproduce, changes by so much over
   * one more radius of the ball that holds them. */
  bool
  isBeyondNeighbors(std::size_t query, std::size_t field) const
  {
    const double value = estimates_.values[query * sampled_.fields + field],
                 error = sum_.computeError(field);
    if (!std::isfinite(error) || values_.empty())
      return false;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto* const coefficients : values_) {
      const double at_sample = coefficients[field * cubic_terms];
      low = std::min(low, at_sample);
      high = std::max(high, at_sample);
    }
    const double room = 0.5 * (high - low) + error;
    return value < low - room || value > high + room;
  }

  /** Replace the values of fits that are uncertain by those of kriging. */
  void
  krigeUncertain()
  {
    if (uncertain_.empty())
      return;
    const std::size_t fields = sampled_.fields;
    std::vector<Query> queries;
    std::vector<std::size_t> sources; // of uncertain values
    for (std::size_t k = 0; k < uncertain_.size(); ++k) {
      const std::size_t query = uncertain_[k] / fields;
      if (k == 0 || query != uncertain_[k - 1] / fields)
        queries.push_back(queries_[query]);
      sources.push_back((queries.size() - 1) * fields + uncertain_[k] % fields);
    }
    const std::size_t count = queries.size();
    std::vector<double> values(count * fields);
    std::vector<double> gradients(estimates_.gradients ? 3 * values.size() : 0);
    std::vector<double> errors(estimates_.errors ? values.size() : 0);
    std::vector<FieldSupport> support(count);
    kriging_.evaluate(queries.data(),
                      count,
                      {values.data(),
                       estimates_.gradients ? gradients.data() : nullptr,
                       estimates_.errors ? errors.data() : nullptr,
                       support.data()});
    for (std::size_t k = 0; k < uncertain_.size(); ++k) {
      estimates_.values[uncertain_[k]] = values[sources[k]];
      if (estimates_.errors)
        estimates_.errors[uncertain_[k]] = errors[sources[k]];
      if (estimates_.gradients)
        std::copy_n(
            &gradients[3 * sources[k]], 3, estimates_.gradients + 3 * uncertain_[k]);
    }
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
  const KrigingModel& kriging_;
  const Query* queries_;
  const Estimates& estimates_;
  const BlendKernels& kernels_;
  PolynomialSum sum_;
  std::vector<std::uint32_t> buckets_;
  Candidates candidates_, wide_;
  std::vector<std::uint32_t> found_;  // by kernels
  std::vector<double> parts_;         ///< of the balls that are held
  std::vector<const double*> values_; ///< coefficients of fits, first those at samples
  std::optional<SupportFinder> support_;
  double sq_reach_ = 0.0; ///< weighted sum of the squared radii of the balls
  bool is_even_ = true;   ///< samples are spread evenly, and the query lies among them
  std::vector<std::size_t> uncertain_; ///< ascending: [query][field]
};

} // namespace

BlendedFits::BlendedFits(const SampledFields& sampled,
                         const std::vector<ValueFrame>& frames,
                         const std::vector<std::string>& names,
                         unsigned threads)
    : sampled_(sampled)
    , sparse_(sparseSamples(*sampled.samples))
    , fits_(sampled, threads)
    , kriging_(sampled, KrigingParameters{}, Eigen::Matrix3d::Identity(), frames, names)
{
}

void
BlendedFits::evaluate(const Query* queries,
                      std::size_t count,
                      const Estimates& estimates) const
{
  BlockBlender(sampled_, sparse_, fits_, kriging_, queries, estimates).answer(count);
}

void
BlendedFits::addTo(Report& report) const
{
  report.count("reduced_fits", fits_.countReduced());
}

} // namespace pcl_uvol::detail
