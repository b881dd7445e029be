// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/memory_need.h"

#include "common/random.h"
#include "isosurface/isopoints.h"
#include "neighbors/memory_need.h"
#include "neighbors/neighbor_candidates.h"
#include "neighbors/sample_values.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cmath>
#include <cstring>
#include <numeric>

namespace pcl_uvol {

namespace {

/** Samples of a thinned cloud: they resolve details of a tenth of its extent, and cost
 * some milliseconds. */
constexpr std::size_t thinned_samples = 1u << 14;

constexpr double float_bytes = sizeof(float), index_bytes = sizeof(std::uint32_t);
constexpr double isopoint_bytes = sizeof(PointIso) + sizeof(IsoEdge);
constexpr double key_bytes = sizeof(std::uint64_t); // of an edge on its way

/** Points at random, of which some may come twice. */
pcl::PCLPointCloud2::Ptr
thin(const CloudView& cloud)
{
  pcl::PCLPointCloud2::Ptr thinned(new pcl::PCLPointCloud2);
  thinned->fields = cloud.fields;
  thinned->height = 1;
  thinned->width = static_cast<pcl::uindex_t>(std::min(cloud.count, thinned_samples));
  thinned->point_step = static_cast<pcl::uindex_t>(cloud.point_step);
  thinned->row_step = thinned->point_step * thinned->width;
  thinned->data.resize(thinned->row_step);
  for (std::size_t i = 0; i < thinned->width; ++i)
    std::memcpy(
        &thinned->data[i * cloud.point_step],
        cloud.point(cloud.count > thinned_samples ? mixBits(i) % cloud.count : i),
        cloud.point_step);
  return thinned;
}

/** A thinned cloud, ready to be asked how many samples and edges an isovalue meets. */
class ThinnedSamples {
public:
  ThinnedSamples(const pcl::PCLPointCloud2& cloud,
                 const IsosurfaceParameters& parameters,
                 unsigned threads)
      : parameters_(parameters)
      , threads_(threads)
  {
    const CloudView view = viewOf(cloud);
    const ScalarField field(view.fields, parameters.field);
    frame_ = findValueRange(view, field, threads).findFrame();
    const std::vector<float> values = readValues(view, field, frame_, threads);
    pcl::Indices all(view.count);
    std::iota(all.begin(), all.end(), 0);
    samples_ = SampleSet::build(view.xyz(0),
                                view.stride(),
                                pointsWithValue(values, all, field),
                                toPosition(parameters.scale),
                                threads,
                                report_);
    values_ = gatherValues(*samples_, values, threads, report_).values;
    ranges_ = samples_->getTree().computeRanges(values_, threads);
    candidates_ = makeCandidates(
        *samples_, parameters.neighbors, parameters.voronoi_cells, threads, report_);
  }

  std::size_t
  size() const
  {
    return samples_->size();
  }

  SurfaceSize
  count(double isovalue)
  {
    const IsopointInput input{*samples_,
                              values_,
                              ranges_,
                              *candidates_,
                              parameters_.criterion,
                              parameters_.outside,
                              Interpolation::Linear,
                              threads_};
    const auto rounded = static_cast<float>(frame_.apply(isovalue));
    const std::vector<std::uint32_t> crossing =
        candidates_->findCrossing(ranges_, rounded, threads_);
    const std::vector<EdgeKey> edges = findEdges(input, crossing, rounded, report_);
    return {static_cast<double>(crossing.size()), static_cast<double>(edges.size())};
  }

private:
  const IsosurfaceParameters& parameters_;
  unsigned threads_;
  Report report_; // nobody asks
  ValueFrame frame_;
  SampleSet::ConstPtr samples_;
  std::vector<float> values_;
  NodeRanges ranges_;
  NeighborCandidates::ConstPtr candidates_;
};

} // namespace

std::vector<SurfaceSize>
estimateSurfaces(const CloudView& cloud,
                 const IsosurfaceParameters& parameters,
                 unsigned threads)
{
  std::vector<SurfaceSize> surfaces(parameters.isovalues.size());
  if (cloud.count == 0)
    return surfaces;
  try {
    checkParameters(parameters);
    const pcl::PCLPointCloud2::ConstPtr thinned = thin(cloud);
    ThinnedSamples samples(*thinned, parameters, threads);
    const double factor =
        std::pow(static_cast<double>(cloud.count) / static_cast<double>(samples.size()),
                 2.0 / 3.0);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const SurfaceSize size = samples.count(parameters.isovalues[i]);
      surfaces[i] = {factor * size.crossing, factor * size.isopoints};
    }
  }
  catch (const InvalidArgument&) {
    return surfaces; // the extraction of the whole cloud will tell what is wrong
  }
  return surfaces;
}

SurfaceSize
allowForDetail(const SurfaceSize& estimated)
{
  // Samples next to surfaces, and isopoints, were 0.8 to 1.2 times as many as
  // estimated, of a CT scan 1.5 and 1.2.
  constexpr double finer_detail = 1.1;
  return {finer_detail * estimated.crossing, finer_detail * estimated.isopoints};
}

double
extractionBytes(double samples)
{
  // With the indices of the points.
  return index_bytes * samples + sampleSetNeed(samples).kept +
         (float_bytes + index_bytes) * samples + nodeRangesBytes(samples);
}

MemoryNeed
isosurfaceNeed(double samples, const std::vector<SurfaceSize>& surfaces)
{
  MemoryForecast forecast(0.0);
  // The scalar as it lies in the cloud and the points with a value, beside the tree
  // while that is built; then the scalar beside all that remains.
  const MemoryNeed of_tree = sampleSetNeed(samples);
  const double of_scalar = float_bytes * samples, remaining = extractionBytes(samples);
  forecast.run({of_scalar + 2.0 * index_bytes * samples + of_tree.peak, 0.0});
  forecast.run({of_scalar + remaining, remaining});
  double kept = 0.0;
  for (const SurfaceSize& surface : surfaces) {
    const double count = surface.isopoints;
    const double own =
        index_bytes * surface.crossing + (key_bytes + isopoint_bytes) * count;
    // Those that fall together are sorted out, which takes a half again to merge. Then
    // they join those of the isovalues before.
    const double sorting = (1.5 * sizeof(SampleRecord) + 1.0) * count;
    const double joined = kept + isopoint_bytes * count;
    forecast.run({own + std::max(sorting, joined), isopoint_bytes * count});
    kept = joined;
  }
  forecast.hold(kept / isopoint_bytes * sizeof(IsoEdge)); // a copy for the caller
  return {forecast.getPeak(), kept};
}

} // namespace pcl_uvol
