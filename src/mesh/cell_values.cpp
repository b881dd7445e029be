// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_values.h"

#include "common/parallel.h"
#include "isosurface/smooth_roots.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t value_block = 1u << 10;

Eigen::Vector3d
toInput(const Position& place, const Position& scale)
{
  return {static_cast<double>(place[0]) / scale[0],
          static_cast<double>(place[1]) / scale[1],
          static_cast<double>(place[2]) / scale[2]};
}

Eigen::Vector3d
centerOf(const KdBox& box, const Position& scale)
{
  Position center;
  for (int axis = 0; axis < 3; ++axis)
    center[axis] =
        static_cast<float>(0.5 * (static_cast<double>(box.low[axis]) + box.high[axis]));
  return toInput(center, scale);
}

} // namespace

CellValues::CellValues(const CellTiling& tiling,
                       const IsopointInput& input,
                       float isovalue,
                       Report& report)
    : tiling_(tiling)
    , input_(input)
    , isovalue_(isovalue)
    , place_of_(input.samples.size(), none)
{
  fitAll(findPartners(
             input.candidates.findCrossing(input.ranges, isovalue, input.threads)),
         report);
}

void
CellValues::turn(const std::vector<std::uint32_t>& cells, Report& report)
{
  // So near to the surface that it passes beside the centre.
  constexpr double part = 0.25;
  std::vector<Candidate> turned;
  for (const std::uint32_t cell : cells) {
    double& value = cells_[place_of_[cell]].value;
    value = value >= 0.0 ? std::min(-part * value, -std::numeric_limits<double>::min())
                         : -part * value;
    turned.push_back({cell, cell});
  }
  fitAll(findOthers(turned), report);
}

void
CellValues::fitAll(std::vector<Candidate> candidates, Report& report)
{
  while (!candidates.empty()) {
    StepTimer step(report, "cells", candidates.size());
    fit(candidates, step);
    candidates = findOthers(candidates);
  }
  std::sort(band_.begin(), band_.end());
  report.setCount("band_cells", cells_.size());
}

std::vector<CellValues::Candidate>
CellValues::findPartners(const std::vector<std::uint32_t>& samples) const
{
  const auto& positions = input_.samples.getPositions();
  std::vector<Candidate> found(samples.size());
  parallelBlocks(
      samples.size(), value_block, input_.threads, [&](auto begin, auto end) {
        std::vector<std::uint32_t> touching;
        for (std::size_t i = begin; i < end; ++i) {
          const std::uint32_t sample = samples[i];
          input_.candidates.find(sample, touching);
          std::pair<double, std::uint32_t> nearest(
              std::numeric_limits<double>::infinity(), none);
          for (const std::uint32_t other : touching) {
            if (isAbove(other) == isAbove(sample))
              continue;
            double square = 0.0;
            for (int axis = 0; axis < 3; ++axis) {
              const double along =
                  static_cast<double>(positions[other][axis]) - positions[sample][axis];
              square += along * along;
            }
            nearest = std::min(nearest, {square, other});
          }
          found[i] = {sample, nearest.second};
        }
      });
  return found;
}

std::vector<CellValues::Candidate>
CellValues::findOthers(const std::vector<Candidate>& fitted) const
{
  auto found = parallelGather<Candidate>(
      fitted.size(),
      value_block,
      input_.threads,
      [&](std::size_t begin, std::size_t end, std::vector<Candidate>& others) {
        std::vector<std::uint32_t> touching;
        for (std::size_t i = begin; i < end; ++i) {
          const std::uint32_t sample = fitted[i].sample;
          if (isAbove(sample) == (input_.values[sample] >= isovalue_))
            continue; // its sample has been looked at
          input_.candidates.find(sample, touching);
          for (const std::uint32_t other : touching)
            if (!isInBand(other) && isAbove(other) != isAbove(sample))
              others.push_back({other, sample});
        }
      });
  const auto byCell = [](const Candidate& a, const Candidate& b) {
    return std::make_pair(a.sample, a.partner) < std::make_pair(b.sample, b.partner);
  };
  parallelSort(found.begin(), found.end(), input_.threads, byCell);
  const auto end = std::unique(
      found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
        return a.sample == b.sample;
      });
  found.erase(end, found.end());
  return found;
}

void
CellValues::fit(const std::vector<Candidate>& candidates, StepTimer& step)
{
  const Position& scale = input_.samples.getScale();
  const std::size_t first = cells_.size();
  cells_.resize(first + candidates.size());
  IsoEdges edges(candidates.size());
  std::vector<PointIso> feet(candidates.size());
  parallelBlocks(
      candidates.size(), value_block, input_.threads, [&](auto begin, auto end) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto [sample, partner] = candidates[i];
          BandCell& cell = cells_[first + i];
          cell.center =
              centerOf(tiling_.findBox(sample, tiling_.findCell(sample)), scale);
          for (int axis = 0; axis < 3; ++axis)
            feet[i].data[axis] = static_cast<float>(cell.center[axis]);
          edges[i] = {sample, partner, 0.5f};
        }
      });
  const std::vector<RootFit> fits = fitRoots(input_, isovalue_, edges, feet, step);
  const double side = input_.outside == Outside::Lower ? 1.0 : -1.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::uint32_t sample = candidates[i].sample;
    BandCell& cell = cells_[first + i];
    // A fit that is too rough to place a root is still better than a rough sample, but
    // where it is steeper than float holds.
    cell.value = std::isfinite(fits[i].value)
                     ? static_cast<double>(fits[i].value)
                     : static_cast<double>(input_.values[sample]) - isovalue_;
    cell.has_foot = fits[i].outcome <= RootOutcome::Quadratic;
    if (cell.has_foot) {
      cell.foot = feet[i].getVector3fMap().cast<double>();
      cell.normal = side * feet[i].getNormalVector3fMap().cast<double>();
      cell.mean_curvature = side * static_cast<double>(feet[i].mean_curvature);
    }
    place_of_[sample] = static_cast<std::uint32_t>(first + i);
    band_.push_back(sample);
  }
}

} // namespace pcl_uvol::detail
