// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracing/splat_tree_kernel.h"

#include "common/lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

/** Directions along an axis are no smaller: their inverses stay finite. */
constexpr float least_direction = 1e-20f;

/** A child that is put aside, and above it the bits of the distance of its box: what is
 * written as a whole is read as a whole, without waiting for two halves. */
using Aside = std::uint64_t;

Aside
makeAside(std::uint32_t child, float near)
{
  std::uint32_t bits = 0;
  __builtin_memcpy(&bits, &near, sizeof bits);
  return Aside{bits} << 32 | child;
}

std::uint32_t
childOf(Aside aside)
{
  return static_cast<std::uint32_t>(aside);
}

/** Distances are not negative: their bits are in their order. */
std::uint32_t
nearBitsOf(Aside aside)
{
  return static_cast<std::uint32_t>(aside >> 32);
}

float
nearOf(Aside aside)
{
  const std::uint32_t bits = nearBitsOf(aside);
  float near = 0.0f;
  __builtin_memcpy(&near, &bits, sizeof near);
  return near;
}

/** In which order children are gone through. */
enum class Order {
  NearestFirst, ///< what hits first ends the way soon
  Any           ///< any hit will do, and most rays meet none
};

/** In radii of a splat: nearer to it a ray that comes out of the surface it starts on,
 * or that goes into it, has not left this surface yet. Splats are tangent planes: where
 * the surface is convex they stand out from it, over the places beside them. @{ */
constexpr float reach_outwards = 3.0f, reach_inwards = 1.0f;
/** @} */

/** Least cosine of the normals of two splats of one surface, for a ray that comes out
 * or goes in. @{ */
constexpr float aligned_outwards = 0.25f, aligned_inwards = 0.7f;
/** @} */

/** In radii of a splat with any normal: what stands out over an edge of the surface. A
 * ray that comes out of it started outside all the same, and one from a place whose
 * tangent plane its centre does not rise above meets what is not there: walls stand on
 * the plane. @{ */
constexpr float reach_at_edges = 1.5f, reach_from_below = 2.0f, least_height = 0.1f;
/** @} */

constexpr float
square(float value)
{
  return value * value;
}

template <Order order>
class Traversal {
public:
  Traversal(const TreeArrays& tree, const TreeRay& ray)
      : tree_(tree)
      , ray_(ray)
      , far_(ray.far)
  {
    for (int axis = 0; axis < 3; ++axis) {
      const float d = ray.direction[axis];
      const bool is_tiny = d < least_direction && d > -least_direction;
      inverse_[axis] = 1.0f / (is_tiny ? least_direction : d);
      is_finite_ =
          is_finite_ && (ray.origin[axis] - ray.origin[axis]) + (d - d) == 0.0f;
    }
  }

  /** Nothing beyond this distance counts any more. */
  void
  shorten(float far)
  {
    far_ = far < far_ ? far : far_;
  }

  float
  far() const
  {
    return far_;
  }

  /** Go through the leaves; visit(leaf) returns false to stop. */
  template <typename Visit>
  void
  run(const Visit& visit)
  {
    if (!is_finite_) // it would meet children that are not there
      return;
    aside_[0] = makeAside(0, ray_.near);
    std::size_t count = 1;
    while (count > 0) {
      const Aside next = aside_[--count];
      if (nearOf(next) > far_)
        continue;
      const std::uint32_t child = childOf(next);
      if ((child & leaf_bit) != 0) {
        if (!visit(child & ~leaf_bit))
          return;
      }
      else
        count = putAside(tree_.nodes[child], count);
    }
  }

