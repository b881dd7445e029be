// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/parallel.h>
#include <pcl_uvol/distributed/byte_stream.h>
#include <pcl_uvol/pipeline/extract_from_ranks.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

namespace {

/** Pieces per process where these are no power of two, at least. */
constexpr std::size_t pieces_per_rank = 4;

constexpr std::size_t block_samples = 1u << 14;

int
levelsFor(std::size_t ranks, std::uint64_t samples)
{
  const bool is_power = (ranks & (ranks - 1)) == 0;
  int levels = 0;
  while ((std::size_t(1) << levels) < (is_power ? ranks : pieces_per_rank * ranks) ||
         samples >> levels > Piece::most_samples)
    ++levels;
  while (levels > 0 && (std::uint64_t(1) << levels) > samples)
    --levels;
  return levels;
}

/** What put makes of samples and the number of their piece. */
std::size_t
bytesOf(const Samples& samples)
{
  return 4 * sizeof(std::size_t) +
         samples.size() * (sizeof(Position) + sizeof(float) + sizeof(std::uint64_t));
}

void
put(ByteWriter& writer, const Samples& samples)
{
  writer.put(samples.positions);
  writer.put(samples.values);
  writer.put(samples.sources);
}

void
get(ByteReader& reader, Samples& samples)
{
  reader.get(samples.positions);
  reader.get(samples.values);
  reader.get(samples.sources);
}

/** One extraction, as one of the processes sees it. */
class RankExtraction {
public:
  RankExtraction(const IsosurfaceSettings& settings,
                 Communicator& communicator,
                 unsigned threads,
                 Report& report)
      : settings_(settings)
      , communicator_(communicator)
      , threads_(threads)
      , report_(report)
  {
  }

  std::vector<std::vector<GlobalIsopoint>>
  extract(Samples&& samples)
  {
    if (!redistribute(samples)) {
      // Equal samples lie in one piece: there they become one.
      for (auto& [piece, own] : samples_) {
        mergeDuplicates(own, threads_, report_);
        samples.append(own.span(0, own.size()));
      }
      samples_.clear();
      pieces_.clear();
      redistribute(samples);
    }
    describePieces();
    exchangeGhosts();
    findIsopoints();
    resolvePending();
    return returnToOwner();
  }

private:
  std::size_t
  rankOf(std::size_t piece) const
  {
    return piece * communicator_.size() / decomposition_->size();
  }

  bool
  isOwn(std::size_t piece) const
  {
    return rankOf(piece) == communicator_.rank();
  }

  /** Part the samples and build the pieces of this process. \param samples empty
   * afterwards \return false, and no pieces but their samples, if some coincide */
  bool
  redistribute(Samples& samples)
  {
    std::vector<std::uint64_t> total{samples.size()};
    communicator_.allReduce(total);
    if (total[0] == 0)
      throw InvalidArgument("No process has a sample with a position and a value.");
    {
      const StepTimer timer(report_, "decomposition");
      const auto positions = [&](std::uint64_t begin, std::size_t, Position*) {
        return samples.positions.data() + begin;
      };
      decomposition_.emplace(PositionSource{samples.size(), positions},
                             levelsFor(communicator_.size(), total[0]),
                             communicator_,
                             threads_);
    }
    sendSamples(samples);
    std::vector<std::uint64_t> coinciding{0};
    for (auto& [index, own] : samples_) {
      auto piece = Piece::build(
          *decomposition_, index, std::move(own), settings_.scale, threads_, report_);
      if (piece)
        pieces_.emplace(index, std::move(*piece));
      else
        ++coinciding[0];
    }
    communicator_.allReduce(coinciding);
    if (coinciding[0] == 0) {
      samples_.clear();
      return true;
    }
    for (const auto& [index, piece] : pieces_) {
      samples_[index] = {};
      samples_[index].append(piece.getOwnSamples());
    }
    return false;
  }

