// Isopoints in PCL's algorithms that are compiled for its own points with normals.
#include <pcl_uvol/common/point_types.h>

#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/surface/gp3.h>

#include <iostream>

int
main()
{
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  for (int i = 0; i < 200; ++i) { // two plane patches of 10 x 10
    pcl_uvol::PointIso point{};
    point.getArray3fMap() << i % 10, i / 10 % 10, 50 * (i / 100);
    point.normal_z = 1.0f;
    surface.push_back(point);
  }
  const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>(
      pcl_uvol::toPointNormal(surface));
  const auto neighbors = pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>();
  neighbors->setInputCloud(points);
  pcl::EuclideanClusterExtraction<pcl::PointNormal> clustering;
  clustering.setInputCloud(points);
  clustering.setSearchMethod(neighbors);
  clustering.setClusterTolerance(1.5);
  std::vector<pcl::PointIndices> clusters;
  clustering.extract(clusters);
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> triangulation;
  triangulation.setInputCloud(points);
  triangulation.setSearchMethod(neighbors);
  triangulation.setSearchRadius(3.0);
  triangulation.setMu(2.5);
  pcl::PolygonMesh mesh;
  triangulation.reconstruct(mesh);
  std::cout << clusters.size() << " clusters, "
            << (mesh.polygons.empty() ? "no" : "some") << " triangles\n";
}
