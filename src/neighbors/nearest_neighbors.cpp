// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/parallel.h>
#include <pcl_uvol/neighbors/nearest_neighbors.h>

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr int leaf_samples = 15; // PCL's choice, and the fastest here
constexpr std::size_t block_samples = 256;

void
checkCount(std::size_t k)
{
  if (k == 0)
    throw InvalidArgument(
        "The number of nearest neighbours is 0: it must be at least 1.");
}

pcl::PointCloud<pcl::PointXYZ>::Ptr
cloudOf(const SampleSet& samples)
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  cloud->reserve(samples.size());
  for (const Position& x : samples.getPositions())
    cloud->push_back({x[0], x[1], x[2]});
  return cloud;
}

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
  parallelBlocks(
      count, block_samples, threads, [&](std::size_t begin, std::size_t end) {
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
        std::vector<std::pair<float, std::uint32_t>> sorted;
        for (std::size_t i = begin; i < end; ++i) {
          sorted.clear();
          for (std::size_t j = 0; j < found; ++j)
            if (const std::size_t neighbor = indices[(i - begin) * found + j];
                neighbor != i)
              sorted.emplace_back(sq_dists[(i - begin) * found + j],
                                  static_cast<std::uint32_t>(neighbor));
          // Sorted by distance already but for ties; a sample whose squared distances
          // underflow may miss itself, then the farthest goes.
          std::sort(sorted.begin(), sorted.end());
          for (std::size_t j = 0; j < row; ++j)
            graph.indices[i * row + j] = sorted[j].second;
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
    throw InvalidArgument("The search method for nearest neighbours is null.");
  const std::size_t count = samples.size();
  const std::size_t row = std::min(k, count - 1);
  StepTimer step(report, "nearest_neighbors", count);
  search->setInputCloud(cloudOf(samples));
  NeighborGraph graph;
  graph.offsets.assign(count + 1, 0);
  graph.indices = parallelGather<std::uint32_t>(
      count, block_samples, threads, [&](auto begin, auto end, auto& block) {
        pcl::Indices found;
        std::vector<float> sq_dists;
        std::vector<std::pair<float, std::uint32_t>> sorted;
        for (std::size_t i = begin; i < end; ++i) {
          // each sample finds itself as well
          search->nearestKSearch(
              static_cast<pcl::index_t>(i), static_cast<int>(row + 1), found, sq_dists);
          sorted.clear();
          for (std::size_t j = 0; j < found.size(); ++j)
            if (const auto neighbor = static_cast<std::uint32_t>(found[j]);
                neighbor != i)
              sorted.emplace_back(sq_dists[j], neighbor);
          std::sort(sorted.begin(), sorted.end());
          sorted.resize(std::min(row, sorted.size()));
          for (const auto& entry : sorted)
            block.push_back(entry.second);
          graph.offsets[i + 1] = sorted.size();
        }
        step.advance(end - begin);
      });
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  return graph;
}

} // namespace pcl_uvol
