// SPDX-License-Identifier: BSD-3-Clause
// Triangles of PLY files, and points spread over them.
#include "files.h"
#include "formats.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/random.h>
#include <pcl_uvol/common/records.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/mesh.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl_uvol {

namespace {

Eigen::Vector3d
vertexOf(const Mesh& mesh, std::size_t triangle, std::size_t corner)
{
  const auto& vertex = mesh.vertices[mesh.triangles[triangle][corner]];
  return {vertex[0], vertex[1], vertex[2]};
}

} // namespace

Mesh
loadMesh(const std::string& path)
{
  const io::InputFile file(path);
  if (file.head(3) != "ply")
    io::throwUnreadable(path, "meshes are read from PLY files, and this is none");
  const Dataset dataset = loadDataset(path);
  const CloudView cloud = viewOf(dataset.cloud);
  Mesh mesh;
  mesh.origin = dataset.origin;
  mesh.vertices.resize(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i)
    std::copy_n(cloud.xyz(i), 3, mesh.vertices[i].begin());
  mesh.triangles = io::readPlyTriangles(path, cloud.count);
  if (mesh.triangles.empty())
    io::throwUnreadable(path, "it has no faces to spread points over");
  return mesh;
}

void
saveMesh(const std::string& path,
         const Dataset& vertices,
         const std::vector<Triangle>& triangles,
         const SaveOptions& options)
{
  checkMeshPath(path);
  checkSavePath(path, vertices.cloud.fields);
  writeAtomically(path, [&](const std::string& file) {
    io::writePly(file, path, vertices, triangles, options);
  });
}

void
checkMeshPath(const std::string& path)
{
  if (io::endingOf(path) != ".ply")
    io::throwUnwritable(path, "meshes are written as .ply");
  io::checkWritable(path);
}

Dataset
toDataset(const Mesh& mesh)
{
  Fields fields;
  for (const char* name : {"x", "y", "z", "normal_x", "normal_y", "normal_z"})
    appendField(fields, name, pcl::PCLPointField::FLOAT32);
  Dataset dataset;
  dataset.origin = mesh.origin;
  dataset.cloud = makeRecords(fields, mesh.vertices.size());
  const auto normals = computeVertexNormals(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    std::uint8_t* const point = &dataset.cloud.data[i * dataset.cloud.point_step];
    std::memcpy(point, mesh.vertices[i].data(), sizeof(mesh.vertices[i]));
    std::memcpy(
        point + sizeof(mesh.vertices[i]), normals[i].data(), sizeof(normals[i]));
  }
  return dataset;
}

std::vector<MeshPoint>
scatterOverMesh(const Mesh& mesh, std::uint64_t n, std::uint64_t seed)
{
  std::vector<double> area_up_to(mesh.triangles.size());
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3d a = vertexOf(mesh, i, 0);
    area += 0.5 * (vertexOf(mesh, i, 1) - a).cross(vertexOf(mesh, i, 2) - a).norm();
    area_up_to[i] = area;
  }
  if (!(area > 0.0) || !std::isfinite(area))
    throw InvalidArgument("The mesh has no area to spread points over.");
  std::vector<MeshPoint> points(n);
  for (std::uint64_t i = 0; i < n; ++i) {
    const double target = area * (static_cast<double>(i) + uniformAt(seed, i, 0)) /
                          static_cast<double>(n);
    const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end(), target);
    const auto triangle = static_cast<std::size_t>(
        std::min(found, area_up_to.end() - 1) - area_up_to.begin());
    const Eigen::Vector3d a = vertexOf(mesh, triangle, 0);
    const Eigen::Vector3d ab = vertexOf(mesh, triangle, 1) - a;
    const Eigen::Vector3d ac = vertexOf(mesh, triangle, 2) - a;
    const double root = std::sqrt(uniformAt(seed, i, 1)), v = uniformAt(seed, i, 2);
    const Eigen::Vector3f position =
        (a + root * (1.0 - v) * ab + root * v * ac).cast<float>();
    const Eigen::Vector3f normal = ab.cross(ac).stableNormalized().cast<float>();
    std::copy_n(position.data(), 3, points[i].position.begin());
    std::copy_n(normal.data(), 3, points[i].normal.begin());
  }
  return points;
}

} // namespace pcl_uvol
