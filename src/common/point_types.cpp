// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/point_types.h>

#include <pcl/impl/pcl_base.hpp>

namespace pcl_uvol {

pcl::PointCloud<pcl::PointNormal>
toPointNormal(const pcl::PointCloud<PointIso>& isopoints)
{
  pcl::PointCloud<pcl::PointNormal> points;
  points.header = isopoints.header;
  points.reserve(isopoints.size());
  for (const PointIso& isopoint : isopoints)
    points.push_back({isopoint.x,
                      isopoint.y,
                      isopoint.z,
                      isopoint.normal_x,
                      isopoint.normal_y,
                      isopoint.normal_z,
                      isopoint.mean_curvature});
  points.is_dense = isopoints.is_dense;
  return points;
}

} // namespace pcl_uvol

template class pcl::PCLBase<pcl_uvol::PointIso>;
