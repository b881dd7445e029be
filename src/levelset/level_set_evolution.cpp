// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "common/records.h"
#include "levelset/band.h"
#include "levelset/data_term.h"
#include "levelset/evolver.h"
#include "levelset/reinitialization.h"
#include "neighbors/sample_values.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/iso_edges.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <pcl/common/io.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>

namespace pcl_uvol {

namespace {

/** Steps until it is looked whether the zero level nears the border of the band. */
constexpr std::size_t band_steps = 5;

/** What averages may leave of the noise in the data's pull: 0.08 to 0.13 of it where
 * the surface is in its place, 0.3 where details of six spacings are smoothed away. And
 * what nobody sees, in spacings, such as the terraces of values in 8 bits. */
constexpr double most_pattern = 0.15, invisible_pattern = 0.03;

/** Steps until it is looked at, and by what mu is raised then. */
constexpr double mu_factor = 1.5;
constexpr std::size_t pattern_steps = 20;

/** Of a whole run, for its progress. */
constexpr std::uint64_t progress_parts = 1000;

/** In spacings: the zero level keeps that far from the border. */
constexpr double band_margin = 2.0;

/** Mean of | |grad phi| - 1 | that asks for a reinitialisation, beyond that of the data
 * term, which would bring it back; and steps between two: a function that starts noisy
 * is smoothed before. */
constexpr double most_slope_error = 0.3;
constexpr std::size_t reinitialization_steps = 10;

/** Values beyond so many times the extent of the samples are a divergence. */
constexpr double most_extents = 100.0;

/** Noise, in spacings, at which data and smoothness count the same. */
constexpr double balanced_noise = 0.015;
constexpr double least_mu = 0.03;

void
checkParameters(const LevelSetParameters& parameters)
{
  const auto fail =
      [](const std::string& what, auto given, const std::string& allowed) {
        std::ostringstream text;
        text << what << " is " << given << ": it must be " << allowed << ".";
        throw InvalidArgument(text.str());
      };
  if (!std::isfinite(parameters.isovalue))
    throw InvalidArgument(
        "LevelSetEvolution has no finite isovalue: call setIsoValue.");
  if (parameters.mu && !(*parameters.mu >= 0.0 && *parameters.mu <= 1.0))
    fail("The weight mu", *parameters.mu, "in [0, 1]");
  parameters.initial.check();
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(parameters.scale[axis]) || parameters.scale[axis] <= 0.0f)
      fail("The scale", parameters.scale[axis], "finite and positive");
  const std::size_t least = derivativesOf(parameters.scheme);
  if (parameters.k < least)
    fail("The number of neighbours",
         parameters.k,
         "at least " + std::to_string(least) + " with this scheme");
  if (parameters.max_steps == 0)
    fail("The number of steps", parameters.max_steps, "at least 1");
  if (!(parameters.tolerance > 0.0))
    fail("The tolerance", parameters.tolerance, "above 0");
  if (parameters.band_width != 0.0 && !(parameters.band_width >= 1.5 * band_margin))
    fail("The width of the band",
         parameters.band_width,
         "at least 3 spacings, or 0 for none");
  if (parameters.reinitialization == Reinitialization::Eikonal &&
      parameters.scheme == FitScheme::Linear)
    throw InvalidArgument(
        "Reinitialisation by the Eikonal equation needs the quadratic "
        "scheme, for its viscosity.");
}

/** One run, from the cloud to phi. */
class LevelSetRun {
public:
  LevelSetRun(const CloudView& cloud,
              const pcl::Indices& indices,
              const LevelSetParameters& parameters,
              std::size_t snapshot_steps,
              const SnapshotCallback& snapshot,
              unsigned threads,
              Report& report)
      : parameters_(parameters)
      , snapshot_steps_(snapshot_steps)
      , snapshot_(snapshot)
      , threads_(threads)
      , report_(report)
  {
    read(cloud, indices);
    start(cloud);
  }

  LevelSet
  run()
  {
    StepTimer timer(report_, "evolution", progress_parts);
    std::uint64_t told = 0;
    for (std::size_t i = 0; i < parameters_.max_steps && !summary_.converged; ++i) {
      advance();
      const std::uint64_t done = std::max(told, partsDone());
      timer.advance(done - told);
      told = done;
      if (snapshot_steps_ > 0 && summary_.steps.size() % snapshot_steps_ == 0)
        snapshot_(summary_, phiOfCloud());
    }
    timer.advance(progress_parts - told);
    if (!summary_.converged)
      warnOfStepLimit();
    report_.count("steps", summary_.steps.size());
    report_.count("band_samples", band_->centers.size());
    return {phiOfCloud(), std::move(sources_), summary_};
  }

private:
  /** By input index, in the input's unit of length. */
  std::vector<float>
  phiOfCloud() const
  {
    std::vector<float> values = current();
    for (float& value : values)
      value = static_cast<float>(samples_->getUnit().toInput(value));
    std::vector<float> phi(cloud_size_, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < samples_->size(); ++i)
      phi[samples_->getInputIndex(i)] = values[i];
    for (const SampleSet::Merged& merged : samples_->getMerged())
      for (const std::uint32_t member : merged.members)
        phi[member] = values[merged.sample];
    return phi;
  }

