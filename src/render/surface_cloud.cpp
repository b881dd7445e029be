// SPDX-License-Identifier: BSD-3-Clause
#include "footprints.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/parallel.h>
#include <pcl_uvol/common/scalar_field.h>
#include <pcl_uvol/render/surface_cloud.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>

namespace pcl_uvol {

namespace {

constexpr std::size_t block_points = 1u << 12;

/** Points of a block at most: few enough to lie close, many enough to be worth a test.
 */
constexpr std::uint32_t largest_block = 256;

/** Largest number in 16 bits with sign. */
constexpr float packed_scale = 32767.0f;

/** Fields that hold the normal, if the cloud has them as numbers. */
std::optional<std::array<ScalarField, 3>>
normalFields(const CloudView& cloud)
{
  for (const char* name : {"normal_x", "normal_y", "normal_z"})
    if (findField(cloud.fields, name) == nullptr)
      return std::nullopt;
  return std::array<ScalarField, 3>{ScalarField(cloud.fields, "normal_x"),
                                    ScalarField(cloud.fields, "normal_y"),
                                    ScalarField(cloud.fields, "normal_z")};
}

/** Normals of all input points, packed. */
struct Normals {
  std::vector<PackedNormal> packed; ///< by input index
  std::vector<std::uint32_t> use;   ///< input points that have one
};

bool
isUsable(const float* normal)
{
  const float sq_length =
      normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  return std::isfinite(sq_length) && sq_length > 0.0f;
}

Normals
readNormals(const CloudView& cloud,
            const std::array<ScalarField, 3>& fields,
            const std::vector<std::uint32_t>& use,
            unsigned threads)
{
  Normals normals;
  normals.packed.resize(cloud.count);
  normals.use = parallelGather<std::uint32_t>(
      use.size(),
      block_points,
      threads,
      [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& found) {
        for (std::size_t i = begin; i < end; ++i) {
          float normal[3];
          for (std::size_t axis = 0; axis < 3; ++axis)
            normal[axis] = static_cast<float>(fields[axis].read(cloud.point(use[i])));
          if (!isUsable(normal))
            continue;
          normals.packed[use[i]] = packNormal(normal);
          found.push_back(use[i]);
        }
      });
  return normals;
}

Normals
estimateNormals(const CloudView& cloud,
                const std::vector<std::uint32_t>& use,
                unsigned threads,
                Report& report)
{
  const StepTimer timer(report, "normals");
  SurfaceNormalParameters parameters;
  parameters.threads = threads;
  Report estimation;
  const auto estimated = estimateSurfaceNormals(cloud, use, parameters, estimation);
  Normals normals;
  normals.packed.resize(cloud.count);
  for (std::size_t i = 0; i < use.size(); ++i)
    if (isUsable(estimated[i].normal)) {
      normals.packed[use[i]] = packNormal(estimated[i].normal);
      normals.use.push_back(use[i]);
    }
  return normals;
}

bool
isFinite(const float* xyz)
{
  return std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]);
}

std::uint64_t
nextRevision()
{
  static std::atomic<std::uint64_t> revision{0};
  return ++revision;
}

} // namespace

PackedNormal
packNormal(const float* normal)
{
  const float sum = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  float u = normal[0] / sum, v = normal[1] / sum;
  if (normal[2] < 0.0f) {
    const float folded = std::copysign(1.0f - std::abs(v), u);
    v = std::copysign(1.0f - std::abs(u), v);
    u = folded;
  }
  const auto pack = [](float value) {
    return static_cast<std::uint32_t>(static_cast<std::uint16_t>(
        static_cast<std::int16_t>(std::lround(packed_scale * value))));
  };
  return pack(u) | pack(v) << 16;
}

void
unpackNormal(PackedNormal packed, float* normal)
{
  const auto unpack = [](std::uint32_t bits) {
    return static_cast<float>(static_cast<std::int16_t>(bits)) / packed_scale;
  };
  float u = unpack(packed & 0xffff), v = unpack(packed >> 16);
  const float z = 1.0f - std::abs(u) - std::abs(v);
  const float fold = std::max(-z, 0.0f);
  u -= std::copysign(fold, u);
  v -= std::copysign(fold, v);
  const float scale = 1.0f / std::sqrt(u * u + v * v + z * z);
  normal[0] = u * scale;
  normal[1] = v * scale;
  normal[2] = z * scale;
}

SurfaceCloud::SurfaceCloud(const CloudView& cloud,
                           const std::vector<std::uint32_t>& use,
                           unsigned threads,
                           Report& report)
    : revision_(nextRevision())
{
  report.count("points", use.size());
  std::vector<std::uint32_t> finite;
  std::copy_if(use.begin(), use.end(), std::back_inserter(finite), [&](auto i) {
    return isFinite(cloud.xyz(i));
  });
  report.count("non_finite", use.size() - finite.size());
  if (finite.empty())
    throw InvalidArgument("The cloud has no point with finite coordinates to draw.");
  Normals normals;
  if (const auto fields = normalFields(cloud))
    normals = readNormals(cloud, *fields, finite, threads);
  two_sided_ = normals.use.empty();
  if (two_sided_) {
    normals = estimateNormals(cloud, finite, threads, report);
    report.warnings.push_back("The cloud has no normals: they were estimated, and the "
                              "surface is drawn from both sides.");
  }
  report.count("without_normal", finite.size() - normals.use.size());
  if (normals.use.empty())
    throw InvalidArgument("No point of the cloud has a normal, and none can be "
                          "estimated.");

  samples_ = SampleSet::build(cloud.xyz(0),
                              cloud.stride(),
                              normals.use,
                              Position{{1.0f, 1.0f, 1.0f}},
                              threads,
                              report);
  place(threads);
  for (std::size_t i = 0; i < size(); ++i) {
    normals_[i] = normals.packed[input_indices_[i]];
    looks_[i] = {normals_[i], 0xffffffff};
  }
  addBlocks(samples_->getTree().getRoot());
}

void
SurfaceCloud::place(unsigned threads)
{
  const std::vector<Position>& positions = samples_->getPositions();
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
    bounds_.center[axis] = center[axis];
    coordinates_[axis].resize(count);
  }
  normals_.resize(count);
  looks_.resize(count);
  input_indices_.resize(count);
  parallelBlocks(count, block_points, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        coordinates_[axis][i] = positions[i][axis] - center[axis];
      input_indices_[i] = samples_->getInputIndex(i);
    }
  });
  float sq_radius = 0.0f;
  for (std::size_t i = 0; i < count; ++i)
    sq_radius = std::max(sq_radius,
                         coordinates_[0][i] * coordinates_[0][i] +
                             coordinates_[1][i] * coordinates_[1][i] +
                             coordinates_[2][i] * coordinates_[2][i]);
  bounds_.radius = std::sqrt(static_cast<double>(sq_radius));
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
    unpackNormal(normals_[i], normal);
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
      unpackNormal(normals_[i], normal);
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
SurfaceCloud::setColors(const std::vector<Rgba>& colors)
{
  for (std::size_t i = 0; i < size(); ++i)
    looks_[i].color = colors[input_indices_[i]];
  revision_ = nextRevision();
}

void
SurfaceCloud::setColor(Rgba color)
{
  for (Look& look : looks_)
    look.color = color;
  revision_ = nextRevision();
}

void
SurfaceCloud::computeFootprints(unsigned threads, Report& report)
{
  if (!footprints_.empty())
    return;
  Footprints footprints =
      pcl_uvol::computeFootprints(*samples_, normals_, two_sided_, threads, report);
  footprints_ = std::move(footprints.radii);
  fillers_ = std::move(footprints.fillers);
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
