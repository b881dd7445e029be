// SPDX-License-Identifier: BSD-3-Clause
// The conversions of the example for ROS 2, on messages of the same members.
#include "../../examples/ros2/conversions.h"

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <string>

namespace test_ros_conversions {

struct Stamp {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};

struct Header {
  Stamp stamp;
  std::string frame_id;
};

struct Field {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
  std::uint32_t count = 0;
};

struct CloudMessage {
  Header header;
  std::uint32_t height = 0, width = 0;
  std::vector<Field> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = false;
};

struct MarkerMessage {
  struct Corner {
    double x, y, z;
  };
  std::vector<Corner> points;
};

TEST(RosConversions, CloudsComeBackAsTheyWere)
{
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int i = 0; i < 5; ++i) {
    pcl::PointXYZI point;
    point.x = static_cast<float>(i);
    point.y = -2.0f * static_cast<float>(i);
    point.z = 0.5f;
    point.intensity = 10.0f + static_cast<float>(i);
    cloud.push_back(point);
  }
  pcl::PCLPointCloud2 records;
  pcl::toPCLPointCloud2(cloud, records);
  CloudMessage message;
  uvol_ros::fromPcl(records, Header{{3, 500000000}, "map"}, message);
  EXPECT_EQ(5u, message.width);
  EXPECT_EQ("map", message.header.frame_id);
  EXPECT_EQ(3.5, uvol_ros::toSeconds(message.header.stamp));
  const pcl::PCLPointCloud2 back = uvol_ros::toPcl(message);
  EXPECT_EQ("map", back.header.frame_id);
  EXPECT_EQ(records.data, back.data);
  pcl::PointCloud<pcl::PointXYZI> points;
  pcl::fromPCLPointCloud2(back, points);
  ASSERT_EQ(5u, points.size());
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(cloud[i].y, points[i].y);
    EXPECT_EQ(cloud[i].intensity, points[i].intensity);
  }
}

TEST(RosConversions, TrianglesBecomeCorners)
{
  pcl::PointCloud<pcl_uvol::PointIso> vertices;
  for (int i = 0; i < 4; ++i) {
    pcl_uvol::PointIso vertex;
    vertex.x = static_cast<float>(i);
    vertex.y = 0.0f;
    vertex.z = -1.0f;
    vertices.push_back(vertex);
  }
  MarkerMessage marker;
  marker.points.resize(2);
  uvol_ros::putTriangles(vertices, {{0, 1, 2}, {2, 1, 3}}, marker);
  ASSERT_EQ(6u, marker.points.size());
  EXPECT_EQ(2.0, marker.points[3].x);
  EXPECT_EQ(3.0, marker.points[5].x);
  EXPECT_EQ(-1.0, marker.points[0].z);
}

} // namespace test_ros_conversions
