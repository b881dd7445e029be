// SPDX-License-Identifier: BSD-3-Clause
// Fields whose isosurfaces have a known shape, sampled with a mean spacing of 1, and
// their meshes.
#pragma once

#include <pcl_uvol/mesh/surface_mesh.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace uvol_test {

/** \brief A field in a cube from the origin, higher inside of its surface at 0. */
struct MeshField {
  std::string name;
  std::function<double(const Eigen::Vector3d&)> value;
  double side;
  std::size_t pieces, handles;
  double volume = 0.0; ///< of the enclosed space; 0: not known
};

inline MeshField
sphereField(double radius)
{
  const double side = 2.0 * radius + 6.0;
  const Eigen::Vector3d center = Eigen::Vector3d::Constant(0.5 * side);
  return {"sphere",
          [=](const Eigen::Vector3d& x) { return radius - (x - center).norm(); },
          side,
          1,
          0,
          4.0 / 3.0 * M_PI * std::pow(radius, 3)};
}

inline MeshField
torusField(double large, double small)
{
  const double side = 2.0 * (large + small) + 6.0;
  const Eigen::Vector3d center = Eigen::Vector3d::Constant(0.5 * side);
  return {"torus",
          [=](const Eigen::Vector3d& x) {
            const Eigen::Vector3d d = x - center;
            return small - std::hypot(std::hypot(d[0], d[1]) - large, d[2]);
          },
          side,
          1,
          1,
          2.0 * M_PI * M_PI * large * small * small};
}

/** \brief Two balls of radius 8, that far apart. */
inline MeshField
twoSpheresField(double gap)
{
  constexpr double radius = 8.0;
  const double side = 4.0 * radius + gap + 6.0;
  const Eigen::Vector3d middle = Eigen::Vector3d::Constant(0.5 * side);
  const Eigen::Vector3d away = Eigen::Vector3d::UnitX() * (radius + 0.5 * gap);
  return {"two spheres",
          [=](const Eigen::Vector3d& x) {
            return radius -
                   std::min((x - middle - away).norm(), (x - middle + away).norm());
          },
          side,
          2,
          0,
          8.0 / 3.0 * M_PI * std::pow(radius, 3)};
}

/** \brief A hollow ball of radius 12 with a wall of that thickness. */
inline MeshField
shellField(double thickness)
{
  constexpr double radius = 12.0;
  const double side = 2.0 * radius + thickness + 6.0;
  const Eigen::Vector3d center = Eigen::Vector3d::Constant(0.5 * side);
  return {"shell",
          [=](const Eigen::Vector3d& x) {
            return 0.5 * thickness - std::abs((x - center).norm() - radius);
          },
          side,
          2,
          0};
}

/** \brief A period of a gyroid, which leaves the cube and is closed by caps; pieces and
 * handles are those of VTK's flying edges on grids of 60, 121 and 200 nodes a side. */
inline MeshField
gyroidField()
{
  constexpr double period = 40.0;
  return {"gyroid",
          [](const Eigen::Vector3d& x) {
            const Eigen::Vector3d p =
                2.0 * M_PI / period * x + Eigen::Vector3d(0.3, 1.1, 2.0);
            return period / (2.0 * M_PI) *
                   (std::sin(p[0]) * std::cos(p[1]) + std::sin(p[1]) * std::cos(p[2]) +
                    std::sin(p[2]) * std::cos(p[0]));
          },
          period,
          1,
          2};
}

/** \brief Uniform samples of mean spacing 1. */
inline pcl::PointCloud<pcl::PointXYZI>::Ptr
sampleField(const MeshField& field, unsigned seed, double noise = 0.0)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> any(0.0, field.side);
  std::normal_distribution<double> deviation(0.0, 1.0);
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  const auto count = static_cast<std::size_t>(std::pow(field.side, 3));
  for (std::size_t i = 0; i < count; ++i) {
    pcl::PointXYZI point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = static_cast<float>(any(random));
    point.intensity = static_cast<float>(
        field.value(point.getVector3fMap().cast<double>()) + noise * deviation(random));
    cloud->push_back(point);
  }
  return cloud;
}

/** \brief The mesh at an isovalue, and its report. */
struct MeshRun {
  pcl_uvol::SurfaceTriangles mesh;
  pcl_uvol::Report report;
};

inline MeshRun
runMesh(const pcl::PointCloud<pcl::PointXYZI>::Ptr& cloud,
        pcl_uvol::MeshingParameters meshing = {},
        const std::vector<double>& isovalues = {0.0},
        pcl_uvol::Outside outside = pcl_uvol::Outside::Lower,
        unsigned threads = 2)
{
  pcl_uvol::SurfaceMesh<pcl::PointXYZI> mesher;
  mesher.setInputCloud(cloud);
  mesher.setNumberOfThreads(threads);
  pcl_uvol::SurfaceMeshParameters parameters;
  parameters.isosurface.isovalues = isovalues;
  parameters.isosurface.outside = outside;
  parameters.meshing = meshing;
  mesher.setParameters(parameters);
  MeshRun run;
  mesher.extract(run.mesh);
  run.report = mesher.getReport();
  return run;
}

inline Eigen::Vector3d
placeOf(const pcl_uvol::SurfaceTriangles& mesh, std::uint32_t vertex)
{
  return mesh.vertices[vertex].getVector3fMap().cast<double>();
}

inline double
volumeOf(const pcl_uvol::SurfaceTriangles& mesh)
{
  double volume = 0.0;
  for (const pcl_uvol::Triangle& triangle : mesh.triangles)
    volume += placeOf(mesh, triangle[0])
                  .dot(placeOf(mesh, triangle[1]).cross(placeOf(mesh, triangle[2]))) /
              6.0;
  return volume;
}

inline double
areaOf(const pcl_uvol::SurfaceTriangles& mesh)
{
  double area = 0.0;
  for (const pcl_uvol::Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3d a = placeOf(mesh, triangle[0]);
    area +=
        0.5 *
        (placeOf(mesh, triangle[1]) - a).cross(placeOf(mesh, triangle[2]) - a).norm();
  }
  return area;
}

/** \brief Every edge is walked once in each direction, but for rims, and the triangles
 * around every vertex are one round or one fan.
 * \return the edges of rims */
inline std::size_t
expectManifold(const std::vector<pcl_uvol::Triangle>& triangles, std::size_t vertices)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> third;
  std::vector<std::size_t> corners(vertices), starts(vertices);
  for (const pcl_uvol::Triangle& triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NE(triangle[i], triangle[(i + 1) % 3]);
      const bool is_new =
          third.insert({{triangle[i], triangle[(i + 1) % 3]}, triangle[(i + 2) % 3]})
              .second;
      EXPECT_TRUE(is_new);
      ++corners[triangle[i]];
    }
  std::size_t rim_edges = 0;
  std::map<std::uint32_t, std::uint32_t> start_of;
  for (const auto& [edge, tip] : third) {
    const bool is_rim = third.count({edge.second, edge.first}) == 0;
    rim_edges += is_rim;
    starts[edge.first] += is_rim;
    if (is_rim || start_of.count(edge.first) == 0)
      start_of[edge.first] = edge.second;
  }
  for (const auto& [center, start] : start_of) {
    EXPECT_LE(starts[center], 1u);
    std::size_t met = 0;
    std::uint32_t vertex = start;
    do {
      const auto found = third.find({center, vertex});
      if (found == third.end())
        break;
      vertex = found->second;
      ++met;
    } while (vertex != start && met <= corners[center]);
    EXPECT_EQ(corners[center], met);
  }
  return rim_edges;
}

} // namespace uvol_test
