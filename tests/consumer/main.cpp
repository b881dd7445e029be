#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <iostream>

int
main()
{
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (int i = 0; i < 8000; ++i) { // a lattice of 20 x 20 x 20 with f = x + y + z
    pcl::PointXYZI point;
    point.getArray3fMap() << i % 20, i / 20 % 20, i / 400;
    point.intensity = point.getArray3fMap().sum();
    cloud->push_back(point);
  }
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(28.5);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);
  std::cout << surface.size() << " isopoints, the first at "
            << surface[0].getArray3fMap().transpose() << '\n';
}