  /** One bit per splat of a leaf that the ray meets before far.
   * \param distance, sq_offset of every splat that is met */
  std::uint32_t
  meet(std::uint32_t number, float* distance, float* sq_offset) const
  {
    const TreeLeaf& leaf = tree_.leaves[number];
    std::uint32_t met = 0;
    for (int first = 0; first < tree_width; first += lanes) {
      Floats along{}, across{};
      Floats offset[3];
      for (int axis = 0; axis < 3; ++axis) {
        const Floats normal = load<Floats>(leaf.normal[axis] + first);
        offset[axis] = load<Floats>(leaf.center[axis] + first) - ray_.origin[axis];
        along += normal * offset[axis];
        across += normal * ray_.direction[axis];
      }
      const Floats t = along / across;
      Floats sq{};
      for (int axis = 0; axis < 3; ++axis) {
        const Floats d = t * ray_.direction[axis] - offset[axis];
        sq += d * d;
      }
      Ints is_met = (sq <= ray_.sq_reach * load<Floats>(leaf.sq_radius + first)) &
                    (t >= fill(ray_.near)) & (t <= fill(far_));
      if (ray_.leaves_surface)
        is_met &= ~isOwn(leaf, first, t, across);
      if (ray_.culls)
        is_met &= looksToEye(leaf, first);
      store(distance + first, t);
      store(sq_offset + first, sq);
      met |= laneBits(is_met) << first;
    }
    return met == 0 || tree_.rims_of_leaf == nullptr
               ? met
               : met & withinRims(number, distance);
  }

private:
  /** Of the splats of a leaf, whose planes the ray meets at these distances. */
  std::uint32_t
  withinRims(std::uint32_t number, const float* distance) const
  {
    if (tree_.rims_of_leaf[number] == no_rims)
      return ~0u;
    const TreeLeaf& leaf = tree_.leaves[number];
    const LeafRims& rims = tree_.rims[tree_.rims_of_leaf[number]];
    std::uint32_t within = 0;
    for (int first = 0; first < tree_width; first += lanes) {
      Floats ahead[2]{};
      for (int axis = 0; axis < 3; ++axis) {
        const Floats offset = ray_.origin[axis] +
                              load<Floats>(distance + first) * ray_.direction[axis] -
                              load<Floats>(leaf.center[axis] + first);
        for (int line = 0; line < 2; ++line)
          ahead[line] += load<Floats>(rims.outwards[line][axis] + first) * offset;
      }
      within |= laneBits((ahead[0] <= load<Floats>(rims.distance[0] + first)) &
                         (ahead[1] <= load<Floats>(rims.distance[1] + first)))
                << first;
    }
    return within;
  }

  /** Which splats of a leaf are of the surface that the ray starts on.
   * \param first that is looked at
   * \param rise cosine of the ray to their normals */
  Ints
  isOwn(const TreeLeaf& leaf,
        int first,
        const Floats& distance,
        const Floats& rise) const
  {
    Floats alignment{}, height{};
    for (int axis = 0; axis < 3; ++axis) {
      alignment += load<Floats>(leaf.normal[axis] + first) * ray_.own_normal[axis];
      height += (load<Floats>(leaf.center[axis] + first) - ray_.origin[axis]) *
                ray_.own_normal[axis];
    }
    const Floats sq_alignment = alignment * alignment, way = distance + ray_.from_start,
                 sq_way = way * way, sq_radius = load<Floats>(leaf.sq_radius + first);
    const Ints outwards = (sq_alignment > fill(square(aligned_outwards))) &
                          (sq_way < square(reach_outwards) * sq_radius);
    const Ints inwards = (sq_alignment > fill(square(aligned_inwards))) &
                         (sq_way < square(reach_inwards) * sq_radius);
    const Ints at_edge = sq_way < square(reach_at_edges) * sq_radius;
    const Ints is_low =
        (height < fill(0.0f)) | (height * height < square(least_height) * sq_radius);
    const Ints from_below = is_low & (sq_way < square(reach_from_below) * sq_radius);
    return from_below |
           (ray_.own_side * rise > fill(0.0f) ? outwards | at_edge : inwards);
  }

