// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/gap_filling.h"

#include "common/median.h"
#include "common/memory.h"
#include "common/number_range.h"
#include "common/parallel.h"
#include "common/printable.h"
#include "common/records.h"
#include "common/scalar_field.h"
#include "interpolation/field_model.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/sampling.h"
#include "pipeline/gap_lattice.h"
#include "pipeline/gap_widths.h"
#include "pipeline/kriged_slopes.h"
#include "pipeline/lattice_band.h"
#include "pipeline/stretched_edges.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl_uvol::detail {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr std::size_t gap_block = 256;

/** Samples that the field between others is kriged from. */
constexpr std::size_t kriged_samples = 16;

/** Share of that spacing: where measured samples are farther away, they do not tell
 * more than the lattice does, whatever lies around. */
constexpr double sampled_part = 0.5;

/** Widths of a gap that samples are predicted within of a measured one, at most: gaps
 * are not equally wide, and beyond there is nothing but the variogram. */
constexpr double farthest_gaps = 4.0;

/** Share of the isopoints: samples all around leave a few beside some emptiness, which
 * are no gaps. */
constexpr double least_gaps = 0.1;

Position
toFloat(const Place& place)
{
  return {{static_cast<float>(place[0]),
           static_cast<float>(place[1]),
           static_cast<float>(place[2])}};
}

/** Pairs of nodes that follow one another along an axis, by their indices.
 * \param nodes ascending */
std::vector<std::pair<std::size_t, std::size_t>>
listNeighbors(const std::vector<std::pair<LatticeNode, double>>& nodes)
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      LatticeNode next = nodes[i].first;
      ++next[axis];
      const auto found =
          std::lower_bound(nodes.begin(),
                           nodes.end(),
                           next,
                           [](const auto& node, const LatticeNode& wanted) {
                             return node.first < wanted;
                           });
      if (found != nodes.end() && found->first == next)
        pairs.emplace_back(i, static_cast<std::size_t>(found - nodes.begin()));
    }
  return pairs;
}

/** Copy points of a cloud behind its others. */
void
appendCopies(const std::vector<std::uint32_t>& sources, pcl::PCLPointCloud2& cloud)
{
  const std::size_t before = cloud.width, step = cloud.point_step;
  checkSize(before + sources.size(), step);
  resizePoints(cloud, before + sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
    std::copy_n(&cloud.data[sources[i] * step], step, &cloud.data[(before + i) * step]);
}

std::vector<Place>
listPlaces(const pcl::PointCloud<PointIso>& points)
{
  std::vector<Place> places;
  for (const PointIso& point : points)
    places.push_back({point.x, point.y, point.z});
  return places;
}

/** How far outside of the hull of measured samples others are predicted: half a gap.
 * \param spacing of predicted samples */
double
findReach(const SamplingSummary& sampling, double spacing)
{
  // Where samples are all around, gaps are about as wide as samples are apart: the
  // widest spacing is that along one axis, and may be far more than the gap next to the
  // hull.
  const double half_gap_of_volume = 0.5 * static_cast<double>(sampling.along);
  const double reach = hull_tolerance * spacing;
  return sampling.most == LocalDimension::Volume ? std::min(reach, half_gap_of_volume)
                                                 : reach;
}

/** Whether so many of the isopoints in gaps tell of gaps in the sampling. */
bool
areGaps(std::size_t in_gaps, std::size_t isopoints)
{
  return in_gaps > 0 &&
         static_cast<double>(in_gaps) >= least_gaps * static_cast<double>(isopoints);
}

/** Why gaps that are there were not filled.
 * \param kriged places where kriging gave a value */
std::string
describeWhyEmpty(const GapFilling& gaps, std::size_t kriged)
{
  if (gaps.range < 0.5 * gaps.width)
    return "the variogram range is " + describeNumbers({gaps.range})[0] +
           ", less than half the gap width of " + describeNumbers({gaps.width})[0];
  return kriged == 0 ? "kriging has no value in the gaps"
                     : "the kriged field does not cross the isovalue in the gaps";
}

void
checkField(const Dataset& samples, const std::string& field)
{
  const pcl::PCLPointField* const stored = findField(samples.cloud.fields, field);
  if (!stored || stored->count > 1)
    throw InvalidArgument("no_field_for_gaps",
                          {{"field", shortenText(field)},
                           {"fields", describeFields(samples.cloud.fields)}});
}

} // namespace

