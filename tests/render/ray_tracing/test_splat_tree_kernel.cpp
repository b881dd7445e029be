// SPDX-License-Identifier: BSD-3-Clause
// Rays through a tree of discs against all discs one by one.
#include "src/render/ray_tracing/splat_tree_kernel.h"
#include "src/render/ray_tracing/tree_builder.h"
#include "support/simd_levels.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace test_splat_tree_kernel {

using namespace pcl_uvol;
using Eigen::Vector3d;

const KernelTable<const SplatTreeKernels*> kernels{&baseline::splat_tree_kernels,
                                                   &avx2::splat_tree_kernels,
                                                   &avx512::splat_tree_kernels};

/** Random discs in the unit cube, and their tree. */
struct Discs {
  WideTree tree;
  std::vector<TreeLeaf> leaves;
  std::vector<std::uint32_t> filled; ///< places of discs
  std::vector<std::uint32_t> rims_of_leaf;
  std::vector<LeafRims> rims;

  /** \param has_rims every other leaf has lines, one, two or none per disc */
  explicit Discs(std::size_t count, bool has_rims = false)
  {
    std::mt19937_64 engine(count);
    std::uniform_real_distribution<double> place(-1.0, 1.0), size(0.02, 0.2);
    std::vector<ItemBox> boxes;
    std::vector<Vector3d> centers, normals;
    std::vector<double> radii;
    for (std::size_t i = 0; i < count; ++i) {
      centers.emplace_back(place(engine), place(engine), place(engine));
      normals.push_back(
          Vector3d(place(engine), place(engine), place(engine)).normalized());
      radii.push_back(size(engine));
      ItemBox box{};
      for (int axis = 0; axis < 3; ++axis) {
        const double n = normals.back()[axis];
        const double half = radii.back() * std::sqrt(1.0 - n * n) + 1e-5;
        box.low[axis] = static_cast<float>(centers.back()[axis] - half);
        box.high[axis] = static_cast<float>(centers.back()[axis] + half);
      }
      boxes.push_back(box);
    }
    Report report;
    StepTimer step(report, "build");
    tree = buildWideTree(boxes, 1, step);
    leaves.resize(tree.leaf_begin.size() - 1);
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
      for (std::uint32_t i = 0; i < tree_width; ++i) {
        leaves[leaf].sq_radius[i] = -1.0f;
        if (tree.leaf_begin[leaf] + i >= tree.leaf_begin[leaf + 1])
          continue;
        const std::uint32_t item = tree.items[tree.leaf_begin[leaf] + i];
        for (int axis = 0; axis < 3; ++axis) {
          leaves[leaf].center[axis][i] = static_cast<float>(centers[item][axis]);
          leaves[leaf].normal[axis][i] = static_cast<float>(normals[item][axis]);
        }
        leaves[leaf].sq_radius[i] = static_cast<float>(radii[item] * radii[item]);
        filled.push_back(static_cast<std::uint32_t>(leaf) * tree_width + i);
      }
    if (has_rims)
      for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
        rims_of_leaf.push_back(leaf % 2 == 0 ? static_cast<std::uint32_t>(rims.size())
                                             : no_rims);
        if (leaf % 2 == 0)
          rims.push_back(makeLines(leaves[leaf], engine));
      }
  }

  TreeArrays
  arrays() const
  {
    return {tree.nodes.data(),
            leaves.data(),
            rims.empty() ? nullptr : rims_of_leaf.data(),
            rims.data()};
  }

  /** How far a place is before the nearer line of a disc. */
  double
  beforeLines(std::uint32_t splat, const Vector3d& offset) const
  {
    double distance = std::numeric_limits<double>::infinity();
    if (rims.empty() || rims_of_leaf[splat / tree_width] == no_rims)
      return distance;
    const LeafRims& lines = rims[rims_of_leaf[splat / tree_width]];
    const std::uint32_t i = splat % tree_width;
    for (int k = 0; k < 2; ++k)
      distance = std::min(distance,
                          static_cast<double>(lines.distance[k][i]) -
                              offset.dot(Vector3d(lines.outwards[k][0][i],
                                                  lines.outwards[k][1][i],
                                                  lines.outwards[k][2][i])));
    return distance;
  }

private:
  static LeafRims
  makeLines(const TreeLeaf& leaf, std::mt19937_64& engine)
  {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    LeafRims lines{};
    for (int i = 0; i < tree_width; ++i) {
      const Vector3d normal(leaf.normal[0][i], leaf.normal[1][i], leaf.normal[2][i]);
      for (int k = 0; k < 2; ++k) {
        const Vector3d random(any(engine), any(engine), any(engine));
        const Vector3d outwards = random.cross(normal).normalized();
        for (int axis = 0; axis < 3; ++axis)
          lines.outwards[k][axis][i] = static_cast<float>(outwards[axis]);
        lines.distance[k][i] =
            i % 3 > k ? std::sqrt(leaf.sq_radius[i]) * static_cast<float>(any(engine))
                      : std::numeric_limits<float>::infinity();
      }
    }
    return lines;
  }
};