  void
  read(const CloudView& cloud, const pcl::Indices& indices)
  {
    detail::checkIndices(indices, cloud.count, "LevelSetEvolution");
    cloud_size_ = cloud.count;
    const double isovalue = parameters_.isovalue;
    const ScalarField field(cloud.fields, parameters_.field);
    const ValueFrame frame = findValueRange(cloud, field, threads_).findFrame();
    const auto values = readValues(cloud, field, frame, threads_);
    const auto use = pointsWithValue(values, indices, field);
    samples_ = SampleSet::build(cloud.xyz(0),
                                cloud.stride(),
                                use,
                                toPosition(parameters_.scale),
                                threads_,
                                report_);
    report_.count("no_value", indices.size() - use.size());
    report_.count("samples", samples_->size());
    if (samples_->size() <= parameters_.k)
      throw InvalidArgument("There are " + std::to_string(samples_->size()) +
                            " distinct samples: a stencil of " +
                            std::to_string(parameters_.k) +
                            " neighbours needs at least one more than that.");
    SampleValues scalar = gatherValues(*samples_, values, threads_, report_);
    f_ = std::move(scalar.values);
    sources_ = std::move(scalar.sources);
    const auto [low, high] = std::minmax_element(f_.begin(), f_.end());
    const double threshold = frame.apply(isovalue);
    if (!(*low < threshold && threshold <= *high)) {
      const auto texts =
          describeNumbers({isovalue, frame.toInput(*low), frame.toInput(*high)});
      throw InvalidArgument("The isovalue " + texts[0] +
                            " does not part the values of " + parameters_.field +
                            ", which are in [" + texts[1] + ", " + texts[2] +
                            "]: there is no surface to evolve.");
    }
    for (float& value : f_)
      value = static_cast<float>(static_cast<double>(value) - threshold);
    largest_phi_ = largestPhi();
  }

