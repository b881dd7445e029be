// A closed mesh as a pcl::PolygonMesh; its area, the volume inside and their errors.
#include "samples.h"
#include <pcl_uvol/mesh/surface_measures.h>
#include <pcl_uvol/mesh/surface_mesh.h>

#include <iostream>

int
main()
{
  pcl_uvol::SurfaceMeshParameters parameters;
  parameters.isosurface.isovalues = {0.5}; // a sphere of radius 0.5
  pcl_uvol::SurfaceMesh<pcl::PointXYZI> mesher;
  mesher.setInputCloud(makeBall(100000));
  mesher.setParameters(parameters);
  pcl::PolygonMesh mesh;
  mesher.extract(mesh);

  const auto vertices = std::make_shared<pcl_uvol::Dataset>();
  vertices->cloud = mesh.cloud;
  std::vector<pcl_uvol::Triangle> triangles;
  for (const pcl::Vertices& polygon : mesh.polygons)
    triangles.push_back({static_cast<std::uint32_t>(polygon.vertices[0]),
                         static_cast<std::uint32_t>(polygon.vertices[1]),
                         static_cast<std::uint32_t>(polygon.vertices[2])});
  pcl_uvol::SurfaceMeasures measures;
  measures.setInputSurface(vertices, triangles);
  const pcl_uvol::PieceMeasures sphere = measures.compute().isovalues[0];
  std::cout << triangles.size() << " triangles, area " << sphere.area.value << " +- "
            << sphere.area.error << " (sphere " << M_PI << "), volume "
            << sphere.volume.value << " +- " << sphere.volume.error << " (sphere "
            << M_PI / 6.0 << "), genus " << sphere.genus.value() << '\n';
}
