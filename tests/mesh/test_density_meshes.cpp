// SPDX-License-Identifier: BSD-3-Clause
// Meshes of values that fall by factors from sample to sample, as densities do, in
// a ball within its box: cells in the corners have centres far from all samples.
#include "mesh_fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace test_density_meshes {

using namespace pcl_uvol;
using namespace uvol_test;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Profile = double (*)(double);

constexpr double ball = 15.0, radius = 13.0;

/** Samples of a value by the depth below the surface. */
Cloud::Ptr
sampleBall(Profile profile, double unit = 1.0)
{
  const Eigen::Vector3d center = Eigen::Vector3d::Constant(ball);
  const auto cloud = sampleField({"ball",
                                  [&](const Eigen::Vector3d& x) {
                                    return unit * profile(radius - (x - center).norm());
                                  },
                                  2.0 * ball,
                                  1,
                                  0},
                                 7);
  Cloud::Ptr inside(new Cloud);
  for (const auto& point : *cloud)
    if ((point.getVector3fMap().cast<double>() - center).norm() < ball)
      inside->push_back(point);
  return inside;
}

void
expectSphere(const MeshRun& run, double farthest)
{
  ASSERT_EQ(1u, run.mesh.pieces.size());
  EXPECT_EQ(0u, run.mesh.pieces[0].genus);
  for (const char* const count : {"cap_vertices", "folds", "slivers"})
    EXPECT_EQ(0u, run.report.getCount(count)) << count;
  const Eigen::Vector3d center = Eigen::Vector3d::Constant(ball);
  for (std::uint32_t i = 0; i < run.mesh.vertices.size(); ++i)
    EXPECT_NEAR(radius, (placeOf(run.mesh, i) - center).norm(), farthest);
  EXPECT_NEAR(1.0, volumeOf(run.mesh) / (4.0 / 3.0 * M_PI * std::pow(radius, 3)), 0.01);
}

const std::vector<Profile> profiles = {
    [](double depth) { return std::pow(2.0, depth); },
    [](double depth) { return std::pow(3.0, depth); },
    [](double depth) { return std::pow(5.0, depth); },
    // As a star ends: ever faster.
    [](double depth) { return std::pow((depth + 3.0) / 3.0, 3.0); },
    [](double depth) { return std::exp(1.2 * depth - 0.04 * depth * depth); }};

TEST(DensityMeshes, AreSpheresAsThoseOfTheirLogarithms)
{
  for (const Profile profile : profiles) {
    const auto density = sampleBall(profile);
    const Cloud::Ptr logarithms(new Cloud(*density));
    for (auto& point : *logarithms)
      point.intensity = std::log(point.intensity);
    const MeshRun run = runMesh(density, {}, {1.0}), other = runMesh(logarithms);
    expectSphere(run, 0.05);
    EXPECT_EQ(1u, other.mesh.pieces.size());
    EXPECT_NEAR(1.0, areaOf(run.mesh) / areaOf(other.mesh), 2e-3);
    EXPECT_NEAR(1.0, volumeOf(run.mesh) / volumeOf(other.mesh), 2e-3);
  }
}

TEST(DensityMeshes, AreSpheresInAnyUnitAndOfEitherSign)
{
  for (const double unit : {1e-30, 1e30})
    expectSphere(runMesh(sampleBall(profiles[1], unit), {}, {unit}), 0.01);
  expectSphere(runMesh(sampleBall(profiles[1], -1.0), {}, {-1.0}, Outside::Higher),
               0.01);
}

} // namespace test_density_meshes
