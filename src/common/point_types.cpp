// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/point_types.h>

#include <pcl/impl/pcl_base.hpp>
#include <pcl/kdtree/impl/kdtree_flann.hpp>
#include <pcl/search/impl/kdtree.hpp>
#include <pcl/search/impl/search.hpp>

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

// Bases first: what a derived class instantiates takes no attributes any more.
template class pcl::PCLBase<pcl_uvol::PointIso>;
template class PCL_UVOL_EXPORTS pcl::search::Search<pcl_uvol::PointIso>;
template class PCL_UVOL_EXPORTS pcl::KdTree<pcl_uvol::PointIso>;
template class PCL_UVOL_EXPORTS pcl::KdTreeFLANN<pcl_uvol::PointIso>;
template class PCL_UVOL_EXPORTS pcl::search::KdTree<pcl_uvol::PointIso>;
