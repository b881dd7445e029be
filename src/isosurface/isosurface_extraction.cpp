// SPDX-License-Identifier: BSD-3-Clause
#include "../neighbors/sample_values.h"
#include "isopoints.h"
#include <pcl_uvol/common/scalar_field.h>
#include <pcl_uvol/isosurface/impl/isosurface_extraction.hpp>
#include <pcl_uvol/isosurface/piece_isopoints.h>

#include <pcl/impl/pcl_base.hpp>

#include <cmath>

namespace pcl_uvol {

void
checkSettings(const IsosurfaceSettings& settings)
{
  if (settings.isovalues.empty())
    throw InvalidArgument(
        "IsosurfaceExtraction has no isovalue: call setIsoValue or setIsoValues.");
  for (const double isovalue : settings.isovalues)
    if (!std::isfinite(static_cast<float>(isovalue)))
      throw InvalidArgument("The isovalue " + std::to_string(isovalue) +
                            " is not a finite number.");
  for (const float factor : settings.scale.x)
    if (!std::isfinite(factor) || factor <= 0.0f)
      throw InvalidArgument("The scale " + std::to_string(factor) +
                            " is not allowed: it must be finite and positive.");
}

void
IsosurfaceExtractionBase::updateSamples(const CloudView& cloud,
                                        std::vector<std::uint32_t>&& use)
{
  if (samples_ && use == sampled_ && (scale_ == sampled_scale_).all())
    report_.counts = sampled_report_.counts;
  else {
    Report built;
    built.progress = report_.progress;
    samples_ = SampleSet::build(cloud.xyz(0),
                                cloud.stride(),
                                use,
                                Position{{scale_[0], scale_[1], scale_[2]}},
                                threads_,
                                built);
    candidates_.reset();
    report_.merge(built);
    sampled_report_ = built;
    sampled_ = std::move(use);
    sampled_scale_ = scale_;
  }
}

struct IsosurfaceExtractionBase::Scalar {
  std::string field;
  std::vector<int> indices;
  Eigen::Array3f scale;
  SampleValues samples;
  NodeRanges ranges; // refers to the values of samples
  Report counts;     // of what was read
};

void
IsosurfaceExtractionBase::forgetSamples()
{
  samples_.reset();
  candidates_.reset();
  scalar_.reset();
}

void
IsosurfaceExtractionBase::updateScalar(const CloudView& cloud,
                                       const std::vector<int>& indices)
{
  if (scalar_ && scalar_->field == field_ && scalar_->indices == indices &&
      (scalar_->scale == scale_).all()) {
    report_.counts = scalar_->counts.counts;
    return;
  }
  scalar_.reset(); // of other samples, should what follows fail
  const ScalarField field(cloud.fields, field_);
  std::vector<float> values;
  std::vector<std::uint32_t> use;
  {
    const StepTimer timer(report_, "scalar");
    values = readValues(cloud, field, threads_);
    use = pointsWithValue(values, indices, field);
  }
  const std::uint64_t without_value = indices.size() - use.size();
  updateSamples(cloud, std::move(use));
  report_.count("no_value", without_value);
  report_.count("samples", samples_->size());

  const StepTimer timer(report_, "ranges");
  auto scalar = std::make_shared<Scalar>();
  scalar->field = field_;
  scalar->indices = indices;
  scalar->scale = scale_;
  scalar->samples = gatherValues(*samples_, values, threads_, report_);
  scalar->ranges = samples_->getTree().computeRanges(scalar->samples.values, threads_);
  scalar->counts.counts = report_.counts;
  scalar_ = scalar;
}

void
IsosurfaceExtractionBase::extractFrom(const CloudView& cloud,
                                      const std::vector<int>& indices,
                                      pcl::PointCloud<PointIso>& isopoints)
{
  IsosurfaceSettings settings;
  settings.isovalues = isovalues_;
  settings.scale = {{scale_[0], scale_[1], scale_[2]}};
  checkSettings(settings);
  if (indices.empty())
    throw InvalidArgument("IsosurfaceExtraction was given an empty cloud.");
  startReport();
  updateScalar(cloud, indices);
  if (!candidates_)
    candidates_ = makeCandidates(*samples_, voronoi_, threads_, report_);

  const NodeRanges::Range range = scalar_->ranges[samples_->getTree().getRoot()];
  const IsopointInput input{*samples_,
                            scalar_->samples.values,
                            scalar_->ranges,
                            *candidates_,
                            criterion_,
                            outside_,
                            interpolation_,
                            threads_};
  pcl::PointCloud<PointIso> found;
  IsoEdges edges;
  for (const double isovalue : isovalues_) {
    const auto rounded = static_cast<float>(isovalue);
    warnIfOutside(isovalue, field_, range, report_);
    appendIsopoints(input, scalar_->samples.sources, rounded, found, edges, report_);
  }
  report_.count("isopoints", found.size());
  isopoints.swap(found);
  edges_.swap(edges);
}

template class PCL_UVOL_EXPORTS IsosurfaceExtraction<pcl::PointXYZI>;
template class PCL_UVOL_EXPORTS IsosurfaceExtraction<pcl::PCLPointCloud2>;

} // namespace pcl_uvol
