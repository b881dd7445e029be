// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracing/splat_tree.h"

#include "common/dispatch.h"
#include "common/parallel.h"
#include "render/ray_tracing/tree_builder.h"
#include "surface/rim_lines.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace pcl_uvol {

namespace {

const KernelTable<const SplatTreeKernels*> kernel_table{&baseline::splat_tree_kernels,
                                                        &avx2::splat_tree_kernels,
                                                        &avx512::splat_tree_kernels};

constexpr std::size_t block_splats = 1u << 12;

/** Splats that a ray meets not farther behind another one than this part of its radius
 * are one surface with it. */
constexpr float same_surface = 0.5f;

/** Splats of which at least so many lie on all sides of a ray, which misses each by
 * less than its radius, and not farther behind one another than that part of it, have a
 * crack between them: on rough surfaces discs are tilted against each other. @{ */
constexpr std::size_t fewest_around = 3;
constexpr float slip = 2.0f, crack_depth = 4.0f;
/** @} */

/** What lies not farther behind splats than across a crack is seen from outside where a
 * ray misses them by less than half their radius: at outlines. Open surfaces end a bit
 * farther on. */
constexpr float slip_at_outlines = 1.5f;

/** They lie on all sides if no angle between neighbours, seen along the ray, is wider:
 * discs reach beyond the hull of their centres. @{ */
constexpr float full_turn = 6.2831853f, widest_gap = 0.6f * full_turn;
/** @} */

/** Room around splats, for rounding: in parts of their distances to the centre. */
constexpr float box_room = 1e-6f;

/** Hits that are looked for at first. */
constexpr std::size_t first_room = 64;

/** The boxes of all splats, in coordinates relative to a centre. */
std::vector<ItemBox>
computeBoxes(const pcl::PointCloud<PointSplat>& splats,
             const Eigen::Vector3d& center,
             unsigned threads)
{
  std::vector<ItemBox> boxes(splats.size());
  parallelBlocks(splats.size(), block_splats, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const PointSplat& splat = splats[i];
      for (int axis = 0; axis < 3; ++axis) {
        const auto x = static_cast<float>(splat.data[axis] - center[axis]);
        const float n = splat.data_n[axis];
        const float half = splat.radius * std::sqrt(std::max(0.0f, 1.0f - n * n)) +
                           box_room * (std::abs(x) + splat.radius);
        boxes[i].low[axis] = x - half;
        boxes[i].high[axis] = x + half;
      }
    }
  });
  return boxes;
}

Eigen::Map<const Eigen::Vector3f>
toVector(const float* numbers)
{
  return Eigen::Map<const Eigen::Vector3f>(numbers);
}

Eigen::Vector3f
toVector(Rgba color)
{
  constexpr float scale = 1.0f / 255.0f;
  return {scale * static_cast<float>(color & 0xff),
          scale * static_cast<float>(color >> 8 & 0xff),
          scale * static_cast<float>(color >> 16 & 0xff)};
}

/** Sine up to which a ray from behind may graze the outside of a splat, however much it
 * bends: of open surfaces more would be their inside. */
constexpr float most_grazing = 0.1f;

/** How much its field turns normals out of the plane's. */
float
bendOf(const SplatRecord& splat)
{
  return std::sqrt(splat.tilt[0] * splat.tilt[0] + splat.tilt[1] * splat.tilt[1]) +
         std::max(std::abs(splat.slope[0]), std::abs(splat.slope[1]));
}

/** What its points say, or its normals, if they know of a larger distance at its
 * border.
 */
float
thicknessOf(const PointSplat& splat)
{
  const float tilt = std::hypot(splat.tilt_u, splat.tilt_v);
  const float slope = std::max(std::abs(splat.slope_u), std::abs(splat.slope_v));
  return std::max(splat.error, splat.radius * (tilt + 0.5f * slope));
}

/** Normal of a splat's field at a place (equation 4.1), not of unit length. */
Eigen::Vector3f
fieldAt(const SplatRecord& splat, const Eigen::Vector3f& place)
{
  const Eigen::Vector3f offset = (place - toVector(splat.center)) / splat.radius;
  const Eigen::Vector3f normal = toVector(splat.normal), u = toVector(splat.tangent),
                        v = normal.cross(u);
  return normal + (splat.tilt[0] + splat.slope[0] * offset.dot(u)) * u +
         (splat.tilt[1] + splat.slope[1] * offset.dot(v)) * v;
}

