// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <cstdio>

int
main()
{
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (int i = 0; i < 1000; i++) {
    const float x = i % 10, y = i / 10 % 10, z = i / 100;
    cloud->emplace_back(x, y, z, x * x + y * y + z * z);
  }
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(30.0);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);
  std::printf("%zu isopoints\n", surface.size());
}
