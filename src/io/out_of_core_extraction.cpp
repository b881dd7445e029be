// SPDX-License-Identifier: BSD-3-Clause
#include "sample_store.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/memory.h>
#include <pcl_uvol/io/out_of_core_extraction.h>
#include <pcl_uvol/isosurface/rank_extraction.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace pcl_uvol {

namespace {

/** Bytes of points that are read at once. */
constexpr std::size_t block_bytes = 16u << 20;

/** Bytes that a process takes besides samples: libraries and buffers. */
constexpr double fixed_bytes = 120e6;

/** Of all samples, whether they are in memory or not: tables of bricks. */
constexpr double table_bytes = 0.5;

/** Per sample of a piece while what it borrowed is joined to it: samples before and
 * after (24 each), planes (up to 16) and positions that planes rest on. */
constexpr double piece_bytes = 72.0;

/** Per sample that it borrows: as it was lent, joined, and its planes. */
constexpr double halo_bytes = 64.0;

/** Sides of bricks, in spacings: a layer of them surrounds a piece. */
constexpr double brick_side = 5.8;

/** Isopoints of an isovalue as multiples of samples^(2/3): a surface that crosses the
 * cloud five times. */
constexpr double expected_isopoints = 10.0;

/** While they are merged, and as points with the samples that they rest on. */
constexpr double isopoint_bytes = 2.0 * sizeof(GlobalIsopoint);

/** Fewer samples in a piece would make three times as much halo as piece. */
constexpr std::uint64_t least_piece = 1u << 14;
constexpr int most_levels = 12;

/** Bytes of a piece with its halo. */
double
pieceBytes(double samples)
{
  const double side = std::cbrt(samples);
  return piece_bytes * samples +
         halo_bytes * samples * (std::pow(1.0 + 2.0 * brick_side / side, 3.0) - 1.0);
}

/** Bytes besides pieces. */
double
besides(double samples, std::size_t isovalues)
{
  return fixed_bytes + table_bytes * samples +
         isopoint_bytes * expected_isopoints * static_cast<double>(isovalues) *
             std::pow(samples, 2.0 / 3.0);
}

/** Of pieces as small as they may be. */
int
mostLevelsFor(std::uint64_t samples)
{
  int levels = 0;
  while (levels < most_levels && samples >> (levels + 1) >= least_piece)
    ++levels;
  return levels;
}

int
levelsFor(std::uint64_t samples, std::size_t isovalues, std::uint64_t max_memory)
{
  const auto count = static_cast<double>(samples);
  const double room = static_cast<double>(max_memory) - besides(count, isovalues);
  for (int levels = 0; levels <= mostLevelsFor(samples); ++levels) {
    const double piece = std::ldexp(count, -levels);
    if (piece <= Piece::most_samples && pieceBytes(piece) <= room)
      return levels;
  }
  throw InvalidArgument(
      "The isosurface of " + std::to_string(samples) + " samples takes at least " +
      formatBytes(static_cast<double>(leastOutOfCoreMemory(samples, isovalues))) +
      " of memory, and " + formatBytes(static_cast<double>(max_memory)) +
      " were allowed.");
}

/** One extraction. */
class OutOfCoreExtraction {
public:
  OutOfCoreExtraction(const IsosurfaceSettings& settings,
                      const OutOfCoreSettings& out_of_core,
                      Report& report)
      : settings_(settings)
      , out_of_core_(out_of_core)
      , report_(report)
      , log_(std::make_unique<io::SampleLog>(out_of_core.scratch_folder))
  {
  }

  std::vector<std::vector<GlobalIsopoint>>
  extract(PointStream& points)
  {
    readPoints(points);
    std::vector<std::vector<GlobalIsopoint>> found(settings_.isovalues.size());
    while (!makePieces())
      mergeInPieces();
    warnOfEmpty();
    for (std::size_t piece = 0; piece < decomposition_->size(); ++piece)
      if (isCrossed(piece)) {
        const auto parts = findIsopoints(piece);
        for (std::size_t i = 0; i < found.size(); ++i)
          found[i].insert(found[i].end(), parts[i].begin(), parts[i].end());
        checkSurface(found);
      }
    for (auto& isopoints : found) {
      mergeIsopoints(isopoints, settings_.interpolation, out_of_core_.threads, report_);
      report_.count("isopoints", isopoints.size());
    }
    return found;
  }

private:
  void
  readPoints(PointStream& points)
  {
    StepTimer step(report_, "scratch", points.size());
    pcl::PCLPointCloud2 block;
    const std::size_t count =
        std::max<std::size_t>(block_bytes / points.getHeader().cloud.point_step, 1);
    for (std::uint64_t begin = points.tell(); points.read(count, block) > 0;
         begin = points.tell()) {
      const CloudView view = viewOf(block);
      log_->append(readSamples(view,
                               ScalarField(view.fields, settings_.field),
                               settings_.scale,
                               begin,
                               out_of_core_.threads,
                               report_));
      step.advance(view.count);
    }
    if (log_->size() == 0)
      throw InvalidArgument("No sample has a position and a finite value of " +
                            settings_.field + ".");
  }

