// SPDX-License-Identifier: BSD-3-Clause
// What a value at a place rests on: samples all around, the sides of a gap, the border
// of the cloud, or nothing.
#pragma once

#include "interpolation/query_search.h"
#include "neighbors/empty_cone.h"
#include "neighbors/nearest_finder.h"

#include <cstddef>
#include <vector>

namespace pcl_uvol::detail {

/** \brief A few samples out of all parts of a cloud: enough to tell from which sides of
 * a place there are none at all. */
std::vector<Position>
sparseSamples(const SampleSet& samples);

/** \brief Support of one query after another; one object per thread. */
class SupportFinder {
public:
  /** \param samples, sparse must outlive the finder; see sparseSamples */
  SupportFinder(const SampleSet& samples, const std::vector<Position>& sparse);

  /** \brief Prepare for a block of queries in spatial order: close ones then share a
   * search. */
  void
  expect(const Query* queries, std::size_t count);

  /** \brief Support of one of the queries expected, in their order. */
  FieldSupport
  findExpected(std::size_t query);

  /** \brief Support of a query whose nearest samples are known.
   * \param near at least the 41 nearest, or all samples */
  FieldSupport
  judge(const Query& query, const NearestFinder::Row& near);

  /** \brief Support of any query. */
  FieldSupport
  find(const Query& query);

private:
  FieldSupport
  judgeNearest(const Position& center, const NearestFinder::Row& near);

  /** Directions to places; those behind the last are zero. */
  bool
  leavesConeEmpty(const Position& center,
                  const std::vector<Position>& places,
                  const std::uint32_t* indices,
                  std::size_t count);

  const SampleSet& samples_;
  const std::vector<Position>& sparse_;
  NearestFinder finder_;
  EmptyCone cone_;
  float reach_ = 1.0f; ///< of the query before
  QueryGroups expected_;
  std::vector<std::pair<float, std::uint32_t>> by_distance_;
  std::vector<float> sq_dists_;
  std::vector<std::uint32_t> nearest_;
  std::vector<float> directions_[3];
};

} // namespace pcl_uvol::detail