/** Where a ray meets the plane of a disc. */
struct Meeting {
  double distance, sq_offset, radius;
  double before_lines;
  double facing; ///< above 0 for a disc that looks to the eye

  Meeting(const Discs& discs, const TreeRay& ray, std::uint32_t splat)
  {
    const TreeLeaf& leaf = discs.leaves[splat / tree_width];
    const std::uint32_t i = splat % tree_width;
    Vector3d center, normal, origin, direction, eye;
    for (int axis = 0; axis < 3; ++axis) {
      center[axis] = leaf.center[axis][i];
      normal[axis] = leaf.normal[axis][i];
      origin[axis] = ray.origin[axis];
      direction[axis] = ray.direction[axis];
      eye[axis] = ray.eye[axis];
    }
    facing = normal.dot(eye - center);
    distance = normal.dot(center - origin) / normal.dot(direction);
    const Vector3d offset = origin + distance * direction - center;
    sq_offset = offset.squaredNorm();
    before_lines = discs.beforeLines(splat, offset);
    radius = std::sqrt(static_cast<double>(leaf.sq_radius[i]));
  }

  /** Negative on the border, where rounding decides. */
  double
  margin(const TreeRay& ray) const
  {
    const double met = std::min({radius - std::sqrt(sq_offset),
                                 before_lines,
                                 distance - ray.near,
                                 static_cast<double>(ray.far) - distance});
    return ray.culls ? std::min(met, facing) : met;
  }
};

std::vector<TreeRay>
randomRays(std::size_t count)
{
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  std::vector<TreeRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    Vector3d direction(place(engine), place(engine), place(engine));
    if (i % 5 == 0)
      direction[static_cast<Eigen::Index>(i / 5 % 3)] = 0.0;
    if (i % 20 == 0)
      direction = Vector3d::Unit(static_cast<Eigen::Index>(i / 20 % 3));
    direction.normalize();
    TreeRay ray{};
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = static_cast<float>(place(engine));
      ray.direction[axis] = static_cast<float>(direction[axis]);
      ray.eye[axis] = static_cast<float>(place(engine));
    }
    ray.culls = i % 7 < 3;
    ray.near = i % 3 == 0 ? 0.3f : 0.0f;
    ray.far = i % 4 == 0 ? 0.8f : std::numeric_limits<float>::infinity();
    rays.push_back(ray);
  }
  return rays;
}

constexpr double rounding = 1e-4;

class SplatTreeKernelWithRims : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Rims, SplatTreeKernelWithRims, testing::Bool());

TEST_P(SplatTreeKernelWithRims, CollectsAllThatBruteForceFinds)
{
  constexpr float part = 0.5f;
  for (const std::size_t count : {1, 15, 40, 700}) {
    const Discs discs(count, GetParam());
    ASSERT_EQ(count, discs.filled.size());
    std::size_t met = 0;
    for (const TreeRay& ray : randomRays(300)) {
      double limit = ray.far; // behind it nothing needs to be found
      bool is_clear = true;
      for (const std::uint32_t splat : discs.filled) {
        const Meeting meeting(discs, ray, splat);
        is_clear = is_clear && std::abs(meeting.margin(ray)) > rounding;
        if (meeting.margin(ray) > 0.0)
          limit = std::min(limit, meeting.distance + part * meeting.radius);
      }
      if (!is_clear)
        continue;
      uvol_test::forLevels(kernels, [&](const SplatTreeKernels* kernel) {
        std::vector<SplatHit> hits(64);
        hits.resize(
            kernel->collect(discs.arrays(), ray, part, hits.data(), hits.size()));
        ASSERT_LE(hits.size(), 64u);
        for (const std::uint32_t splat : discs.filled) {
          const Meeting meeting(discs, ray, splat);
          const auto found =
              std::find_if(hits.begin(), hits.end(), [&](const SplatHit& hit) {
                return hit.splat == splat;
              });
          if (meeting.margin(ray) < 0.0) {
            EXPECT_EQ(hits.end(), found);
          }
          else if (meeting.distance < limit - rounding) {
            ASSERT_NE(hits.end(), found);
            EXPECT_NEAR(meeting.distance, found->distance, rounding);
            EXPECT_NEAR(meeting.sq_offset, found->sq_offset, rounding);
          }
        }
        EXPECT_EQ(!hits.empty(), kernel->isBlocked(discs.arrays(), ray));
        if (hits.size() > 1) {
          std::vector<SplatHit> few(hits.size() - 1);
          EXPECT_GT(kernel->collect(discs.arrays(), ray, part, few.data(), few.size()),
                    few.size());
        }
        met += hits.size();
      });
    }
    EXPECT_GE(met, count / 20);
  }
}