  /** Part the samples, order those of each piece. \return false if some coincide: the
   * log then has to be made anew from the pieces */
  bool
  makePieces()
  {
    {
      const StepTimer timer(report_, "decomposition");
      SingleRank alone;
      decomposition_.emplace(
          [&](const auto& block) { log_->scan(block); },
          levelsFor(log_->size(), settings_.isovalues.size(), out_of_core_.max_memory),
          alone,
          out_of_core_.threads);
      store_ = std::make_unique<io::PieceStore>(
          *log_, *decomposition_, out_of_core_.scratch_folder, out_of_core_.threads);
    }
    checkPieces();
    const std::uint64_t log_bytes = log_->bytes();
    bricks_.clear();
    ranges_.clear();
    for (std::size_t piece = 0; piece < decomposition_->size(); ++piece) {
      const auto built = Piece::build(*decomposition_,
                                      piece,
                                      store_->load(piece),
                                      settings_.scale,
                                      out_of_core_.threads,
                                      report_);
      if (!built)
        return false;
      bricks_.push_back(built->makeBricks());
      const auto& values = built->getValues();
      const auto [min, max] = std::minmax_element(values.begin(), values.end());
      ranges_.push_back({*min, *max});
      store_->save(piece, *built);
    }
    report_.count("scratch_bytes", log_bytes + store_->bytes());
    log_.reset();
    report_.count("pieces", decomposition_->size());
    report_.count("samples", decomposition_->getSampleCount());
    return true;
  }

  void
  mergeInPieces()
  {
    log_ = std::make_unique<io::SampleLog>(out_of_core_.scratch_folder);
    for (std::size_t piece = 0; piece < decomposition_->size(); ++piece) {
      Samples samples = store_->load(piece);
      mergeDuplicates(samples, out_of_core_.threads, report_);
      log_->append(samples);
    }
    store_.reset();
  }

  /** All samples at one place are in one piece, however many: levelsFor cannot know. */
  void
  checkPieces() const
  {
    for (std::size_t piece = 0; piece < decomposition_->size(); ++piece) {
      const std::uint64_t count = store_->count(piece);
      if (count > decomposition_->getCount(piece) &&
          fixed_bytes + pieceBytes(static_cast<double>(count)) >
              static_cast<double>(out_of_core_.max_memory))
        throw InvalidArgument(
            std::to_string(count) +
            " samples lie together, many of them at one place: they do not fit into " +
            formatBytes(static_cast<double>(out_of_core_.max_memory)) + " of memory.");
    }
  }

  void
  checkSurface(const std::vector<std::vector<GlobalIsopoint>>& found) const
  {
    std::size_t isopoints = 0;
    for (const auto& part : found)
      isopoints += part.size();
    const double bytes = fixed_bytes + isopoint_bytes * static_cast<double>(isopoints);
    if (bytes > static_cast<double>(out_of_core_.max_memory))
      throw InvalidArgument("The isosurface alone takes more than " +
                            formatBytes(bytes) + " of memory, and " +
                            formatBytes(static_cast<double>(out_of_core_.max_memory)) +
                            " were allowed.");
  }

  void
  warnOfEmpty()
  {
    NodeRanges::Range range = ranges_.front();
    for (const auto& [min, max] : ranges_)
      range = {std::min(range.min, min), std::max(range.max, max)};
    for (const double isovalue : settings_.isovalues)
      warnIfOutside(isovalue, settings_.field, range, report_);
  }

  /** True if an isovalue lies between two values of a range. */
  bool
  isCrossed(float min, float max) const
  {
    return std::any_of(
        settings_.isovalues.begin(), settings_.isovalues.end(), [&](double isovalue) {
          const auto rounded = static_cast<float>(isovalue);
          return min < rounded && rounded <= max;
        });
  }

