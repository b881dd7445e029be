// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/piece.h"

#include "common/large_array.h"
#include "common/parallel.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr std::size_t piece_block = 1u << 14;

/** Samples that the planes around a cell rest on. */
constexpr std::size_t anchors_per_cell = 6;

/** Bricks whose trees a thread builds at once. */
constexpr std::size_t block_bricks = 16;

SampleRecords
makeRecords(const std::vector<Position>& positions, unsigned threads)
{
  SampleRecords records(positions.size());
  parallelBlocks(records.size(), piece_block, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i)
      records[i] = {positions[i], static_cast<std::uint32_t>(i)};
  });
  return records;
}

/** The cell with its planes' samples appended to the positions. */
KdCell
anchored(const CellKey& key, std::vector<Position>& positions)
{
  const auto anchor = [&](const PlaneKey& plane) -> SplitPlane {
    if (!std::isfinite(plane.coordinate))
      return {plane.coordinate, 0};
    positions.push_back(plane.below);
    return {plane.coordinate, static_cast<std::uint32_t>(positions.size() - 1)};
  };
  KdCell cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell.low[axis] = anchor(key.low[axis]);
    cell.high[axis] = anchor(key.high[axis]);
  }
  return cell;
}

std::vector<KdTree>
buildTrees(const std::vector<GhostBrick>& bricks,
           const AxisCycle& axes,
           unsigned threads)
{
  std::vector<KdTree> trees(bricks.size());
  parallelBlocks(bricks.size(), block_bricks, threads, [&](auto begin, auto end) {
    Report none;
    StepTimer step(none, "ghosts");
    for (std::size_t i = begin; i < end; ++i) {
      auto records = makeRecords(bricks[i].samples.positions, 1);
      trees[i].build(records, axes, bricks[i].brick.depth, 1, step);
    }
  });
  return trees;
}

/** Give trees whose samples stand one after the other their cells, and the positions
 * what these rest on. */
void
placeTrees(SampleSet::Parts& parts, const std::vector<CellKey>& cells)
{
  parts.size = parts.positions.size();
  std::uint32_t begin = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    parts.trees[i].place(begin, anchored(cells[i], parts.positions));
    begin += parts.trees[i].getRoot().count;
  }
}

/** Cells that a function accepts. */
struct Accepted {
  const std::function<bool(const CellKey&)>* accepts;
  bool is_accepted;

  Accepted
  within(const CellKey& cell) const
  {
    return {accepts, (*accepts)(cell)};
  }
  bool
  isEmpty() const
  {
    return !is_accepted;
  }
};

/** Cells that meet balls: below a node only those that meet it are asked, so that many
 * balls cost no more than their own paths. */
struct MeetingBalls {
  std::vector<Ball> balls;

  MeetingBalls
  within(const CellKey& cell) const
  {
    return {cell.selectMeeting(balls)};
  }
  bool
  isEmpty() const
  {
    return balls.empty();
  }
};

} // namespace

template <typename Criterion>
void
BrickTable::visit(const KdNode& node,
                  CellKey& cell,
                  const Criterion& criterion,
                  const std::function<void(const Brick&)>& found) const
{
  const Criterion left = criterion.within(cell);
  if (left.isEmpty())
    return;
  if (node.count <= most_samples) {
    found({begin_ + node.begin, node.count, node.depth, cell, ranges_[node.number]});
    return;
  }
  const std::size_t axis = axisAt(axes_, node.depth);
  const PlaneKey &plane = planes_[node.number], low = cell.low[axis],
                 high = cell.high[axis];
  cell.high[axis] = plane;
  visit(node.left(), cell, left, found);
  cell.high[axis] = high;
  cell.low[axis] = plane;
  visit(node.right(), cell, left, found);
  cell.low[axis] = low;
}