/** What the splats that a ray meets together look like. */
struct Blend {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero(), color = normal;
  float weights = 0.0f, thickness = 0.0f;
  const SplatHit* nearest = nullptr; ///< whose centre is, in radii
  float least_offset = std::numeric_limits<float>::infinity();

  /** \param place where the ray meets it
   * \param reach offset at which the weight is 0 */
  void
  add(const SplatRecord& splat,
      const SplatHit& hit,
      const Eigen::Vector3f& place,
      float reach)
  {
    const float offset = std::sqrt(hit.sq_offset) / splat.radius;
    if (offset < least_offset) {
      least_offset = offset;
      nearest = &hit;
    }
    const float weight = std::max(0.0f, reach - offset);
    normal += weight * fieldAt(splat, place);
    color += weight * toVector(splat.color);
    weights += weight;
    thickness = std::max(thickness, splat.thickness);
  }
};

/** Of a splat of a leaf. */
void
setRim(const SplatRecord& splat, PackedRim rim, std::size_t place, LeafRims& rims)
{
  const RimLines lines = unpackRim(rim);
  const Eigen::Vector3f u = toVector(splat.tangent),
                        v = toVector(splat.normal).cross(u);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Eigen::Vector3f outwards =
        lines[k].outwards[0] * u + lines[k].outwards[1] * v;
    for (int axis = 0; axis < 3; ++axis)
      rims.outwards[k][axis][place] = outwards[axis];
    rims.distance[k][place] = splat.radius * lines[k].distance;
  }
}

} // namespace

SplatTree::SplatTree(const SplatObject& object, unsigned threads, StepTimer& step)
    : kernels_(kernel_table.get())
    , two_sided_(object.two_sided)
{
  const pcl::PointCloud<PointSplat>& splats = *object.splats;
  const Rgba color = toRgba(object.material.color);
  Eigen::Array3f low = splats.front().getArray3fMap(), high = low;
  for (const PointSplat& splat : splats) {
    low = low.min(splat.getArray3fMap());
    high = high.max(splat.getArray3fMap());
  }
  center_ = 0.5 * (low + high).matrix().cast<double>();
  for (const PointSplat& splat : splats)
    radius_ = std::max(radius_,
                       (splat.getVector3fMap().cast<double>() - center_).norm() +
                           splat.radius);
  radius_ *= 1.0 + box_room;
  WideTree tree = buildWideTree(computeBoxes(splats, center_, threads), threads, step);
  nodes_ = std::move(tree.nodes);
  const std::size_t leaves = tree.leaf_begin.size() - 1;
  leaves_.resize(leaves);
  splats_.resize(leaves * tree_width);
  parallelBlocks(leaves, block_splats / tree_width, threads, [&](auto begin, auto end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      TreeLeaf& filled = leaves_[leaf];
      const std::uint32_t first = tree.leaf_begin[leaf];
      const std::uint32_t count = tree.leaf_begin[leaf + 1] - first;
      for (std::uint32_t i = 0; i < tree_width; ++i) {
        filled.sq_radius[i] = -1.0f;
        if (i >= count)
          continue;
        const std::uint32_t index = tree.items[first + i];
        const PointSplat& splat = splats[index];
        for (int axis = 0; axis < 3; ++axis) {
          filled.center[axis][i] = static_cast<float>(splat.data[axis] - center_[axis]);
          filled.normal[axis][i] = splat.data_n[axis];
        }
        filled.sq_radius[i] = splat.radius * splat.radius;
        splats_[leaf * tree_width + i] = {
            {filled.center[0][i], filled.center[1][i], filled.center[2][i]},
            {splat.normal_x, splat.normal_y, splat.normal_z},
            {splat.tangent_x, splat.tangent_y, splat.tangent_z},
            splat.radius,
            {splat.tilt_u, splat.tilt_v},
            {splat.slope_u, splat.slope_v},
            thicknessOf(splat),
            object.colors.empty() ? color : object.colors[index]};
      }
    }
  });
  if (!object.rims.empty())
    addRims(object.rims, tree);
}

void
SplatTree::addRims(const std::vector<std::uint32_t>& rims, const WideTree& tree)
{
  rims_of_leaf_.assign(leaves_.size(), no_rims);
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    const std::uint32_t* const items = &tree.items[tree.leaf_begin[leaf]];
    const std::size_t count = tree.leaf_begin[leaf + 1] - tree.leaf_begin[leaf];
    if (std::none_of(items, items + count, [&](auto item) { return rims[item] != 0; }))
      continue;
    rims_of_leaf_[leaf] = static_cast<std::uint32_t>(rims_.size());
    rims_.emplace_back();
    for (std::size_t i = 0; i < count; ++i)
      setRim(splats_[leaf * tree_width + i], rims[items[i]], i, rims_.back());
  }
}

