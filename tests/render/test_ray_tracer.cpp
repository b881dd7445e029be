// SPDX-License-Identifier: BSD-3-Clause
// Ray tracing of spheres and planes, whose pictures are known: light, shadows, mirrors
// and glass.
#include "render/tracer_setup.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <limits>

namespace test_ray_tracer {

using namespace uvol_test;
using pcl_uvol::Camera;
using pcl_uvol::Image;
using pcl_uvol::InvalidArgument;
using pcl_uvol::Light;
using pcl_uvol::RayTracer;
using pcl_uvol::Scene;

/** The step of a byte of an image. */
constexpr double step = 1.0 / 255.0;

/** A scene without light, before black. */
Scene
darkScene()
{
  Scene scene;
  scene.lights.clear();
  scene.background.color = {0.0f, 0.0f, 0.0f};
  return scene;
}

TEST(RayTracer, LitSphereIsBlinnPhong)
{
  Scene scene = darkScene();
  scene.spheres.push_back({{0.0, 0.0, 0.0}, 1.0, {}});
  auto& material = scene.spheres[0].material;
  material.color = {0.9f, 0.5f, 0.2f};
  material.shininess = 20.0;
  scene.lights = {lightFrom({3.0, -4.0, 5.0}),
                  lightFrom({-1.0, -1.0, 0.2}, Light::Kind::Directional)};
  scene.lights[0].color = {0.8f, 0.8f, 0.6f};
  scene.lights[1].color = {0.1f, 0.2f, 0.4f};
  const Camera camera = looking({0.0, -6.0, 0.0}, {0.0, 0.0, 0.0}, 22.0);
  constexpr int size = 60;
  const Image image = trace(scene, camera, size);
  int lit = 0;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const Vector d = rayThrough(camera, size, column, row);
      const double b = camera.eye.dot(d), rest = b * b - camera.eye.squaredNorm() + 1.0;
      Vector expected = Vector::Zero();
      if (rest > 0.0) {
        const Vector n = camera.eye + (-b - std::sqrt(rest)) * d;
        const Vector color(0.9, 0.5, 0.2);
        expected = material.ambient * color;
        for (const Light& light : scene.lights) {
          const bool is_point = light.kind == Light::Kind::Point;
          const Vector l =
              (is_point ? Vector(light.position - n) : light.position).normalized();
          if (n.dot(l) <= 0.0) // a sphere shades itself there
            continue;
          ++lit;
          const Vector h = (l - d).normalized();
          const double highlight =
              material.specular * std::pow(n.dot(h), material.shininess);
          const Vector shine(light.color.r, light.color.g, light.color.b);
          expected += shine.cwiseProduct(material.diffuse * n.dot(l) * color +
                                         Vector::Constant(highlight));
        }
      }
      for (int channel = 0; channel < 3; ++channel)
        ASSERT_NEAR(std::min(expected[channel], 1.0),
                    channelAt(image, column, row, channel),
                    0.51 * step)
            << column << ", " << row;
    }
  EXPECT_GT(lit, 1000);
}

TEST(RayTracer, MirrorShowsWhatLiesInTheMirroredDirection)
{
  // The mirror stands at 45 degrees; what lies to the right is seen in its middle.
  Scene scene = darkScene();
  scene.planes.push_back({{0.0, 0.0, 0.0}, {1.0, -1.0, 0.0}, clear(0.5, 0.0), 0.0, {}});
  scene.spheres.push_back({{5.0, 0.0, 0.0}, 0.2, glowing(1.0f, 0.0f, 0.0f)});
  const Camera camera = looking({0.0, -5.0, 0.0}, {0.0, 0.0, 0.0}, 6.0);
  constexpr int size = 61;
  const Image image = trace(scene, camera, size);
  for (int column = 0; column < size; ++column) {
    // Unfolded, the sphere stands 10 behind the eye.
    const Vector d = rayThrough(camera, size, column, size / 2);
    const double off = 10.0 * std::abs(d.x()) / d.norm();
    if (std::abs(off - 0.2) > 0.01) {
      EXPECT_NEAR(off < 0.2 ? 0.5 : 0.0, channelAt(image, column, size / 2), step)
          << column;
    }
  }
}

