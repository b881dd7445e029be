// SPDX-License-Identifier: BSD-3-Clause
// Colours of single rays where light, shadow and glass are known in closed form.
#include "src/render/ray_tracing/ray_shader.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace test_ray_shader {

using namespace pcl_uvol;
using Eigen::Vector3d;

RayMaterial
makeMaterial(double ambient, double diffuse)
{
  RayMaterial material;
  material.color = {1.0f, 1.0f, 1.0f};
  material.ambient = ambient;
  material.diffuse = diffuse;
  material.specular = 0.0;
  return material;
}

/** A white plane z = 0 and balls above it, before black. */
Scene
makeScene(double ambient, double diffuse)
{
  Scene scene;
  PlaneObject plane;
  plane.material = makeMaterial(ambient, diffuse);
  scene.planes.push_back(plane);
  scene.lights.clear();
  scene.background.color = {0.0f, 0.0f, 0.0f};
  return scene;
}

void
addBall(Scene& scene, const Vector3d& center, double radius)
{
  SphereObject ball;
  ball.center = center;
  ball.radius = radius;
  ball.material = makeMaterial(0.0, 0.0);
  scene.spheres.push_back(ball);
}

/** Brightness of the origin, seen from the side, a mean over some rays. */
double
brightness(const Scene& scene, const RayTracingSettings& settings)
{
  Report report;
  const World world(Scene(scene), 1, report);
  RayShader shader(world, settings, Camera());
  const Vector3d eye(6.0, 0.0, 0.5);
  double sum = 0.0;
  constexpr int rays = 16;
  for (std::uint64_t number = 0; number < rays; ++number)
    sum += shader.shade({eye, -eye.normalized()}, 0.5, number).color[0];
  return sum / rays;
}

/** A ball on the axis covers the middle of a round light: what is left is a part of the
 * area. */
TEST(RayShader, SoftShadowsArePartsOfTheAreaOfTheLight)
{
  constexpr double height = 10.0, light_radius = 2.0, ball_height = 5.0;
  for (const double covered : {0.0, 0.3, 0.5, 0.8, 1.2}) {
    Scene scene = makeScene(0.0, 1.0);
    Light light;
    light.kind = Light::Kind::Point;
    light.follows_camera = false;
    light.position = {0.0, 0.0, height};
    light.radius = light_radius;
    scene.lights.push_back(light);
    const double tangent = covered * light_radius / height;
    if (covered > 0.0)
      addBall(scene,
              {0.0, 0.0, ball_height},
              ball_height * tangent / std::hypot(1.0, tangent));
    RayTracingSettings settings;
    settings.light_samples = 500;
    EXPECT_NEAR(
        1.0 - std::min(1.0, covered * covered), brightness(scene, settings), 0.005)
        << covered;
  }
}

/** Half of it behind a ball that is as good as a half-space. */
TEST(RayShader, HalfALightIsHalfAsBright)
{
  Scene scene = makeScene(0.0, 1.0);
  Light light;
  light.kind = Light::Kind::Directional;
  light.follows_camera = false;
  light.position = {0.0, 0.0, 3.0};
  light.radius = 0.1;
  scene.lights.push_back(light);
  addBall(scene, {0.0, -1000.0, 50.0}, 1000.0);
  RayTracingSettings settings;
  settings.light_samples = 500;
  EXPECT_NEAR(0.5, brightness(scene, settings), 0.01);
}

/** Ambient light comes by the cosine: a ball overhead takes its squared sine. */
TEST(RayShader, AmbientLightIsWeightedByTheCosine)
{
  for (const double sine : {0.3, 0.6, 0.9}) {
    Scene scene = makeScene(1.0, 0.0);
    addBall(scene, {0.0, 0.0, 2.0}, 2.0 * sine);
    RayTracingSettings settings;
    settings.occlusion_samples = 500;
    settings.occlusion_distance = 100.0;
    EXPECT_NEAR(1.0 - sine * sine, brightness(scene, settings), 0.005) << sine;
    // The nearest place of the ball is too far away to matter.
    settings.occlusion_distance = 2.0 - 2.0 * sine - 0.01;
    EXPECT_NEAR(1.0, brightness(scene, settings), 1e-6);
  }
}

/** Fresnel's equations at a plane of glass over black: what comes back is the dome. */
TEST(RayShader, GlassMirrorsByFresnelsEquations)
{
  for (const double index : {1.33, 1.5, 2.4})
    for (const double angle : {0.1, 0.5, 1.0, 1.4}) {
      Scene scene = makeScene(0.0, 0.0);
      RayMaterial& glass = scene.planes[0].material;
      glass.transparency = 1.0;
      glass.refractive_index = index;
      PlaneObject ground = scene.planes[0];
      ground.point = {0.0, 0.0, -1.0};
      ground.material = makeMaterial(0.0, 0.0); // takes what goes through
      scene.planes.push_back(ground);
      scene.background.color = {1.0f, 1.0f, 1.0f};
      Report report;
      const World world(Scene(scene), 1, report);
      RayTracingSettings settings;
      settings.depth = 1;
      RayShader shader(world, settings, Camera());
      const Vector3d direction(std::sin(angle), 0.0, -std::cos(angle));
      const double behind = std::asin(std::sin(angle) / index);
      const double across =
          std::pow(std::sin(angle - behind) / std::sin(angle + behind), 2);
      const double along =
          std::pow(std::tan(angle - behind) / std::tan(angle + behind), 2);
      EXPECT_NEAR(0.5 * (across + along),
                  shader.shade({-3.0 * direction, direction}, 0.5, 0).color[0],
                  1e-9);
    }
}

} // namespace test_ray_shader
