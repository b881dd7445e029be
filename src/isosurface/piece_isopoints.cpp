// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/piece_isopoints.h"

#include "common/parallel.h"
#include "distributed/byte_stream.h"
#include "isosurface/examined_isopoints.h"
#include "isosurface/isopoints.h"
#include "isosurface/one_sided.h"
#include "isosurface/smooth_roots.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace pcl_uvol {

namespace {

/** Room for rounding: a ball must not be too small by one bit. */
constexpr float slack = 1.0001f;

/** Part of the distance of the farthest sample known that is asked for first. */
constexpr float first_part = 0.25f;

Position
positionOf(const float* x)
{
  return {{x[0], x[1], x[2]}};
}

/** The linear isopoint that a fit starts from. */
PointIso
linearPoint(const GlobalIsopoint& isopoint)
{
  PointIso point;
  std::copy(isopoint.linear.x, isopoint.linear.x + 3, point.data);
  std::copy(isopoint.outside.x, isopoint.outside.x + 3, point.data_n);
  point.edge_length = isopoint.edge_length;
  return point;
}

void
setResult(GlobalIsopoint& isopoint, const PointIso& point)
{
  isopoint.position = positionOf(point.data);
  isopoint.normal = positionOf(point.data_n);
  isopoint.mean_curvature = point.mean_curvature;
  isopoint.error = point.error;
  isopoint.support = point.support;
}

/** The isopoints of one piece. */
class PieceIsopoints : public PieceTask {
public:
  PieceIsopoints(const Piece& piece,
                 const IsosurfaceParameters& settings,
                 unsigned threads,
                 SurfaceTally& tally,
                 Report& report);

  /** They are small at first, and grow as long as the nearest samples may lie beyond
   * them: a far one may turn out not to matter. */
  std::vector<Ball>
  getPendingBalls() const override;

  void
  resolvePending() override;

  void
  giveRecords(const RecordSink& sink) const override;

private:
  /** An isopoint whose fit may rest on samples that the piece does not have. */
  struct Pending {
    std::size_t isovalue, index;
    std::vector<Ball> known; ///< all samples in them the piece has, or asks for: the
                             ///< last one
  };

  /** The linear isopoints of one isovalue. */
  void
  find(const IsopointInput& input, std::size_t isovalue);

  /** Those of one isovalue that fits are made for. */
  std::vector<std::size_t>
  listFitted(std::size_t isovalue) const;

  /** Fit some of them; those that this does not settle become pending. Linear ones get
   * their support from it, which take() counts.
   * \param known per isopoint, balls all samples of which the piece has */
  void
  fit(const IsopointInput& input,
      std::size_t isovalue,
      const std::vector<std::size_t>& indices,
      std::vector<std::vector<Ball>>&& known);

  /** Ask for the first of some balls that may hold other samples than the piece has:
   * what lies in it decides where the next ones are.
   * \param known balls, which it becomes one of
   * \return false if there is none */
  bool
  askForFirst(const std::vector<Ball>& searched, std::vector<Ball>& known) const;