/** Part of the light that is mirrored where a ray leaves or enters glass. */
double
fresnel(double from_index, double to_index, double sine)
{
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double sine_behind = sine * from_index / to_index;
  if (sine_behind >= 1.0)
    return 1.0;
  const double cosine_behind = std::sqrt(1.0 - sine_behind * sine_behind);
  const double s = (from_index * cosine - to_index * cosine_behind) /
                   (from_index * cosine + to_index * cosine_behind);
  const double p = (from_index * cosine_behind - to_index * cosine) /
                   (from_index * cosine_behind + to_index * cosine);
  return 0.5 * (s * s + p * p);
}

TEST(RayTracer, GlassLetsThroughWhatItDoesNotMirror)
{
  // From within a ball, off its centre: beyond the critical angle all is mirrored, and
  // what is mirrored ends at depth 1.
  constexpr double index = 1.5, off = 0.9;
  Scene scene;
  scene.lights.clear();
  scene.spheres.push_back({{0.0, 0.0, 0.0}, 1.0, clear(0.0, 1.0, index)});
  const Camera camera = looking({0.0, off, 0.0}, {1.0, off, 0.0}, 100.0);
  constexpr int size = 61;
  const Image image = trace(scene, camera, size, 1);
  int total = 0, partial = 0;
  for (int column = 0; column < size; ++column) {
    const Vector d = rayThrough(camera, size, column, size / 2);
    // The law of sines in the triangle of eye, centre and place.
    const double sine =
        off * std::sqrt(1.0 - std::pow(d.dot(camera.eye.normalized()), 2));
    const double mirrored = fresnel(index, 1.0, sine);
    EXPECT_NEAR(1.0 - mirrored, channelAt(image, column, size / 2), step) << column;
    (mirrored == 1.0 ? total : partial) += 1;
  }
  EXPECT_GT(total, 10);
  EXPECT_GT(partial, 10);
}

TEST(RayTracer, GlassBallHasItsFocalLength)
{
  // From far away parallel rays close to the axis meet at n R / 2 (n - 1) behind the
  // centre.
  constexpr double index = 1.6, height = 0.08;
  constexpr double focus = index / (2.0 * (index - 1.0));
  const Camera camera = looking({0.0, -1000.0, 0.0},
                                {0.0, 0.0, 0.0},
                                2.0 * std::atan(height / 1000.0) * 180.0 / M_PI);
  constexpr int size = 21;
  for (const double distance : {focus, 1.5 * focus}) {
    Scene scene = darkScene();
    scene.spheres.push_back({{0.0, 0.0, 0.0}, 1.0, clear(0.0, 1.0, index)});
    scene.spheres.push_back({{0.0, distance, 0.0}, 0.01, glowing(1.0f, 1.0f, 1.0f)});
    const Image image = trace(scene, camera, size);
    const double at_normal = 1.0 - fresnel(1.0, index, 0.0);
    int seen = 0;
    for (int column = 0; column < size; ++column)
      seen += channelAt(image, column, size / 2) > 0.9 * at_normal * at_normal ? 1 : 0;
    if (distance == focus) {
      EXPECT_EQ(size, seen);
    }
    else {
      EXPECT_LT(seen, size / 2);
    }
  }
}

TEST(RayTracer, LightIsBentAtAPlane)
{
  // Down into water: a ball under water, seen where Snell's law puts it.
  constexpr double index = 1.33, deep = 2.0;
  const Camera camera = looking({0.0, 0.0, 3.0}, {2.0, 0.0, 0.0}, 20.0);
  constexpr int size = 81;
  const Vector middle = rayThrough(camera, size, size / 2, size / 2);
  const double sine = middle.head<2>().norm(), below = sine / index;
  const double reach = 2.0 + deep * below / std::sqrt(1.0 - below * below);
  Scene scene = darkScene();
  scene.planes.push_back(
      {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, clear(0.0, 1.0, index), 0.0, {}});
  scene.spheres.push_back({{reach, 0.0, -deep}, 0.03, glowing(1.0f, 1.0f, 1.0f)});
  const Image image = trace(scene, camera, size, 2);
  EXPECT_NEAR(1.0 - fresnel(1.0, index, sine),
              channelAt(image, size / 2, size / 2),
              2.0 * step);
  EXPECT_LT(channelAt(image, size / 2, size / 2 + 8), 0.2);
  EXPECT_LT(channelAt(image, size / 2, size / 2 - 8), 0.2);
}

