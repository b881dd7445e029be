// SPDX-License-Identifier: BSD-3-Clause
#include "../distributed/sample_store.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/memory.h>
#include <pcl_uvol/isosurface/edge_ends.h>
#include <pcl_uvol/pipeline/extract_out_of_core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace pcl_uvol {

namespace {

constexpr NodeRanges::Range no_range{std::numeric_limits<float>::infinity(),
                                     -std::numeric_limits<float>::infinity()};

/** Bytes of points that are read at once. */
constexpr std::size_t block_bytes = 16u << 20;

/** Samples that isopoints are sought among at once: with four times as many, most of
 * them would lie far from any surface; with fewer, halos would be larger. */
constexpr std::uint64_t block_samples = 1u << 15;

/** As many with their surroundings, elsewhere than in the sparse parts beside a
 * cluster; they count among the fixed bytes. */
constexpr std::uint64_t most_around_block = 4 * block_samples;

/** Bytes that a process takes besides samples: libraries and buffers. */
constexpr double fixed_bytes = 120e6;

/** Of all samples, whether they are in memory or not: tables of bricks. */
constexpr double table_bytes = 0.5;

/** Per sample of a piece while its tree is built: as read (24), as sorted (16 and 12),
 * and planes (up to 16). */
constexpr double piece_bytes = 72.0;

/** Isopoints of an isovalue as multiples of samples^(2/3): a surface that crosses the
 * cloud twice. Whether there are more is checked as they are found. */
constexpr double expected_isopoints = 4.0;

/** Of an isopoint while it is merged, or a point with the samples that it rests on. */
constexpr double merging_copies = 2.0;

/** With fewer samples in a piece, other bytes outweigh its own. */
constexpr std::uint64_t least_piece = 1u << 14;
constexpr int most_levels = 12;

/** Bytes but those of pieces and isopoints. */
double
besides(double samples)
{
  return fixed_bytes + table_bytes * samples;
}

/** Bytes of a process that takes samples through memory in pieces; what is drawn for
 * the decomposition is less. */
double
bytesFor(double samples, double piece, std::size_t isovalues)
{
  const double isopoints = expected_isopoints * static_cast<double>(isovalues) *
                           std::pow(samples, 2.0 / 3.0);
  return besides(samples) +
         std::max(piece_bytes * piece,
                  merging_copies * sizeof(GlobalIsopoint) * isopoints);
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
  for (int levels = 0; levels <= mostLevelsFor(samples); ++levels) {
    const double piece = std::ldexp(count, -levels);
    if (piece <= Piece::most_samples &&
        bytesFor(count, piece, isovalues) <= static_cast<double>(max_memory))
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
      , log_(std::make_unique<SampleLog>(out_of_core.scratch_folder,
                                         out_of_core.threads))
  {
  }

  std::vector<std::vector<GlobalIsopoint>>
  extract(PointStream& points)
  {
    readPoints(points);
    while (!makePieces())
      mergeInPieces();
    warnOfEmpty();
    // They wait on disk while there are pieces in memory.
    ScratchFile found(out_of_core_.scratch_folder);
    struct Run {
      std::uint64_t begin, count;
    };
    std::vector<std::vector<Run>> runs(settings_.isovalues.size());
    const Decomposition blocks = makeBlocks();
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      const auto parts = findIsopoints(blocks, block);
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (!parts[i].empty()) {
          runs[i].push_back({found.size(), parts[i].size()});
          found.append(parts[i].data(), parts[i].size() * sizeof(GlobalIsopoint));
        }
      checkSurface(found.size());
    }
    std::vector<std::vector<GlobalIsopoint>> all;
    for (const auto& runs_of_value : runs) {
      auto& isopoints = all.emplace_back();
      std::size_t count = 0;
      for (const Run& run : runs_of_value)
        count += run.count;
      isopoints.reserve(count); // growing would take more than the bound counts
      for (const Run& run : runs_of_value) {
        const std::size_t old = isopoints.size();
        isopoints.resize(old + run.count);
        found.read(
            run.begin, isopoints.data() + old, run.count * sizeof(GlobalIsopoint));
      }
      mergeIsopoints(isopoints, settings_.interpolation, out_of_core_.threads, report_);
      report_.count("isopoints", isopoints.size());
    }
    return all;
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
      SelfCommunicator alone;
      decomposition_.emplace(
          log_->getPositions(),
          levelsFor(log_->size(), settings_.isovalues.size(), out_of_core_.max_memory),
          alone,
          out_of_core_.threads);
      store_ = std::make_unique<PieceStore>(std::move(*log_),
                                            *decomposition_,
                                            out_of_core_.scratch_folder,
                                            out_of_core_.threads);
    }
    log_.reset();
    checkPieces();
    bricks_.clear();
    ranges_.clear();
    for (std::size_t piece = 0; piece < decomposition_->size(); ++piece) {
      const auto built = Piece::build(*decomposition_,
                                      piece,
                                      load(*decomposition_, piece),
                                      settings_.scale,
                                      out_of_core_.threads,
                                      report_);
      if (!built)
        return false;
      bricks_.push_back(built->makeBricks());
      const auto& values = built->getValues();
      const auto [min, max] = std::minmax_element(values.begin(), values.end());
      ranges_.push_back({*min, *max});
      const StepTimer timer(report_, "scratch");
      store_->save(decomposition_->getBegin(piece), built->getOwnSamples());
    }
    report_.count("scratch_bytes", store_->bytes());
    report_.count("pieces", decomposition_->size());
    report_.count("samples", decomposition_->getSampleCount());
    return true;
  }

