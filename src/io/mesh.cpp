// SPDX-License-Identifier: BSD-3-Clause
// Meshes from and into files of several formats.
#include "common/records.h"
#include "io/files.h"
#include "io/formats.h"
#include "io/globe_places.h"
#include "io/mesh_readers.h"
#include "io/record_source.h"
#include "io/vtk_library.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace pcl_uvol {

namespace io {
namespace {

LoadedMesh
readMesh(const std::string& path)
{
  const std::string ending = getEnding(path);
  if (ending == ".obj")
    return readObj(path);
  if (ending == ".off")
    return readOff(path);
  if (ending == ".stl")
    return readStl(path);
  if (ending == ".vtp")
    return {vtkLibrary().readVtk(path, {}), vtkLibrary().readVtpTriangles(path)};
  if (ending == ".vtkhdf")
    return {readWhole(vtkLibrary().openHdf5(path, {}), {}),
            vtkLibrary().readVtkHdfTriangles(path)};
  if (InputFile(path).head(3) != "ply")
    throwUnreadable(
        path, {"other_ending", "meshes", ".ply, .vtp, .vtkhdf, .obj, .off or .stl"});
  return readPlyMesh(path);
}

} // namespace
} // namespace io

Mesh
loadMesh(const std::string& path)
{
  std::vector<Triangle> triangles;
  const Dataset vertices = loadMesh(path, triangles);
  if (triangles.empty())
    io::throwUnreadable(path, {"nothing_inside", "faces"});
  const CloudView cloud = io::reading(path, [&] { return viewOf(vertices.cloud); });
  Mesh mesh;
  mesh.origin = vertices.origin;
  mesh.vertices.resize(cloud.count);
  for (std::size_t i = 0; i < cloud.count; ++i)
    std::copy_n(cloud.xyz(i), 3, mesh.vertices[i].begin());
  mesh.triangles = std::move(triangles);
  return mesh;
}

Dataset
loadMesh(const std::string& path,
         std::vector<Triangle>& triangles,
         const std::optional<MapProjection>& map)
{
  return io::reading(path, [&] {
    io::LoadedMesh mesh = io::readMesh(path);
    triangles = std::move(mesh.triangles);
    io::putOnMap(mesh.vertices, map);
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
  const std::string ending = io::getEnding(path);
  writeAtomically(path, [&](const std::string& file) {
    if (ending == ".ply")
      io::writePly(file, path, vertices, triangles, options);
    else if (ending == ".vtp")
      io::vtkLibrary().writeVtp(file, path, vertices, triangles);
    else if (ending == ".vtkhdf")
      io::writeVtkHdf(file, path, vertices, triangles);
    else if (ending == ".obj")
      io::writeObj(file, path, vertices, triangles, options);
    else if (ending == ".off")
      io::writeOff(file, path, vertices, triangles, options);
    else
      io::writeStl(file, path, vertices, triangles);
  });
}

void
checkMeshPath(const std::string& path)
{
  if (!isMeshPath(path))
    io::throwUnwritable(
        path,
        {"unwritten_ending", "meshes", ".ply, .vtp, .vtkhdf, .obj, .off or .stl"});
  io::checkWritable(path);
}

bool
isMeshPath(const std::string& path)
{
  const std::string ending = io::getEnding(path);
  return ending == ".ply" || ending == ".vtp" || ending == ".vtkhdf" ||
         isMeshOnly(path);
}

bool
isMeshOnly(const std::string& path)
{
  const std::string ending = io::getEnding(path);
  return ending == ".obj" || ending == ".off" || ending == ".stl";
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
