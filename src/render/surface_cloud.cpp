// SPDX-License-Identifier: BSD-3-Clause
#include "render/surface_cloud.h"

#include "common/memory.h"
#include "common/parallel.h"
#include "render/point_colors.h"
#include "surface/memory_need.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_uvol {

namespace {

constexpr std::size_t block_points = 1u << 12;

/** Points of a block at most: few enough to lie close, many enough to be worth a test.
 */
constexpr std::uint32_t largest_block = 256;

std::uint64_t
nextRevision()
{
  static std::atomic<std::uint64_t> revision{0};
  return ++revision;
}

OrientedPoints
orientWithinMemory(const CloudView& cloud,
                   const std::vector<std::uint32_t>& use,
                   unsigned threads,
                   Report& report)
{
  checkMemoryOf(
      "A picture", use.size(), footprintsBytes(static_cast<double>(use.size())));
  return orientPoints(cloud, use, threads, report);
}

} // namespace

SurfaceCloud::SurfaceCloud(const CloudView& cloud,
                           const std::vector<std::uint32_t>& use,
                           unsigned threads,
                           Report& report)
    : points_(orientWithinMemory(cloud, use, threads, report))
    , revision_(nextRevision())
{
  place(threads);
  for (std::size_t i = 0; i < size(); ++i) {
    looks_[i].normal = points_.normals[i];
    setColorOf(i, 0xffffffff);
  }
  addBlocks(points_.samples->getTree().getRoot());
  is_inside_out_ = !isTwoSided() && looksInwards();
  if (!points_.bridged.empty())
    report.count("bridged",
                 static_cast<std::uint64_t>(
                     std::count(points_.bridged.begin(), points_.bridged.end(), 1)));
}

void
SurfaceCloud::place(unsigned threads)
{
  const std::vector<Position>& positions = points_.samples->getPositions();
  const LengthUnit& unit = points_.samples->getUnit();
  const std::size_t count = positions.size();
  Position low = positions[0], high = positions[0];
  for (const Position& position : positions)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], position[axis]);
      high[axis] = std::max(high[axis], position[axis]);
    }
  // The centre is a float, so that differences to it are exact or nearly so.
  Position center;
  for (int axis = 0; axis < 3; ++axis) {
    center[axis] = 0.5f * low[axis] + 0.5f * high[axis];
    bounds_.center[axis] = unit.toInput(center[axis]);
    coordinates_[axis].resize(count);
  }
  looks_.resize(count);
  input_indices_.resize(count);
  parallelBlocks(count, block_points, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        coordinates_[axis][i] = positions[i][axis] - center[axis];
      input_indices_[i] = points_.samples->getInputIndex(i);
    }
  });
  float sq_radius = 0.0f;
  for (std::size_t i = 0; i < count; ++i)
    sq_radius = std::max(sq_radius,
                         coordinates_[0][i] * coordinates_[0][i] +
                             coordinates_[1][i] * coordinates_[1][i] +
                             coordinates_[2][i] * coordinates_[2][i]);
  bounds_.radius = unit.toInput(std::sqrt(static_cast<double>(sq_radius)));
  // Powers of two, so that nothing is rounded.
  length_factor_ = static_cast<float>(unit.toInput(chooseLengthUnit(bounds_)));
  for (auto& coordinates : coordinates_)
    for (float& coordinate : coordinates)
      coordinate *= length_factor_;
}

bool
SurfaceCloud::looksInwards() const
{
  // Sheets, and surfaces that wind through space, look to the middle as much as away.
  constexpr double least_part = 0.25;
  constexpr std::size_t enough_points = 50000;
  double outwards = 0.0, all = 0.0;
  for (std::size_t i = 0; i < size(); i += size() / enough_points + 1) {
    float normal[3];
    unpackNormal(points_.normals[i], normal);
    double along = 0.0;
    for (int axis = 0; axis < 3; ++axis)
      along += double{normal[axis]} * coordinates_[axis][i];
    outwards += along;
    all += std::abs(along);
  }
  return outwards < -least_part * all;
}

void
SurfaceCloud::addBlocks(const KdNode& node)
{
  if (node.count > largest_block) {
    addBlocks(node.left());
    addBlocks(node.right());
  }
  else
    blocks_.push_back(makeBlock(node.begin, node.begin + node.count));
}

