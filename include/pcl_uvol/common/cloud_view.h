// SPDX-License-Identifier: BSD-3-Clause
// A cloud of any point type as bytes and fields: what the plain kernels read.
#pragma once

#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/common/io.h>
#include <pcl/point_cloud.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Refers to a cloud, which must outlive it. x, y, z are consecutive floats. */
struct PCL_UVOL_EXPORTS CloudView {
  const std::uint8_t* data = nullptr;
  std::size_t count = 0;
  std::size_t point_step = 0; ///< bytes from point to point, a multiple of 4
  std::size_t xyz_offset = 0; ///< bytes from the start of a point to x, a multiple of 4
  std::vector<pcl::PCLPointField> fields;

  const std::uint8_t*
  point(std::size_t index) const
  {
    return data + index * point_step;
  }

  const float*
  xyz(std::size_t index) const
  {
    return reinterpret_cast<const float*>(point(index) + xyz_offset);
  }

  /** \brief Floats from one point's x to the next one's. */
  std::size_t
  stride() const
  {
    return point_step / sizeof(float);
  }
};

/** \brief View of a cloud of a registered point type. */
template <typename PointT>
CloudView
viewOf(const pcl::PointCloud<PointT>& cloud)
{
  CloudView view;
  view.data = reinterpret_cast<const std::uint8_t*>(cloud.points.data());
  view.count = cloud.size();
  view.point_step = sizeof(PointT);
  view.xyz_offset = offsetof(PointT, x);
  view.fields = pcl::getFields<PointT>();
  return view;
}

/** \brief View of a cloud with fields known at run time only.
 * \throws InvalidArgument unless x, y, z are consecutive aligned float32 fields and the
 * data is as large as width * height says */
PCL_UVOL_EXPORTS CloudView
viewOf(const pcl::PCLPointCloud2& cloud);

} // namespace pcl_uvol
