// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "isosurface/iso_edges.h"
#include "levelset/phi_cloud.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <pcl/common/io.h>

namespace pcl_uvol {

pcl::PCLPointCloud2
detail::addPhi(const CloudView& cloud,
               const pcl::Indices& indices,
               const std::vector<float>& phi,
               unsigned threads,
               Report& report)
{
  const StepTimer timer(report, "fields");
  pcl::PCLPointCloud2 points = makePhiCloud(cloud, phi);
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

} // namespace pcl_uvol