InterpolationParameters
gapKriging(const IsosurfaceParameters& isosurface)
{
  InterpolationParameters parameters;
  parameters.fields = {isosurface.field};
  parameters.model = InterpolationModel::Kriging;
  parameters.kriging.octants = true;
  parameters.kriging.k = kriged_samples;
  parameters.gradients = parameters.errors = false;
  parameters.scale = isosurface.scale;
  return parameters;
}

bool
takesLattice(const IsosurfacePipelineParameters& parameters)
{
  return returnsToEdges(parameters) && parameters.normals == NormalMethod::Auto;
}

FilledGaps::FilledGaps(PipelineInput& input, unsigned threads, Report& report)
    : samples_(input.samples)
    , indices_(std::make_shared<pcl::Indices>(listPoints(input)))
{
  const StepTimer timer(report, "gaps");
  const IsosurfaceParameters& parameters = input.parameters.isosurface;
  const CloudView cloud = viewOf(samples_->cloud);
  checkField(*samples_, parameters.field);
  InterpolationParameters kriging = gapKriging(parameters);
  kriging.extrapolate = kriging.errors = true;
  Report own; // of samples that the extraction tells of as well
  own.progress = report.progress;
  field_ = std::make_unique<FieldInterpolator>(cloud, *indices_, kriging, threads, own);
  takeVariogram();
  kriging.model = InterpolationModel::Nearest;
  nearest_ =
      std::make_unique<FieldInterpolator>(cloud, *indices_, kriging, threads, own);

  IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setInputCloud(shareCloud(input));
  extraction.setIndices(indices_);
  extraction.setParameters(parameters);
  extraction.setInterpolation(Interpolation::Linear);
  extraction.setNumberOfThreads(threads);
  extraction.setProgressCallback(report.progress);
  pcl::PointCloud<PointIso> roots;
  extraction.extract(roots);
  measured_ = extraction.getSamples();
  sampling_ = summarizeSampling(*measured_, threads);
  const auto is_in_gap =
      findSpacing(roots, extraction.getEdges(), parameters, threads, report.progress);
  filled_ = samples_;
  if (summary_.spacing > 0.0) {
    hull_ = std::make_unique<SampleHull>(*measured_,
                                         findReach(sampling_, summary_.spacing) *
                                             measured_->getUnit().factor);
    krigeComposites(parameters, threads, report.progress);
    compareFits(is_in_gap, parameters, extraction, threads, report.progress);
    predictBetween(roots, is_in_gap, parameters, threads, report);
  }
  if (has_gaps_ && summary_.predicted == 0)
    report.warn("unfilled_gaps", {{"reason", summary_.unfilled}});
  input.use =
      takesLattice(input.parameters) // which adds isopoints between predicted ones
          ? std::make_shared<pcl::Indices>(listPoints(input))
          : indices_;
  input.samples = filled_;
}

