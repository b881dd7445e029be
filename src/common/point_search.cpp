// SPDX-License-Identifier: BSD-3-Clause
// PCL's searches for isopoints. The tree below them is compiled in point_kdtree.cpp:
// both in one unit take too much memory.
#include <pcl_uvol/common/point_types.h>

#include <pcl/kdtree/impl/kdtree_flann.hpp>
#include <pcl/search/impl/kdtree.hpp>
#include <pcl/search/impl/search.hpp>

extern template class PCL_UVOL_EXPORTS pcl::KdTree<pcl_uvol::PointIso>;
extern template class PCL_UVOL_EXPORTS pcl::KdTreeFLANN<pcl_uvol::PointIso>;

// Bases first: what a derived class instantiates takes no attributes any more.
template class PCL_UVOL_EXPORTS pcl::search::Search<pcl_uvol::PointIso>;
template class PCL_UVOL_EXPORTS pcl::search::KdTree<pcl_uvol::PointIso>;
