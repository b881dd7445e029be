// SPDX-License-Identifier: BSD-3-Clause
// Subjects that are hard to draw, by the settings that renderers start with, as small
// pictures that somebody has looked at: see golden_image.h.
#include "golden_image.h"
#include "support/environment.h"
#include "support/surfaces.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <cmath>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace test_golden_subjects {

using pcl_uvol::Camera;
using pcl_uvol::Image;
using pcl_uvol::PointIso;
using uvol_test::golden_height;
using uvol_test::golden_width;
using uvol_test::SurfaceCloudPtr;

struct Subject {
  const char* name;
  std::function<Image()> draw;
};

void
PrintTo(const Subject& subject, std::ostream* out)
{
  *out << subject.name;
}

template <typename PointT>
Image
draw(const std::shared_ptr<pcl::PointCloud<PointT>>& cloud,
     const std::vector<double>& opacities = {},
     bool culls = false)
{
  pcl_uvol::ImageSpaceRenderer<PointT> renderer;
  renderer.setInputCloud(cloud);
  renderer.setSize(golden_width, golden_height);
  renderer.settings().cull_back_faces = culls;
  if (!opacities.empty()) {
    renderer.setColorField("isovalue");
    renderer.setOpacities(opacities);
  }
  renderer.setCamera(Camera::fit(renderer.getBounds(), "iso", 30.0, 4.0 / 3.0));
  Image image;
  renderer.render(image);
  return image;
}

/** A ball, and points far from it and from each other, which look anywhere. */
SurfaceCloudPtr
makeSpecks()
{
  auto cloud = uvol_test::makeSphere(6000, 1);
  uvol_test::Random random(4);
  const auto anywhere = [&](float extent) {
    Eigen::Vector3f place;
    for (float& coordinate : place)
      coordinate = extent * static_cast<float>(2.0 * random.uniform() - 1.0);
    return place;
  };
  for (int i = 0; i < 60; ++i) {
    pcl::PointNormal speck;
    speck.getVector3fMap() = anywhere(1.6f);
    speck.getNormalVector3fMap() = anywhere(1.0f).normalized();
    cloud->push_back(speck);
  }
  return cloud;
}

SurfaceCloudPtr
makeInwardBall()
{
  auto cloud = uvol_test::makeSphere(6000, 1);
  for (auto& point : *cloud)
    point.getNormalVector3fMap() *= -1.0f;
  return cloud;
}

/** Isopoints of random samples of the cube from -3 to 3.
 * \param value of the samples */
template <typename Field>
pcl::PointCloud<PointIso>::Ptr
extract(const Field& value, const std::vector<double>& isovalues)
{
  uvol_test::Random random(9);
  const pcl::PointCloud<pcl::PointXYZI>::Ptr samples(
      new pcl::PointCloud<pcl::PointXYZI>);
  for (int i = 0; i < 30000; ++i) {
    pcl::PointXYZI sample;
    for (int axis = 0; axis < 3; ++axis)
      sample.data[axis] = static_cast<float>(6.0 * random.uniform() - 3.0);
    sample.intensity = value(sample.getVector3fMap());
    samples->push_back(sample);
  }
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(samples);
  extraction.setIsoValues(isovalues);
  pcl::PointCloud<PointIso>::Ptr surface(new pcl::PointCloud<PointIso>);
  extraction.extract(*surface);
  return surface;
}

/** A surface that the cube of samples cuts open everywhere. */
float
gyroidAt(const Eigen::Vector3f& x)
{
  return std::sin(x[0]) * std::cos(x[1]) + std::sin(x[1]) * std::cos(x[2]) +
         std::sin(x[2]) * std::cos(x[0]);
}

Image
trace(const SurfaceCloudPtr& cloud, double reflectivity)
{
  pcl_uvol::SplatGeneration<pcl::PointNormal> generation;
  generation.setInputCloud(cloud);
  const pcl::PointCloud<pcl_uvol::PointSplat>::Ptr splats(
      new pcl::PointCloud<pcl_uvol::PointSplat>);
  generation.compute(*splats);
  pcl_uvol::SplatObject object;
  object.splats = splats;
  object.rims = generation.getRims();
  object.material.reflectivity = reflectivity;
  pcl_uvol::Scene scene;
  scene.splats.push_back(object);
  pcl_uvol::RayTracer tracer;
  tracer.setScene(scene);
  tracer.setSize(golden_width, golden_height);
  tracer.setSupersampling(2);
  Image image;
  tracer.render(image);
  return image;
}

const Subject subjects[] = {
    {"specks", [] { return draw(makeSpecks()); }},
    {"inward_ball", [] { return draw(makeInwardBall()); }},
    {"gyroid", [] { return draw(extract(gyroidAt, {0.0})); }},
    {"gyroid_culled", [] { return draw(extract(gyroidAt, {0.0}), {}, true); }},
    {"rims", [] { return draw(uvol_test::makeWaves(1500, 1)); }},
    {"two_isovalues",
     [] {
       return draw(
           extract([](const Eigen::Vector3f& x) { return x.norm() + 0.5f * x[0]; },
                   {1.5, 2.0}),
           {1.0, 0.4});
     }},
    {"traced_knot", [] { return trace(uvol_test::makeTorusKnot(9000, 3), 0.0); }},
    {"traced_mirror", [] { return trace(uvol_test::makeTorusKnot(9000, 3), 0.6); }},
    {"traced_rims", [] { return trace(uvol_test::makeWaves(1500, 1), 0.0); }},
};

class GoldenSubject : public testing::TestWithParam<Subject> {};

TEST_P(GoldenSubject, IsWhatItWas)
{
  EXPECT_GE(uvol_test::partLikeGolden(GetParam().name, GetParam().draw()),
            uvol_test::golden_part);
}

INSTANTIATE_TEST_SUITE_P(Subjects,
                         GoldenSubject,
                         testing::ValuesIn(subjects),
                         [](const auto& tested) { return tested.param.name; });

} // namespace test_golden_subjects
