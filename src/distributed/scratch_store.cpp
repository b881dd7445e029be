// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/scratch_store.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

/** Selects those bricks of a block that a stage can find something in together with the
 * bricks that touch them. */
std::vector<Brick>
selectFruitful(const std::vector<Brick>& own,
               const std::vector<Brick>& around,
               const PieceStage& stage)
{
  const auto join_ranges = [&](const auto& accepts) {
    NodeRanges::Range range = no_range;
    for (const auto* bricks : {&own, &around})
      for (const Brick& brick : *bricks)
        if (accepts(brick))
          range = range.joined(brick.range);
    return range;
  };
  std::vector<Brick> fruitful;
  if (stage.canFindIn(join_ranges([](const Brick&) { return true; })))
    std::copy_if(own.begin(), own.end(), std::back_inserter(fruitful), [&](auto& one) {
      return stage.canFindIn(join_ranges(
          [&](const Brick& other) { return other.cell.touches(one.cell); }));
    });
  return fruitful;
}

/** Selects the bricks that touch one of some others. */
std::vector<Brick>
selectTouching(const std::vector<Brick>& bricks, const std::vector<Brick>& others)
{
  std::vector<Brick> touching;
  std::copy_if(
      bricks.begin(), bricks.end(), std::back_inserter(touching), [&](auto& one) {
        return std::any_of(others.begin(), others.end(), [&](const Brick& other) {
          return other.cell.touches(one.cell);
        });
      });
  return touching;
}

} // namespace

ScratchSamples::ScratchSamples(const OutOfCoreSettings& settings, const Position& scale)
    : settings_(settings)
    , scale_(scale)
    , log_(std::make_unique<SampleLog>(settings.scratch_folder, settings.threads))
{
}

ScratchSamples::ScratchSamples(ScratchSamples&&) noexcept = default;
ScratchSamples&
ScratchSamples::operator=(ScratchSamples&&) noexcept = default;
ScratchSamples::~ScratchSamples() = default;

void
ScratchSamples::append(const Samples& samples)
{
  magnitudes_.add(countMagnitudes(
      samples.size(),
      [&](std::size_t i) { return samples.positions[i]; },
      scale_,
      settings_.threads));
  log_->append(samples);
}

LengthUnit
ScratchSamples::normalize(Report& report)
{
  const LengthUnit unit = magnitudes_.findUnit(scale_);
  if (!magnitudes_.reachesBeyond(unit)) {
    log_->setUnit(unit);
    return unit;
  }
  auto kept = std::make_unique<SampleLog>(settings_.scratch_folder, settings_.threads);
  FarPoints far_points;
  log_->take([&](Samples& samples) {
    far_points.add(samples.normalize(unit));
    kept->append(samples);
  });
  log_ = std::move(kept);
  if (far_points.count > 0)
    report.count("far_points", far_points.count);
  far_points.warn(report);
  return unit;
}

std::uint64_t
ScratchSamples::size() const
{
  return log_->size();
}

std::unique_ptr<SampleLog>
ScratchSamples::takeLog() &&
{
  return std::move(log_);
}

ScratchStore::ScratchStore(std::unique_ptr<SampleLog> log,
                           const PieceStage& stage,
                           const OutOfCoreSettings& settings,
                           Report& report)
    : settings_(settings)
    , report_(report)
    , memory_(settings.max_memory, stage.countLists(), stage.getRecordSize())
    , log_(std::move(log))
    , records_(settings.scratch_folder)
    , runs_(stage.countLists())
{
}

void
ScratchStore::redistribute()
{
  file_.reset(); // all of it is in the log
  const StepTimer timer(report_, "decomposition");
  decomposition_.emplace(log_->getPositions(),
                         memory_.chooseLevels(log_->size()),
                         alone_,
                         settings_.threads);
  // All samples at one place are in one piece, however many: levels cannot know.
  for (const std::size_t piece : getOwnPieces())
    memory_.checkPiece(decomposition_->getCount(piece),
                       decomposition_->getSampleCount());
  file_ = std::make_unique<PieceFile>(
      std::move(*log_), *decomposition_, settings_.scratch_folder, settings_.threads);
  log_.reset();
  bricks_.clear();
}

