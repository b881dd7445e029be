// Isopoints in PCL's algorithms as they are: their templates are compiled for PointIso.
#define PCL_NO_PRECOMPILE
#include <pcl_uvol/common/point_types.h>

#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/surface/gp3.h>

#include <iostream>

int
main()
{
  using pcl_uvol::PointIso;
  const auto surface = pcl::make_shared<pcl::PointCloud<PointIso>>();
  for (int i = 0; i < 200; ++i) { // two plane patches of 10 x 10
    PointIso point{};
    point.getArray3fMap() << i % 10, i / 10 % 10, 50 * (i / 100);
    point.normal_z = 1.0f;
    surface->push_back(point);
  }
  const auto neighbors = pcl::make_shared<pcl::search::KdTree<PointIso>>();
  neighbors->setInputCloud(surface);
  pcl::EuclideanClusterExtraction<PointIso> clustering;
  clustering.setInputCloud(surface);
  clustering.setSearchMethod(neighbors);
  clustering.setClusterTolerance(1.5);
  std::vector<pcl::PointIndices> clusters;
  clustering.extract(clusters);
  pcl::GreedyProjectionTriangulation<PointIso> triangulation;
  triangulation.setInputCloud(surface);
  triangulation.setSearchMethod(neighbors);
  triangulation.setSearchRadius(3.0);
  triangulation.setMu(2.5);
  pcl::PolygonMesh mesh;
  triangulation.reconstruct(mesh);
  std::cout << clusters.size() << " clusters, "
            << (mesh.polygons.empty() ? "no" : "some") << " triangles\n";
}
