// SPDX-License-Identifier: BSD-3-Clause
#include "surface/dataset_normals.h"

#include "common/records.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/conversions.h>

#include <numeric>

namespace pcl_uvol {

Dataset
estimateNormals(const Dataset& points,
                SurfaceNormalParameters parameters,
                unsigned threads,
                Report& report)
{
  const CloudView view = viewOf(points.cloud);
  detail::warnOfUnsetViewPoint(view, parameters, report);
  parameters.view_point = parameters.view_point.value_or(Eigen::Array3d::Zero()) -
                          Eigen::Array3d(points.origin.data());
  SurfaceNormalEstimation<pcl::PCLPointCloud2, pcl::PointNormal> estimation;
  estimation.setInputCloud(
      pcl::PCLPointCloud2::ConstPtr(&points.cloud, [](const void*) {}));
  estimation.setParameters(parameters);
  estimation.setNumberOfThreads(threads);
  estimation.setProgressCallback(report.progress);
  pcl::PointCloud<pcl::PointNormal> normals;
  estimation.compute(normals);
  report.merge(estimation.getReport());
  for (std::size_t i = 0; i < normals.size(); ++i)
    normals[i].getVector3fMap() = Eigen::Vector3f(view.xyz(i));
  std::vector<std::uint32_t> all(normals.size());
  std::iota(all.begin(), all.end(), 0u);
  Dataset result = withoutCloud(points);
  pcl::toPCLPointCloud2(normals, result.cloud);
  copyFields(points.cloud, all, result.cloud, threads);
  return result;
}

} // namespace pcl_uvol
