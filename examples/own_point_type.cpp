// A point type of one's own: any registered one with x, y, z will do, and any of its
// fields can be the scalar.
#define PCL_NO_PRECOMPILE
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <pcl/register_point_struct.h>

#include <cmath>
#include <iostream>

struct Particle {
  PCL_ADD_POINT4D;
  float density;
  double temperature;
};
POINT_CLOUD_REGISTER_POINT_STRUCT(
    Particle,
    (float, x, x)(float, y, y)(float, z, z)(float, density, density)(double,
                                                                     temperature,
                                                                     temperature))

int
main()
{
  pcl::PointCloud<Particle>::Ptr particles(new pcl::PointCloud<Particle>);
  for (int i = 0; i < 27000; ++i) { // a lattice around a sphere
    Particle particle{};
    particle.x = 0.1f * static_cast<float>(i % 30) - 1.45f;
    particle.y = 0.1f * static_cast<float>(i / 30 % 30) - 1.45f;
    particle.z = 0.1f * static_cast<float>(i / 900) - 1.45f;
    particle.density = 1.0f - particle.getVector3fMap().norm();
    particle.temperature = 300.0 + 100.0 * particle.z;
    particles->push_back(particle);
  }
  pcl_uvol::IsosurfaceExtraction<Particle> extraction;
  extraction.setInputCloud(particles);
  extraction.setScalarField("density");
  extraction.setIsoValue(0.2); // a sphere of radius 0.8
  pcl::PointCloud<pcl_uvol::PointIso> surface;
  extraction.extract(surface);

  // Every isopoint knows the edge between samples that it belongs to.
  const pcl_uvol::IsoEdge& edge = extraction.getEdges()[0];
  std::cout << surface.size() << " isopoints at radius "
            << surface[0].getVector3fMap().norm() << ", temperatures around the first "
            << (*particles)[edge.first].temperature << " and "
            << (*particles)[edge.second].temperature << '\n';
}
