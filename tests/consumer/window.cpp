#include <pcl_uvol/vtk/image_space_prop.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>
#include <vtkNew.h>

#include <iostream>

int
main()
{
  pcl::PointCloud<pcl::PointNormal> points;
  points.push_back({1.0f, 2.0f, 3.0f, 0.0f, 0.0f, 1.0f});
  pcl::PCLPointCloud2::Ptr cloud(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(points, *cloud);
  vtkNew<pcl_uvol::ImageSpaceProp> prop;
  prop->setInputCloud(cloud);
  std::cout << "bounds from " << prop->GetBounds()[4] << '\n';
}