  const Piece& piece_;
  const IsosurfaceParameters& settings_;
  unsigned threads_;
  SurfaceTally& tally_;
  Report& report_;
  std::vector<std::vector<GlobalIsopoint>> found_;
  std::vector<Pending> pending_;
};

PieceIsopoints::PieceIsopoints(const Piece& piece,
                               const IsosurfaceParameters& settings,
                               unsigned threads,
                               SurfaceTally& tally,
                               Report& report)
    : piece_(piece)
    , settings_(settings)
    , threads_(threads)
    , tally_(tally)
    , report_(report)
    , found_(settings.isovalues.size())
{
  const SampleSet& samples = piece.getSamples();
  NodeRanges ranges;
  {
    const StepTimer timer(report, "ranges");
    ranges = samples.getTree().computeRanges(piece.getValues(), threads);
  }
  const TouchingCells candidates(samples);
  const IsopointInput input{samples,
                            piece.getValues(),
                            ranges,
                            candidates,
                            settings.criterion,
                            settings.outside,
                            settings.interpolation,
                            threads};
  for (std::size_t i = 0; i < found_.size(); ++i) {
    find(input, i);
    const std::vector<std::size_t> fitted = listFitted(i);
    fit(input, i, fitted, std::vector<std::vector<Ball>>(fitted.size()));
  }
}

void
PieceIsopoints::find(const IsopointInput& input, std::size_t which)
{
  const auto isovalue = static_cast<float>(settings_.isovalues[which]);
  std::vector<std::uint32_t> crossing;
  {
    const StepTimer timer(report_, "crossing_pairs");
    crossing = input.candidates.findCrossing(input.ranges, isovalue, threads_);
  }
  tally_.crossing += crossing.size();
  report_.count("crossing_samples", crossing.size());
  for (const EdgeKey key : findEdges(input, crossing, isovalue, tally_, report_)) {
    PointIso point;
    IsoEdge edge;
    placeIsopoint(input, key, isovalue, point, edge);
    GlobalIsopoint isopoint{};
    isopoint.lower = piece_.toGlobal(edge.first);
    isopoint.higher = piece_.toGlobal(edge.second);
    isopoint.first = piece_.getSource(edge.first);
    isopoint.second = piece_.getSource(edge.second);
    isopoint.t = edge.t;
    isopoint.linear = positionOf(point.data);
    isopoint.outside = positionOf(point.data_n);
    isopoint.edge_length = point.edge_length;
    setResult(isopoint, point);
    found_[which].push_back(isopoint);
  }
}

std::vector<std::size_t>
PieceIsopoints::listFitted(std::size_t isovalue) const
{
  const std::vector<GlobalIsopoint>& isopoints = found_[isovalue];
  std::vector<std::size_t> all(isopoints.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  if (settings_.interpolation != Interpolation::Linear)
    return all;
  ExaminedCandidates candidates;
  for (const GlobalIsopoint& isopoint : isopoints)
    candidates.add(isopoint.linear);
  const ExaminedIsopoints examined(candidates);
  const auto last = std::remove_if(all.begin(), all.end(), [&](std::size_t i) {
    return !examined.contain(isopoints[i].linear);
  });
  return {all.begin(), last};
}

bool
PieceIsopoints::askForFirst(const std::vector<Ball>& searched,
                            std::vector<Ball>& known) const
{
  const auto first =
      std::find_if(searched.begin(), searched.end(), [&](const Ball& ball) {
        return !piece_.getCell().contains(ball) &&
               std::none_of(known.begin(), known.end(), [&](const Ball& other) {
                 return other.contains(ball);
               });
      });
  if (first == searched.end())
    return false;
  Ball asked = *first;
  const auto smaller = std::find_if(known.begin(), known.end(), [&](const Ball& other) {
    return asked.isConcentric(other);
  });
  if (smaller == known.end())
    asked.radius *= first_part;
  else {
    asked.radius = std::min(asked.radius, 2.0f * smaller->radius);
    known.erase(smaller);
  }
  known.push_back(asked);
  return true;
}

void
PieceIsopoints::fit(const IsopointInput& input,
                    std::size_t isovalue,
                    const std::vector<std::size_t>& indices,
                    std::vector<std::vector<Ball>>&& known)
{
  std::vector<PointIso> points;
  IsoEdges edges;
  for (const std::size_t index : indices) {
    const GlobalIsopoint& isopoint = found_[isovalue][index];
    points.push_back(linearPoint(isopoint));
    edges.push_back(
        {piece_.toLocal(isopoint.lower), piece_.toLocal(isopoint.higher), isopoint.t});
  }
  StepTimer step(report_, "smooth_roots", points.size());
  std::vector<std::vector<Ball>> searched;
  const auto fits = fitRoots(input,
                             static_cast<float>(settings_.isovalues[isovalue]),
                             edges,
                             points,
                             step,
                             &searched);
  OneSidedTest test(input, static_cast<float>(settings_.isovalues[isovalue]));
  for (std::size_t i = 0; i < indices.size(); ++i) {
    GlobalIsopoint& isopoint = found_[isovalue][indices[i]];
    float radius = fits[i].radius;
    isopoint.is_contradicted = settings_.interpolation == Interpolation::Auto &&
                               test.contradicts(points[i], edges[i], radius);
    if (settings_.interpolation == Interpolation::Linear)
      isopoint.support = points[i].support;
    else
      setResult(isopoint, points[i]);
    isopoint.outcome = static_cast<std::uint8_t>(fits[i].outcome);
    const Ball nearest{stretched(isopoint.linear, toPosition(settings_.scale)), radius};
    searched[i].insert(searched[i].begin(), nearest);
    for (Ball& ball : searched[i])
      ball.radius *= slack;
    if (askForFirst(searched[i], known[i]))
      pending_.push_back({isovalue, indices[i], std::move(known[i])});
  }
}

std::vector<Ball>
PieceIsopoints::getPendingBalls() const
{
  std::vector<Ball> balls;
  for (const Pending& one : pending_)
    balls.push_back(one.known.back());
  return balls;
}

void
PieceIsopoints::resolvePending()
{
  std::vector<Pending> pending = std::exchange(pending_, {});
  const NodeRanges none{};
  const TouchingCells candidates(piece_.getSamples());
  const IsopointInput input{piece_.getSamples(),
                            piece_.getValues(),
                            none,
                            candidates,
                            settings_.criterion,
                            settings_.outside,
                            settings_.interpolation,
                            threads_};
  for (std::size_t isovalue = 0; isovalue < found_.size(); ++isovalue) {
    std::vector<std::size_t> indices;
    std::vector<std::vector<Ball>> known;
    for (Pending& one : pending)
      if (one.isovalue == isovalue) {
        indices.push_back(one.index);
        known.push_back(std::move(one.known));
      }
    fit(input, isovalue, indices, std::move(known));
  }
}

void
PieceIsopoints::giveRecords(const RecordSink& sink) const
{
  for (std::size_t i = 0; i < found_.size(); ++i)
    sink(i, found_[i].data(), found_[i].size());
}

/** Order isopoints of one isovalue, leave one for each edge, and of those that coincide
 * the first. */
void
mergeIsopoints(std::vector<GlobalIsopoint>& isopoints,
               const IsosurfaceParameters& parameters,
               unsigned threads,
               SurfaceTally& tally,
               Report& report)
{
  parallelSort(isopoints.begin(), isopoints.end(), threads, isBefore);
  isopoints.erase(std::unique(isopoints.begin(),
                              isopoints.end(),
                              [](const auto& a, const auto& b) {
                                return a.lower == b.lower && a.higher == b.higher;
                              }),
                  isopoints.end());
  report.count("edges", isopoints.size());
  std::vector<Position> positions, normals;
  for (const GlobalIsopoint& isopoint : isopoints) {
    positions.push_back(isopoint.linear);
    normals.push_back(isopoint.outside);
  }
  const auto stays = mergeCoincident(positions, normals, threads);
  const bool smooth = parameters.interpolation != Interpolation::Linear;
  std::vector<RootOutcome> outcomes;
  std::vector<std::uint8_t> supports;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < isopoints.size(); ++i)
    if (stays[i] != 0) {
      GlobalIsopoint& isopoint = isopoints[kept++] = isopoints[i];
      const auto outcome = static_cast<RootOutcome>(isopoint.outcome);
      if (!smooth || outcome > RootOutcome::Quadratic)
        isopoint.normal = normals[i];
      outcomes.push_back(outcome);
      supports.push_back(isopoint.support);
    }
  report.count("coincident", isopoints.size() - kept);
  isopoints.resize(kept);
  if (smooth)
    countRoots(outcomes, supports, parameters.errors_only, report);
  const auto end = std::remove_if(isopoints.begin(),
                                  isopoints.end(),
                                  [](const auto& one) { return one.is_contradicted; });
  const auto contradicted = static_cast<std::uint64_t>(isopoints.end() - end);
  tally.contradicted += contradicted;
  if (contradicted > 0)
    report.count("contradicted", contradicted);
  isopoints.erase(end, isopoints.end());
}

/** Count the support of those linear isopoints of one isovalue that are examined, of
 * all processes together, and forget it. */
void
countTogether(std::vector<GlobalIsopoint>& isopoints,
              Communicator& communicator,
              SurfaceTally& tally,
              Report& report)
{
  ExaminedCandidates own, all;
  for (const GlobalIsopoint& isopoint : isopoints)
    own.add(isopoint.linear);
  all.add(allGatherItems(communicator, own.list()));
  const ExaminedIsopoints examined(all);
  std::vector<std::uint8_t> supports;
  for (GlobalIsopoint& isopoint : isopoints) {
    if (examined.contain(isopoint.linear))
      supports.push_back(isopoint.support);
    isopoint.support = static_cast<std::uint8_t>(IsoSupport::Unknown);
  }
  countExamined(supports, tally, report);
}

} // namespace

