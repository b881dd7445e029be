// Isovalues one after the other, as a slider asks for them: values, tree and their
// ranges are kept, so that only the first one waits for them.
#include "samples.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <chrono>
#include <iostream>

int
main()
{
  using Clock = std::chrono::steady_clock;
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(makeBall(300000));
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  for (const double isovalue : {0.2, 0.3, 0.4, 0.5, 0.6}) {
    extraction.setIsoValue(isovalue);
    const Clock::time_point start = Clock::now();
    extraction.extract(surface);
    const std::chrono::duration<double, std::milli> time = Clock::now() - start;
    std::cout << "isovalue " << isovalue << ": " << surface.size() << " isopoints in "
              << time.count() << " ms\n";
  }
  // All of them at once: the isopoints of one isovalue follow those of another.
  extraction.setIsoValues({0.2, 0.4, 0.6});
  extraction.extract(surface);
  std::cout << surface.size() << " isopoints, the last one of isovalue "
            << surface.back().isovalue << '\n';
}