  Samples
  load(const Decomposition& decomposition, std::size_t piece)
  {
    const StepTimer timer(report_, "scratch");
    return store_->load(decomposition.getBegin(piece), decomposition.getCount(piece));
  }

  void
  mergeInPieces()
  {
    log_ =
        std::make_unique<SampleLog>(out_of_core_.scratch_folder, out_of_core_.threads);
    for (std::size_t piece = 0; piece < decomposition_->size(); ++piece) {
      Samples samples = load(*decomposition_, piece);
      store_->release(decomposition_->getBegin(piece), samples.size());
      mergeDuplicates(samples, out_of_core_.threads, report_);
      log_->append(samples);
    }
    store_.reset();
  }

  /** Bytes but those of pieces and isopoints. */
  double
  bytesBesides() const
  {
    return besides(static_cast<double>(decomposition_->getSampleCount()));
  }

  /** True if there is room for as many samples and their trees at a time. */
  bool
  fits(std::uint64_t samples) const
  {
    return bytesBesides() + piece_bytes * static_cast<double>(samples) <=
           static_cast<double>(out_of_core_.max_memory);
  }

  /** All samples at one place are in one piece, however many: levelsFor cannot know. */
  void
  checkPieces() const
  {
    for (std::size_t piece = 0; piece < decomposition_->size(); ++piece) {
      const std::uint64_t count = decomposition_->getCount(piece);
      if (!fits(count))
        throw InvalidArgument(
            std::to_string(count) +
            " samples lie together, many of them at one place: they do not fit into " +
            formatBytes(static_cast<double>(out_of_core_.max_memory)) + " of memory.");
    }
  }

  void
  checkSurface(std::uint64_t found) const
  {
    const double bytes = bytesBesides() + merging_copies * static_cast<double>(found);
    if (bytes > static_cast<double>(out_of_core_.max_memory))
      throw InvalidArgument("The isosurface alone takes more than " +
                            formatBytes(bytes) + " of memory, and " +
                            formatBytes(static_cast<double>(out_of_core_.max_memory)) +
                            " were allowed.");
  }

  void
  warnOfEmpty()
  {
    NodeRanges::Range range = no_range;
    for (const NodeRanges::Range& other : ranges_)
      range = range.joined(other);
    for (const double isovalue : settings_.isovalues)
      warnIfOutside(isovalue, settings_.field, range, report_);
  }

  /** The pieces, parted further by their trees, so that those which the surface does
   * not cross are not looked at again. */
  Decomposition
  makeBlocks() const
  {
    int levels = decomposition_->getLevels();
    while (decomposition_->getSampleCount() >> levels > block_samples)
      ++levels;
    return {*decomposition_, levels, [&](std::size_t piece, std::size_t node) {
              return bricks_[piece].getPlane(node);
            }};
  }

  /** True if an isovalue lies between two values of a range. */
  bool
  isCrossed(const NodeRanges::Range& range) const
  {
    return std::any_of(
        settings_.isovalues.begin(), settings_.isovalues.end(), [&](double isovalue) {
          const auto rounded = static_cast<float>(isovalue);
          return range.min < rounded && rounded <= range.max;
        });
  }

  /** The bricks of a block and those that touch it. */
  struct Bricks {
    std::vector<Brick> own, around;
  };

  Bricks
  touchingBricks(const Decomposition& blocks, std::size_t block) const
  {
    const CellKey cell = blocks.getCell(block);
    const std::uint64_t begin = blocks.getBegin(block),
                        end = blocks.getBegin(block + 1);
    Bricks bricks;
    for (const BrickTable& table : bricks_)
      table.find([&](const CellKey& around) { return around.touches(cell); },
                 [&](const Brick& brick) {
                   const bool is_own = begin <= brick.begin && brick.begin < end;
                   (is_own ? bricks.own : bricks.around).push_back(brick);
                 });
    return bricks;
  }

