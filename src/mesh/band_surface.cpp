// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/band_surface.h"

#include "common/parallel.h"
#include "mesh/dual_surface.h"

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t block_cells = 1u << 10, block_vertices = 1u << 10;

/** Of the distance of two cells: a surface farther from the line between them is that
 * of another sheet. */
constexpr double farthest_foot = 1.0;

/** Rounds of means over neighbours that the sizes of vertices take. */
constexpr int size_rounds = 5;

/** Makes the surface of one isovalue. */
class BandSurface {
public:
  BandSurface(const IsopointInput& input, float isovalue, Report& report)
      : input_(input)
      , isovalue_(isovalue)
      , tiling_(input.samples.getTree(), input.samples.getPositions())
      , values_(tiling_, input, isovalue, report)
      , ghosts_are_above_(input.outside == Outside::Higher)
  {
  }

  WorkingMesh
  make()
  {
    findPairs();
    WorkingMesh mesh;
    const KdTree& tree = input_.samples.getTree();
    const KdBox& box = tree.getBox(tree.getRoot());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double scale = input_.samples.getScale()[static_cast<int>(axis)];
      mesh.sides[2 * axis] = box.low[static_cast<int>(axis)] / scale;
      mesh.sides[2 * axis + 1] = box.high[static_cast<int>(axis)] / scale;
    }
    mesh.vertices.resize(pairs_.size());
    parallelBlocks(
        pairs_.size(), block_vertices, input_.threads, [&](auto begin, auto end) {
          for (std::size_t i = begin; i < end; ++i)
            mesh.vertices[i] = makeVertex(pairs_[i], mesh);
        });
    const auto placeOf = [&](const CellPair& pair) -> const Eigen::Vector3d& {
      const auto at = std::lower_bound(pairs_.begin(), pairs_.end(), pair);
      return mesh.vertices[static_cast<std::size_t>(at - pairs_.begin())].foot.place;
    };
    mesh.triangles = marchTetrahedra(
        tiling_,
        pairs_,
        [&](std::uint32_t cell) { return isAbove(cell); },
        [&](const CellPair& a, const CellPair& b) {
          return (placeOf(a) - placeOf(b)).squaredNorm();
        },
        input_.threads);
    smoothSizes(mesh);
    return mesh;
  }

