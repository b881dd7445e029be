// SPDX-License-Identifier: BSD-3-Clause
// Triangles of PLY files.
#include "common/records.h"
#include "io/files.h"
#include "io/formats.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/io/mesh.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace pcl_uvol {

Mesh
loadMesh(const std::string& path)
{
  const io::InputFile file(path);
  if (file.head(3) != "ply")
    io::throwUnreadable(path, "meshes are read from PLY files, and this is none");
  io::PlyMesh read = io::readPlyMesh(path);
  const CloudView cloud = viewOf(read.vertices.cloud);
  Mesh mesh;
  mesh.origin = read.vertices.origin;
  mesh.vertices.resize(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i)
    std::copy_n(cloud.xyz(i), 3, mesh.vertices[i].begin());
  mesh.triangles = std::move(read.triangles);
  if (mesh.triangles.empty())
    io::throwUnreadable(path, "it has no faces");
  return mesh;
}

Dataset
loadMesh(const std::string& path, std::vector<Triangle>& triangles)
{
  return io::reading(path, [&] {
    io::PlyMesh mesh = io::readPlyMesh(path);
    triangles = std::move(mesh.triangles);
    return std::move(mesh.vertices);
  });
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
  if (io::getEnding(path) != ".ply")
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

} // namespace pcl_uvol