BrickTable::BrickTable(const KdTree& tree,
                       const std::vector<Position>& positions,
                       const std::vector<float>& values,
                       std::uint64_t begin,
                       const CellKey& cell)
    : root_(tree.getRoot())
    , begin_(begin)
    , cell_(cell)
{
  for (std::size_t depth = 0; depth < axes_.size(); ++depth)
    axes_[depth] = static_cast<std::int8_t>(tree.getAxis(static_cast<int>(depth)));
  const std::function<void(const KdNode&)> take = [&](const KdNode& node) {
    if (node.count <= most_samples) {
      if (ranges_.size() <= node.number)
        ranges_.resize(node.number + 1);
      const auto [min, max] = std::minmax_element(
          values.begin() + node.begin, values.begin() + node.begin + node.count);
      ranges_[node.number] = {*min, *max};
      return;
    }
    if (planes_.size() <= node.number)
      planes_.resize(node.number + 1);
    const SplitPlane& plane = tree.getPlane(node);
    planes_[node.number] = {plane.coordinate, positions[plane.below_sample]};
    take(node.left());
    take(node.right());
  };
  take(root_);
}

void
BrickTable::find(const std::function<bool(const CellKey&)>& accepts,
                 const std::function<void(const Brick&)>& found) const
{
  CellKey cell = cell_;
  visit(root_, cell, Accepted{&accepts, true}, found);
}

void
BrickTable::find(const std::vector<Ball>& balls,
                 const std::function<void(const Brick&)>& found) const
{
  CellKey cell = cell_;
  visit(root_, cell, MeetingBalls{balls}, found);
}

Piece::Piece(const Decomposition& decomposition,
             std::size_t piece,
             Samples&& samples,
             KdTree&& tree,
             const Position& scale)
    : values_(std::move(samples.values))
    , sources_(std::move(samples.sources))
    , runs_{{decomposition.getBegin(piece),
             static_cast<std::uint32_t>(samples.positions.size()),
             decomposition.getCell(piece)}}
    , axes_(decomposition.getAxes())
{
  SampleSet::Parts parts;
  parts.unit.scale = scale;
  parts.positions = std::move(samples.positions);
  parts.trees.push_back(std::move(tree));
  placeTrees(parts, {runs_[0].cell});
  samples_ = std::make_unique<SampleSet>(std::move(parts));
}

std::optional<Piece>
Piece::build(const Decomposition& decomposition,
             std::size_t piece,
             Samples&& samples,
             const Position& scale,
             unsigned threads,
             Report& report)
{
  if (samples.size() > most_samples)
    throw InvalidArgument("piece_too_large",
                          {{"samples", samples.size()}, {"most", most_samples}});
  if (samples.size() == 0)
    return std::nullopt; // elsewhere equal ones lie together
  StepTimer step(report, "tree", samples.size());
  SampleRecords records = makeRecords(samples.positions, threads);
  samples.positions = {};
  KdTree tree;
  const bool distinct = tree.build(
      records, decomposition.getAxes(), decomposition.getLevels(), threads, step);
  reserveLarge(samples.positions, records.size() + anchors_per_cell);
  samples.positions.resize(records.size());
  if (!distinct) {
    for (const SampleRecord& record : records)
      samples.positions[record.input_index] = record.position;
    return std::nullopt;
  }
  Samples ordered;
  resizeLarge(ordered.values, records.size());
  resizeLarge(ordered.sources, records.size());
  parallelBlocks(records.size(), piece_block, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      samples.positions[i] = records[i].position;
      ordered.values[i] = samples.values[records[i].input_index];
      ordered.sources[i] = samples.sources[records[i].input_index];
    }
  });
  ordered.positions = std::move(samples.positions);
  return Piece(decomposition, piece, std::move(ordered), std::move(tree), scale);
}

BrickTable
Piece::makeBricks() const
{
  return {samples_->getTree(),
          samples_->getPositions(),
          values_,
          runs_[own_].begin,
          runs_[own_].cell};
}

std::uint32_t
Piece::getFirst(const Run& run) const
{
  const auto index = static_cast<std::size_t>(&run - runs_.data());
  return samples_->getTrees()[index].getRoot().begin;
}

std::uint64_t
Piece::toGlobal(std::uint32_t sample) const
{
  const auto run =
      std::upper_bound(runs_.begin(), runs_.end(), sample, [&](auto s, const Run& r) {
        return s < getFirst(r);
      });
  return run[-1].begin + (sample - getFirst(run[-1]));
}

