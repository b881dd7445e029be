// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/band_surface.h"

#include "common/parallel.h"
#include "mesh/creases.h"
#include "mesh/dual_surface.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

namespace pcl_uvol::detail {

namespace {

constexpr std::size_t band_cell_block = 1u << 10, band_vertex_block = 1u << 10;

/** Share of the distance of two cells: a surface farther from the line between them is
 * that of another sheet. */
constexpr double farthest_foot = 1.0;

/** Rounds of means over neighbours that the sizes of vertices take. */
constexpr int size_rounds = 5;

/** Rounds of putting cells on the other side. */
constexpr int repair_rounds = 4;

/** Cosine of the angle between normals of fits that tell of one smooth sheet. */
constexpr double least_band_agreement = 0.7;

constexpr std::uint32_t no_cell = std::numeric_limits<std::uint32_t>::max();

/** Makes the surface of one isovalue. */
class BandSurface {
public:
  BandSurface(const IsopointInput& input, float isovalue, Report& report)
      : input_(input)
      , isovalue_(isovalue)
      , tiling_(input.samples.getTree(), input.samples.getPositions())
      , values_(tiling_, input, isovalue, report)
      , ghosts_are_above_(input.outside == Outside::Higher)
      , report_(report)
  {
  }

  WorkingMesh
  make()
  {
    WorkingMesh mesh = join();
    for (int round = 0; round < repair_rounds; ++round) {
      const std::vector<std::uint32_t> wrong = findWrongCells(mesh);
      if (wrong.empty())
        break;
      is_turned_.resize(input_.samples.size());
      for (const std::uint32_t cell : wrong)
        is_turned_[cell] = true;
      values_.turn(wrong, report_);
      mesh = join();
    }
    const StepTimer step(report_, "creases");
    splitCreases(mesh);
    smoothSizes(mesh);
    return mesh;
  }

private:
  bool
  isAbove(std::uint32_t cell) const
  {
    return tiling_.isGhost(cell) ? ghosts_are_above_ : values_.isAbove(cell);
  }

  /** The surface between the cells as they are. */
  WorkingMesh
  join()
  {
    // Pairs are found, get vertices and are joined, which takes about as long each.
    const std::size_t band = values_.getBand().size();
    StepTimer step(report_, "triangles", 3 * band);
    findPairs(step);
    const auto passPairs = [&](std::size_t begin, std::size_t end) {
      step.advance(band * end / pairs_.size() - band * begin / pairs_.size());
    };
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
        pairs_.size(), band_vertex_block, input_.threads, [&](auto begin, auto end) {
          for (std::size_t i = begin; i < end; ++i)
            mesh.vertices[i] = makeVertex(pairs_[i]);
          passPairs(begin, end);
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
        passPairs,
        input_.threads);
    return mesh;
  }

  /** The cell that pairs have in common; ghosts count as none. */
  std::uint32_t
  commonCell(const CellPair& a, const CellPair& b) const
  {
    if (a.lower == b.lower || a.lower == b.higher)
      return a.lower;
    const bool is_shared = a.higher == b.lower || a.higher == b.higher;
    return is_shared && !tiling_.isGhost(a.higher) ? a.higher : no_cell;
  }

  /** Euler's characteristic, by place in the band, of what a cell touches on the other
   * side: that of a disc, 1, where the surface passes it as it passes a plane. */
  std::vector<int>
  findCharacteristics(const WorkingMesh& mesh) const
  {
    std::vector<int> euler(values_.getBand().size());
    const auto count = [&](std::uint32_t cell, int change) {
      if (cell != no_cell && values_.isInBand(cell))
        euler[values_.placeOf(cell)] += change;
    };
    for (const WorkingVertex& vertex : mesh.vertices) {
      count(vertex.pair.lower, 1);
      count(tiling_.isGhost(vertex.pair.higher) ? no_cell : vertex.pair.higher, 1);
    }
    for (const Triangle& triangle : mesh.triangles) {
      std::uint32_t common[3];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
        common[i] = commonCell(mesh.vertices[from].pair, mesh.vertices[to].pair);
        if (from < to) // of the two triangles at an edge one counts it
          count(common[i], -1);
      }
      if (common[0] == common[1] && common[1] == common[2])
        count(common[0], 1);
    }
    return euler;
  }

  /** Cells whose side makes a small component or a handle where the field, by the fits,
   * has none: a few of the tetrahedra between the centres of cells are turned inside
   * out. Of those that touch one another only the one nearest to the surface. */
  std::vector<std::uint32_t>
  findWrongCells(const WorkingMesh& mesh) const
  {
    const std::vector<int> euler = findCharacteristics(mesh);
    const std::vector<bool> is_smooth = findSmoothCells(mesh);
    std::vector<std::pair<double, std::uint32_t>> wrong;
    for (const std::uint32_t cell : values_.getBand()) {
      const std::uint32_t place = values_.placeOf(cell);
      const bool was_turned = !is_turned_.empty() && is_turned_[cell];
      // The whole surroundings of an isolated cell are on the other side: a sphere.
      if ((euler[place] == 0 || euler[place] == 2) && is_smooth[place] && !was_turned &&
          isIsolatedOrHandle(cell))
        wrong.emplace_back(
            (values_.getCell(cell).foot - values_.getCell(cell).center).norm(), cell);
    }
    std::sort(wrong.begin(), wrong.end());
    std::vector<std::uint32_t> chosen, touching;
    for (const auto& [distance, cell] : wrong) {
      input_.candidates.find(cell, touching);
      if (std::find_first_of(
              chosen.begin(), chosen.end(), touching.begin(), touching.end()) ==
          chosen.end())
        chosen.push_back(cell);
    }
    return chosen;
  }