std::optional<double>
SplatTree::findEntry(const Ray& ray, double near, double far) const
{
  const Eigen::Vector3d offset = ray.origin - center_;
  if (offset.squaredNorm() <= radius_ * radius_)
    return 0.0;
  const double b = offset.dot(ray.direction);
  const double rest = radius_ * radius_ - (offset - b * ray.direction).squaredNorm();
  if (rest < 0.0)
    return std::nullopt;
  const double half = std::sqrt(rest);
  if (half - b < near || -half - b > far)
    return std::nullopt;
  return std::max(0.0, -half - b);
}

TreeRay
SplatTree::localRay(
    const Ray& ray, bool leaves_surface, double entry, double near, double far) const
{
  TreeRay local{};
  const Eigen::Vector3d origin = ray.origin + entry * ray.direction - center_;
  for (int axis = 0; axis < 3; ++axis) {
    local.origin[axis] = static_cast<float>(origin[axis]);
    local.direction[axis] = static_cast<float>(ray.direction[axis]);
  }
  local.near = static_cast<float>(std::max(near - entry, 0.0));
  local.far = static_cast<float>(far - entry);
  local.culls = ray.eye != nullptr && !two_sided_;
  for (int axis = 0; local.culls && axis < 3; ++axis)
    local.eye[axis] = static_cast<float>((*ray.eye)[axis] - center_[axis]);
  local.leaves_surface = leaves_surface;
  for (int axis = 0; leaves_surface && axis < 3; ++axis)
    local.own_normal[axis] = static_cast<float>(ray.start.normal[axis]);
  local.own_side = ray.start.is_outside ? 1.0f : -1.0f;
  local.from_start = static_cast<float>(entry);
  return local;
}

bool
SplatTree::isBlocked(const Ray& ray, bool leaves_surface, double near, double far) const
{
  const auto entry = findEntry(ray, near, far);
  return entry && kernels_->isBlocked(arrays(),
                                      localRay(ray, leaves_surface, *entry, near, far));
}

SplatTree::HitRange
SplatTree::collect(const TreeRay& ray,
                   float part,
                   std::size_t begin,
                   std::vector<SplatHit>& hits) const
{
  if (hits.size() < begin + first_room)
    hits.resize(begin + first_room);
  for (;;) {
    const std::size_t room = hits.size() - begin;
    const std::size_t count =
        kernels_->collect(arrays(), ray, part, hits.data() + begin, room);
    if (count <= room) {
      for (std::size_t i = begin; i < begin + count; ++i)
        __builtin_prefetch(&splats_[hits[i].splat]); // they are read one after another
      return {begin, begin + count};
    }
    hits.resize(4 * hits.size());
  }
}

std::pair<const SplatHit*, float>
SplatTree::findFirst(const std::vector<SplatHit>& hits, const HitRange& range) const
{
  float limit = std::numeric_limits<float>::infinity();
  const SplatHit* first = &hits[range.begin];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const SplatHit& other = hits[i];
    limit =
        std::min(limit, other.distance + same_surface * splats_[other.splat].radius);
    if (other.distance < first->distance ||
        (other.distance == first->distance && other.splat < first->splat))
      first = &other;
  }
  return {first, limit};
}

bool
SplatTree::isBehind(const TreeRay& ray, const SplatHit& hit) const
{
  return toVector(splats_[hit.splat].normal).dot(toVector(ray.direction)) > 0.0f;
}

bool
SplatTree::looksAway(const TreeRay& ray, const SplatHit& hit) const
{
  const SplatRecord& splat = splats_[hit.splat];
  return toVector(splat.normal).dot(toVector(ray.eye) - toVector(splat.center)) < 0.0f;
}

bool
SplatTree::surround(const TreeRay& ray,
                    const std::vector<SplatHit>& hits,
                    const HitRange& range) const
{
  const Eigen::Vector3f direction = toVector(ray.direction);
  const Eigen::Vector3f u = direction.unitOrthogonal(), v = direction.cross(u);
  std::vector<float> angles;
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const Eigen::Vector3f side =
        toVector(splats_[hits[i].splat].center) - toVector(ray.origin);
    angles.push_back(std::atan2(side.dot(v), side.dot(u)));
  }
  std::sort(angles.begin(), angles.end());
  float gap = angles.front() + full_turn - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap < widest_gap;
}

