// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/inner_samples.h"

#include "common/parallel.h"
#include "common/scalar_field.h"
#include "common/scalar_names.h"
#include "mesh/cell_tiling.h"
#include "mesh/mesh_columns.h"
#include "neighbors/sample_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl_uvol::detail {

namespace {

/** Places that a thread looks up at a time. */
constexpr std::size_t inner_block = 4096;

/** Share of the difference between a sample and the next one in leaf order, which lies
 * a cell or so away: what a cell's mean differs from its sample, about. */
constexpr double cell_deviation = 0.5;

/** Share of what cells of samples beside the surface add: half of such a cell is beyond
 * it.
 */
constexpr double beyond_surface = 0.25;

/** A point of the input, or a sample, inside a piece. */
struct InnerPoint {
  std::uint32_t index;
  std::int32_t piece;
  int turns;
};

/** The points inside, ascending.
 * \param place_of a point */
template <typename PlaceOf>
std::vector<InnerPoint>
findInner(const MeshColumns& columns,
          std::size_t count,
          unsigned threads,
          StepTimer& step,
          const PlaceOf& place_of)
{
  return parallelGather<
      InnerPoint>(count, inner_block, threads, [&](auto begin, auto end, auto& found) {
    std::vector<Winding> around;
    for (std::size_t i = begin; i < end; ++i) {
      columns.findAround(place_of(i), around);
      for (const Winding& winding : around)
        found.push_back({static_cast<std::uint32_t>(i), winding.piece, winding.turns});
    }
    step.advance(end - begin);
  });
}

/** Volumes of the samples' cells, in units of the input. */
std::vector<double>
computeCellVolumes(const SampleSet& samples, unsigned threads)
{
  const CellTiling tiling(samples.getTree(), samples.getPositions());
  const Position& scale = samples.getScale();
  std::vector<double> volumes(samples.size());
  parallelBlocks(volumes.size(), inner_block, threads, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto sample = static_cast<std::uint32_t>(i);
      const KdBox box = tiling.findBox(sample, tiling.findCell(sample));
      volumes[i] = 1.0;
      for (int axis = 0; axis < 3; ++axis)
        volumes[i] *=
            (static_cast<double>(box.high[axis]) - box.low[axis]) / scale[axis];
    }
  });
  return volumes;
}

/** Sums over the cells of the samples inside a piece. */
struct CellSums {
  double volume = 0.0;       ///< of cells whose sample has a value
  double integral = 0.0;     ///< volume times value
  double sq_deviation = 0.0; ///< squares of volume times difference to the next sample
  double at_surface = 0.0;   ///< volume of cells beside the surface times difference to
                             ///< the value there
  double low = std::numeric_limits<double>::infinity(), high = -low; ///< values
};

/** Integrals over what the pieces enclose, by the cells of the samples. */
class CellIntegrals {
public:
  template <typename PlaceOf>
  CellIntegrals(const MeshColumns& columns,
                const CloudView& cloud,
                const PlaceOf& place_of,
                unsigned threads,
                StepTimer& step,
                Report& report)
      : cloud_(cloud)
  {
    std::vector<std::uint32_t> use(cloud.count);
    std::iota(use.begin(), use.end(), 0u);
    samples_ = SampleSet::build(cloud.xyz(0),
                                cloud.stride(),
                                use,
                                Position{{1.0f, 1.0f, 1.0f}},
                                threads,
                                report,
                                SplitRule::LongestSide);
    volumes_ = computeCellVolumes(*samples_, threads);
    inner_ = findInner(columns, samples_->size(), threads, step, [&](std::size_t i) {
      return place_of(samples_->getInputIndex(i));
    });
  }

  /** The sums of a field over each piece.
   * \param at_surface value there, by piece */
  std::vector<CellSums>
  sum(const ScalarField& field, const std::vector<double>& at_surface) const
  {
    std::vector<CellSums> sums(at_surface.size());
    for (const InnerPoint& point : inner_) {
      const double value = valueOf(field, point.index);
      if (!std::isfinite(value))
        continue;
      const auto piece = static_cast<std::size_t>(point.piece);
      CellSums& of_piece = sums[piece];
      const double volume = volumes_[point.index];
      of_piece.volume += point.turns * volume;
      of_piece.integral += point.turns * volume * value;
      of_piece.low = std::min(of_piece.low, value);
      of_piece.high = std::max(of_piece.high, value);
      const std::size_t next =
          point.index + 1 < volumes_.size() ? point.index + 1 : point.index;
      const double step = valueOf(field, next) - value;
      if (std::isfinite(step))
        of_piece.sq_deviation += volume * volume * step * step;
      if (isBesideSurface(point) && std::isfinite(at_surface[piece]))
        of_piece.at_surface += volume * std::abs(value - at_surface[piece]);
    }
    return sums;
  }

