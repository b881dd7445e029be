// SPDX-License-Identifier: BSD-3-Clause
// Rays through a tree of splats. Plain arrays, no library headers: the file is compiled
// once per instruction set.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_uvol {

/** Children of a node, and splats of a leaf, at most: what the widest registers take at
 * once. */
constexpr int tree_width = 16;

/** In a child's number: it is a leaf. */
constexpr std::uint32_t leaf_bit = 0x80000000;

/** Entries that a traversal puts aside, at most; see SplatTree for the depth. */
constexpr std::size_t traversal_room = 512;

/** \brief Boxes of the children side by side. Those that are not there have boxes that
 * no ray meets. */
struct alignas(64) TreeNode {
  float low[3][tree_width], high[3][tree_width];
  std::uint32_t child[tree_width]; ///< a node, or a leaf with the leaf bit
};

/** \brief Discs side by side; those that are not there have a negative square. */
struct alignas(64) TreeLeaf {
  float center[3][tree_width], normal[3][tree_width], sq_radius[tree_width];
};

/** \brief Lines at which the discs of a leaf end at the rim of the surface. */
struct alignas(64) LeafRims {
  float outwards[2][3][tree_width]; ///< of length 1, in the plane of the disc
  float distance[2][tree_width];    ///< from the centre; infinite: there is no line
};

/** Number of the rims of a leaf whose discs are whole. */
constexpr std::uint32_t no_rims = 0xffffffff;

/** \brief Splat i is in leaf i / tree_width. */
struct TreeArrays {
  const TreeNode* nodes; ///< the root first
  const TreeLeaf* leaves;
  const std::uint32_t* rims_of_leaf = nullptr; ///< null: all discs are whole
  const LeafRims* rims = nullptr;
};

/** \brief A ray, in the coordinates of the tree. */
struct TreeRay {
  float origin[3], direction[3]; ///< of length 1
  float near, far;               ///< distances between which it is looked at
  float sq_reach = 1.0f;         ///< squares of radii count as so many times as large
  /** It starts on the surface of splats that has this normal, on the side of the ray,
   * and so far before the origin: splats of this surface near the start are not met. @{
   */
  bool leaves_surface = false;
  float own_normal[3]{}, from_start = 0.0f;
  float own_side = 1.0f; ///< -1: the normal looks into what the surface encloses
  /** @} */
  /** Splats that look away from the eye are not met. @{ */
  bool culls = false;
  float eye[3]{};
  /** @} */
};

/** \brief A place where a ray meets a splat. */
struct SplatHit {
  float distance;
  float sq_offset; ///< squared distance to the splat's centre
  std::uint32_t splat;
};

/** \brief One instruction set's versions. */
struct SplatTreeKernels {
  /** \brief All splats that a ray meets not farther behind any of them than that part
   * of its radius, and some behind; in no particular but always the same order.
   * \param part of the radius
   * \param room of hits
   * \return their number; more than there is room for: nothing is known */
  std::size_t (*collect)(const TreeArrays& tree,
                         const TreeRay& ray,
                         float part,
                         SplatHit* hits,
                         std::size_t room);

  /** \brief True if the ray meets any splat. */
  bool (*isBlocked)(const TreeArrays& tree, const TreeRay& ray);
};

namespace baseline {
extern const SplatTreeKernels splat_tree_kernels;
}
namespace avx2 {
extern const SplatTreeKernels splat_tree_kernels;
}
namespace avx512 {
extern const SplatTreeKernels splat_tree_kernels;
}

} // namespace pcl_uvol
