// SPDX-License-Identifier: BSD-3-Clause
#include "distributed/neighbor_need.h"

#include "common/parallel.h"
#include "distributed/byte_stream.h"
#include "distributed/run_stage.h"
#include "neighbors/nearest_finder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace pcl_uvol {
namespace {

constexpr std::size_t need_block = 1024;

/** Room for rounding: a ball must not be too small by one bit. */
constexpr float slack = 1.0001f;

/** Part of the distance of the farthest sample known that is asked for first. */
constexpr float first_part = 0.25f;

struct NeedSettings {
  std::size_t neighbors;
  double reach;
  LengthUnit unit;
};

/** What a piece needs, at a place in it. */
struct PlacedNeed {
  Position place;
  NeighborNeed need;
};

void
takeLarger(NeighborNeed& need, const NeighborNeed& other)
{
  need.beyond = std::max(need.beyond, other.beyond);
  need.within = std::max(need.within, other.within);
}

/** The samples of one piece. */
class PieceNeeds : public PieceTask {
public:
  PieceNeeds(const Piece& piece, const NeedSettings& settings, unsigned threads)
      : piece_(piece)
      , settings_(settings)
      , threads_(threads)
  {
    std::vector<Question> near;
    for (std::uint32_t i = 0; i < getRoot().count; ++i)
      if (getDepth(i) <= settings.reach)
        near.push_back({i, 0.0f});
    ask(near);
  }

  std::vector<Ball>
  getPendingBalls() const override
  {
    std::vector<Ball> balls;
    for (const Question& question : pending_)
      balls.push_back({getPosition(question.sample), question.known});
    return balls;
  }

  void
  resolvePending() override
  {
    ask(std::exchange(pending_, {}));
  }

  void
  giveRecords(const RecordSink& sink) const override
  {
    const PlacedNeed record{getPosition(0), need_};
    sink(0, &record, 1);
  }

private:
  /** What the neighbours of a sample, counted from the first one of the piece, need. */
  struct Question {
    std::uint32_t sample;
    float known; ///< radius of a ball all samples of which the piece has, or asks for
  };

  struct Answer {
    Question question;
    float radius; ///< of the neighbours among what the piece has
  };

  KdNode
  getRoot() const
  {
    return piece_.getSamples().getTree().getRoot();
  }

  const Position&
  getPosition(std::uint32_t sample) const
  {
    return piece_.getSamples().getPositions()[getRoot().begin + sample];
  }

  double
  getDepth(std::uint32_t sample) const
  {
    return static_cast<double>(piece_.getValues()[getRoot().begin + sample]);
  }

  NeighborNeed
  getNeed(const Answer& answer) const
  {
    const double length = settings_.unit.toInput(static_cast<double>(answer.radius)),
                 depth = getDepth(answer.question.sample);
    return {length - depth, static_cast<double>(slack) * (length + depth)};
  }

  void
  ask(const std::vector<Question>& questions)
  {
    for (const Answer& answer : findNeighbors(questions)) {
      const Question& question = answer.question;
      const Ball ball{getPosition(question.sample), slack * answer.radius};
      if (ball.radius <= question.known || piece_.getCell().contains(ball))
        takeLarger(need_, getNeed(answer));
      else // grows, as samples that are farther may turn out not to matter
        pending_.push_back({question.sample,
                            question.known > 0.0f
                                ? std::min(ball.radius, 2.0f * question.known)
                                : first_part * ball.radius});
    }
  }

  /** Leaves out samples whose neighbours lie within the reach: more samples can only
   * bring them nearer. */
  std::vector<Answer>
  findNeighbors(const std::vector<Question>& questions) const
  {
    return parallelGather<Answer>(
        questions.size(),
        need_block,
        threads_,
        [&](std::size_t begin, std::size_t end, std::vector<Answer>& found) {
          NearestFinder finder(piece_.getSamples(), settings_.neighbors);
          float length = 1.0f;
          for (std::size_t i = begin; i < end; ++i) {
            const auto row = finder.find(getPosition(questions[i].sample), length);
            length =
                std::sqrt(*std::max_element(row.sq_dists, row.sq_dists + row.size));
            const Answer answer{questions[i],
                                row.size < settings_.neighbors
                                    ? std::numeric_limits<float>::infinity()
                                    : length};
            if (getNeed(answer).beyond > settings_.reach)
              found.push_back(answer);
          }
        });
  }

  const Piece& piece_;
  const NeedSettings& settings_;
  unsigned threads_;
  NeighborNeed need_;
  std::vector<Question> pending_;
};

/** The values of its samples are their depths in the box. */
class NeedStage : public PieceStage {
public:
  explicit NeedStage(const NeedSettings& settings)
      : settings_(settings)
  {
  }

  Position
  getScale() const override
  {
    return settings_.unit.scale;
  }

  std::size_t
  countLists() const override
  {
    return 1;
  }

  std::size_t
  getRecordSize() const override
  {
    return sizeof(PlacedNeed);
  }

  void
  checkValues(const NodeRanges::Range&, Report&) const override
  {
    // Depths are what they are.
  }

  bool
  canFindIn(const NodeRanges::Range& range) const override
  {
    return static_cast<double>(range.min) <= settings_.reach;
  }

  std::unique_ptr<PieceTask>
  start(const Piece& piece, unsigned threads, Report&) override
  {
    return std::make_unique<PieceNeeds>(piece, settings_, threads);
  }

  Position
  findPlace(const void* record) const override
  {
    PlacedNeed placed;
    std::memcpy(&placed, record, sizeof(placed));
    return placed.place;
  }

  void
  receive(std::size_t,
          std::size_t count,
          const std::function<void(void*)>& read,
          unsigned,
          Report&) override
  {
    std::vector<PlacedNeed> placed(count);
    read(placed.data());
    for (const PlacedNeed& one : placed)
      takeLarger(need_, one.need);
  }

  /** \brief The need of the pieces of this process. */
  const NeighborNeed&
  getNeed() const
  {
    return need_;
  }

private:
  NeedSettings settings_;
  NeighborNeed need_;
};

} // namespace

NeighborNeed
measureNeed(Samples&& samples,
            const Position& scale,
            std::size_t neighbors,
            double reach,
            Communicator& communicator,
            unsigned threads,
            const ProgressCallback& progress)
{
  Report own; // of samples that others count as well
  own.progress = progress;
  const LengthUnit unit = normalizeTogether(samples, scale, communicator, threads, own);
  NeedStage stage({neighbors, reach, unit});
  runOnRanks(stage, std::move(samples), communicator, threads, own);
  NeighborNeed all;
  for (const NeighborNeed& need :
       allGatherItems(communicator, std::vector<NeighborNeed>{stage.getNeed()}))
    takeLarger(all, need);
  return all;
}

} // namespace pcl_uvol