  /** The sums of a field over all cells. */
  CellSums
  sumAll(const ScalarField& field) const
  {
    CellSums sums;
    for (std::size_t i = 0; i < volumes_.size(); ++i) {
      const double value = valueOf(field, i);
      if (!std::isfinite(value))
        continue;
      sums.volume += volumes_[i];
      sums.integral += volumes_[i] * value;
      sums.low = std::min(sums.low, value);
      sums.high = std::max(sums.high, value);
    }
    return sums;
  }

private:
  double
  valueOf(const ScalarField& field, std::size_t sample) const
  {
    return field.read(cloud_.point(samples_->getInputIndex(sample)));
  }

  bool
  isInside(std::uint32_t sample, std::int32_t piece) const
  {
    const auto at =
        std::lower_bound(inner_.begin(),
                         inner_.end(),
                         std::make_pair(sample, piece),
                         [](const InnerPoint& point, const auto& other) {
                           return std::make_pair(point.index, point.piece) < other;
                         });
    return at != inner_.end() && at->index == sample && at->piece == piece;
  }

  /** Whether the piece leaves out a sample next to one inside, in leaf order. */
  bool
  isBesideSurface(const InnerPoint& point) const
  {
    return (point.index > 0 && !isInside(point.index - 1, point.piece)) ||
           !isInside(point.index + 1, point.piece);
  }

  const CloudView& cloud_;
  SampleSet::ConstPtr samples_;
  std::vector<double> volumes_;   // by sample
  std::vector<InnerPoint> inner_; // ascending by sample and piece
};

/** Mean of a field on a piece; NaN where it has none of that name. */
double
meanOnSurface(const PieceMeasures& piece, const std::string& name)
{
  for (const SurfaceFieldMeasures& field : piece.on_surface)
    if (field.name == name)
      return field.mean;
  return std::numeric_limits<double>::quiet_NaN();
}

/** The integral over a piece, what cells miss of its volume at the surface's value. The
 * mean is no value that is nowhere, however different the volumes are. */
Measure
estimateIntegral(const CellSums& sums, const PieceMeasures& piece, double at_surface)
{
  if (sums.volume == 0.0 && !std::isfinite(at_surface))
    return {};
  const double there =
      std::isfinite(at_surface) ? at_surface : sums.integral / sums.volume;
  const double cells = cell_deviation * std::sqrt(sums.sq_deviation);
  const double volume = piece.volume.value,
               raw = sums.integral + there * (volume - sums.volume),
               bounded = volume * std::clamp(raw / volume,
                                             std::min(sums.low, there),
                                             std::max(sums.high, there));
  const bool is_bounded =
      volume != 0.0 && std::abs(bounded - raw) > 1e-9 * std::abs(raw);
  return {is_bounded ? bounded : raw,
          cells + beyond_surface * sums.at_surface +
              std::abs(there) * piece.volume.error +
              (is_bounded ? std::abs(bounded - raw) : 0.0)};
}

/** The samples and their sums, and integrals over the box. */
PieceMeasures
describeBox(const CloudView& samples,
            const std::vector<std::string>& names,
            const CellIntegrals& cells,
            double volume)
{
  PieceMeasures all;
  all.volume = {volume, 0.0};
  for (std::size_t i = 0; i < samples.count; ++i) {
    const float* const place = samples.xyz(i);
    all.samples +=
        std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]);
  }
  for (const std::string& name : names) {
    const ScalarField field(samples.fields, name);
    double sum = 0.0;
    for (std::size_t i = 0; i < samples.count; ++i)
      if (const double value = field.read(samples.point(i)); std::isfinite(value))
        sum += value;
    const Measure integral = estimateIntegral(
        cells.sumAll(field), all, std::numeric_limits<double>::quiet_NaN());
    all.inside.push_back({name, integral, integral.value / volume, sum});
  }
  return all;
}

} // namespace