void
FilledGaps::compareFits(const std::vector<std::uint8_t>& is_in_gap,
                        const IsosurfaceParameters& parameters,
                        IsosurfaceExtraction<pcl::PCLPointCloud2>& extraction,
                        unsigned threads,
                        const ProgressCallback& progress)
{
  extraction.setInterpolation(Interpolation::Fit);
  pcl::PointCloud<PointIso> fits, crossings;
  extraction.extract(fits); // of the same edges
  std::vector<std::uint8_t> are_supported;
  std::vector<float> errors;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (is_in_gap[i] != 0 &&
        stretchedLength(viewOf(samples_->cloud),
                        extraction.getEdges()[i],
                        parameters.scale) <= half_gap * summary_.spacing)
      continue;
    crossings.push_back(fits[i]);
    if (!hasFit(fits[i]))
      crossings.back().error = std::numeric_limits<float>::infinity();
    are_supported.push_back(is_in_gap[i] == 0);
    errors.push_back(fits[i].error);
  }
  const std::vector<Place> places = listPlaces(crossings);
  const auto slopes = findKrigedSlopes(*field_,
                                       places,
                                       slope_step * summary_.spacing,
                                       parameters.scale.cast<double>(),
                                       threads,
                                       progress);
  reliable_fits_ = std::make_unique<ReliableFits>(
      crossings, are_supported, slopes, parameters.scale, summary_.spacing, threads);
  const auto is_reliable = reliable_fits_->find(places, threads);
  std::vector<float> uncertain;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (is_reliable[i] == 0 && are_supported[i] == 0)
      uncertain.push_back(errors[i]);
  if (!uncertain.empty())
    measured_error_ = computeMedian(uncertain);
}

void
FilledGaps::predictBetween(const pcl::PointCloud<PointIso>& roots,
                           const std::vector<std::uint8_t>& is_in_gap,
                           const IsosurfaceParameters& parameters,
                           unsigned threads,
                           Report& report)
{
  const auto is_reliable = reliable_fits_->find(listPlaces(roots), threads);
  pcl::PointCloud<PointIso> seeds;
  std::size_t in_gaps = 0, uncertain = 0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    in_gaps += is_in_gap[i];
    if (is_reliable[i] != 0)
      continue;
    uncertain += is_in_gap[i];
    seeds.push_back(roots[i]);
  }
  if (!areGaps(uncertain, roots.size())) {
    summary_.unfilled =
        "fits to the measured samples are more certain of the surface across "
        "them than kriging is";
    return;
  }
  predict(seeds, parameters, threads, report);
  if (summary_.predicted > 0 && 2 * uncertain < in_gaps)
    report.warn("few_filled_gaps",
                {{"by_fits", in_gaps - uncertain}, {"crossings", in_gaps}});
}

void
FilledGaps::takeVariogram()
{
  const Variogram variogram = field_->findVariogram(0)->model;
  summary_.range = variogram.range;
  summary_.nugget = variogram.nugget;
  summary_.psill = variogram.psill;
}

void
FilledGaps::krigeComposites(const IsosurfaceParameters& parameters,
                            unsigned threads,
                            const ProgressCallback& progress)
{
  const CloudView cloud = viewOf(samples_->cloud);
  const ScalarField field(samples_->cloud.fields, parameters.field);
  const Lattice lattice(summary_.spacing, parameters.scale, *measured_);
  std::vector<Composite> all;
  for (const int index : *indices_) {
    const auto i = static_cast<std::size_t>(index);
    const float* const xyz = cloud.xyz(i);
    const double value = field.read(cloud.point(i));
    const Place place{xyz[0], xyz[1], xyz[2]};
    if (std::isfinite(value) && isFinite(toFloat(place)))
      all.push_back({lattice.cellOf(place), place, value});
  }
  pcl::PointCloud<pcl::PointXYZ> places;
  std::vector<double> values;
  for (const Composite& mean : averageInCells(std::move(all))) {
    const Position place = toFloat(mean.place);
    places.push_back({place[0], place[1], place[2]});
    values.push_back(mean.value);
  }
  Dataset composites;
  pcl::toPCLPointCloud2(places, composites.cloud);
  setField(composites, parameters.field, values);
  pcl::Indices every(values.size());
  std::iota(every.begin(), every.end(), 0);
  InterpolationParameters kriging = gapKriging(parameters);
  kriging.extrapolate = kriging.errors = true;
  Report own;
  own.progress = progress;
  // Drill cores have a few grades of many times the mean, and the mean square of their
  // differences finds a range below the width of the gaps in three of five folds of a
  // hold-out test (tests/benchmarks).
  SampledFields sampled;
  sampled.samples = SampleSet::build(places.points[0].data,
                                     sizeof(pcl::PointXYZ) / sizeof(float),
                                     {every.begin(), every.end()},
                                     toPosition(parameters.scale),
                                     threads,
                                     own);
  sampled.fields = 1;
  for (std::size_t i = 0; i < sampled.samples->size(); ++i)
    sampled.values.push_back(values[sampled.samples->getInputIndex(i)]);
  const Variogram fitted =
      fitVariogram(computeEmpiricalVariograms(sampled,
                                              0,
                                              Eigen::Matrix3d::Identity(),
                                              kriging.kriging.trend,
                                              VariogramEstimator::MeanRoot)
                       .all,
                   {kriging.kriging.variogram, nan, nan, nan});
  kriging.kriging.nugget = fitted.nugget;
  kriging.kriging.psill = fitted.psill;
  kriging.kriging.range = sampled.samples->getUnit().toInput(fitted.range);
  field_ = std::make_unique<FieldInterpolator>(
      viewOf(composites.cloud), every, kriging, threads, own);
  takeVariogram();
}

