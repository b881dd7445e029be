// A closed mesh as a pcl::PolygonMesh, its area and the volume inside.
#include "samples.h"
#include <pcl_uvol/mesh/surface_mesh.h>

#include <pcl/conversions.h>

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

  pcl::PointCloud<pcl::PointXYZ> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  double area = 0.0, volume = 0.0;
  for (const pcl::Vertices& triangle : mesh.polygons) {
    const Eigen::Vector3f a = vertices[triangle.vertices[0]].getVector3fMap();
    const Eigen::Vector3f b = vertices[triangle.vertices[1]].getVector3fMap();
    const Eigen::Vector3f c = vertices[triangle.vertices[2]].getVector3fMap();
    area += 0.5 * (b - a).cross(c - a).norm();
    volume += a.dot(b.cross(c)) / 6.0; // of a closed, oriented mesh
  }
  std::cout << mesh.polygons.size() << " triangles, area " << area << " (sphere "
            << M_PI << "), volume " << volume << " (sphere " << M_PI / 6.0 << ")\n";
}