  void
  sendSamples(Samples& samples)
  {
    const StepTimer timer(report_, "exchange");
    std::vector<std::uint32_t> piece_of(samples.size());
    parallelBlocks(samples.size(), block_samples, threads_, [&](auto begin, auto end) {
      for (std::size_t i = begin; i < end; ++i)
        piece_of[i] =
            static_cast<std::uint32_t>(decomposition_->pieceOf(samples.positions[i]));
    });
    std::vector<std::size_t> counts(decomposition_->size());
    for (const std::uint32_t piece : piece_of)
      ++counts[piece];
    std::vector<Samples> parts(decomposition_->size());
    for (std::size_t piece = 0; piece < parts.size(); ++piece)
      parts[piece].reserve(counts[piece]);
    for (std::size_t i = 0; i < samples.size(); ++i)
      parts[piece_of[i]].push(
          samples.positions[i], samples.values[i], samples.sources[i]);
    samples = {};
    std::vector<Bytes> messages(communicator_.size());
    for (std::size_t piece = 0; piece < parts.size(); ++piece) {
      if (isOwn(piece)) {
        samples_[piece] = std::move(parts[piece]);
        samples_[piece].reserve(decomposition_->getCount(piece)); // with those to come
      }
      else if (parts[piece].size() > 0) {
        Bytes& message = messages[rankOf(piece)];
        message.reserve(message.size() + bytesOf(parts[piece]));
        ByteWriter writer(message);
        writer.put(piece);
        put(writer, parts[piece]);
      }
      parts[piece] = {};
    }
    for (Bytes& bytes : exchange(std::move(messages), "bytes_dealt_out")) {
      for (ByteReader reader(bytes); !reader.atEnd();)
        get(reader, samples_[reader.get<std::size_t>()]);
      bytes = {};
    }
  }

  std::vector<Bytes>
  exchange(std::vector<Bytes>&& messages, const std::string& counter)
  {
    for (std::size_t rank = 0; rank < messages.size(); ++rank)
      if (rank != communicator_.rank())
        report_.count(counter, messages[rank].size());
    return communicator_.allToAll(std::move(messages));
  }

  /** Bricks on their way from one piece to another one. */
  class GhostMessages {
  public:
    explicit GhostMessages(RankExtraction& owner)
        : owner_(owner)
        , messages_(owner.communicator_.size())
    {
    }

    void
    lend(std::size_t to, const GhostBrick& lent)
    {
      ByteWriter writer(messages_[owner_.rankOf(to)]);
      writer.put(to);
      writer.put(lent.brick);
      put(writer, lent.samples);
    }

    void
    deliver()
    {
      std::map<std::size_t, std::vector<GhostBrick>> loans;
      for (const Bytes& bytes :
           owner_.exchange(std::move(messages_), "bytes_exchanged"))
        for (ByteReader reader(bytes); !reader.atEnd();) {
          auto& lent = loans[reader.get<std::size_t>()].emplace_back();
          lent.brick = reader.get<Brick>();
          get(reader, lent.samples);
        }
      for (auto& [piece, bricks] : loans)
        owner_.pieces_.at(piece).borrow(std::move(bricks), owner_.threads_);
    }

  private:
    RankExtraction& owner_;
    std::vector<Bytes> messages_;
  };

  /** Counts, and warnings of isovalues that no sample reaches. */
  void
  describePieces()
  {
    report_.count("pieces", pieces_.size());
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::vector<NodeRanges::Range> ranges{{infinity, -infinity}};
    const auto extend = [&](float min, float max) {
      ranges[0] = ranges[0].joined({min, max});
    };
    for (const auto& [index, piece] : pieces_) {
      report_.count("samples", piece.getValues().size());
      for (const float value : piece.getValues())
        extend(value, value);
    }
    for (const NodeRanges::Range& range : allGatherItems(communicator_, ranges))
      extend(range.min, range.max);
    for (const double isovalue : settings_.isovalues)
      warnIfOutside(isovalue, settings_.field, ranges[0], report_);
  }

  void
  exchangeGhosts()
  {
    const StepTimer timer(report_, "exchange");
    for (const auto& [own, piece] : pieces_)
      bricks_.emplace(own, piece.makeBricks());
    GhostMessages loans(*this);
    for (const auto& [own, piece] : pieces_)
      for (std::size_t other = 0; other < decomposition_->size(); ++other) {
        const CellKey cell = decomposition_->getCell(other);
        if (other != own && cell.touches(piece.getCell()))
          bricks_.at(own).find(
              [&](const CellKey& around) { return around.touches(cell); },
              [&, &lender = piece](const Brick& brick) {
                loans.lend(other, lender.lend(brick));
              });
      }
    loans.deliver();
  }

  void
  findIsopoints()
  {
    for (const auto& [index, piece] : pieces_)
      isopoints_.emplace(std::piecewise_construct,
                         std::forward_as_tuple(index),
                         std::forward_as_tuple(piece, settings_, threads_, report_));
  }

  /** Ask for what balls around isopoints reach beyond their pieces, until none is
   * open. */
  void
  resolvePending()
  {
    std::vector<std::uint64_t> open(1);
    do {
      exchangePending();
      open[0] = 0;
      for (auto& [index, isopoints] : isopoints_) {
        isopoints.resolvePending();
        open[0] += isopoints.getPendingBalls().size();
      }
      communicator_.allReduce(open);
    } while (open[0] > 0);
  }