  /** True if an edge from a sample of the piece may be crossed. */
  bool
  isCrossed(std::size_t piece) const
  {
    const auto& [min, max] = ranges_[piece];
    bool crossed = isCrossed(min, max);
    const CellKey cell = decomposition_->getCell(piece);
    for (std::size_t other = 0; other < ranges_.size() && !crossed; ++other)
      if (other != piece)
        bricks_[other].find(
            [&](const CellKey& around) { return !crossed && around.touches(cell); },
            [&, low = min, high = max](const Brick& brick) {
              crossed = crossed || isCrossed(std::min(low, brick.range.min),
                                             std::max(high, brick.range.max));
            });
    return crossed;
  }

  std::vector<std::vector<GlobalIsopoint>>
  findIsopoints(std::size_t index)
  {
    Piece piece = store_->restore(*decomposition_, index, settings_.scale);
    std::vector<LentBrick> bricks;
    const auto lend = [&](std::size_t other, const Brick& brick) {
      bricks.push_back(store_->lend(other, decomposition_->getBegin(other), brick));
    };
    {
      const StepTimer timer(report_, "exchange");
      const CellKey& cell = piece.getCell();
      for (std::size_t other = 0; other < decomposition_->size(); ++other)
        if (other != index)
          bricks_[other].find(
              [&](const CellKey& around) { return around.touches(cell); },
              [&](const Brick& brick) { lend(other, brick); });
      piece.borrow(std::exchange(bricks, {}), out_of_core_.threads);
    }
    PieceIsopoints isopoints(piece, settings_, out_of_core_.threads, report_);
    while (!isopoints.getOpenBalls().empty()) {
      {
        const StepTimer timer(report_, "exchange");
        decomposition_->findPieces(
            isopoints.getOpenBalls(),
            [&](std::size_t other, const std::vector<Ball>& balls) {
              if (other != index)
                bricks_[other].find(balls, [&](const Brick& brick) {
                  if (!piece.holds(brick))
                    lend(other, brick);
                });
            });
        piece.borrow(std::exchange(bricks, {}), out_of_core_.threads);
      }
      isopoints.settle();
    }
    return std::move(isopoints).take();
  }

  const IsosurfaceSettings& settings_;
  const OutOfCoreSettings& out_of_core_;
  Report& report_;
  std::unique_ptr<io::SampleLog> log_;
  std::unique_ptr<io::PieceStore> store_;
  std::optional<Decomposition> decomposition_;
  std::vector<BrickTable> bricks_;        // by piece
  std::vector<NodeRanges::Range> ranges_; // of values, by piece
};

/** The points that edges end at, and the edges by their indices. */
void
readEnds(PointStream& points,
         const std::vector<std::vector<GlobalIsopoint>>& isopoints,
         OutOfCoreIsosurface& surface)
{
  std::vector<std::uint64_t> ends;
  for (const auto& part : isopoints)
    for (const GlobalIsopoint& isopoint : part) {
      ends.push_back(isopoint.first);
      ends.push_back(isopoint.second);
    }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const auto index_of = [&](std::uint64_t end) {
    return static_cast<std::uint32_t>(std::lower_bound(ends.begin(), ends.end(), end) -
                                      ends.begin());
  };
  for (const auto& part : isopoints)
    for (const GlobalIsopoint& isopoint : part)
      surface.edges.push_back(
          {index_of(isopoint.first), index_of(isopoint.second), isopoint.t});
  points.seek(0);
  points.readRows(ends, surface.samples);
}

} // namespace

std::uint64_t
leastOutOfCoreMemory(std::uint64_t samples, std::size_t isovalues)
{
  const auto count = static_cast<double>(samples);
  return static_cast<std::uint64_t>(
      std::ceil(besides(count, isovalues) +
                pieceBytes(std::ldexp(count, -mostLevelsFor(samples)))));
}

OutOfCoreIsosurface
extractOutOfCore(PointStream& points,
                 const IsosurfaceSettings& settings,
                 const OutOfCoreSettings& out_of_core,
                 Report& report)
{
  const auto found = OutOfCoreExtraction(settings, out_of_core, report).extract(points);
  OutOfCoreIsosurface surface;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const GlobalIsopoint& isopoint : found[i])
      surface.isopoints.push_back(toPointIso(isopoint, settings.isovalues[i]));
  const StepTimer timer(report, "fields");
  readEnds(points, found, surface);
  return surface;
}

} // namespace pcl_uvol