std::vector<std::uint8_t>
FilledGaps::findThin(const std::vector<Place>& places,
                     unsigned threads,
                     std::vector<double>* distances) const
{
  std::vector<std::uint8_t> thin(places.size());
  if (distances)
    distances->resize(places.size());
  const LengthUnit& unit = measured_->getUnit();
  parallelBlocks(places.size(), gap_block, threads, [&](auto begin, auto end) {
    NearestFinder nearest(*measured_, 1);
    SamplingFinder local(*measured_);
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = nearest.find(unit.apply(toFloat(places[i])), 1.0f);
      thin[i] = local.find(row.samples[0]).dimension != LocalDimension::Volume;
      if (distances)
        (*distances)[i] = unit.toInput(std::sqrt(static_cast<double>(row.sq_dists[0])));
    }
  });
  return thin;
}

std::vector<std::uint8_t>
FilledGaps::findSpacing(const pcl::PointCloud<PointIso>& roots,
                        const IsoEdges& edges,
                        const IsosurfaceParameters& parameters,
                        unsigned threads,
                        const ProgressCallback& progress)
{
  const std::vector<Place> places = listPlaces(roots);
  Report own;
  own.progress = progress;
  const auto support = nearest_->interpolate(places, threads, own).support;
  const auto thin = findThin(places, threads, nullptr);
  const CloudView cloud = viewOf(samples_->cloud);
  std::vector<std::uint8_t> is_in_gap(roots.size(), 0);
  std::size_t in_gaps = 0;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (thin[i] == 0 && support[i] == FieldSupport::Measured)
      continue;
    ++in_gaps;
    is_in_gap[i] = 1;
    lengths.push_back(stretchedLength(cloud, edges[i], parameters.scale));
  }
  has_gaps_ = areGaps(in_gaps, roots.size());
  summary_.unfilled = roots.empty() ? "there is no surface"
                      : has_gaps_ ? "there are too few samples to estimate their width"
                                  : "samples surround the surface";
  summary_.width = has_gaps_ ? findGapWidth(sampling_, std::move(lengths)) : 0.0;
  summary_.spacing = summary_.width / samples_per_gap;
  reach_ = farthest_gaps * summary_.width;
  return is_in_gap;
}