PieceMeasures
measureInside(const ClosedMesh& mesh,
              const CloudView& samples,
              unsigned threads,
              std::vector<PieceMeasures>& pieces,
              Report& report)
{
  const std::vector<std::string> names = listScalars(samples.fields);
  StepTimer step(report, "inside", (2 + names.size()) * samples.count);
  const MeshColumns columns(mesh.places, mesh.triangles, mesh.piece_of, mesh.closure);
  const auto place_of = [&](std::size_t i) {
    const float* const place = samples.xyz(i);
    Eigen::Vector3d in_box(place[0], place[1], place[2]);
    if (mesh.closure != nullptr)
      for (std::size_t axis = 0; axis < 3; ++axis)
        in_box[static_cast<int>(axis)] =
            mesh.box.low[axis] + mesh.box.toBox(static_cast<double>(place[axis]), axis);
    return in_box;
  };
  const std::vector<InnerPoint> inner =
      findInner(columns, samples.count, threads, step, place_of);
  const CellIntegrals cells(columns, samples, place_of, threads, step, report);
  for (const InnerPoint& point : inner)
    pieces[static_cast<std::size_t>(point.piece)].samples += point.turns;
  for (const std::string& name : names) {
    const ScalarField field(samples.fields, name);
    std::vector<double> at_surface, sums(pieces.size(), 0.0);
    for (const PieceMeasures& piece : pieces)
      at_surface.push_back(meanOnSurface(piece, name));
    for (const InnerPoint& point : inner) {
      const double value = field.read(samples.point(point.index));
      if (std::isfinite(value))
        sums[static_cast<std::size_t>(point.piece)] += point.turns * value;
    }
    const std::vector<CellSums> of_cells = cells.sum(field, at_surface);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].rims > 0)
        continue;
      const Measure integral = estimateIntegral(of_cells[i], pieces[i], at_surface[i]);
      pieces[i].inside.push_back(
          {name, integral, integral.value / pieces[i].volume.value, sums[i]});
    }
    step.advance(samples.count);
  }
  for (PieceMeasures& piece : pieces)
    if (piece.rims > 0)
      piece.samples = 0;
  const double of_box = mesh.closure != nullptr ? mesh.closure->getBoxVolume() : 0.0;
  return of_box > 0.0 ? describeBox(samples, names, cells, of_box) : PieceMeasures();
}

void
sumBeyond(const CloudView& samples,
          const ScalarField& field,
          Outside outside,
          std::vector<PieceMeasures>& isovalues)
{
  const std::vector<std::string> names = listScalars(samples.fields);
  for (PieceMeasures& all : isovalues) {
    if (std::isnan(all.isovalue))
      continue;
    std::vector<std::uint32_t> beyond;
    for (std::size_t i = 0; i < samples.count; ++i) {
      const double value = field.read(samples.point(i));
      if (outside == Outside::Lower ? value >= all.isovalue : value <= all.isovalue)
        beyond.push_back(static_cast<std::uint32_t>(i));
    }
    all.samples_beyond = static_cast<std::int64_t>(beyond.size());
    for (const std::string& name : names) {
      const ScalarField summed(samples.fields, name);
      double sum = 0.0;
      for (const std::uint32_t i : beyond)
        if (const double value = summed.read(samples.point(i)); std::isfinite(value))
          sum += value;
      all.sums_beyond.push_back({name, sum});
    }
  }
}

void
addInside(const PieceMeasures& piece, PieceMeasures& all, int times)
{
  all.samples += times * piece.samples;
  if (all.inside.empty() && times == 1) {
    all.inside = piece.inside;
    return;
  }
  for (std::size_t i = 0; i < piece.inside.size(); ++i) {
    const InnerFieldMeasures& from = piece.inside[i];
    InnerFieldMeasures& to = all.inside[i];
    // A piece without samples has no integral, and hardly any volume.
    if (std::isfinite(from.integral.value)) {
      const bool is_first = !std::isfinite(to.integral.value);
      to.integral.value =
          times * from.integral.value + (is_first ? 0.0 : to.integral.value);
      to.integral.error = from.integral.error + (is_first ? 0.0 : to.integral.error);
    }
    to.sum += times * from.sum;
  }
}

} // namespace pcl_uvol::detail