/** What lies farther behind a disc than a part of its radius is not looked for. */
TEST(SplatTreeKernel, LeavesOutWhatLiesFarBehind)
{
  const Discs discs(700);
  std::size_t all = 0, near = 0;
  for (TreeRay ray : randomRays(300)) {
    ray.culls = false;
    std::vector<SplatHit> hits(700);
    const SplatTreeKernels& kernel = baseline::splat_tree_kernels;
    near += kernel.collect(discs.arrays(), ray, 0.5f, hits.data(), hits.size());
    all += kernel.collect(discs.arrays(), ray, 1e6f, hits.data(), hits.size());
  }
  EXPECT_LT(2 * near, all);
}

/** A single disc of radius 0.1, and a ray along x that starts on a surface of splats.
 */
struct DiscBesideStart {
  double alignment; ///< cosine of the normals of this surface and of the disc
  double radii;     ///< to where the ray meets the disc
  bool goes_in;
  double shift; ///< of the centre from there, along the plane of the disc, in radii
  double side;  ///< of both surfaces that is outside: 1 for the ray's, or -1

  Vector3d
  normal() const
  {
    return Vector3d(goes_in ? -1.0 : 1.0, 1.0, 0.0).normalized();
  }

  Vector3d
  ownNormal() const
  {
    return alignment * normal() +
           std::sqrt(1.0 - alignment * alignment) * Vector3d::UnitZ();
  }

  Vector3d
  center() const
  {
    return {0.1 * radii, 0.0, 0.1 * shift};
  }

  /** It is of the surface that the ray starts on. */
  bool
  isOwn() const
  {
    if (radii < 2.0 && ownNormal().dot(center()) < 0.01)
      return true;
    if (goes_in)
      return alignment > 0.7 && radii < 1.0;
    return radii < (alignment > 0.25 ? 3.0 : 1.5);
  }
};

void
expectMet(const DiscBesideStart& disc)
{
  TreeNode node{};
  TreeLeaf leaf{};
  for (int i = 0; i < tree_width; ++i) {
    leaf.sq_radius[i] = -1.0f;
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][i] = std::numeric_limits<float>::infinity();
      node.high[axis][i] = -std::numeric_limits<float>::infinity();
    }
  }
  TreeRay ray{{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, 0.0f, 10.0f};
  ray.leaves_surface = true;
  ray.own_side = static_cast<float>(disc.side);
  for (int axis = 0; axis < 3; ++axis) {
    leaf.center[axis][0] = static_cast<float>(disc.center()[axis]);
    node.low[axis][0] = leaf.center[axis][0] - 0.1f;
    node.high[axis][0] = leaf.center[axis][0] + 0.1f;
    leaf.normal[axis][0] = static_cast<float>(disc.side * disc.normal()[axis]);
    ray.own_normal[axis] = static_cast<float>(disc.ownNormal()[axis]);
  }
  node.child[0] = leaf_bit;
  leaf.sq_radius[0] = 0.01f;
  uvol_test::forLevels(kernels, [&](const SplatTreeKernels* kernel) {
    EXPECT_EQ(!disc.isOwn(), kernel->isBlocked({&node, &leaf}, ray))
        << disc.alignment << ' ' << disc.radii << ' ' << disc.goes_in << ' '
        << disc.shift << ' ' << disc.side;
    SplatHit hit{};
    EXPECT_EQ(disc.isOwn() ? 0u : 1u,
              kernel->collect({&node, &leaf}, ray, 0.5f, &hit, 1));
  });
}

/** Splats beside the start of a ray are of its own surface if their normals agree by
 * 0.25, or 0.7 where the ray goes in, and if they are not beyond 3 radii, or one; any
 * that it comes out of within 1.5; and within two those whose centres are not above the
 * plane of its start. Walls beside it shade. */
TEST(SplatTreeKernel, PassesSplatsOfItsOwnSurface)
{
  for (const double alignment : {0.0, 0.1, 0.24, 0.26, 0.5, 0.69, 0.71, 0.9, 1.0})
    for (const double radii :
         {0.5, 0.95, 1.05, 1.45, 1.55, 1.95, 2.05, 2.95, 3.05, 9.0})
      for (const double shift : {-0.9, 0.0, 0.9})
        for (const double side : {1.0, -1.0})
          for (const bool goes_in : {false, true})
            expectMet({alignment, radii, goes_in, shift, side});
}

TEST(TreeBuilder, EveryItemIsInOneLeafAndWithinTheBoxesAbove)
{
  const Discs discs(700);
  std::vector<std::uint32_t> items = discs.tree.items;
  std::sort(items.begin(), items.end());
  for (std::uint32_t i = 0; i < items.size(); ++i)
    EXPECT_EQ(i, items[i]);
  // About as many leaves as full ones would be.
  EXPECT_LT(discs.leaves.size(), 3 * 700 / tree_width);
}

} // namespace test_splat_tree_kernel
