// SPDX-License-Identifier: BSD-3-Clause
// A component of ROS 2: samples come in as PointCloud2, isopoints go out as PointCloud2
// and the mesh as a MarkerArray, while more samples come.
#include "conversions.h"
#include "sample_map.h"
#include <pcl_uvol/mesh/surface_mesh.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <chrono>
#include <future>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <sensor_msgs/msg/point_cloud2.hpp>
#include <visualization_msgs/msg/marker_array.hpp>

namespace uvol_ros {

using PointCloud2 = sensor_msgs::msg::PointCloud2;
using MarkerArray = visualization_msgs::msg::MarkerArray;
using Map = SampleMap<pcl::PointXYZI>;

class IsosurfaceNode : public rclcpp::Node {
public:
  explicit IsosurfaceNode(const rclcpp::NodeOptions& options)
      : Node("isosurface", options)
      , map_(declareMap())
      , has_mesh_(declare_parameter("mesh", true))
  {
    parameters_.isovalues = {declare_parameter("isovalue", 0.5)};
    parameters_.field = "intensity";
    isopoints_ = create_publisher<PointCloud2>("isopoints", 1);
    markers_ = create_publisher<MarkerArray>("mesh", 1);
    samples_ = create_subscription<PointCloud2>(
        "samples", rclcpp::SensorDataQoS(), [this](const PointCloud2& message) {
          append(message);
        });
    timer_ = create_wall_timer(
        std::chrono::milliseconds(declare_parameter("period_ms", 100)),
        [this] { update(); });
  }

private:
  struct Surface {
    SampleMapSurface<pcl::PointXYZI> points;
    pcl_uvol::SurfaceTriangles mesh;
  };

  SampleMapParameters
  declareMap()
  {
    SampleMapParameters parameters;
    parameters.window = declare_parameter("window_s", 10.0);
    parameters.most_samples =
        static_cast<std::size_t>(declare_parameter("most_samples", 100000));
    return parameters;
  }

  void
  append(const PointCloud2& message)
  {
    pcl::PointCloud<pcl::PointXYZI> cloud;
    pcl::fromPCLPointCloud2(toPcl(message), cloud);
    header_ = message.header;
    map_.append(cloud, toSeconds(message.header.stamp));
  }

  /** Publish the surface that is ready, and begin the next one. */
  void
  update()
  {
    if (pending_.valid()) {
      if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
      try {
        publish(pending_.get());
      }
      catch (const pcl_uvol::Exception& error) {
        RCLCPP_WARN(get_logger(), "%s", error.message().c_str());
      }
    }
    if (map_.size() == 0)
      return;
    pending_header_ = header_;
    pending_ = std::async(std::launch::async, [this] {
      Surface surface{map_.extract(parameters_), {}};
      if (has_mesh_ && !surface.points.isopoints.empty()) {
        pcl_uvol::SurfaceMesh<pcl::PointXYZI> mesher;
        mesher.setInputCloud(surface.points.samples);
        pcl_uvol::SurfaceMeshParameters meshing;
        meshing.isosurface = parameters_;
        mesher.setParameters(meshing);
        mesher.extract(surface.mesh);
      }
      return surface;
    });
  }

  void
  publish(const Surface& surface)
  {
    pcl::PCLPointCloud2 cloud;
    pcl::toPCLPointCloud2(surface.points.isopoints, cloud);
    PointCloud2 message;
    fromPcl(cloud, pending_header_, message);
    isopoints_->publish(message);
    if (!has_mesh_)
      return;
    visualization_msgs::msg::Marker marker;
    marker.header = pending_header_;
    marker.ns = "isosurface";
    marker.type = visualization_msgs::msg::Marker::TRIANGLE_LIST;
    marker.action = surface.mesh.triangles.empty()
                        ? visualization_msgs::msg::Marker::DELETE
                        : visualization_msgs::msg::Marker::ADD;
    marker.pose.orientation.w = 1.0;
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
    marker.color.r = marker.color.g = marker.color.b = 0.7f;
    marker.color.a = 1.0f;
    putTriangles(surface.mesh.vertices, surface.mesh.triangles, marker);
    MarkerArray all;
    all.markers.push_back(marker);
    markers_->publish(all);
  }

  Map map_;
  const bool has_mesh_;
  pcl_uvol::IsosurfaceParameters parameters_;
  std_msgs::msg::Header header_, pending_header_;
  rclcpp::Publisher<PointCloud2>::SharedPtr isopoints_;
  rclcpp::Publisher<MarkerArray>::SharedPtr markers_;
  rclcpp::Subscription<PointCloud2>::SharedPtr samples_;
  rclcpp::TimerBase::SharedPtr timer_;
  std::future<Surface> pending_; // the last member: its thread uses the others
};

} // namespace uvol_ros

RCLCPP_COMPONENTS_REGISTER_NODE(uvol_ros::IsosurfaceNode)