  void
  exchangePending()
  {
    const StepTimer timer(report_, "exchange");
    std::vector<Bytes> messages(communicator_.size());
    for (const auto& [index, isopoints] : isopoints_)
      decomposition_->findPieces(
          isopoints.getPendingBalls(),
          [&, own = index](std::size_t other, const std::vector<Ball>& balls) {
            if (other == own)
              return;
            ByteWriter writer(messages[rankOf(other)]);
            writer.put(own);
            writer.put(other);
            writer.put(balls);
          });
    GhostMessages loans(*this);
    for (const Bytes& bytes : exchange(std::move(messages), "bytes_exchanged"))
      for (ByteReader reader(bytes); !reader.atEnd();) {
        const auto borrower = reader.get<std::size_t>();
        const auto lender = reader.get<std::size_t>();
        const Piece& piece = pieces_.at(lender);
        std::vector<Ball> balls;
        reader.get(balls);
        const CellKey border = decomposition_->getCell(borrower);
        bricks_.at(lender).find(balls, [&](const Brick& brick) {
          // Those at the border were lent before.
          if (!brick.cell.touches(border) &&
              lent_.emplace(borrower, brick.begin).second)
            loans.lend(borrower, piece.lend(brick));
        });
      }
    loans.deliver();
  }

  /** Isopoints that coincide or were found twice meet in the piece that they lie in. */
  std::vector<std::vector<GlobalIsopoint>>
  returnToOwner()
  {
    std::vector<std::vector<std::vector<GlobalIsopoint>>> homes(
        communicator_.size(),
        std::vector<std::vector<GlobalIsopoint>>(settings_.isovalues.size()));
    for (auto& [index, isopoints] : isopoints_) {
      const auto found = std::move(isopoints).take();
      for (std::size_t i = 0; i < found.size(); ++i)
        for (const GlobalIsopoint& isopoint : found[i]) {
          const Position place = stretched(isopoint.linear, settings_.scale);
          homes[rankOf(decomposition_->pieceOf(place))][i].push_back(isopoint);
        }
    }
    std::vector<Bytes> messages(communicator_.size());
    for (std::size_t rank = 0; rank < messages.size(); ++rank)
      for (const auto& isopoints : homes[rank])
        ByteWriter(messages[rank]).put(isopoints);
    homes.clear();
    std::vector<std::vector<GlobalIsopoint>> own(settings_.isovalues.size());
    for (const Bytes& bytes : exchange(std::move(messages), "bytes_exchanged")) {
      ByteReader reader(bytes);
      for (auto& isopoints : own)
        reader.get(isopoints);
    }
    for (auto& isopoints : own) {
      mergeIsopoints(isopoints, settings_.interpolation, threads_, report_);
      report_.count("isopoints", isopoints.size());
    }
    return own;
  }

  const IsosurfaceSettings& settings_;
  Communicator& communicator_;
  unsigned threads_;
  Report& report_;
  std::optional<Decomposition> decomposition_;
  std::map<std::size_t, Samples> samples_; // by piece, until these are built
  std::map<std::size_t, Piece> pieces_;
  std::map<std::size_t, BrickTable> bricks_; // of these
  std::map<std::size_t, PieceIsopoints> isopoints_;
  std::set<std::pair<std::size_t, std::uint64_t>> lent_; // to balls: borrower, brick
};

} // namespace

std::vector<std::vector<GlobalIsopoint>>
extractFromRanks(Samples&& samples,
                 const IsosurfaceSettings& settings,
                 Communicator& communicator,
                 unsigned threads,
                 Report& report)
{
  checkSettings(settings);
  return RankExtraction(settings, communicator, threads, report)
      .extract(std::move(samples));
}

std::vector<std::vector<GlobalIsopoint>>
gatherIsopoints(std::vector<std::vector<GlobalIsopoint>>&& isopoints,
                Communicator& communicator,
                unsigned threads)
{
  std::vector<Bytes> messages(communicator.size());
  for (auto& part : isopoints) {
    ByteWriter(messages[0]).put(part);
    part = {};
  }
  for (const Bytes& bytes : communicator.allToAll(std::move(messages)))
    for (ByteReader reader(bytes); !reader.atEnd();)
      for (auto& part : isopoints)
        reader.get(part);
  for (auto& part : isopoints)
    parallelSort(part.begin(), part.end(), threads, isBefore);
  return std::move(isopoints);
}

} // namespace pcl_uvol
