// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/rank_store.h"

#include "distributed/messages.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>

namespace pcl_uvol {

namespace {

/** Pieces per process where these are no power of two, at least. */
constexpr std::size_t pieces_per_rank = 4;

int
chooseLevels(std::size_t ranks, std::uint64_t samples)
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

} // namespace

/** Ghosts on their way to their pieces. */
class RankStore::GhostMessages {
public:
  explicit GhostMessages(RankStore& store)
      : store_(store)
      , messages_(store.communicator_.size())
  {
  }

  void
  add(std::size_t piece, const GhostBrick& ghost)
  {
    ByteWriter writer(messages_[store_.parted_->owners.getOwner(piece)]);
    writer.put(piece);
    writer.put(ghost.brick);
    putSamples(writer, ghost.samples.span(0, ghost.samples.size()));
  }

  /** Exchanges the messages; all processes call it together. */
  void
  deliver()
  {
    std::map<std::size_t, std::vector<GhostBrick>> ghosts;
    for (const Bytes& bytes : send(std::move(messages_),
                                   "bytes_exchanged",
                                   store_.communicator_,
                                   store_.report_))
      for (ByteReader reader(bytes); !reader.atEnd();) {
        GhostBrick& ghost = ghosts[reader.get<std::size_t>()].emplace_back();
        ghost.brick = reader.get<Brick>();
        getSamples(reader, ghost.samples);
      }
    for (auto& [piece, bricks] : ghosts)
      store_.pieces_.at(piece).addGhosts(std::move(bricks), store_.threads_);
  }

private:
  RankStore& store_;
  std::vector<Bytes> messages_;
};

RankStore::RankStore(Samples&& samples,
                     Communicator& communicator,
                     unsigned threads,
                     Report& report)
    : communicator_(communicator)
    , threads_(threads)
    , report_(report)
    , samples_(std::move(samples))
{
}

void
RankStore::redistribute()
{
  std::vector<std::uint64_t> total{samples_.size()};
  communicator_.allReduce(total);
  if (total[0] == 0)
    throw InvalidArgument("no_samples_of_ranks", {});
  const int levels = chooseLevels(communicator_.size(), total[0]);
  parted_.emplace(pcl_uvol::redistribute(std::move(samples_),
                                         levels,
                                         chooseGroups(communicator_.size(), levels),
                                         communicator_,
                                         threads_,
                                         report_));
  samples_ = {};
}

std::vector<std::size_t>
RankStore::getOwnPieces() const
{
  std::vector<std::size_t> own;
  for (std::size_t piece = 0; piece < parted_->decomposition.size(); ++piece)
    if (parted_->owners.getOwner(piece) == communicator_.rank())
      own.push_back(piece);
  return own;
}

Samples
RankStore::takeSamples(std::size_t piece)
{
  if (const auto built = pieces_.find(piece); built != pieces_.end()) {
    parted_->samples[piece].append(built->second.getOwnSamples());
    pieces_.erase(built);
    bricks_.erase(piece);
  }
  Samples samples = std::move(parted_->samples.at(piece));
  parted_->samples.erase(piece);
  return samples;
}

void
RankStore::putBack(std::size_t piece, Samples&& samples)
{
  parted_->samples.emplace(piece, std::move(samples));
}

void
RankStore::put(std::size_t piece, Piece&& built)
{
  bricks_.emplace(piece, built.makeBricks());
  pieces_.emplace(piece, std::move(built));
}

void
RankStore::append(std::size_t, Samples&& samples)
{
  samples_.append(samples.span(0, samples.size()));
}

void
RankStore::makeBlocks(Report&)
{
  // They are the pieces.
}

std::map<std::size_t, Piece>&
RankStore::openBatch(std::size_t, const PieceStage&)
{
  const StepTimer timer(report_, "exchange");
  GhostMessages messages(*this);
  for (const auto& [own, piece] : pieces_)
    for (std::size_t other = 0; other < parted_->decomposition.size(); ++other) {
      const CellKey cell = parted_->decomposition.getCell(other);
      if (other != own && cell.touches(piece.getCell()))
        bricks_.at(own).find(
            [&](const CellKey& around) { return around.touches(cell); },
            [&, &holder = piece](const Brick& brick) {
              messages.add(other, holder.makeGhost(brick));
            });
    }
  messages.deliver();
  return pieces_;
}

void
RankStore::fetchGhosts(const std::map<std::size_t, std::vector<Ball>>& balls)
{
  const StepTimer timer(report_, "exchange");
  std::vector<Bytes> questions(communicator_.size());
  for (const auto& [own, own_balls] : balls)
    parted_->decomposition.findPieces(
        own_balls,
        [&, asking = own](std::size_t other, const std::vector<Ball>& meeting) {
          if (other == asking)
            return;
          ByteWriter writer(questions[parted_->owners.getOwner(other)]);
          writer.put(asking);
          writer.put(other);
          writer.put(meeting);
        });
  GhostMessages messages(*this);
  for (const Bytes& bytes :
       send(std::move(questions), "bytes_exchanged", communicator_, report_))
    for (ByteReader reader(bytes); !reader.atEnd();) {
      const auto asking = reader.get<std::size_t>();
      const auto asked = reader.get<std::size_t>();
      const Piece& piece = pieces_.at(asked);
      std::vector<Ball> meeting;
      reader.get(meeting);
      const CellKey border = parted_->decomposition.getCell(asking);
      bricks_.at(asked).find(meeting, [&](const Brick& brick) {
        // Those at the border were sent before.
        if (!brick.cell.touches(border) && sent_.emplace(asking, brick.begin).second)
          messages.add(asking, piece.makeGhost(brick));
      });
    }
  messages.deliver();
}

void
RankStore::keepRecords(const PieceStage& stage,
                       std::size_t list,
                       const void* records,
                       std::size_t count)
{
  const std::size_t size = stage.getRecordSize();
  records_.resize(communicator_.size());
  const auto* record = static_cast<const std::uint8_t*>(records);
  for (std::size_t i = 0; i < count; ++i, record += size) {
    const std::size_t piece = parted_->decomposition.findPiece(stage.findPlace(record));
    auto& lists = records_[parted_->owners.getOwner(piece)];
    lists.resize(stage.countLists());
    lists[list].insert(lists[list].end(), record, record + size);
  }
}

void
RankStore::returnToOwner(PieceStage& stage)
{
  std::vector<Bytes> messages(communicator_.size());
  records_.resize(communicator_.size());
  for (std::size_t rank = 0; rank < messages.size(); ++rank) {
    records_[rank].resize(stage.countLists());
    for (const Bytes& list : records_[rank])
      ByteWriter(messages[rank]).put(list);
    records_[rank] = {};
  }
  std::vector<std::vector<Bytes>> lists(stage.countLists()); // by list and process
  for (Bytes& bytes :
       send(std::move(messages), "bytes_exchanged", communicator_, report_)) {
    ByteReader reader(bytes);
    for (auto& list : lists)
      reader.get(list.emplace_back());
    bytes = {};
  }
  for (std::size_t i = 0; i < lists.size(); ++i) {
    std::size_t bytes = 0;
    for (const Bytes& part : lists[i])
      bytes += part.size();
    stage.receive(
        i,
        bytes / stage.getRecordSize(),
        [&](void* records) {
          auto* next = static_cast<std::uint8_t*>(records);
          for (Bytes& part : lists[i])
            next = std::copy(part.begin(), part.end(), next);
          lists[i] = {};
        },
        threads_,
        report_);
  }
}

} // namespace pcl_uvol
