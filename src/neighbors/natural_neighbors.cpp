// SPDX-License-Identifier: BSD-3-Clause
#include "common/parallel.h"
#include "common/parameter_json.h"
#include "neighbors/neighborhood_finder.h"
#include <pcl_uvol/neighbors/natural_neighbors.h>

#include <pcl/point_types.h>

#include <algorithm>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr std::size_t angle_block = 1u << 12;

/** The rows of consecutive samples. */
struct AngleRows {
  std::vector<std::uint32_t> sizes, indices;
  std::uint64_t candidates = 0;
};

double
sqDistance(const Position& a, const Position& b)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = static_cast<double>(a[axis]) - b[axis];
    sum += along * along;
  }
  return sum;
}

/** Neighbours as input indices, in rows by input index. */
NeighborGraph
toInputOrder(const NeighborGraph& by_sample,
             const SampleSet& samples,
             std::size_t points)
{
  NeighborGraph graph;
  graph.offsets.assign(points + 1, 0);
  for (std::size_t i = 0; i < samples.size(); ++i)
    graph.offsets[samples.getInputIndex(i) + 1] = by_sample[i].size();
  for (std::size_t i = 0; i < points; ++i)
    graph.offsets[i + 1] += graph.offsets[i];
  graph.indices.resize(by_sample.indices.size());
  const std::vector<Position>& positions = samples.getPositions();
  std::vector<std::pair<double, std::uint32_t>> row;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    row.clear();
    for (const std::uint32_t neighbor : by_sample[i])
      row.emplace_back(sqDistance(positions[i], positions[neighbor]),
                       samples.getInputIndex(neighbor));
    std::sort(row.begin(), row.end()); // equally far ones by another index than before
    std::uint64_t position = graph.offsets[samples.getInputIndex(i)];
    for (const auto& entry : row)
      graph.indices[position++] = entry.second;
  }
  return graph;
}

} // namespace

NeighborGraph
computeNaturalNeighbors(const SampleSet& samples,
                        const NeighborCandidates& candidates,
                        AngleCriterion criterion,
                        unsigned threads,
                        Report& report)
{
  StepTimer step(report, "neighborhoods", samples.size());
  std::vector<AngleRows> blocks((samples.size() + angle_block - 1) / angle_block);
  parallelBlocks(
      samples.size(), angle_block, threads, [&](std::size_t begin, std::size_t end) {
        NeighborhoodFinder finder(samples, candidates, criterion);
        AngleRows& rows = blocks[begin / angle_block];
        for (std::size_t i = begin; i < end; ++i) {
          const auto& neighbors = finder.find(static_cast<std::uint32_t>(i));
          rows.sizes.push_back(static_cast<std::uint32_t>(neighbors.size()));
          rows.indices.insert(rows.indices.end(), neighbors.begin(), neighbors.end());
        }
        rows.candidates = finder.getCandidateCount();
        step.advance(end - begin);
      });

  NeighborGraph graph;
  graph.offsets.reserve(samples.size() + 1);
  graph.offsets.push_back(0);
  std::uint64_t candidate_count = 0;
  for (const AngleRows& rows : blocks) {
    for (const std::uint32_t size : rows.sizes)
      graph.offsets.push_back(graph.offsets.back() + size);
    candidate_count += rows.candidates;
  }
  graph.indices.resize(graph.offsets.back());
  parallelBlocks(blocks.size(), 1, threads, [&](std::size_t begin, std::size_t) {
    std::copy(blocks[begin].indices.begin(),
              blocks[begin].indices.end(),
              graph.indices.begin() +
                  static_cast<std::ptrdiff_t>(graph.offsets[begin * angle_block]));
  });
  report.count("candidates", candidate_count);
  report.count("neighbors", graph.indices.size());
  return graph;
}

NeighborGraph
detail::computeNaturalNeighbors(const CloudView& cloud,
                                const pcl::Indices& indices,
                                const NaturalNeighborParameters& parameters,
                                unsigned threads,
                                Report& report)
{
  const std::vector<std::uint32_t> use(indices.begin(), indices.end());
  const auto samples = SampleSet::build(
      cloud.xyz(0), cloud.stride(), use, Position{{1.0f, 1.0f, 1.0f}}, threads, report);
  const auto candidates = makeCandidates(
      *samples, parameters.source, parameters.voronoi_cells, threads, report);
  return toInputOrder(pcl_uvol::computeNaturalNeighbors(
                          *samples, *candidates, parameters.criterion, threads, report),
                      *samples,
                      cloud.count);
}

std::string
NaturalNeighborParameters::toJson() const
{
  return writeJson(*this);
}

NaturalNeighborParameters
NaturalNeighborParameters::fromJson(const std::string& text)
{
  return readJson<NaturalNeighborParameters>(text);
}

} // namespace pcl_uvol
