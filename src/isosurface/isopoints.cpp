// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/isopoints.h"

#include "common/parallel.h"
#include "isosurface/examined_isopoints.h"
#include "isosurface/one_sided.h"
#include "isosurface/piece_isopoints.h"
#include "isosurface/smooth_roots.h"
#include "isosurface/spike_test.h"
#include "neighbors/neighborhood_finder.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

namespace pcl_uvol {

namespace {

constexpr std::size_t block_edges = 1u << 10;

/** So few neighbours surround a sample: with fewer across it is no spike. */
constexpr std::size_t surrounding = 4;

EdgeKey
edgeKey(std::uint32_t a, std::uint32_t b)
{
  return (static_cast<EdgeKey>(std::min(a, b)) << 32) | std::max(a, b);
}

} // namespace

void
warnIfOutside(double isovalue,
              const std::string& field,
              const NodeRanges::Range& range,
              const ValueFrame& frame,
              Report& report)
{
  const auto rounded = static_cast<float>(frame.apply(isovalue));
  if (range.min < rounded && rounded <= range.max)
    return;
  const double low = frame.toInput(range.min), high = frame.toInput(range.max);
  const auto words = describeNumbers({isovalue, low, high});
  const char* const code = range.min == range.max ? "constant_field"
                           : rounded == range.min ? "lowest_isovalue"
                                                  : "no_isopoints";
  report.warn(code,
              {{"isovalue", words[0]},
               {"field", field},
               {"low", words[1]},
               {"high", words[2]}});
}

std::vector<EdgeKey>
findEdges(const IsopointInput& input,
          const std::vector<std::uint32_t>& crossing,
          float isovalue,
          SurfaceTally& tally,
          Report& report)
{
  StepTimer step(report, "neighborhoods", crossing.size());
  const std::vector<float>& f = input.values;
  std::atomic<std::uint64_t> spikes{0};
  auto edges = parallelGather<EdgeKey>(
      crossing.size(),
      block_edges,
      input.threads,
      [&](std::size_t begin, std::size_t end, std::vector<EdgeKey>& found) {
        NeighborhoodFinder finder(input.samples, input.candidates, input.criterion);
        SpikeTest spike_test(input, isovalue);
        for (std::size_t i = begin; i < end; ++i) {
          const std::uint32_t x = crossing[i];
          const std::size_t before = found.size();
          const auto& neighbors = finder.find(x);
          for (const std::uint32_t y : neighbors)
            if ((f[x] >= isovalue) != (f[y] >= isovalue))
              found.push_back(edgeKey(x, y));
          const std::size_t across = found.size() - before;
          if (across >= surrounding &&
              across + SpikeTest::most_alike >= neighbors.size() &&
              spike_test.isSpike(x))
            ++spikes;
        }
        step.advance(end - begin);
      });
  tally.spikes += spikes;
  report.count("spikes", spikes);
  parallelSort(edges.begin(), edges.end(), input.threads, std::less<EdgeKey>());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void
placeIsopoint(const IsopointInput& input,
              EdgeKey key,
              float isovalue,
              PointIso& point,
              IsoEdge& edge)
{
  const auto x = static_cast<std::uint32_t>(key >> 32);
  const auto y = static_cast<std::uint32_t>(key);
  const double fx = input.values[x], fy = input.values[y];
  const double t = (static_cast<double>(isovalue) - fx) / (fy - fx);
  const bool towards_second = (fy < fx) == (input.outside == Outside::Lower);
  edge = {x, y, static_cast<float>(t)};

  const Position &a = input.samples.getPositions()[x],
                 &b = input.samples.getPositions()[y];
  double sq_length = 0.0, covector[3], sq_covector = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double scale = input.samples.getScale()[axis];
    const double stretched = static_cast<double>(b[axis]) - a[axis];
    const double direction = stretched / scale;
    sq_length += direction * direction;
    point.data[axis] = static_cast<float>(a[axis] / scale + t * direction);
    // A normal of the stretched space is a covector: it grows where positions shrink.
    covector[axis] = stretched * scale;
    sq_covector += covector[axis] * covector[axis];
  }
  const double length = std::sqrt(sq_length), norm = std::sqrt(sq_covector);
  for (int axis = 0; axis < 3; ++axis)
    point.data_n[axis] =
        static_cast<float>((towards_second ? covector[axis] : -covector[axis]) / norm);
  point.isovalue = isovalue;
  point.edge_length = static_cast<float>(length);
}

namespace {

/** A merged isopoint looks to the mean of the outside vectors, or where the first one
 * looks if they cancel out. */
void
averageNormal(const std::vector<SampleRecord>& order,
              std::size_t begin,
              std::size_t end,
              std::vector<Position>& normals)
{
  // A shorter sum of unit vectors has no direction to speak of.
  constexpr double smallest_sum = 1e-3;
  double sum[3] = {0.0, 0.0, 0.0};
  for (std::size_t i = begin; i < end; ++i)
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] += normals[order[i].input_index][axis];
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  if (length < smallest_sum)
    return;
  for (int axis = 0; axis < 3; ++axis)
    normals[order[begin].input_index][axis] = static_cast<float>(sum[axis] / length);
}

/** Leave only the first of isopoints that fall together.
 * \return how many went */
std::size_t
dropCoincident(std::vector<PointIso>& points, IsoEdges& edges, unsigned threads)
{
  std::vector<Position> positions(points.size()), normals(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      positions[i][axis] = points[i].data[axis];
      normals[i][axis] = points[i].data_n[axis];
    }
  const auto stays = mergeCoincident(positions, normals, threads);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (stays[i] != 0) {
      points[kept] = points[i];
      std::copy(normals[i].x, normals[i].x + 3, points[kept].data_n);
      edges[kept++] = edges[i];
    }
  const std::size_t gone = points.size() - kept;
  points.resize(kept);
  edges.resize(kept);
  return gone;
}

} // namespace

