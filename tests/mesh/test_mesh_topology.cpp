// SPDX-License-Identifier: BSD-3-Clause
// The topology of meshes of random trilinear fields, which have all cases that cells of
// a grid can have (Etiene et al., Topology Verification for Isosurface Extraction,
// 2012): components and handles against those of many small cubes.
#include "mesh_fields.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <queue>
#include <random>

namespace test_mesh_topology {

using namespace pcl_uvol;
using namespace uvol_test;

/** Random values at the nodes of a lattice, and between them. */
class TrilinearField {
public:
  static constexpr int cells = 2;

  explicit TrilinearField(unsigned seed)
  {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (double& value : nodes_)
      value = any(random);
  }

  /** \param x from 0 to 1 */
  double
  operator()(const Eigen::Vector3d& x) const
  {
    std::array<int, 3> node{};
    std::array<double, 3> part{};
    for (int axis = 0; axis < 3; ++axis) {
      const double place = x[axis] * cells;
      const auto a = static_cast<std::size_t>(axis);
      node[a] = std::min(static_cast<int>(place), cells - 1);
      part[a] = place - node[a];
    }
    double value = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      std::size_t index = 0;
      for (int axis = 2; axis >= 0; --axis) {
        const int side = corner >> axis & 1;
        const auto a = static_cast<std::size_t>(axis);
        weight *= side == 1 ? part[a] : 1.0 - part[a];
        index = index * (cells + 1) + static_cast<std::size_t>(node[a] + side);
      }
      value += weight * nodes_[index];
    }
    return value;
  }

private:
  std::array<double, (cells + 1) * (cells + 1) * (cells + 1)> nodes_{};
};

/** Pieces and handles of a surface. */
struct Topology {
  std::int64_t pieces, handles;

  bool
  operator==(const Topology& other) const
  {
    return pieces == other.pieces && handles == other.handles;
  }
};

/** Small cubes where a field is at least a value, in a frame of others. */
class Cubes {
public:
  Cubes(const TrilinearField& field, double isovalue)
      : marks_(side * side * side, 0)
  {
    for (std::size_t z = 1; z + 1 < side; ++z)
      for (std::size_t y = 1; y + 1 < side; ++y)
        for (std::size_t x = 1; x + 1 < side; ++x) {
          constexpr double width = 1.0 / (side - 2);
          const Eigen::Vector3d place((static_cast<double>(x) - 0.5) * width,
                                      (static_cast<double>(y) - 0.5) * width,
                                      (static_cast<double>(z) - 0.5) * width);
          marks_[indexOf(x, y, z)] = field(place) >= isovalue;
        }
  }

  /** The topology of the surface around the marked cubes, which is a manifold where
   * these are small enough: its Euler characteristic is twice that of the cubes, and
   * beside each of their components it has one more piece for each hollow. */
  Topology
  findTopology() const
  {
    const std::int64_t pieces = countParts(1) + countParts(0) - 1;
    return {pieces, pieces - findEuler()};
  }

private:
  static constexpr std::size_t side = 82;

  static std::size_t
  indexOf(std::size_t x, std::size_t y, std::size_t z)
  {
    return (z * side + y) * side + x;
  }

  /** Components of cubes with that mark that share faces. */
  std::int64_t
  countParts(char mark) const
  {
    std::vector<bool> is_met(marks_.size());
    std::int64_t parts = 0;
    for (std::size_t start = 0; start < marks_.size(); ++start) {
      if (marks_[start] != mark || is_met[start])
        continue;
      ++parts;
      std::queue<std::size_t> next;
      const auto meet = [&](std::size_t cube) {
        if (marks_[cube] != mark || is_met[cube])
          return;
        is_met[cube] = true;
        next.push(cube);
      };
      for (meet(start); !next.empty(); next.pop()) {
        const std::size_t cube = next.front();
        std::size_t stride = 1;
        for (int axis = 0; axis < 3; ++axis, stride *= side) {
          const std::size_t place = cube / stride % side;
          if (place > 0)
            meet(cube - stride);
          if (place + 1 < side)
            meet(cube + stride);
        }
      }
    }
    return parts;
  }

  /** Corners less edges plus faces less cubes. */
  std::int64_t
  findEuler() const
  {
    std::int64_t euler = 0;
    for (std::size_t z = 1; z < side; ++z)
      for (std::size_t y = 1; y < side; ++y)
        for (std::size_t x = 1; x < side; ++x) {
          // Parts that begin at the corner below this cube, along some of the axes.
          for (std::size_t along = 0; along < 8; ++along) {
            bool is_there = false;
            for (std::size_t beside = 0; beside < 8; ++beside)
              if ((beside & along) == 0)
                is_there |= marks_[indexOf(x - (beside & 1),
                                           y - (beside >> 1 & 1),
                                           z - (beside >> 2 & 1))] != 0;
            const bool is_odd =
                ((along & 1) + (along >> 1 & 1) + (along >> 2)) % 2 == 1;
            euler += is_there ? (is_odd ? -1 : 1) : 0;
          }
        }
    return euler;
  }

  std::vector<char> marks_;
};

/** Fields that were compared, and those whose mesh has the right topology. */
struct Agreement {
  int compared = 0, agreed = 0;
};

/** Compare meshes of fields whose topology is the same at isovalues a little lower and
 * higher: what joins or parts in between is smaller than the samples show. */
Agreement
compareFields(unsigned first, unsigned last)
{
  // 20 samples along the side of a cell, between which values differ by a twentieth.
  constexpr double samples_per_side = 40.0, margin = 0.05;
  Agreement result;
  for (unsigned seed = first; seed < last; ++seed) {
    const TrilinearField field(seed);
    const Topology truth = Cubes(field, 0.0).findTopology();
    if (!(truth == Cubes(field, -margin).findTopology()) ||
        !(truth == Cubes(field, margin).findTopology()))
      continue;
    const MeshField scaled{
        "trilinear",
        [&](const Eigen::Vector3d& x) { return field(x / samples_per_side); },
        samples_per_side,
        0,
        0};
    const MeshRun run = runMesh(sampleField(scaled, seed));
    EXPECT_EQ(0u, expectManifold(run.mesh.triangles, run.mesh.vertices.size()));
    const Topology found{static_cast<std::int64_t>(run.mesh.pieces.size()),
                         static_cast<std::int64_t>(run.report.getCount("handles"))};
    ++result.compared;
    result.agreed += found == truth;
  }
  return result;
}

TEST(MeshTopology, IsThatOfTrilinearFields)
{
  const Agreement result = compareFields(1, 11);
  EXPECT_GE(result.compared, 2);
  EXPECT_EQ(result.compared, result.agreed);
}

TEST(MeshTopology, IsThatOfManyTrilinearFields_long)
{
  const Agreement result = compareFields(11, 200);
  EXPECT_GE(result.compared, 40);
  // Where a field passes an edge of the samples' box by less than their spacing, a
  // crumb may come or go.
  EXPECT_GE(result.agreed, 0.9 * result.compared);
  RecordProperty("compared", result.compared);
  RecordProperty("agreed", result.agreed);
  std::cout << result.agreed << " of " << result.compared << " agree\n";
}

} // namespace test_mesh_topology
