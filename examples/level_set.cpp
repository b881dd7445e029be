// Noisy samples: a level set on the samples takes the noise away, the surface stays.
#include "samples.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>

#include <cmath>
#include <iostream>

namespace {

/** Root of the mean square of distances to the true sphere. */
double
deviation(const pcl::PointCloud<pcl_uvol::PointIso>& surface, double radius)
{
  double sum = 0.0;
  for (const auto& point : surface)
    sum += std::pow(point.getVector3fMap().norm() - radius, 2);
  return std::sqrt(sum / static_cast<double>(surface.size()));
}

} // namespace

int
main()
{
  const pcl::PointCloud<pcl::PointXYZI>::Ptr samples = makeBall(100000, 0.03f);
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(samples);
  extraction.setIsoValue(0.5); // a sphere of radius 0.5
  pcl::PointCloud<pcl_uvol::PointIso> direct, smooth;
  extraction.extract(direct);

  pcl_uvol::LevelSetEvolution<pcl::PointXYZI> evolution;
  evolution.setInputCloud(samples);
  evolution.setIsoValue(0.5);
  std::vector<float> phi; // about the distance to the surface, per sample
  evolution.evolve(phi);

  for (std::size_t i = 0; i < phi.size(); ++i)
    (*samples)[i].intensity = phi[i];
  extraction.setIsoValue(0.0);
  extraction.extract(smooth);
  std::cout << "deviation from the sphere: " << deviation(direct, 0.5) << " directly, "
            << deviation(smooth, 0.5) << " after the level set\n";
}