  /** Beyond it the function has diverged. */
  double
  largestPhi() const
  {
    Position low = samples_->getPositions()[0], high = low;
    for (const Position& x : samples_->getPositions())
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], x[axis]);
        high[axis] = std::max(high[axis], x[axis]);
      }
    return most_extents *
           std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  }

  /** Samples next to the zero level of a function. */
  std::vector<std::uint32_t>
  crossingOf(const std::vector<float>& values) const
  {
    const KdTree& tree = samples_->getTree();
    return tree.findCrossing(
        samples_->getPositions(), tree.computeRanges(values, threads_), 0.0f, threads_);
  }

  /** The band, its data term and the values it starts with. */
  void
  start(const CloudView& cloud)
  {
    const auto surface = crossingOf(f_);
    spacing_ = medianSpacing(*samples_, surface, parameters_.k, threads_);
    summary_.spacing = samples_->getUnit().toInput(spacing_);
    if (!(spacing_ > 0.0))
      throw InvalidArgument("The samples at the surface have no extent.");
    const auto initial = initialValues(cloud);
    phi_ = initial.empty() ? f_ : initial;
    const auto crossing = initial.empty() ? surface : crossingOf(phi_);
    if (crossing.empty())
      throw InvalidArgument("The function that the level set starts from has no zero "
                            "level among the samples.");
    makeBand(crossing);
    summary_.noise = term_.noise / spacing_;
    summary_.mu = parameters_.mu.value_or(
        std::max(least_mu, balanced_noise / (balanced_noise + summary_.noise)));
    if (initial.empty()) {
      // Far from the surface the sign is all that counts.
      for (float& value : phi_)
        value = static_cast<float>(value / term_.slope);
      band_->forPlaces([&](std::size_t place, std::uint32_t sample) {
        phi_[sample] = term_.target[place];
      });
    }
    makeEvolver();
  }

  /** Of a shape or a field, in leaf order and the samples' unit; empty if f itself is
   * the start. */
  std::vector<float>
  initialValues(const CloudView& cloud) const
  {
    const InitialFunction& initial = parameters_.initial;
    const double unit = samples_->getUnit().factor;
    std::vector<float> values;
    if (initial.kind == InitialKind::Field) {
      const ScalarField field(cloud.fields, initial.field_name);
      for (std::size_t i = 0; i < samples_->size(); ++i) {
        const double value = field.read(cloud.point(sources_[i]));
        if (!std::isfinite(value))
          throw InvalidArgument("The field " + field.getName() +
                                " that the level set starts from is not finite "
                                "everywhere.");
        values.push_back(static_cast<float>(unit * value));
      }
    }
    else if (initial.isShape()) {
      const double side = parameters_.outside == Outside::Lower ? 1.0 : -1.0;
      for (std::size_t i = 0; i < samples_->size(); ++i) {
        const Eigen::Vector3d x =
            Eigen::Vector3f(cloud.xyz(samples_->getInputIndex(i))).cast<double>();
        values.push_back(static_cast<float>(side * unit * initial.computeDistance(x)));
      }
    }
    return values;
  }

  void
  makeBand(const std::vector<std::uint32_t>& crossing)
  {
    evolver_.reset();
    band_.reset(); // before the new one takes as much again
    band_ = pcl_uvol::makeBand(*samples_,
                               crossing,
                               parameters_.band_width * spacing_,
                               parameters_.scheme,
                               parameters_.k,
                               threads_,
                               report_);
    term_ = makeDataTerm(*band_, *samples_, f_, threads_, report_);
  }

  void
  makeEvolver()
  {
    std::vector<float> phi(band_->places(), 0.0f);
    band_->forPlaces(
        [&](std::size_t place, std::uint32_t sample) { phi[place] = phi_[sample]; });
    evolver_.emplace(
        *band_, parameters_, threads_, spacing_, summary_.mu, std::move(phi), term_);
  }

  void
  advance()
  {
    LevelSetStep step = evolver_->advance();
    report_.count("updates", evolver_->getUpdates());
    const double before = summary_.steps.empty() ? 0.0 : summary_.steps.back().time;
    step.time = before + evolver_->getStep();
    checkDivergence(step);
    summary_.steps.push_back(step);
    const std::size_t count = summary_.steps.size();
    summary_.converged = step.change < parameters_.tolerance;
    if (!parameters_.mu && (summary_.converged || count % pattern_steps == 0) &&
        isTooSmooth()) {
      summary_.converged = false;
      summary_.mu = std::min(1.0, mu_factor * summary_.mu);
      phi_ = current();
      makeEvolver();
      report_.count("mu_raised", 1);
    }
    if (summary_.converged)
      return;
    if (count % reinitialization_steps == 0 &&
        step.slope_error > most_slope_error + term_.slope_error)
      reinitialize();
    if (!band_->distance.empty() && count % band_steps == 0)
      followZeroLevel();
  }

  /** How far the run is: changes fall about exponentially. */
  std::uint64_t
  partsDone() const
  {
    const auto& steps = summary_.steps;
    const double by_steps =
        static_cast<double>(steps.size()) / static_cast<double>(parameters_.max_steps);
    const double to_go = std::log(steps.back().change / parameters_.tolerance),
                 all = std::log(steps.front().change / parameters_.tolerance);
    const double by_change = all > 0.0 ? 1.0 - to_go / all : 0.0;
    return static_cast<std::uint64_t>(
        progress_parts * std::clamp(std::max(by_steps, by_change), 0.0, 1.0));
  }

  void
  checkDivergence(const LevelSetStep& step) const
  {
    if (evolver_->isBounded(largest_phi_) && std::isfinite(step.change))
      return;
    std::ostringstream text;
    text << "The level set diverged in step " << summary_.steps.size() + 1
         << ": use a smaller time step, the quadratic scheme or a larger mu.";
    throw Diverged(text.str());
  }

  /** Whether smoothing has taken more away than noise. */
  bool
  isTooSmooth()
  {
    return summary_.mu < 1.0 &&
           evolver_->findPattern() >
               std::max(most_pattern * summary_.noise, invisible_pattern);
  }

  void
  reinitialize()
  {
    if (parameters_.reinitialization == Reinitialization::Distance)
      evolver_->setPhi(distanceToZeroLevel(
          *band_, *samples_, current(), spacing_, threads_, report_));
    else if (parameters_.reinitialization == Reinitialization::Eikonal)
      evolver_->setPhi(relaxToDistance(*band_, evolver_->getPhi(), spacing_, threads_));
    else
      return;
    summary_.steps.back().reinitialized = true;
    report_.count("reinitializations", 1);
  }

  /** A new band where the zero level has come near the border of the old one: a sample
   * there has changed its side. */
  void
  followZeroLevel()
  {
    const double border = (parameters_.band_width - band_margin) * spacing_;
    const std::vector<float>& phi = evolver_->getPhi();
    bool is_near = false;
    for (std::size_t i = 0; i < band_->centers.size() && !is_near; ++i)
      is_near = band_->distance[i] > border &&
                (phi[i] < 0.0f) != (phi_[band_->centers[i]] < 0.0f);
    if (!is_near)
      return;
    phi_ = current();
    const std::vector<std::uint32_t> crossing = crossingOf(phi_);
    if (crossing.empty())
      return;
    const std::vector<std::uint32_t> old = std::move(band_->centers);
    makeBand(crossing);
    // What has not been advanced yet is no farther away than the crossing samples.
    for (std::size_t i = 0; i < band_->centers.size(); ++i) {
      const std::uint32_t sample = band_->centers[i];
      if (!std::binary_search(old.begin(), old.end(), sample))
        phi_[sample] = std::copysign(
            std::min(std::abs(phi_[sample]), band_->distance[i]), phi_[sample]);
    }
    makeEvolver();
    report_.count("band_updates", 1);
  }

  /** By sample. */
  std::vector<float>
  current() const
  {
    std::vector<float> values = phi_;
    for (std::size_t i = 0; i < band_->centers.size(); ++i)
      values[band_->centers[i]] = evolver_->getPhi()[i];
    return values;
  }

  void
  warnOfStepLimit()
  {
    std::ostringstream text;
    text.precision(2);
    text << "The level set has not converged after " << summary_.steps.size()
         << " steps: it still moves by " << summary_.steps.back().change
         << " spacings per unit of time.";
    report_.warnings.push_back(text.str());
  }

  const LevelSetParameters& parameters_;
  std::size_t snapshot_steps_;
  const SnapshotCallback& snapshot_;
  unsigned threads_;
  LevelSetSummary summary_;
  Report& report_;
  std::size_t cloud_size_ = 0;
  double largest_phi_ = 0.0;
  double spacing_ = 0.0; ///< in the samples' unit, as all that follows
  SampleSet::ConstPtr samples_;
  std::vector<float> f_;               ///< minus the isovalue, by sample
  std::vector<std::uint32_t> sources_; ///< by sample, the points that they are of
  std::vector<float> phi_; ///< by sample; in the band as it was when that was made
  std::optional<Band> band_;
  DataTerm term_;
  std::optional<Evolver> evolver_;
};

} // namespace