std::vector<Piece::Run>::const_iterator
Piece::findRun(std::uint64_t sample) const
{
  const auto next =
      std::upper_bound(runs_.begin(), runs_.end(), sample, [](auto s, const Run& run) {
        return s < run.begin;
      });
  return next == runs_.begin() ? runs_.end() : next - 1;
}

std::uint32_t
Piece::toLocal(std::uint64_t sample) const
{
  const auto run = findRun(sample);
  if (run == runs_.end() || sample - run->begin >= run->count)
    throw InvalidArgument("sample_not_in_piece", {{"sample", sample}});
  return getFirst(*run) + static_cast<std::uint32_t>(sample - run->begin);
}

GhostBrick
Piece::makeGhost(const Brick& brick) const
{
  GhostBrick ghost{brick, {}};
  ghost.samples.append(getSpan(toLocal(brick.begin), brick.count));
  return ghost;
}

SampleSpan
Piece::getSpan(std::uint32_t first, std::uint32_t count) const
{
  return {samples_->getPositions().data() + first,
          values_.data() + first,
          sources_.data() + first,
          count};
}

bool
Piece::holds(const Brick& brick) const
{
  const auto run = findRun(brick.begin);
  return run != runs_.end() && brick.begin - run->begin < run->count;
}

std::size_t
Piece::addGhosts(std::vector<GhostBrick>&& bricks, unsigned threads)
{
  const auto begin_of = [](const GhostBrick& ghost) { return ghost.brick.begin; };
  std::sort(bricks.begin(), bricks.end(), [&](const auto& a, const auto& b) {
    return begin_of(a) < begin_of(b);
  });
  bricks.erase(std::unique(bricks.begin(),
                           bricks.end(),
                           [&](const auto& a, const auto& b) {
                             return begin_of(a) == begin_of(b);
                           }),
               bricks.end());
  bricks.erase(std::remove_if(bricks.begin(),
                              bricks.end(),
                              [&](const auto& ghost) { return holds(ghost.brick); }),
               bricks.end());
  if (!bricks.empty())
    join(bricks, buildTrees(bricks, axes_, threads));
  return bricks.size();
}

void
Piece::join(const std::vector<GhostBrick>& bricks, std::vector<KdTree>&& trees)
{
  std::size_t total = samples_->size();
  for (const GhostBrick& ghost : bricks)
    total += ghost.samples.size();
  if (total >
      std::size_t(2) * most_samples - anchors_per_cell * (runs_.size() + bricks.size()))
    throw InvalidArgument("piece_too_large_with_ghosts", {{"samples", total}});
  SampleSet::Parts old = std::move(*samples_).take();
  Samples before;
  before.positions = std::move(old.positions);
  before.values = std::move(values_);
  before.sources = std::move(sources_);

  /** Samples of a run, and where they are. */
  struct Block {
    Run run;
    KdTree* tree;
    const Samples* samples;
    std::size_t first;
  };
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < runs_.size(); ++i)
    blocks.push_back({runs_[i], &old.trees[i], &before, old.trees[i].getRoot().begin});
  const std::uint64_t own_begin = runs_[own_].begin;
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    const Brick& brick = bricks[i].brick;
    blocks.push_back(
        {{brick.begin, brick.count, brick.cell}, &trees[i], &bricks[i].samples, 0});
  }
  std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) {
    return a.run.begin < b.run.begin;
  });

  SampleSet::Parts parts;
  parts.unit = old.unit;
  Samples joined;
  reserveLarge(joined.positions, total + anchors_per_cell * blocks.size());
  joined.reserve(total);
  runs_.clear();
  std::vector<CellKey> cells;
  for (const Block& block : blocks) {
    if (block.run.begin == own_begin)
      own_ = parts.own = runs_.size();
    joined.append(block.samples->span(block.first, block.run.count));
    parts.trees.push_back(std::move(*block.tree));
    runs_.push_back(block.run);
    cells.push_back(block.run.cell);
  }
  parts.positions = std::move(joined.positions);
  values_ = std::move(joined.values);
  sources_ = std::move(joined.sources);
  placeTrees(parts, cells);
  samples_ = std::make_unique<SampleSet>(std::move(parts));
}

} // namespace pcl_uvol
