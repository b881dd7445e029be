// SPDX-License-Identifier: BSD-3-Clause
#include "isosurface/memory_need.h"

#include "common/random.h"
#include "neighbors/kd_tree.h"
#include "neighbors/memory_need.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cmath>
#include <cstring>

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

} // namespace

std::vector<SurfaceSize>
estimateSurfaces(const CloudView& cloud,
                 const IsosurfaceParameters& parameters,
                 unsigned threads)
{
  const std::vector<double>& isovalues = parameters.isovalues;
  std::vector<SurfaceSize> surfaces(isovalues.size());
  if (cloud.count == 0)
    return surfaces;
  IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setInputCloud(thin(cloud));
  extraction.setParameters(parameters);
  extraction.setNeighborSource(parameters.neighbors); // cells by the number of samples
  extraction.setInterpolation(Interpolation::Linear);
  extraction.setNumberOfThreads(threads);
  pcl::PointCloud<PointIso> isopoints;
  for (std::size_t i = 0; i < isovalues.size(); ++i) {
    extraction.setIsoValue(isovalues[i]);
    try {
      extraction.extract(isopoints);
    }
    catch (const InvalidArgument&) {
      return surfaces; // the extraction of the whole cloud will tell what is wrong
    }
    const Report& report = extraction.getReport();
    const double factor = std::pow(static_cast<double>(cloud.count) /
                                       static_cast<double>(report.getCount("samples")),
                                   2.0 / 3.0);
    surfaces[i] = {factor * static_cast<double>(report.getCount("crossing_samples")),
                   factor * static_cast<double>(report.getCount("edges"))};
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
  // Indices of the points: those given, those with a value, and those remembered.
  return 3.0 * index_bytes * samples + sampleSetNeed(samples).kept +
         (float_bytes + index_bytes) * samples + nodeRangesBytes(samples);
}

MemoryNeed
isosurfaceNeed(double samples, const std::vector<SurfaceSize>& surfaces)
{
  MemoryForecast forecast(0.0);
  // The scalar as it lies in the cloud, beside the tree while that is built, and beside
  // all that remains.
  const MemoryNeed of_tree = sampleSetNeed(samples);
  const double of_scalar = float_bytes * samples, remaining = extractionBytes(samples);
  forecast.run({of_scalar + 3.0 * index_bytes * samples + of_tree.peak, 0.0});
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
