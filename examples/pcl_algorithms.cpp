// Isopoints in PCL's own algorithms: a search tree on them as they are, clusters and
// triangles of what toPointNormal makes of them.
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/surface/gp3.h>

#include <cmath>
#include <iostream>

int
main()
{
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (int i = 0; i < 8000; ++i) { // a lattice of 20 x 20 x 20 around a sphere
    pcl::PointXYZI point;
    point.getArray3fMap() << i % 20 - 9.5f, i / 20 % 20 - 9.5f, i / 400 - 9.5f;
    point.intensity = 7.2f - point.getVector3fMap().norm();
    cloud->push_back(point);
  }
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(0.0);
  const pcl::PointCloud<pcl_uvol::PointIso>::Ptr surface(
      new pcl::PointCloud<pcl_uvol::PointIso>);
  extraction.extract(*surface);

  pcl::KdTreeFLANN<pcl_uvol::PointIso> tree;
  tree.setInputCloud(surface);
  pcl::search::KdTree<pcl_uvol::PointIso> search;
  search.setInputCloud(surface);
  pcl::Indices nearest(1);
  std::vector<float> sq_distances(1);
  if (tree.nearestKSearch(*surface, 5, 1, nearest, sq_distances) != 1 ||
      search.nearestKSearch((*surface)[5], 1, nearest, sq_distances) != 1 ||
      nearest[0] != 5)
    return 1;

  const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>(
      pcl_uvol::toPointNormal(*surface));
  const auto neighbors = pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>();
  neighbors->setInputCloud(points);
  pcl::EuclideanClusterExtraction<pcl::PointNormal> clustering;
  clustering.setInputCloud(points);
  clustering.setSearchMethod(neighbors);
  clustering.setClusterTolerance(1.5);
  clustering.setMinClusterSize(10);
  std::vector<pcl::PointIndices> clusters;
  clustering.extract(clusters);

  pcl::GreedyProjectionTriangulation<pcl::PointNormal> triangulation;
  triangulation.setInputCloud(points);
  triangulation.setSearchMethod(neighbors);
  triangulation.setSearchRadius(3.0);
  triangulation.setMu(2.5);
  pcl::PolygonMesh mesh;
  triangulation.reconstruct(mesh);
  std::cout << clusters.size() << " clusters, " << mesh.polygons.size()
            << " triangles\n";
}