void
FilledGaps::predict(const pcl::PointCloud<PointIso>& roots,
                    const IsosurfaceParameters& parameters,
                    unsigned threads,
                    Report& report)
{
  Report own;
  own.progress = report.progress;
  reach_ = std::min(summary_.range, reach_);
  std::vector<std::pair<LatticeNode, double>> nodes;
  std::size_t kriged = 0;
  for (bool is_complete = false; !is_complete;) {
    const Lattice lattice(summary_.spacing, parameters.scale, *measured_);
    kriged = 0;
    const auto evaluate = [&](const std::vector<LatticeNode>& asked) {
      std::vector<NodeValue> values(asked.size(), {nan, false});
      std::vector<Place> places;
      places.reserve(asked.size());
      for (const LatticeNode& node : asked)
        places.push_back(lattice.placeOf(node));
      std::vector<double> distances;
      const auto thin = findThin(places, threads, &distances);
      std::vector<std::size_t> near;
      std::vector<Place> near_places;
      for (std::size_t i = 0; i < asked.size(); ++i)
        if (distances[i] <= reach_) {
          near.push_back(i);
          near_places.push_back(places[i]);
        }
      const auto is_reliable = reliable_fits_->find(near_places, threads);
      const InterpolatedFields field = field_->interpolate(near_places, threads, own);
      const auto support = nearest_->interpolate(near_places, threads, own).support;
      for (std::size_t j = 0; j < near.size(); ++j) {
        const std::size_t i = near[j];
        const bool is_gap = thin[i] != 0 || support[j] != FieldSupport::Measured ||
                            distances[i] > sampled_part * summary_.spacing;
        const bool is_between =
            hull_->contains(measured_->getUnit().apply(toFloat(places[i])));
        values[i] = {field.values[j],
                     is_gap && is_between && is_reliable[j] == 0 && distances[i] > 0.0};
        kriged += std::isfinite(field.values[j]);
      }
      return values;
    };
    LatticeBand band(evaluate, most_gap_nodes);
    is_complete = true;
    auto root = roots.begin();
    for (const double isovalue : parameters.isovalues) {
      std::vector<LatticeNode> seeds;
      for (; root != roots.end() && root->isovalue == static_cast<float>(isovalue);
           ++root)
        seeds.push_back(lattice.cellOf({root->x, root->y, root->z}));
      is_complete = is_complete && band.follow(seeds, isovalue);
    }
    if (is_complete)
      nodes = band.listNodes();
    else
      summary_.spacing *= 2.0;
  }
  checkMemoryOf("Filling gaps by a lattice",
                nodes.size(),
                gap_node_bytes * static_cast<double>(nodes.size()));
  summary_.predicted = nodes.size();
  summary_.unfilled =
      nodes.empty() ? describeWhyEmpty(summary_, kriged) : std::string();
  if (nodes.empty())
    return;
  report.count("predicted_samples", nodes.size());

  const Lattice lattice(summary_.spacing, parameters.scale, *measured_);
  const ScalarField field(samples_->cloud.fields, parameters.field);
  const CloudView cloud = viewOf(samples_->cloud);
  std::vector<double> values(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i)
    values[i] = field.read(cloud.point(i));
  NearestFinder nearest(*measured_, 1);
  std::vector<std::uint32_t> sources;
  for (const auto& [node, value] : nodes) {
    const Position place = toFloat(lattice.placeOf(node));
    const auto row = nearest.find(measured_->getUnit().apply(place), 1.0f);
    sources.push_back(measured_->getInputIndex(row.samples[0]));
    values.push_back(value);
    indices_->push_back(static_cast<int>(values.size() - 1));
  }
  auto filled = std::make_shared<Dataset>(*samples_);
  appendCopies(sources, filled->cloud);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Place place = lattice.placeOf(nodes[i].first);
    for (std::size_t axis = 0; axis < 3; ++axis)
      putCoordinate(place[axis],
                    axis,
                    &filled->cloud.data[(cloud.count + i) * filled->cloud.point_step]);
  }
  for (const auto& [first, second] : listNeighbors(nodes))
    lattice_edges_.emplace_back(static_cast<std::uint32_t>(cloud.count + first),
                                static_cast<std::uint32_t>(cloud.count + second));
  summary_.sources = std::move(sources);
  setField(*filled, parameters.field, values); // double: integers hold no estimates
  filled_ = filled;
}

} // namespace pcl_uvol::detail