bool
SplatTree::isCloseBehind(const SplatHit& back,
                         const std::vector<SplatHit>& hits,
                         const HitRange& range) const
{
  return std::any_of(hits.begin() + static_cast<std::ptrdiff_t>(range.begin),
                     hits.begin() + static_cast<std::ptrdiff_t>(range.end),
                     [&](const SplatHit& hit) {
                       const float radius = splats_[hit.splat].radius;
                       const float reach = slip_at_outlines * radius;
                       return back.distance - hit.distance < crack_depth * radius &&
                              hit.sq_offset < reach * reach;
                     });
}

SplatTree::HitRange
SplatTree::findAround(const TreeRay& ray,
                      const SplatHit& first,
                      std::vector<SplatHit>& hits,
                      std::size_t begin) const
{
  TreeRay wide = ray;
  wide.sq_reach = slip * slip;
  wide.far = first.distance;
  HitRange range = collect(wide, crack_depth, begin, hits);
  const auto from = hits.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto fronts_end =
      std::remove_if(from,
                     hits.begin() + static_cast<std::ptrdiff_t>(range.end),
                     [&](const SplatHit& hit) { return isBehind(ray, hit); });
  range.end = begin + static_cast<std::size_t>(fronts_end - from);
  const bool is_crack =
      range.end - begin >= fewest_around && surround(ray, hits, range);
  if (!is_crack && !isCloseBehind(first, hits, range))
    range.end = begin;
  return range;
}

bool
SplatTree::intersect(const Ray& ray,
                     bool leaves_surface,
                     double near,
                     double far,
                     std::vector<SplatHit>& hits,
                     SplatSurfaceHit& hit) const
{
  const auto entry = findEntry(ray, near, far);
  if (!entry)
    return false;
  TreeRay local = localRay(ray, leaves_surface, *entry, near, far);
  const bool culls = std::exchange(local.culls, false); // backs tell of cracks
  HitRange range = collect(local, same_surface, 0, hits);
  if (range.begin == range.end)
    return false;
  // Which of them belong to the surface is known now that all are known.
  auto [first, limit] = findFirst(hits, range);
  float reach = 1.0f;
  if (isBehind(local, *first)) {
    const SplatHit behind = *first;
    const HitRange around = findAround(local, behind, hits, range.end);
    if (around.begin != around.end) {
      range = around;
      reach = slip;
    }
    std::tie(first, limit) = findFirst(hits, range);
  }
  if (culls && looksAway(local, *first)) {
    local.culls = true;
    range = collect(local, same_surface, 0, hits);
    if (range.begin == range.end)
      return false;
    std::tie(first, limit) = findFirst(hits, range);
    reach = 1.0f;
  }
  const Eigen::Vector3f side = toVector(splats_[first->splat].normal);
  const auto isOfSurface = [&, limit = limit](const SplatHit& other) {
    return other.distance <= limit &&
           toVector(splats_[other.splat].normal).dot(side) > 0.0f;
  };
  const auto begin = hits.begin() + static_cast<std::ptrdiff_t>(range.begin),
             end = hits.begin() + static_cast<std::ptrdiff_t>(range.end);
  const bool has_front =
      !isBehind(local, *first) || std::any_of(begin, end, [&](const SplatHit& other) {
        return !isBehind(local, other) && isOfSurface(other);
      });
  const Eigen::Vector3f origin = toVector(local.origin),
                        direction = toVector(local.direction);
  Blend blend;
  blend.nearest = first;
  for (auto other = begin; other != end; ++other) {
    // Beside fronts, backs are of the side beyond an edge, over which they stand out.
    if (!isOfSurface(*other) || (has_front && isBehind(local, *other)))
      continue;
    blend.add(
        splats_[other->splat], *other, origin + other->distance * direction, reach);
  }
  const SplatRecord& splat = splats_[blend.nearest->splat];
  const bool has_weight = blend.weights > 0.0f; // else on the border of a single splat
  hit.distance = *entry + blend.nearest->distance;
  hit.thickness = blend.thickness;
  hit.bend = std::min(bendOf(splat), most_grazing);
  hit.plane_normal = toVector(splat.normal).cast<double>();
  hit.normal = has_weight ? Eigen::Vector3d(blend.normal.cast<double>().normalized())
                          : hit.plane_normal;
  hit.color = (has_weight ? Eigen::Vector3f(blend.color / blend.weights)
                          : toVector(splat.color))
                  .cast<double>();
  return true;
}

} // namespace pcl_uvol