/** A ball over a plane, looked at from above; the light is straight above as well. */
Scene
ballOverPlane(double light_radius)
{
  Scene scene = darkScene();
  scene.planes.push_back({{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {}, 0.0, {}});
  auto& material = scene.planes[0].material;
  material.color = {1.0f, 1.0f, 1.0f};
  material.ambient = material.specular = 0.0;
  material.diffuse = 1.0;
  scene.spheres.push_back({{0.0, 0.0, 2.0}, 0.5, glowing(0.0f, 0.0f, 0.0f)});
  scene.lights = {lightFrom({0.0, 0.0, 4.0})};
  scene.lights[0].radius = light_radius;
  return scene;
}

TEST(RayTracer, ShadowsEndWhereTheyShould)
{
  // A cone about the ball: sin = 0.5 / 2.
  const double border = 4.0 * 0.25 / std::sqrt(1.0 - 0.25 * 0.25);
  const Camera camera = looking({0.0, -6.0, 1.0}, {0.0, 0.0, 0.0}, 30.0);
  constexpr int size = 101;
  const Image image = trace(ballOverPlane(0.0), camera, size);
  int shaded = 0, lit = 0;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const Vector d = rayThrough(camera, size, column, row);
      const Vector place = camera.eye - camera.eye.z() / d.z() * d;
      const double distance = place.head<2>().norm();
      if (d.z() >= 0.0 || distance > 3.0 || std::abs(distance - border) < 1e-3)
        continue;
      const double lambert = 4.0 / std::hypot(4.0, distance);
      EXPECT_NEAR(
          distance < border ? 0.0 : lambert, channelAt(image, column, row), step)
          << column << ", " << row;
      (distance < border ? shaded : lit) += 1;
    }
  EXPECT_GT(shaded, 100);
  EXPECT_GT(lit, 1000);
}

TEST(RayTracer, LargeLightsCastSoftShadows)
{
  // In the middle of the plane's half shadow half of the light is seen.
  const Camera camera = looking({0.0, -0.01, 0.5}, {1.03279556, 0.0, 0.0}, 0.01);
  const double lambert = 4.0 / std::hypot(4.0, 1.03279556);
  for (const double radius : {0.05, 0.2}) {
    Scene scene = ballOverPlane(radius);
    RayTracer tracer;
    tracer.setScene(scene);
    tracer.setCamera(camera);
    tracer.setSize(8, 8);
    tracer.settings().light_samples = 256;
    Image image;
    tracer.render(image);
    double sum = 0.0;
    for (int pixel = 0; pixel < 64; ++pixel)
      sum += channelAt(image, pixel % 8, pixel / 8);
    EXPECT_NEAR(0.5 * lambert, sum / 64.0, 0.05) << radius;
  }
}

TEST(RayTracer, GlassCastsALightShadow)
{
  const Camera camera = looking({0.0, -6.0, 1.0}, {0.0, -0.5, 0.0}, 1.0);
  Scene scene = ballOverPlane(0.0);
  scene.spheres[0].material = clear(0.0, 0.6);
  const double lambert = 4.0 / std::hypot(4.0, 0.5);
  EXPECT_NEAR(0.6 * lambert, channelAt(trace(scene, camera, 1), 0, 0), step);
}

