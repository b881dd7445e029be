// SPDX-License-Identifier: BSD-3-Clause
#include "files.h"
#include "vtk_messages.h"
#include <pcl_uvol/common/analytic_fields.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/mesh.h>

#include <Eigen/Geometry>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

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
  { // missing, empty or a directory: said in our words
    const io::InputFile exists(path);
  }
  const io::VtkMessages messages;
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  if (!messages.getError().empty())
    io::throwUnreadable(path, "VTK says: " + messages.getError());
  vtkPolyData* const data = reader->GetOutput();
  Mesh mesh;
  mesh.vertices.resize(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    double position[3];
    data->GetPoint(static_cast<vtkIdType>(i), position);
    for (std::size_t axis = 0; axis < 3; ++axis)
      mesh.vertices[i][axis] = static_cast<float>(position[axis]);
  }
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  vtkCellArray* const polygons = data->GetPolys();
  for (polygons->InitTraversal(); polygons->GetNextCell(size, corners) != 0;)
    for (vtkIdType k = 2; k < size; ++k) {
      std::array<std::uint32_t, 3> triangle{};
      const vtkIdType ids[3] = {corners[0], corners[k - 1], corners[k]};
      for (std::size_t c = 0; c < 3; ++c) {
        if (ids[c] < 0 || ids[c] >= data->GetNumberOfPoints())
          io::throwUnreadable(path, "a face names a vertex that is not there");
        triangle[c] = static_cast<std::uint32_t>(ids[c]);
      }
      mesh.triangles.push_back(triangle);
    }
  if (mesh.triangles.empty())
    io::throwUnreadable(path, "it has no faces to spread points over");
  return mesh;
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
