// Samples at random places that the examples share: a field that falls from 1 in the
// centre to 0 at distance 1.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <random>

/** \param noise standard deviation of what is added to the values */
inline pcl::PointCloud<pcl::PointXYZI>::Ptr
makeBall(int count, float noise = 0.0f)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<float> position(-1.0f, 1.0f);
  std::normal_distribution<float> error(0.0f, 1.0f);
  pcl::PointCloud<pcl::PointXYZI>::Ptr samples(new pcl::PointCloud<pcl::PointXYZI>);
  for (int i = 0; i < count; ++i) {
    pcl::PointXYZI sample;
    sample.x = position(random);
    sample.y = position(random);
    sample.z = position(random);
    sample.intensity = 1.0f - sample.getVector3fMap().norm() + noise * error(random);
    samples->push_back(sample);
  }
  return samples;
}