  /** Cells, by place in the band, at which the surface is one smooth sheet, by normals.
   */
  std::vector<bool>
  findSmoothCells(const WorkingMesh& mesh) const
  {
    std::vector<bool> is_smooth(values_.getBand().size(), true);
    for (const WorkingVertex& vertex : mesh.vertices)
      for (const std::uint32_t cell : {vertex.pair.lower, vertex.pair.higher})
        if (vertex.is_on_surface && values_.isInBand(cell)) {
          const BandCell& own = values_.getCell(cell);
          if (!own.has_foot ||
              own.normal.dot(vertex.foot.normal) < least_band_agreement)
            is_smooth[values_.placeOf(cell)] = false;
        }
    return is_smooth;
  }

  /** True for a cell that touches none of its own side, but others; and for one that
   * touches several groups of its own side, which others nearby join as well. */
  bool
  isIsolatedOrHandle(std::uint32_t cell) const
  {
    std::vector<std::uint32_t> touching, own;
    input_.candidates.find(cell, touching);
    const auto is_own = [&](std::uint32_t other) {
      return other != cell && isAbove(other) == isAbove(cell);
    };
    std::copy_if(touching.begin(), touching.end(), std::back_inserter(own), is_own);
    if (own.empty() || own.size() == touching.size())
      return own.empty();
    std::sort(own.begin(), own.end());
    if (countReached(own, own) == own.size())
      return false;
    std::vector<std::uint32_t> nearby = own, around;
    for (const std::uint32_t other : own) {
      input_.candidates.find(other, around);
      std::copy_if(around.begin(), around.end(), std::back_inserter(nearby), is_own);
    }
    std::sort(nearby.begin(), nearby.end());
    nearby.erase(std::unique(nearby.begin(), nearby.end()), nearby.end());
    return countReached(own, nearby) == own.size();
  }

  /** How many of some cells are joined with the first of them through cells of a set
   * that holds them.
   * \param cells, set ascending */
  std::size_t
  countReached(const std::vector<std::uint32_t>& cells,
               const std::vector<std::uint32_t>& set) const
  {
    std::vector<bool> is_reached(set.size());
    std::vector<std::uint32_t> open{cells.front()}, touching;
    const auto placeIn = [&](std::uint32_t cell) {
      const auto at = std::lower_bound(set.begin(), set.end(), cell);
      return at != set.end() && *at == cell ? static_cast<std::size_t>(at - set.begin())
                                            : set.size();
    };
    is_reached[placeIn(cells.front())] = true;
    while (!open.empty()) {
      input_.candidates.find(open.back(), touching);
      open.pop_back();
      for (const std::uint32_t other : touching)
        if (const std::size_t place = placeIn(other);
            place < set.size() && !is_reached[place]) {
          is_reached[place] = true;
          open.push_back(other);
        }
    }
    return static_cast<std::size_t>(
        std::count_if(cells.begin(), cells.end(), [&](std::uint32_t cell) {
          return is_reached[placeIn(cell)];
        }));
  }

  void
  findPairs(StepTimer& step)
  {
    const std::vector<std::uint32_t>& band = values_.getBand();
    pairs_ = parallelGather<CellPair>(
        band.size(),
        band_cell_block,
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
              addGhosts(cell, tiling_.findCell(cell), pairs);
          }
          step.advance(end - begin);
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
  makeVertex(const CellPair& pair) const
  {
    return tiling_.isGhost(pair.higher) ? makeCapVertex(pair) : makeSurfaceVertex(pair);
  }

  WorkingVertex
  makeCapVertex(const CellPair& pair) const
  {
    const std::uint32_t side = pair.higher - tiling_.countSamples();
    const auto axis = static_cast<int>(side / 2);
    const KdBox box = tiling_.findBox(pair.lower, tiling_.findCell(pair.lower));
    WorkingVertex vertex;
    vertex.pair = pair;
    vertex.is_on_surface = false;
    vertex.sides = static_cast<BoxSides>(1u << side);
    const Position& scale = input_.samples.getScale();
    for (int i = 0; i < 3; ++i)
      vertex.foot.place[i] =
          0.5 * (static_cast<double>(box.low[i]) + box.high[i]) / scale[i];
    const Position& face = side % 2 == 1 ? box.high : box.low;
    const double border = static_cast<double>(face[axis]) / scale[axis];
    const double depth = std::abs(border - vertex.foot.place[axis]);
    vertex.foot.place[axis] = border;
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
  Report& report_;
  std::vector<CellPair> pairs_;
  std::vector<bool> is_turned_; // by sample; empty: none is
};

} // namespace

WorkingMesh
makeBandSurface(const IsopointInput& input, float isovalue, Report& report)
{
  BandSurface surface(input, isovalue, report);
  return surface.make();
}

} // namespace pcl_uvol::detail