private:
  bool
  isAbove(std::uint32_t cell) const
  {
    return tiling_.isGhost(cell) ? ghosts_are_above_ : values_.isAbove(cell);
  }

  void
  findPairs()
  {
    const std::vector<std::uint32_t>& band = values_.getBand();
    pairs_ = parallelGather<CellPair>(
        band.size(),
        block_cells,
        input_.threads,
        [&](std::size_t begin, std::size_t end, std::vector<CellPair>& pairs) {
          std::vector<std::uint32_t> touching;
          for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t cell = band[i];
            input_.candidates.find(cell, touching);
            for (const std::uint32_t other : touching)
              if (cell < other && isAbove(cell) != isAbove(other))
                pairs.push_back({cell, other});
            // Cells whose sample is on the ghosts' side are found here only.
            if ((input_.values[cell] >= isovalue_) == ghosts_are_above_)
              addGhosts(cell, tiling_.cellOf(cell), pairs);
          }
        });
    const KdTree& tree = input_.samples.getTree();
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_high : {false, true})
        findAtSide(tree.getRoot(), axis, is_high);
    parallelSort(pairs_.begin(), pairs_.end(), input_.threads, std::less<CellPair>());
  }

  /** Pairs of a cell with the ghosts that it touches. */
  void
  addGhosts(std::uint32_t cell, const TileCell& planes, std::vector<CellPair>& pairs)
  {
    if (isAbove(cell) == ghosts_are_above_)
      return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (planes.low[axis].node.number == 0)
        pairs.push_back({cell, tiling_.getGhost(static_cast<int>(axis), false)});
      if (planes.high[axis].node.number == 0)
        pairs.push_back({cell, tiling_.getGhost(static_cast<int>(axis), true)});
    }
  }

  /** Pairs with one ghost of the samples below a node that are not on its side. */
  void
  findAtSide(const KdNode& node, int axis, bool is_high)
  {
    const KdTree& tree = input_.samples.getTree();
    const NodeRanges::Range range = input_.ranges[node];
    if (ghosts_are_above_ ? range.min >= isovalue_ : range.max < isovalue_)
      return;
    if (node.isLeaf()) {
      if (isAbove(node.begin) != ghosts_are_above_)
        pairs_.push_back({node.begin, tiling_.getGhost(axis, is_high)});
      return;
    }
    const bool is_parallel = tree.getAxis(node) == axis;
    if (!is_parallel || !is_high)
      findAtSide(node.left(), axis, is_high);
    if (!is_parallel || is_high)
      findAtSide(node.right(), axis, is_high);
  }

  WorkingVertex
  makeVertex(const CellPair& pair, const WorkingMesh& mesh) const
  {
    return tiling_.isGhost(pair.higher) ? makeCapVertex(pair, mesh)
                                        : makeSurfaceVertex(pair);
  }

  WorkingVertex
  makeCapVertex(const CellPair& pair, const WorkingMesh& mesh) const
  {
    const std::uint32_t side = pair.higher - tiling_.countSamples();
    const auto axis = static_cast<int>(side / 2);
    const KdBox box = tiling_.boxOf(tiling_.cellOf(pair.lower));
    WorkingVertex vertex;
    vertex.pair = pair;
    vertex.cap = static_cast<std::int8_t>(side);
    const Position& scale = input_.samples.getScale();
    for (int i = 0; i < 3; ++i)
      vertex.foot.place[i] =
          0.5 * (static_cast<double>(box.low[i]) + box.high[i]) / scale[i];
    const double depth = std::abs(mesh.sides[side] - vertex.foot.place[axis]);
    vertex.foot.place[axis] = mesh.sides[side];
    // From where values are on the inner side to where they are not.
    vertex.foot.normal = Eigen::Vector3d::Unit(axis) *
                         ((side % 2 == 1) != ghosts_are_above_ ? 1.0 : -1.0);
    vertex.foot.mean_curvature = 0.0;
    vertex.size = 2.0 * depth;
    return vertex;
  }

  WorkingVertex
  makeSurfaceVertex(const CellPair& pair) const
  {
    const BandCell &a = values_.getCell(pair.lower), &b = values_.getCell(pair.higher);
    const Eigen::Vector3d way = b.center - a.center;
    const double t = a.value / (a.value - b.value);
    WorkingVertex vertex;
    vertex.pair = pair;
    vertex.size = way.norm();
    vertex.foot.place = a.center + t * way;
    vertex.foot.normal = (a.value >= 0.0 ? way : -way).stableNormalized();
    vertex.foot.mean_curvature = 0.0;
    std::vector<Foot> feet;
    for (const BandCell* const cell : {&a, &b})
      if (cell->has_foot)
        feet.push_back({cell->foot, cell->normal, cell->mean_curvature});
    if (feet.empty() || !(vertex.size > 0.0))
      return vertex;
    const Foot found = blendFeet(feet, vertex.foot.place, vertex.size);
    if ((found.place - vertex.foot.place).norm() <= farthest_foot * vertex.size &&
        found.normal.allFinite())
      vertex.foot = found;
    return vertex;
  }

  static void
  smoothSizes(WorkingMesh& mesh)
  {
    std::vector<double> sums(mesh.vertices.size()), counts(mesh.vertices.size());
    for (int round = 0; round < size_rounds; ++round) {
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] = mesh.vertices[i].size;
        counts[i] = 1.0;
      }
      for (const Triangle& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
          sums[triangle[i]] += mesh.vertices[triangle[(i + 1) % 3]].size;
          counts[triangle[i]] += 1.0;
        }
      for (std::size_t i = 0; i < sums.size(); ++i)
        mesh.vertices[i].size = sums[i] / counts[i];
    }
  }

  const IsopointInput& input_;
  float isovalue_;
  CellTiling tiling_;
  CellValues values_;
  bool ghosts_are_above_;
  std::vector<CellPair> pairs_;
};

} // namespace

WorkingMesh
makeBandSurface(const IsopointInput& input, float isovalue, Report& report)
{
  BandSurface surface(input, isovalue, report);
  const StepTimer step(report, "triangles");
  return surface.make();
}

} // namespace pcl_uvol::detail