  /** Of bricks of a block those that hold an end of an edge that may be crossed: its
   * ends lie in bricks that touch each other. */
  std::vector<Brick>
  crossedBricks(const Bricks& bricks) const
  {
    std::vector<Brick> all = bricks.own;
    all.insert(all.end(), bricks.around.begin(), bricks.around.end());
    const auto range_of = [&](const auto& accepts) {
      NodeRanges::Range range = no_range;
      for (const Brick& brick : all)
        if (accepts(brick))
          range = range.joined(brick.range);
      return range;
    };
    std::vector<Brick> crossed;
    if (isCrossed(range_of([](const Brick&) { return true; })))
      for (const Brick& own : bricks.own)
        if (isCrossed(range_of(
                [&](const Brick& other) { return other.cell.touches(own.cell); })))
          crossed.push_back(own);
    return crossed;
  }

  /** The bricks around a block that its isopoints may rest on.
   * \param crossed bricks of it
   * \param around bricks that touch it */
  static std::vector<Brick>
  neededBricks(const std::vector<Brick>& crossed, const std::vector<Brick>& around)
  {
    std::vector<Brick> needed;
    std::copy_if(around.begin(),
                 around.end(),
                 std::back_inserter(needed),
                 [&](const auto& other) {
                   return std::any_of(
                       crossed.begin(), crossed.end(), [&](const Brick& own) {
                         return own.cell.touches(other.cell);
                       });
                 });
    return needed;
  }

  /** Bricks on their way to a block. */
  struct Ghosts {
    std::uint64_t samples; ///< of the block with these
    std::vector<GhostBrick> bricks;
  };

  void
  lend(const Brick& brick, Ghosts& loan) const
  {
    loan.samples += brick.count;
    if (loan.samples > most_around_block && !fits(loan.samples))
      throw InvalidArgument(
          std::to_string(loan.samples) +
          " samples around one place of the isosurface do not fit into " +
          formatBytes(static_cast<double>(out_of_core_.max_memory)) + " of memory.");
    loan.bricks.push_back({brick, store_->load(brick.begin, brick.count)});
  }

  std::vector<std::vector<GlobalIsopoint>>
  findIsopoints(const Decomposition& blocks, std::size_t block)
  {
    Ghosts loan{blocks.getCount(block), {}};
    {
      const StepTimer timer(report_, "exchange");
      const Bricks bricks = touchingBricks(blocks, block);
      const std::vector<Brick> crossed = crossedBricks(bricks);
      if (crossed.empty())
        return {};
      for (const Brick& brick : neededBricks(crossed, bricks.around))
        lend(brick, loan);
    }
    Piece piece = *Piece::build(blocks,
                                block,
                                load(blocks, block),
                                settings_.scale,
                                out_of_core_.threads,
                                report_);
    borrow(piece, std::move(loan.bricks));
    PieceIsopoints isopoints(piece, settings_, out_of_core_.threads, report_);
    while (!isopoints.getPendingBalls().empty()) {
      loan = {piece.getSamples().size(), {}};
      {
        const StepTimer timer(report_, "exchange");
        decomposition_->findPieces(
            isopoints.getPendingBalls(),
            [&](std::size_t other, const std::vector<Ball>& balls) {
              bricks_[other].find(balls, [&](const Brick& brick) {
                if (!piece.holds(brick))
                  lend(brick, loan);
              });
            });
      }
      borrow(piece, std::move(loan.bricks));
      isopoints.resolvePending();
    }
    return std::move(isopoints).take();
  }

  void
  borrow(Piece& piece, std::vector<GhostBrick>&& bricks)
  {
    const StepTimer timer(report_, "exchange");
    piece.borrow(std::move(bricks), out_of_core_.threads);
  }

  const IsosurfaceSettings& settings_;
  const OutOfCoreSettings& out_of_core_;
  Report& report_;
  std::unique_ptr<SampleLog> log_;
  std::unique_ptr<PieceStore> store_;
  std::optional<Decomposition> decomposition_;
  std::vector<BrickTable> bricks_;        // by piece
  std::vector<NodeRanges::Range> ranges_; // of values, by piece
};

} // namespace

std::uint64_t
leastOutOfCoreMemory(std::uint64_t samples, std::size_t isovalues)
{
  const auto count = static_cast<double>(samples);
  return static_cast<std::uint64_t>(std::ceil(
      bytesFor(count, std::ldexp(count, -mostLevelsFor(samples)), isovalues)));
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
  EdgeEnds ends = findEdgeEnds(found);
  surface.edges = std::move(ends.edges);
  points.seek(0);
  points.readRows(ends.points, surface.samples);
  return surface;
}

} // namespace pcl_uvol
