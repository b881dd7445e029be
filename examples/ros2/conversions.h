// SPDX-License-Identifier: BSD-3-Clause
// Between messages of ROS 2 and the library. The messages are template parameters, so
// that this compiles, and is tested, where ROS is not installed.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/point_types.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/point_cloud.h>

#include <cstddef>
#include <vector>

namespace uvol_ros {

/** \brief A sensor_msgs/PointCloud2 as PCL has it; the stamp stays with the message. */
template <typename Message>
pcl::PCLPointCloud2
toPcl(const Message& message)
{
  pcl::PCLPointCloud2 cloud;
  cloud.header.frame_id = message.header.frame_id;
  cloud.width = message.width;
  cloud.height = message.height;
  cloud.point_step = message.point_step;
  cloud.row_step = message.row_step;
  cloud.is_bigendian = message.is_bigendian;
  cloud.is_dense = message.is_dense;
  for (const auto& field : message.fields) {
    pcl::PCLPointField copy;
    copy.name = field.name;
    copy.offset = field.offset;
    copy.datatype = field.datatype; // PCL took ROS's numbers
    copy.count = field.count;
    cloud.fields.push_back(copy);
  }
  cloud.data.assign(message.data.begin(), message.data.end());
  return cloud;
}

/** \brief The other way round.
 * \param header of the samples */
template <typename Message, typename Header>
void
fromPcl(const pcl::PCLPointCloud2& cloud, const Header& header, Message& message)
{
  message.header = header;
  message.width = cloud.width;
  message.height = cloud.height;
  message.point_step = cloud.point_step;
  message.row_step = cloud.row_step;
  message.is_bigendian = cloud.is_bigendian;
  message.is_dense = cloud.is_dense;
  message.fields.resize(cloud.fields.size());
  for (std::size_t i = 0; i < cloud.fields.size(); ++i) {
    message.fields[i].name = cloud.fields[i].name;
    message.fields[i].offset = cloud.fields[i].offset;
    message.fields[i].datatype = cloud.fields[i].datatype;
    message.fields[i].count = cloud.fields[i].count;
  }
  message.data.assign(cloud.data.begin(), cloud.data.end());
}

/** \brief Seconds of a builtin_interfaces/Time. */
template <typename Time>
double
toSeconds(const Time& stamp)
{
  return static_cast<double>(stamp.sec) + 1e-9 * static_cast<double>(stamp.nanosec);
}

/** \brief The corners of triangles, three by three, as a visualization_msgs/Marker of
 * the kind TRIANGLE_LIST has them. */
template <typename Marker>
void
putTriangles(const pcl::PointCloud<pcl_uvol::PointIso>& vertices,
             const std::vector<pcl_uvol::Triangle>& triangles,
             Marker& marker)
{
  marker.points.clear();
  marker.points.reserve(3 * triangles.size());
  for (const pcl_uvol::Triangle& triangle : triangles)
    for (const auto vertex : triangle) {
      auto& corner = marker.points.emplace_back();
      corner.x = vertices[vertex].x;
      corner.y = vertices[vertex].y;
      corner.z = vertices[vertex].z;
    }
}

} // namespace uvol_ros
