// SPDX-License-Identifier: BSD-3-Clause
// PCL's kd-tree by FLANN for isopoints. A unit of its own: FLANN takes much memory to
// compile.
#include <pcl_uvol/common/point_types.h>

#include <pcl/kdtree/impl/kdtree_flann.hpp>

// Bases first: what a derived class instantiates takes no attributes any more.
template class PCL_UVOL_EXPORTS pcl::KdTree<pcl_uvol::PointIso>;
template class PCL_UVOL_EXPORTS pcl::KdTreeFLANN<pcl_uvol::PointIso>;
