// SPDX-License-Identifier: BSD-3-Clause
// For models that are weighted means of near samples: finding these samples, and the
// mean with its gradient and spread.
#pragma once

#include "interpolation/field_model.h"
#include "neighbors/nearest_finder.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pcl_uvol::detail {

/** \brief The queries of a block, as places of a search that is told which ones come
 * next, a group at a time. */
class QueryGroups {
public:
  /** \param queries in spatial order */
  void
  assign(const Query* queries, std::size_t count);

  /** \brief A query to search for, after the ones before it. */
  const Position&
  announce(std::size_t query, NearestFinder& finder);

private:
  std::vector<Position> places_;
  std::size_t announced_ = 0; ///< queries before this one are
};

/** \brief Nearest samples of a block of queries. */
class QuerySearch {
public:
  /** \param samples must outlive the search
   * \param queries in spatial order */
  QuerySearch(const SampleSet& samples,
              std::size_t k,
              const Query* queries,
              std::size_t count);

  /** \brief See NearestFinder::find. */
  NearestFinder::Row
  find(std::size_t query);

private:
  NearestFinder finder_;
  QueryGroups queries_;
  float reach_ = 1.0f; ///< of the query before
};

/** \brief The weighted mean of values of several fields, with its gradient. */
class WeightedSum {
public:
  explicit WeightedSum(std::size_t fields);

  /** \param reference of all fields: values are summed relative to it, so that one
   * that has all the weight stays what it is */
  void
  start(const double* reference);

  /** \param values of all fields
   * \param gradient of the weight */
  void
  add(const double* values, double weight, const std::array<double, 3>& gradient);

  /** \brief Sum of the weights so far. */
  double
  getWeight() const
  {
    return weight_;
  }

  /** \brief Divide by the weights and store value, gradient and, as the error, the
   * weighted standard deviation of the values. */
  void
  finish(std::size_t query, const Estimates& estimates) const;

  /** \brief The same without dividing, for sums relative to zero; the error stays that
   * of the mean. */
  void
  finishSum(std::size_t query, const Estimates& estimates) const;

  const double*
  getReference() const
  {
    return reference_;
  }

private:
  std::size_t fields_;
  double weight_ = 0.0;
  std::array<double, 3> weight_gradient_{};
  const double* reference_ = nullptr;
  std::vector<double> sums_, squares_, gradients_;
};

} // namespace pcl_uvol::detail
