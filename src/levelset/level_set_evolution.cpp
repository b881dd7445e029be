// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_json.h"
#include "common/records.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <pcl/common/io.h>

#include <cstring>

namespace pcl_uvol {

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