PointIso
toPointIso(const GlobalIsopoint& isopoint, double isovalue)
{
  PointIso point;
  std::copy(isopoint.position.x, isopoint.position.x + 3, point.data);
  std::copy(isopoint.normal.x, isopoint.normal.x + 3, point.data_n);
  point.isovalue = static_cast<float>(isovalue);
  point.mean_curvature = isopoint.mean_curvature;
  point.error = isopoint.error;
  point.edge_length = isopoint.edge_length;
  point.support = isopoint.support;
  return point;
}

IsosurfaceStage::IsosurfaceStage(const IsosurfaceParameters& parameters,
                                 const LengthUnit& unit,
                                 const ValueFrame& frame)
    : parameters_(parameters)
    , isovalues_(parameters.isovalues)
    , frame_(frame)
    , received_(parameters.isovalues.size())
{
  checkParameters(parameters);
  parameters_.scale = {unit.scale[0], unit.scale[1], unit.scale[2]};
  for (double& isovalue : parameters_.isovalues)
    isovalue = frame.apply(isovalue);
}

void
IsosurfaceStage::checkValues(const NodeRanges::Range& range, Report& report) const
{
  for (const double isovalue : isovalues_)
    warnIfOutside(isovalue, parameters_.field, range, frame_, report);
}