std::vector<std::size_t>
ScratchStore::getOwnPieces() const
{
  std::vector<std::size_t> all(decomposition_->size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  return all;
}

Samples
ScratchStore::load(std::uint64_t begin, std::uint64_t count) const
{
  const StepTimer timer(report_, "scratch");
  return file_->load(begin, count);
}

Samples
ScratchStore::takeSamples(std::size_t piece)
{
  return load(decomposition_->getBegin(piece), decomposition_->getCount(piece));
}

void
ScratchStore::putBack(std::size_t, Samples&&)
{
  // They are still there.
}

void
ScratchStore::put(std::size_t piece, Piece&& built)
{
  bricks_.push_back(built.makeBricks());
  const StepTimer timer(report_, "scratch");
  file_->save(decomposition_->getBegin(piece), built.getOwnSamples());
}

void
ScratchStore::append(std::size_t piece, Samples&& samples)
{
  if (!log_)
    log_ = std::make_unique<SampleLog>(settings_.scratch_folder, settings_.threads);
  file_->release(decomposition_->getBegin(piece), decomposition_->getCount(piece));
  log_->append(samples);
}

void
ScratchStore::makeBlocks(Report& report)
{
  report.count("scratch_bytes", file_->bytes());
  int levels = decomposition_->getLevels();
  while (decomposition_->getSampleCount() >> levels > samples_per_block)
    ++levels;
  blocks_.emplace(*decomposition_, levels, [&](std::size_t piece, std::size_t node) {
    return bricks_[piece].getPlane(node);
  });
}

ScratchStore::Bricks
ScratchStore::findTouching(std::size_t block) const
{
  const CellKey cell = blocks_->getCell(block);
  const std::uint64_t begin = blocks_->getBegin(block),
                      end = blocks_->getBegin(block + 1);
  Bricks bricks;
  for (const BrickTable& table : bricks_)
    table.find([&](const CellKey& around) { return around.touches(cell); },
               [&](const Brick& brick) {
                 const bool is_own = begin <= brick.begin && brick.begin < end;
                 (is_own ? bricks.own : bricks.around).push_back(brick);
               });
  return bricks;
}

std::vector<GhostBrick>
ScratchStore::loadGhosts(const std::vector<Brick>& bricks, std::uint64_t samples) const
{
  std::vector<GhostBrick> ghosts;
  for (const Brick& brick : bricks) {
    samples += brick.count;
    memory_.checkBlock(samples, decomposition_->getSampleCount());
    ghosts.push_back({brick, file_->load(brick.begin, brick.count)});
  }
  return ghosts;
}

std::map<std::size_t, Piece>&
ScratchStore::openBatch(std::size_t batch, const PieceStage& stage)
{
  const std::size_t block = batch;
  open_.clear();
  std::vector<GhostBrick> ghosts;
  {
    const StepTimer timer(report_, "exchange");
    const Bricks bricks = findTouching(block);
    const auto fruitful = selectFruitful(bricks.own, bricks.around, stage);
    if (fruitful.empty())
      return open_;
    ghosts =
        loadGhosts(selectTouching(bricks.around, fruitful), blocks_->getCount(block));
  }
  Piece piece = *Piece::build(*blocks_,
                              block,
                              load(blocks_->getBegin(block), blocks_->getCount(block)),
                              stage.getScale(),
                              settings_.threads,
                              report_);
  const StepTimer timer(report_, "exchange");
  piece.addGhosts(std::move(ghosts), settings_.threads);
  open_.emplace(block, std::move(piece));
  return open_;
}

void
ScratchStore::fetchGhosts(const std::map<std::size_t, std::vector<Ball>>& balls)
{
  const StepTimer timer(report_, "exchange");
  for (const auto& [block, own_balls] : balls) {
    Piece& piece = open_.at(block);
    std::vector<Brick> bricks;
    decomposition_->findPieces(
        own_balls, [&](std::size_t other, const std::vector<Ball>& meeting) {
          bricks_[other].find(meeting, [&](const Brick& brick) {
            if (!piece.holds(brick))
              bricks.push_back(brick);
          });
        });
    piece.addGhosts(loadGhosts(bricks, piece.getSamples().size()), settings_.threads);
  }
}

void
ScratchStore::keepRecords(const PieceStage& stage,
                          std::size_t list,
                          const void* records,
                          std::size_t count)
{
  if (count == 0)
    return;
  const std::size_t size = count * stage.getRecordSize();
  runs_[list].push_back({records_.size(), size});
  records_.append(records, size);
  memory_.checkRecords(records_.size(), decomposition_->getSampleCount());
}

void
ScratchStore::returnToOwner(PieceStage& stage)
{
  open_.clear();
  for (std::size_t list = 0; list < runs_.size(); ++list) {
    std::size_t bytes = 0;
    for (const Run& run : runs_[list])
      bytes += run.size;
    stage.receive(
        list,
        bytes / stage.getRecordSize(),
        [&](void* records) {
          auto* next = static_cast<std::uint8_t*>(records);
          for (const Run& run : runs_[list]) {
            records_.read(run.begin, next, run.size);
            next += run.size;
          }
        },
        settings_.threads,
        report_);
  }
}

} // namespace pcl_uvol