SurfaceBlock
SurfaceCloud::makeBlock(std::uint32_t begin, std::uint32_t end) const
{
  SurfaceBlock block{begin, end, {}, 0.0f, {}, 1.0f, 0.0f, 0.0f, 0.0f};
  float low[3], high[3], sum[3] = {0.0f, 0.0f, 0.0f};
  for (int axis = 0; axis < 3; ++axis) {
    const auto first = coordinates_[axis].begin();
    const auto range = std::minmax_element(first + begin, first + end);
    low[axis] = *range.first;
    high[axis] = *range.second;
    block.center[axis] = 0.5f * (low[axis] + high[axis]);
  }
  float sq_radius = 0.0f, normal[3];
  for (std::uint32_t i = begin; i < end; ++i) {
    float sq_dist = 0.0f;
    unpackNormal(points_.normals[i], normal);
    for (int axis = 0; axis < 3; ++axis) {
      const float offset = coordinates_[axis][i] - block.center[axis];
      sq_dist += offset * offset;
      sum[axis] += normal[axis];
    }
    sq_radius = std::max(sq_radius, sq_dist);
  }
  // Room for rounding.
  block.radius = 1.0001f * std::sqrt(sq_radius);
  const float length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  if (length > 0.0f) {
    float cosine = 1.0f;
    for (int axis = 0; axis < 3; ++axis)
      block.axis[axis] = sum[axis] / length;
    for (std::uint32_t i = begin; i < end; ++i) {
      unpackNormal(points_.normals[i], normal);
      cosine = std::min(cosine,
                        normal[0] * block.axis[0] + normal[1] * block.axis[1] +
                            normal[2] * block.axis[2]);
    }
    if (cosine > 0.0f)
      block.spread = std::min(1.0f, std::sqrt(1.0f - cosine * cosine) + 0.001f);
  }
  float extent[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  std::sort(extent, extent + 3);
  block.mean_spacing =
      std::sqrt(extent[2] * extent[1] / static_cast<float>(end - begin));
  return block;
}

void
SurfaceCloud::setColorOf(std::size_t point, Rgba color)
{
  constexpr Rgba rgb = 0xffffff;
  const Rgba surface = hasSurfaces() ? points_.surfaces[point] : 0;
  looks_[point].color = (color & rgb) | surface << 24;
}

void
SurfaceCloud::setColors(const std::vector<Rgba>& colors)
{
  for (std::size_t i = 0; i < size(); ++i)
    setColorOf(i, colors[input_indices_[i]]);
  revision_ = nextRevision();
}

void
SurfaceCloud::setColor(Rgba color)
{
  for (std::size_t i = 0; i < size(); ++i)
    setColorOf(i, color);
  revision_ = nextRevision();
}

void
SurfaceCloud::fadeBridged(const Color& background)
{
  if (points_.bridged.empty())
    return;
  for (std::size_t i = 0; i < size(); ++i)
    if (points_.bridged[i])
      setColorOf(i, makePaler(looks_[i].color, background));
  revision_ = nextRevision();
}

void
SurfaceCloud::computeFootprints(unsigned threads, Report& report)
{
  if (footprints_.empty())
    setFootprints(findFootprints(threads, report));
}

Footprints
SurfaceCloud::findFootprints(unsigned threads, Report& report) const
{
  return pcl_uvol::computeFootprints(points_, threads, report);
}

std::vector<FittedDisc>
SurfaceCloud::listFittedDiscs(const Footprints& footprints,
                              std::size_t input_count) const
{
  const std::vector<float>& radii = footprints.radii;
  const auto dots =
      static_cast<std::size_t>(std::count(radii.begin(), radii.end(), 0.0f));
  constexpr float uncounted = std::numeric_limits<float>::quiet_NaN();
  const float of_dots = 2 * dots > radii.size() ? 0.0f : uncounted;
  const LengthUnit& unit = points_.samples->getUnit();
  std::vector<FittedDisc> discs(input_count, {uncounted, {}});
  for (std::size_t i = 0; i < radii.size(); ++i) {
    FittedDisc& disc = discs[input_indices_[i]];
    disc.radius = radii[i] > 0.0f
                      ? static_cast<float>(unit.toInput(static_cast<double>(radii[i])))
                      : of_dots;
    unpackNormal(points_.normals[i], disc.normal.data());
  }
  return discs;
}

void
SurfaceCloud::setFootprints(Footprints footprints)
{
  footprints_ = std::move(footprints.radii);
  fillers_ = std::move(footprints.fillers);
  bends_ = std::move(footprints.bends);
  rims_ = std::move(footprints.rims);
  for (auto* const radii : {&footprints_, &fillers_})
    for (float& radius : *radii)
      radius *= length_factor_;
  std::vector<float> sorted = footprints_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  typical_footprint_ = *middle;
  for (SurfaceBlock& block : blocks_) {
    const auto begin = footprints_.begin() + block.begin,
               end = footprints_.begin() + block.end;
    block.largest_footprint = *std::max_element(begin, end);
    block.mean_footprint = static_cast<float>(std::accumulate(begin, end, 0.0) /
                                              (block.end - block.begin));
  }
  revision_ = nextRevision();
}

} // namespace pcl_uvol