bool
IsosurfaceStage::canFindIn(const NodeRanges::Range& range) const
{
  return std::any_of(
      parameters_.isovalues.begin(), parameters_.isovalues.end(), [&](double isovalue) {
        const auto rounded = static_cast<float>(isovalue);
        return range.min < rounded && rounded <= range.max;
      });
}

std::unique_ptr<PieceTask>
IsosurfaceStage::start(const Piece& piece, unsigned threads, Report& report)
{
  return std::make_unique<PieceIsopoints>(piece, parameters_, threads, tally_, report);
}

Position
IsosurfaceStage::findPlace(const void* record) const
{
  GlobalIsopoint isopoint;
  std::memcpy(&isopoint, record, sizeof(isopoint));
  return stretched(isopoint.linear, toPosition(parameters_.scale));
}

void
IsosurfaceStage::receive(std::size_t list,
                         std::size_t count,
                         const std::function<void(void*)>& read,
                         unsigned threads,
                         Report& report)
{
  std::vector<GlobalIsopoint>& isopoints = received_[list];
  isopoints.resize(count);
  read(isopoints.data());
  mergeIsopoints(isopoints, parameters_, threads, tally_, report);
  report.count("isopoints", isopoints.size());
}

std::vector<std::vector<GlobalIsopoint>>
IsosurfaceStage::take(Communicator& communicator, Report& report)
{
  if (parameters_.interpolation == Interpolation::Linear)
    for (std::vector<GlobalIsopoint>& isopoints : received_)
      countTogether(isopoints, communicator, tally_, report);
  return std::move(received_);
}

} // namespace pcl_uvol