  /** Of the splats of a leaf from the first one on. */
  Ints
  looksToEye(const TreeLeaf& leaf, int first) const
  {
    Floats facing{};
    for (int axis = 0; axis < 3; ++axis)
      facing += load<Floats>(leaf.normal[axis] + first) *
                (ray_.eye[axis] - load<Floats>(leaf.center[axis] + first));
    return facing >= fill(0.0f);
  }

  /** The children that the ray meets, the nearest one last, or in any order. */
  std::size_t
  putAside(const TreeNode& node, std::size_t count)
  {
    alignas(64) float nears[tree_width];
    std::uint32_t met = 0;
    for (int first = 0; first < tree_width; first += lanes) {
      Floats near = fill(ray_.near), far = fill(far_);
      for (int axis = 0; axis < 3; ++axis) {
        const bool is_upwards = inverse_[axis] >= 0.0f;
        const float* const front = is_upwards ? node.low[axis] : node.high[axis];
        const float* const back = is_upwards ? node.high[axis] : node.low[axis];
        const Floats in =
            (load<Floats>(front + first) - ray_.origin[axis]) * inverse_[axis];
        const Floats out =
            (load<Floats>(back + first) - ray_.origin[axis]) * inverse_[axis];
        near = maximum(in, near);
        far = minimum(out, far);
      }
      store(nears + first, near);
      met |= laneBits(near <= far) << first;
    }
    const std::size_t begin = count;
    for (; met != 0; met &= met - 1) {
      const int child = __builtin_ctz(met);
      const Aside found = makeAside(node.child[child], nears[child]);
      std::size_t place = count++;
      if (order == Order::NearestFirst)
        for (; place > begin && nearBitsOf(aside_[place - 1]) < nearBitsOf(found);
             --place)
          aside_[place] = aside_[place - 1];
      aside_[place] = found;
    }
    return count;
  }

  const TreeArrays& tree_;
  const TreeRay& ray_;
  float inverse_[3];
  bool is_finite_ = true;
  float far_;
  Aside aside_[traversal_room];
};

std::size_t
collect(const TreeArrays& tree,
        const TreeRay& ray,
        float part,
        SplatHit* hits,
        std::size_t room)
{
  Traversal<Order::NearestFirst> traversal(tree, ray);
  std::size_t count = 0;
  alignas(64) float distance[tree_width], sq_offset[tree_width], behind[tree_width];
  traversal.run([&](std::uint32_t number) {
    const TreeLeaf& leaf = tree.leaves[number];
    std::uint32_t met = traversal.meet(number, distance, sq_offset);
    if (met == 0)
      return true;
    for (int first = 0; first < tree_width; first += lanes)
      store(behind + first,
            load<Floats>(distance + first) +
                part * squareRoot(load<Floats>(leaf.sq_radius + first)));
    for (std::uint32_t rest = met; rest != 0; rest &= rest - 1)
      traversal.shorten(behind[__builtin_ctz(rest)]);
    for (; met != 0; met &= met - 1) {
      const int i = __builtin_ctz(met);
      if (distance[i] > traversal.far())
        continue;
      if (count < room)
        hits[count] = {distance[i],
                       sq_offset[i],
                       number * tree_width + static_cast<std::uint32_t>(i)};
      ++count;
    }
    return count <= room;
  });
  return count;
}

bool
isBlocked(const TreeArrays& tree, const TreeRay& ray)
{
  Traversal<Order::Any> traversal(tree, ray);
  bool is_blocked = false;
  alignas(64) float distance[tree_width], sq_offset[tree_width];
  traversal.run([&](std::uint32_t number) {
    is_blocked = traversal.meet(number, distance, sq_offset) != 0;
    return !is_blocked;
  });
  return is_blocked;
}

} // namespace

extern const SplatTreeKernels splat_tree_kernels{collect, isBlocked};

} // namespace pcl_uvol::PCL_UVOL_SIMD
