// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/nearest_neighbors.h"

#include "common/parallel.h"
#include <pcl_uvol/common/exceptions.h>

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

constexpr int leaf_samples = 15; // PCL's choice, and the fastest here
constexpr std::size_t query_block = 256;

void
checkCount(std::size_t k)
{
  if (k == 0)
    throw InvalidArgument("no_nearest_neighbors", {});
}

/** A search of the user's may have settings in the unit of the input, as an octree its
 * resolution: it gets samples in that unit as long as, with factors within these
 * bounds, the squares of their distances are numbers in float. */
constexpr float least_factor = 0x1p-20f, largest_factor = 0x1p20f;

pcl::PointCloud<pcl::PointXYZ>::Ptr
makeSearchCloud(const SampleSet& samples)
{
  const float factor = samples.getUnit().factor;
  const float back =
      factor >= least_factor && factor <= largest_factor ? 1.0f / factor : 1.0f;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  cloud->reserve(samples.size());
  for (const Position& x : samples.getPositions())
    cloud->push_back({back * x[0], back * x[1], back * x[2]});
  return cloud;
}

/** Samples found, without the one that was searched for, nearest first. */
class SortedRow {
public:
  explicit SortedRow(std::size_t sample_count)
      : sample_count_(sample_count)
  {
  }

  void
  start(std::size_t sample)
  {
    sample_ = sample;
    found_.clear();
  }

  /** What a search gives that does not find as many as it should: no sample, or no
   * distance. */
  void
  add(float sq_dist, std::size_t neighbor)
  {
    if (neighbor != sample_ && neighbor < sample_count_ && std::isfinite(sq_dist))
      found_.emplace_back(sq_dist, static_cast<std::uint32_t>(neighbor));
  }

  /** At most so many, sorted. */
  const std::vector<std::pair<float, std::uint32_t>>&
  finish(std::size_t most)
  {
    // Sorted by distance already but for ties; a sample whose squared distances
    // underflow may miss itself, then the farthest goes.
    std::sort(found_.begin(), found_.end());
    found_.resize(std::min(most, found_.size()));
    return found_;
  }

private:
  std::size_t sample_count_, sample_ = 0;
  std::vector<std::pair<float, std::uint32_t>> found_;
};

} // namespace

NeighborGraph
computeNearestNeighbors(const SampleSet& samples,
                        std::size_t k,
                        unsigned threads,
                        Report& report)
{
  checkCount(k);
  const std::size_t count = samples.size();
  StepTimer step(report, "nearest_neighbors", count);
  const std::size_t row = std::min(k, count - 1);
  NeighborGraph graph;
  graph.offsets.resize(count + 1);
  for (std::size_t i = 0; i <= count; ++i)
    graph.offsets[i] = i * row;
  graph.indices.resize(count * row);
  if (row == 0)
    return graph;

  // FLANN's interface takes mutable data, which it only reads.
  auto* const positions = const_cast<float*>(samples.getPositions().front().x);
  using Index = flann::KDTreeSingleIndex<flann::L2_3D<float>>;
  Index index(flann::Matrix<float>(positions, count, 3),
              flann::KDTreeSingleIndexParams(leaf_samples));
  index.buildIndex();
  parallelBlocks(count, query_block, threads, [&](std::size_t begin, std::size_t end) {
    const std::size_t found = row + 1; // each sample finds itself as well
    std::vector<std::size_t> indices((end - begin) * found);
    std::vector<float> sq_dists(indices.size());
    flann::Matrix<std::size_t> index_rows(indices.data(), end - begin, found);
    flann::Matrix<float> distance_rows(sq_dists.data(), end - begin, found);
    flann::SearchParams search(flann::FLANN_CHECKS_UNLIMITED);
    search.cores = 1;
    search.use_heap = flann::FLANN_False;
    index.knnSearch(flann::Matrix<float>(positions + 3 * begin, end - begin, 3),
                    index_rows,
                    distance_rows,
                    found,
                    search);
    SortedRow sorted(count);
    for (std::size_t i = begin; i < end; ++i) {
      sorted.start(i);
      for (std::size_t j = (i - begin) * found; j < (i - begin + 1) * found; ++j)
        sorted.add(sq_dists[j], indices[j]);
      const auto& neighbors = sorted.finish(row);
      if (neighbors.size() < row)
        throw InvalidArgument(
            "neighbors_not_finite",
            {{"sample", i}, {"found", neighbors.size()}, {"needed", row}});
      for (std::size_t j = 0; j < row; ++j)
        graph.indices[i * row + j] = neighbors[j].second;
    }
    step.advance(end - begin);
  });
  return graph;
}

NeighborGraph
computeNearestNeighbors(const SampleSet& samples,
                        std::size_t k,
                        unsigned threads,
                        const pcl::search::Search<pcl::PointXYZ>::Ptr& search,
                        Report& report)
{
  checkCount(k);
  if (!search)
    throw InvalidArgument("neighbor_search_null", {});
  const std::size_t count = samples.size();
  const std::size_t row = std::min(k, count - 1);
  StepTimer step(report, "nearest_neighbors", count);
  search->setInputCloud(makeSearchCloud(samples));
  NeighborGraph graph;
  graph.offsets.assign(count + 1, 0);
  graph.indices = parallelGather<std::uint32_t>(
      count, query_block, threads, [&](auto begin, auto end, auto& block) {
        pcl::Indices found;
        std::vector<float> sq_dists;
        SortedRow sorted(count);
        for (std::size_t i = begin; i < end; ++i) {
          // each sample finds itself as well
          search->nearestKSearch(
              static_cast<pcl::index_t>(i), static_cast<int>(row + 1), found, sq_dists);
          sorted.start(i);
          for (std::size_t j = 0; j < std::min(found.size(), sq_dists.size()); ++j)
            sorted.add(sq_dists[j], static_cast<std::size_t>(found[j]));
          const auto& neighbors = sorted.finish(row);
          for (const auto& entry : neighbors)
            block.push_back(entry.second);
          graph.offsets[i + 1] = neighbors.size();
        }
        step.advance(end - begin);
      });
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  return graph;
}

} // namespace pcl_uvol