std::vector<std::uint8_t>
mergeCoincident(const std::vector<Position>& positions,
                std::vector<Position>& normals,
                unsigned threads)
{
  std::vector<SampleRecord> order(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    order[i] = {positions[i], static_cast<std::uint32_t>(i)};
  const auto less = [](const SampleRecord& a, const SampleRecord& b) {
    if (lessAlong(0, a.position, b.position))
      return true;
    return !lessAlong(0, b.position, a.position) && a.input_index < b.input_index;
  };
  parallelSort(order.begin(), order.end(), threads, less);
  std::vector<std::uint8_t> stays(positions.size(), 1);
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() &&
           !lessAlong(0, order[begin].position, order[end].position))
      stays[order[end++].input_index] = 0;
    if (end - begin > 1)
      averageNormal(order, begin, end, normals);
    begin = end;
  }
  return stays;
}

namespace {

/** Count of some of the linear isopoints how many fits would find in gaps or on rims.
 */
void
examineSome(const IsopointInput& input,
            float isovalue,
            const IsoEdges& edges,
            const std::vector<PointIso>& points,
            SurfaceTally& tally,
            Report& report)
{
  ExaminedCandidates candidates;
  for (const PointIso& point : points)
    candidates.add(toPosition(point.data));
  const ExaminedIsopoints examined(candidates);
  IsoEdges some_edges;
  std::vector<PointIso> some;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (examined.contain(toPosition(points[i].data))) {
      some_edges.push_back(edges[i]);
      some.push_back(points[i]);
    }
  StepTimer step(report, "smooth_roots", some.size());
  fitRoots(input, isovalue, some_edges, some, step);
  std::vector<std::uint8_t> supports;
  supports.reserve(some.size());
  for (const PointIso& point : some)
    supports.push_back(point.support);
  countExamined(supports, tally, report);
}

} // namespace

void
appendIsopoints(const IsopointInput& input,
                const std::vector<std::uint32_t>& sources,
                float isovalue,
                pcl::PointCloud<PointIso>& isopoints,
                IsoEdges& edges,
                SurfaceTally& tally,
                Report& report)
{
  std::vector<std::uint32_t> crossing;
  {
    const StepTimer timer(report, "crossing_pairs");
    crossing = input.candidates.findCrossing(input.ranges, isovalue, input.threads);
  }
  const std::vector<EdgeKey> keys = findEdges(input, crossing, isovalue, tally, report);
  std::vector<PointIso> points(keys.size());
  IsoEdges point_edges(keys.size());
  {
    const StepTimer timer(report, "linear_roots");
    parallelBlocks(keys.size(), block_edges, input.threads, [&](auto begin, auto end) {
      for (std::size_t i = begin; i < end; ++i)
        placeIsopoint(input, keys[i], isovalue, points[i], point_edges[i]);
    });
    tally.crossing += crossing.size();
    report.count("crossing_samples", crossing.size());
    report.count("edges", keys.size());
    report.count("coincident", dropCoincident(points, point_edges, input.threads));
  }
  if (input.interpolation == Interpolation::Linear)
    examineSome(input, isovalue, point_edges, points, tally, report);
  else
    smoothIsopoints(input, isovalue, point_edges, points, report);
  if (input.interpolation == Interpolation::Auto)
    removeContradicted(input, isovalue, points, point_edges, tally, report);
  for (IsoEdge& edge : point_edges) {
    edge.first = sources[edge.first];
    edge.second = sources[edge.second];
  }
  isopoints.insert(isopoints.end(), points.begin(), points.end());
  edges.insert(edges.end(), point_edges.begin(), point_edges.end());
}

} // namespace pcl_uvol
