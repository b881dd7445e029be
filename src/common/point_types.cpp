// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/point_types.h>

#include <pcl/impl/pcl_base.hpp>

template class pcl::PCLBase<PointIso>;