LevelSet
detail::evolveLevelSet(const CloudView& cloud,
                       const pcl::Indices& indices,
                       const LevelSetParameters& parameters,
                       std::size_t snapshot_steps,
                       const SnapshotCallback& snapshot,
                       unsigned threads,
                       Report& report)
{
  checkParameters(parameters);
  return LevelSetRun(
             cloud, indices, parameters, snapshot_steps, snapshot, threads, report)
      .run();
}

pcl::PCLPointCloud2
detail::addPhi(const CloudView& cloud,
               const pcl::Indices& indices,
               const std::vector<float>& phi,
               unsigned threads,
               Report& report)
{
  const StepTimer timer(report, "fields");
  pcl::PCLPointCloud2 points = cloudOfPhi(cloud, phi);
  if (indices.size() != cloud.count) {
    pcl::PCLPointCloud2 chosen;
    pcl::copyPointCloud(points, indices, chosen);
    points = std::move(chosen);
  }
  warnOfReplacedFields(cloud.fields, points.fields, report);
  IsoEdges edges;
  edges.reserve(indices.size());
  for (const pcl::index_t index : indices) {
    const auto point = static_cast<std::uint32_t>(index);
    edges.push_back({point, point, 0.0f});
  }
  interpolateFields(cloud, edges, points, threads);
  return points;
}

std::string
LevelSetParameters::toJson() const
{
  return writeJson(*this);
}

LevelSetParameters
LevelSetParameters::fromJson(const std::string& text)
{
  return readJson<LevelSetParameters>(text);
}

pcl::PCLPointCloud2
cloudOfPhi(const CloudView& cloud, const std::vector<float>& phi)
{
  if (phi.size() != cloud.count)
    throw InvalidArgument(std::to_string(phi.size()) +
                          " values of phi are not one for "
                          "each of " +
                          std::to_string(cloud.count) + " points.");
  Fields fields;
  for (const char* const name : {"x", "y", "z", "phi"})
    appendField(fields, name, pcl::PCLPointField::FLOAT32);
  pcl::PCLPointCloud2 result = makeRecords(std::move(fields), phi.size());
  result.is_dense = 0;
  for (std::size_t i = 0; i < phi.size(); ++i) {
    std::uint8_t* const point = result.data.data() + i * result.point_step;
    std::memcpy(point, cloud.xyz(i), 3 * sizeof(float));
    std::memcpy(point + 3 * sizeof(float), &phi[i], sizeof(float));
  }
  return result;
}

} // namespace pcl_uvol
