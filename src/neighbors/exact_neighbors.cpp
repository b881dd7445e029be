// SPDX-License-Identifier: BSD-3-Clause
#include "neighbors/exact_neighbors.h"

#include "common/parallel.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/simple_cell.h"
#include "neighbors/voronoi_cell.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

constexpr std::size_t face_block = 1u << 9;

/** Samples that share a copy of those around them. */
constexpr std::size_t group_samples = 16;

/** Share of the squared distance of two samples: a face of less area is one of
 * rounding. */
constexpr double least_area = 1e-12;

/** The rows of consecutive samples. */
struct FaceRows {
  std::vector<std::uint32_t> sizes, indices;
};

/** Finds the neighbours of one sample of a block after another, ascending. */
class FaceFinder {
public:
  FaceFinder(const SampleSet& samples, std::size_t begin, std::size_t end)
      : samples_(samples)
      , expected_(begin)
      , end_(end)
      , nearest_(samples, detail::CellSearch::usual_near + 1)
      , search_(samples)
  {
  }

  const std::vector<std::uint32_t>&
  find(std::uint32_t sample)
  {
    const Position& place = samples_.getPositions()[sample];
    if (sample == expected_) {
      expected_ = std::min(end_, expected_ + group_samples);
      nearest_.expect(&place, expected_ - sample);
    }
    const NearestFinder::Row row = nearest_.find(place, reach_);
    reach_ = std::sqrt(row.sq_dists[row.size - 1]);
    others_.clear();
    std::remove_copy(
        row.samples, row.samples + row.size, std::back_inserter(others_), sample);
    found_.clear();
    if (others_.empty())
      return found_;
    search_.start(
        {{place[0], place[1], place[2]}}, sample, others_.data(), others_.size());
    if (!simple_cells_.find(search_) || !takeSimpleCell())
      takeWholeCell();
    std::sort(found_.begin(), found_.end());
    return found_;
  }

private:
  /** \return false if rounding has left the cell open */
  bool
  takeSimpleCell()
  {
    const detail::SimpleCell& cell = simple_cells_.getCell();
    ratios_.resize(cell.getNumFaces());
    moments_.resize(cell.getNumFaces());
    if (!cell.measureFaces(ratios_.data(), moments_.data()))
      return false;
    for (std::size_t i = 0; i < cell.getNumFaces(); ++i)
      if (ratios_[i] > least_area * cell.getFace(i).length)
        found_.push_back(cell.getFace(i).sample);
    return true;
  }

  void
  takeWholeCell()
  {
    cells_.findWhole(search_);
    cells_.forFaces([&](const detail::CellFace& face) {
      const std::uint32_t other =
          cells_.getNeighbors()[static_cast<std::size_t>(face.tag)];
      if (face.polygon.computeMoments().area >
          least_area * search_.offsetOf(other).squaredNorm())
        found_.push_back(other);
    });
  }

  const SampleSet& samples_;
  std::size_t expected_; ///< samples before this one are in a group
  std::size_t end_;
  NearestFinder nearest_;
  detail::CellSearch search_;
  detail::SimpleCellFinder simple_cells_;
  detail::VoronoiCellFinder cells_;
  float reach_ = 1.0f; ///< of the sample before
  std::vector<std::uint32_t> others_, found_;
  std::vector<double> ratios_;
  std::vector<Eigen::Vector3d> moments_;
};

} // namespace

ExactNeighbors::ExactNeighbors(const SampleSet& samples,
                               unsigned threads,
                               Report& report)
{
  if (samples.getTrees().size() != 1)
    throw InvalidArgument("exact_neighbors_in_pieces", {});
  StepTimer step(report, "voronoi_cells", samples.size());
  std::vector<FaceRows> blocks((samples.size() + face_block - 1) / face_block);
  parallelBlocks(
      samples.size(), face_block, threads, [&](std::size_t begin, std::size_t end) {
        FaceFinder finder(samples, begin, end);
        FaceRows& rows = blocks[begin / face_block];
        for (std::size_t i = begin; i < end; ++i) {
          const auto& found = finder.find(static_cast<std::uint32_t>(i));
          rows.sizes.push_back(static_cast<std::uint32_t>(found.size()));
          rows.indices.insert(rows.indices.end(), found.begin(), found.end());
        }
        step.advance(end - begin);
      });
  faces_.offsets.reserve(samples.size() + 1);
  faces_.offsets.push_back(0);
  for (const FaceRows& rows : blocks) {
    for (const std::uint32_t size : rows.sizes)
      faces_.offsets.push_back(faces_.offsets.back() + size);
    faces_.indices.insert(
        faces_.indices.end(), rows.indices.begin(), rows.indices.end());
  }
}

void
ExactNeighbors::find(std::uint32_t sample, std::vector<std::uint32_t>& candidates) const
{
  candidates.clear();
  for (const std::uint32_t other : faces_[sample]) {
    const NeighborGraph::Row seen = faces_[other];
    if (std::binary_search(seen.begin(), seen.end(), sample))
      candidates.push_back(other);
  }
}

std::vector<std::uint32_t>
ExactNeighbors::findCrossing(const NodeRanges& ranges,
                             float isovalue,
                             unsigned threads) const
{
  const auto isAbove = [&](std::uint32_t sample) {
    return ranges.values[sample] >= isovalue;
  };
  // Blocks come in order, and so do their samples.
  return parallelGather<std::uint32_t>(
      faces_.size(), face_block, threads, [&](auto begin, auto end, auto& found) {
        std::vector<std::uint32_t> others;
        for (std::size_t i = begin; i < end; ++i) {
          const auto sample = static_cast<std::uint32_t>(i);
          find(sample, others);
          if (std::any_of(others.begin(), others.end(), [&](std::uint32_t other) {
                return isAbove(other) != isAbove(sample);
              }))
            found.push_back(sample);
        }
      });
}

} // namespace pcl_uvol
