// An isosurface among the other things of a PCLVisualizer: drawn without holes, lit,
// hiding what lies behind it. usage: pcl_visualizer [SCREENSHOT.png]
#include "samples.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/vtk/image_space_prop.h>

#include <pcl/conversions.h>
#include <pcl/visualization/pcl_visualizer.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRendererCollection.h>

int
main(int argc, char** argv)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(makeBall(100000));
  extraction.setIsoValue(0.5);
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);

  pcl::PCLPointCloud2::Ptr cloud(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(surface, *cloud);
  vtkNew<pcl_uvol::ImageSpaceProp> prop;
  prop->setInputCloud(cloud);

  pcl::visualization::PCLVisualizer viewer("isosurface", true);
  viewer.setBackgroundColor(1.0, 1.0, 1.0);
  viewer.addCoordinateSystem(0.8);
  viewer.getRendererCollection()->GetFirstRenderer()->AddViewProp(prop);
  viewer.setCameraPosition(2.0, 1.5, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0);
  if (argc > 1)
    viewer.saveScreenshot(argv[1]);
  else
    viewer.spin();
}