TEST(RayTracer, AmbientLightDoesNotReachCorners)
{
  // On a plane beside a wall as high as the distance counts half of the sky is there.
  Scene scene = darkScene();
  scene.planes.push_back({{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, glowing(1, 1, 1), 0.0, {}});
  scene.planes.push_back(
      {{0.0, 0.001, 0.0}, {0.0, -1.0, 0.0}, glowing(1, 1, 1), 0.0, {}});
  RayTracer tracer;
  tracer.setScene(scene);
  tracer.setSize(4, 4);
  tracer.settings().occlusion_samples = 1024;
  tracer.settings().occlusion_distance = 1.0;
  Image image;
  tracer.setCamera(looking({0.0, -0.2, 0.3}, {0.0, 0.0, 0.0}, 0.01));
  tracer.render(image);
  EXPECT_NEAR(0.5, channelAt(image, 1, 1), 0.02);
  tracer.setCamera(looking({0.0, -5.0, 0.3}, {0.0, -4.0, 0.0}, 0.01));
  tracer.render(image);
  EXPECT_NEAR(1.0, channelAt(image, 1, 1), step);
}

TEST(RayTracer, EndsAtItsDepth)
{
  // Within a mirroring ball every ray goes on: c (1 - r^(depth + 1)) is seen.
  Scene scene = darkScene();
  scene.spheres.push_back({{0.0, 0.0, 0.0}, 1.0, glowing(0.8f, 0.8f, 0.8f)});
  scene.spheres[0].material.reflectivity = 0.5;
  const Camera camera = looking({0.1, 0.0, 0.0}, {0.0, 0.3, 0.1}, 60.0);
  for (const int depth : {0, 1, 2, 5})
    EXPECT_NEAR(0.8 * (1.0 - std::pow(0.5, depth + 1)),
                channelAt(trace(scene, camera, 3, depth), 1, 1),
                step)
        << depth;
  // Perfect mirrors and glass end as well, and soon.
  scene.spheres[0].material = clear(1.0, 0.0);
  EXPECT_EQ(0.0, channelAt(trace(scene, camera, 3, 1000), 1, 1));
  scene.spheres[0].material = clear(0.5, 0.5, 1.5);
  EXPECT_EQ(0.0, channelAt(trace(scene, camera, 3, 1000), 1, 1));
}

TEST(RayTracer, BackgroundsAndOpacity)
{
  Scene scene;
  scene.spheres.push_back({{0.0, 0.0, 0.0}, 1.0, glowing(0.0f, 1.0f, 0.0f)});
  const Camera camera = looking({0.0, -9.0, 0.0}, {0.0, 0.0, 0.0}, 30.0);
  scene.background.color = {0.2f, 0.4f, 0.6f};
  EXPECT_NEAR(0.4, channelAt(trace(scene, camera, 9), 0, 0, 1), step);
  scene.background.kind = pcl_uvol::Background::Kind::Gradient;
  scene.background.top = {1.0f, 1.0f, 1.0f};
  const Image gradient = trace(scene, camera, 9);
  EXPECT_NEAR(0.4 + 0.6 * 8.5 / 9.0, channelAt(gradient, 0, 0, 1), step);
  EXPECT_NEAR(0.4 + 0.6 * 0.5 / 9.0, channelAt(gradient, 0, 8, 1), step);
  scene.background.kind = pcl_uvol::Background::Kind::Transparent;
  const Image transparent = trace(scene, camera, 9);
  EXPECT_EQ(0.0, channelAt(transparent, 0, 0, 3));
  EXPECT_EQ(1.0, channelAt(transparent, 4, 4, 3));
  EXPECT_EQ(1.0, channelAt(transparent, 4, 4, 1));
}

TEST(RayTracer, ChessboardsAndSupersampling)
{
  Scene scene = darkScene();
  scene.planes.push_back(
      {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, glowing(1, 1, 1), 0.5, {0.0f, 0.0f, 0.0f}});
  RayTracer tracer;
  tracer.setScene(scene);
  tracer.setCamera(looking({0.05, 0.07, 1000.0}, {0.05, 0.07, 0.0}, 0.5, {0, 1, 0}));
  tracer.setSize(16, 16);
  Image image;
  tracer.render(image);
  int white = 0;
  for (int pixel = 0; pixel < 256; ++pixel)
    white += channelAt(image, pixel % 16, pixel / 16) == 1.0 ? 1 : 0;
  EXPECT_NEAR(128, white, 40);
  tracer.setSupersampling(4);
  tracer.render(image);
  int between = 0;
  for (int pixel = 0; pixel < 256; ++pixel) {
    const double value = channelAt(image, pixel % 16, pixel / 16);
    between += value > 0.0 && value < 1.0 ? 1 : 0;
  }
  EXPECT_GT(between, 100);
}

TEST(RayTracer, RejectsBadInput)
{
  RayTracer tracer;
  Image image;
  image.width = 7;
  EXPECT_THROW(tracer.render(image), InvalidArgument);
  EXPECT_THROW(tracer.getBounds(), InvalidArgument);
  EXPECT_THROW(tracer.setScene(Scene()), InvalidArgument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [&](const auto& change) {
    Scene scene;
    scene.spheres.emplace_back();
    scene.planes.emplace_back();
    scene.splats.push_back(objectOf({discAt({0, 0, 0}, {0, 0, 1}, 1.0)}));
    EXPECT_NO_THROW(tracer.setScene(scene));
    change(scene);
    EXPECT_THROW(tracer.setScene(scene), InvalidArgument);
  };
  refuses([](Scene& s) { s.spheres[0].radius = 0.0; });
  refuses([nan](Scene& s) { s.spheres[0].center[1] = nan; });
  refuses([](Scene& s) { s.planes[0].normal.setZero(); });
  refuses([](Scene& s) { s.planes[0].square = -1.0; });
  refuses([](Scene& s) { s.spheres[0].material.refractive_index = 0.0; });
  refuses([](Scene& s) { s.spheres[0].material.reflectivity = -0.1; });
  refuses([](Scene& s) { s.spheres[0].material = clear(0.7, 0.4); });
  refuses([nan](Scene& s) { s.planes[0].material.diffuse = nan; });
  refuses([](Scene& s) { s.lights[0].position.setZero(); });
  refuses([](Scene& s) { s.lights[0].radius = -1.0; });
  refuses([](Scene& s) { s.background.color.g = -1.0f; });
  refuses([](Scene& s) { s.splats[0] = objectOf({}); });
  refuses([](Scene& s) { s.splats[0].splats.reset(); });
  refuses([](Scene& s) { s.splats[0].colors.resize(2); });
  refuses([](Scene& s) {
    s.splats[0] = objectOf({discAt({0, 0, 0}, {0, 0, 1}, 0.0)});
  });
  refuses([nan](Scene& s) {
    s.splats[0] = objectOf({discAt({0, 0, nan}, {0, 0, 1}, 1.0)});
  });

  Scene scene;
  scene.spheres.emplace_back();
  tracer.setScene(scene);
  const auto refusesSetting = [&](const auto& change) {
    const auto settings = tracer.settings();
    change(tracer.settings());
    EXPECT_THROW(tracer.render(image), InvalidArgument);
    tracer.settings() = settings;
  };
  refusesSetting([](auto& s) { s.depth = -1; });
  refusesSetting([](auto& s) { s.light_samples = 0; });
  refusesSetting([](auto& s) { s.occlusion_samples = -1; });
  refusesSetting([nan](auto& s) { s.occlusion_distance = nan; });
  tracer.setSupersampling(0);
  EXPECT_THROW(tracer.render(image), InvalidArgument);
  tracer.setSupersampling(1);
  tracer.setSize(0, 5);
  EXPECT_THROW(tracer.render(image), InvalidArgument);
  tracer.setSize(5, 16385);
  EXPECT_THROW(tracer.render(image), InvalidArgument);
  tracer.setSize(5, 5);
  tracer.setCamera(looking({0, 0, 0}, {0, 0, 0}, 30.0));
  EXPECT_THROW(tracer.render(image), InvalidArgument);
  EXPECT_EQ(7u, image.width);
}

TEST(RayTracer, ManyLightsAndAnExceptionFromProgress)
{
  Scene scene = darkScene();
  scene.spheres.push_back({{0.0, 0.0, 0.0}, 1.0, {}});
  for (int i = 0; i < 100; ++i)
    scene.lights.push_back(lightFrom({0.1 * i - 5.0, -5.0, 3.0}));
  const Image image = trace(scene, looking({0, -6, 0}, {0, 0, 0}, 20.0), 9);
  EXPECT_EQ(1.0, channelAt(image, 4, 4));
  RayTracer tracer;
  tracer.setScene(scene);
  tracer.setSize(64, 64);
  tracer.setProgressCallback(
      [](const std::string&, double) { throw std::runtime_error("enough"); });
  Image untouched;
  EXPECT_THROW(tracer.render(untouched), std::runtime_error);
  EXPECT_TRUE(untouched.color.empty());
}

} // namespace test_ray_tracer
