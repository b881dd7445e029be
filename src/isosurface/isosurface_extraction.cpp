// SPDX-License-Identifier: BSD-3-Clause
#include "common/cloud_fingerprint.h"
#include "common/number_range.h"
#include "common/parameter_json.h"
#include "common/scalar_field.h"
#include "isosurface/iso_edges.h"
#include "isosurface/isopoints.h"
#include "isosurface/piece_isopoints.h"
#include "neighbors/sample_values.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

std::string
IsosurfaceParameters::toJson() const
{
  return writeJson(*this);
}

IsosurfaceParameters
IsosurfaceParameters::fromJson(const std::string& text)
{
  return readJson<IsosurfaceParameters>(text);
}

void
checkParameters(const IsosurfaceParameters& parameters)
{
  if (parameters.isovalues.empty())
    throw InvalidArgument("extraction_without_isovalue", {});
  for (const double isovalue : parameters.isovalues) {
    if (!std::isfinite(isovalue))
      throw InvalidArgument("isovalue_not_finite", {{"isovalue", isovalue}});
    if (std::count(parameters.isovalues.begin(), parameters.isovalues.end(), isovalue) >
        1)
      throw InvalidArgument("repeated_isovalue",
                            {{"isovalue", describeNumbers({isovalue}).front()}});
  }
  for (const float factor : parameters.scale)
    if (!std::isfinite(factor) || factor <= 0.0f)
      throw InvalidArgument("scale_not_positive", {{"scale", factor}});
}

void
IsosurfaceExtractionBase::updateSamples(const CloudView& cloud,
                                        const std::vector<std::uint32_t>& use)
{
  const Eigen::Array3f& scale = parameters_.scale;
  const std::uint64_t fingerprint = computeFingerprint(use);
  if (samples_ && fingerprint == sampled_ && (scale == sampled_scale_).all())
    report_.merge(sampled_report_);
  else {
    Report built;
    built.progress = report_.progress;
    samples_ = SampleSet::build(
        cloud.xyz(0), cloud.stride(), use, toPosition(scale), threads_, built);
    candidates_.reset();
    report_.merge(built);
    sampled_report_ = built;
    sampled_report_.milliseconds.clear();
    sampled_ = fingerprint;
    sampled_scale_ = scale;
  }
}

struct IsosurfaceExtractionBase::Scalar {
  std::string field;
  std::uint64_t indices; // their fingerprint
  Eigen::Array3f scale;
  std::uint64_t fingerprint; // of the values that were read
  ValueFrame frame;
  SampleValues samples; // values in the frame
  NodeRanges ranges;    // refers to the values of samples
  Report read;          // of what was read
};

void
IsosurfaceExtractionBase::forgetSamples()
{
  samples_.reset();
  candidates_.reset();
  scalar_.reset();
}

void
SurfaceTally::add(const SurfaceTally& other)
{
  crossing += other.crossing;
  spikes += other.spikes;
  contradicted += other.contradicted;
  examined += other.examined;
  examined_bridged += other.examined_bridged;
  examined_rim += other.examined_rim;
}

void
IsosurfaceExtractionBase::updateScalar(const CloudView& cloud,
                                       const pcl::Indices& indices)
{
  const ScalarField field(cloud.fields, parameters_.field);
  const CloudFingerprint fingerprint = computeFingerprint(cloud, field, threads_);
  if (fingerprint.positions != sampled_fingerprint_)
    forgetSamples();
  sampled_fingerprint_ = fingerprint.positions;
  const std::uint64_t chosen = computeFingerprint(indices);
  if (scalar_ && scalar_->field == parameters_.field && scalar_->indices == chosen &&
      (scalar_->scale == parameters_.scale).all() &&
      scalar_->fingerprint == fingerprint.values) {
    report_.merge(scalar_->read);
    return;
  }
  scalar_.reset(); // of other samples, should what follows fail
  ValueFrame frame;
  std::vector<float> values;
  std::vector<std::uint32_t> use;
  {
    const StepTimer timer(report_, "scalar");
    frame = findValueRange(cloud, field, threads_).findFrame();
    values = readValues(cloud, field, frame, threads_);
    use = pointsWithValue(values, indices, field);
  }
  const std::uint64_t without_value = indices.size() - use.size();
  updateSamples(cloud, use);
  use = std::vector<std::uint32_t>(); // what follows takes its memory
  report_.countSamples("no_value", without_value);
  report_.countSamples("samples", samples_->size());

  const StepTimer timer(report_, "ranges");
  auto scalar = std::make_shared<Scalar>();
  scalar->field = parameters_.field;
  scalar->indices = chosen;
  scalar->scale = parameters_.scale;
  scalar->fingerprint = fingerprint.values;
  scalar->frame = frame;
  scalar->samples = gatherValues(*samples_, values, threads_, report_);
  scalar->ranges = samples_->getTree().computeRanges(scalar->samples.values, threads_);
  scalar->read.merge(report_);
  scalar->read.milliseconds.clear();
  scalar_ = scalar;
}

void
IsosurfaceExtractionBase::updateCandidates()
{
  if (candidates_ && candidate_source_ == parameters_.neighbors &&
      candidate_cells_ == parameters_.voronoi_cells)
    return;
  candidates_ = makeCandidates(
      *samples_, parameters_.neighbors, parameters_.voronoi_cells, threads_, report_);
  candidate_source_ = parameters_.neighbors;
  candidate_cells_ = parameters_.voronoi_cells;
}

void
IsosurfaceExtractionBase::extractFrom(const CloudView& cloud,
                                      const pcl::Indices& indices,
                                      pcl::PointCloud<PointIso>& isopoints)
{
  checkParameters(parameters_);
  detail::checkIndices(indices, cloud.count, "IsosurfaceExtraction");
  startReport();
  tally_ = {};
  updateScalar(cloud, indices);
  updateCandidates();

  const NodeRanges::Range range = scalar_->ranges[samples_->getTree().getRoot()];
  const IsopointInput input{*samples_,
                            scalar_->samples.values,
                            scalar_->ranges,
                            *candidates_,
                            parameters_.criterion,
                            parameters_.outside,
                            parameters_.interpolation,
                            threads_,
                            parameters_.errors_only};
  pcl::PointCloud<PointIso> found;
  IsoEdges edges;
  for (const double isovalue : parameters_.isovalues) {
    const auto rounded = static_cast<float>(scalar_->frame.apply(isovalue));
    warnIfOutside(isovalue, parameters_.field, range, scalar_->frame, report_);
    const std::size_t first = found.size();
    appendIsopoints(
        input, scalar_->samples.sources, rounded, found, edges, tally_, report_);
    for (std::size_t i = first; i < found.size(); ++i)
      found[i].isovalue = static_cast<float>(isovalue);
  }
  report_.count("isopoints", found.size());
  isopoints.swap(found);
  edges_.swap(edges);
}

void
IsosurfaceExtractionBase::extractFrom(const CloudView& cloud,
                                      const pcl::Indices& indices,
                                      pcl::PCLPointCloud2& isopoints)
{
  pcl::PointCloud<PointIso> found;
  extractFrom(cloud, indices, found);
  pcl::PCLPointCloud2 with_fields;
  pcl::toPCLPointCloud2(found, with_fields);
  warnOfReplacedFields(cloud.fields, with_fields.fields, report_);
  interpolateFields(cloud, edges_, with_fields, threads_);
  isopoints = std::move(with_fields);
}

} // namespace pcl_uvol
