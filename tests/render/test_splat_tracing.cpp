// SPDX-License-Identifier: BSD-3-Clause
// Ray tracing of splats (thesis 4.2.2): which of them is hit, and how they are
// averaged.
#include "render/tracer_setup.h"
#include "support/environment.h"
#include "support/surfaces.h"
#include "surface/rim_lines.h"
#include "surface/splat_input.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>

namespace test_splat_tracing {

using namespace uvol_test;
using pcl_uvol::Camera;
using pcl_uvol::Image;
using pcl_uvol::Rgba;
using pcl_uvol::Scene;

constexpr double step = 1.0 / 255.0;
constexpr Rgba red = 0xff0000ff, green = 0xff00ff00;

Scene
sceneOf(const std::vector<pcl_uvol::PointSplat>& splats,
        const std::vector<Rgba>& colors)
{
  Scene scene;
  scene.lights.clear();
  scene.background.color = {0.0f, 0.0f, 0.0f};
  scene.splats.push_back(objectOf(splats, colors));
  return scene;
}

TEST(SplatTracing, TheNearerOfTwoSurfacesIsSeen)
{
  // Far apart the first one is hit, although the ray passes near the other's centre.
  const Camera camera = looking({0.9, 0.0, 10.0}, {0.9, 0.0, 0.0}, 0.01, {0, 1, 0});
  const Image image = trace(sceneOf({discAt({0, 0, 0}, {0, 0, 1}, 1.0),
                                     discAt({0.9, 0.0, -0.6}, {0, 0, 1}, 1.0)},
                                    {red, green}),
                            camera,
                            1);
  EXPECT_NEAR(1.0, channelAt(image, 0, 0, 0), step);
  EXPECT_NEAR(0.0, channelAt(image, 0, 0, 1), step);
}

/** A picture of a wall, behind what looks away from the eye if that is there, over a
 * mirror: in the light of a lamp at the eye. */
Image
traceWall(bool has_back, bool two_sided, bool culls)
{
  Scene scene;
  scene.lights = {lightFrom({0.5, -9.0, 1.0})};
  scene.splats.push_back(objectOf({discAt({0, 0, 0}, {0, -1, 0.2}, 3.0)}, {green}));
  scene.splats[0].material = {};
  if (has_back) {
    scene.splats.push_back(objectOf({discAt({0.5, -3, 0.3}, {0, 1, 0}, 0.5),
                                     discAt({0.6, -3.1, 0.3}, {0.1, 1, 0}, 0.5),
                                     discAt({-0.5, -4, 1.0}, {0.2, 1, 0}, 0.3)},
                                    {red, red, red}));
    scene.splats[1].two_sided = two_sided;
  }
  scene.planes.push_back({{0, 0, -1}, {0, 0, 1}, clear(1.0, 0.0), 0.0, {}});
  pcl_uvol::RayTracer tracer;
  tracer.setScene(scene);
  tracer.setCamera(looking({0, -9, 1}, {0, 0, 0}, 30.0));
  tracer.setSize(60, 60);
  tracer.settings().occlusion_samples = 8;
  tracer.settings().occlusion_distance = 5.0;
  tracer.settings().cull_back_faces = culls;
  Image image;
  tracer.render(image);
  return image;
}

TEST(SplatTracing, CulledSplatsAreNotThere)
{
  const Image alone = traceWall(false, false, false);
  EXPECT_TRUE(alone.color == traceWall(false, false, true).color);
  const auto different = [&](const Image& image) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.color.size(); ++i)
      count += std::abs(image.color[i] - alone.color[i]) > 1;
    return count;
  };
  EXPECT_GT(different(traceWall(true, false, false)), 500u); // itself and its shadow
  EXPECT_EQ(0u, different(traceWall(true, false, true)));
  EXPECT_TRUE(traceWall(true, true, true).color ==
              traceWall(true, true, false).color); // no side is its back
}

TEST(SplatTracing, ClosedSurfacesLookAsWellWithoutTheirBacks)
{
  const auto points = makeSphere(5000, 3);
  const auto render = [&](double outwards, bool culls) {
    auto turned = *points;
    for (auto& point : turned)
      point.getNormalVector3fMap() *= static_cast<float>(outwards);
    pcl_uvol::SplatGeneration<pcl::PointNormal> generation;
    generation.setInputCloud(turned.makeShared());
    std::vector<pcl_uvol::PointSplat> splats;
    pcl::PointCloud<pcl_uvol::PointSplat> cloud;
    generation.compute(cloud);
    splats.assign(cloud.begin(), cloud.end());
    Scene scene;
    scene.background.color = {0.0f, 0.0f, 1.0f};
    scene.splats.push_back(objectOf(splats));
    scene.splats[0].material = {};
    pcl_uvol::RayTracer tracer;
    tracer.setScene(scene);
    tracer.setCamera(looking({0, -6, 0}, {0, 0, 0}, 25.0));
    tracer.setSize(100, 100);
    tracer.settings().cull_back_faces = culls;
    tracer.setNormalPlane(true);
    Image image;
    tracer.render(image);
    return image;
  };
  const Image whole = render(1.0, false), culled = render(1.0, true);
  std::size_t different = 0;
  for (std::size_t i = 0; i < whole.color.size(); ++i)
    different += std::abs(whole.color[i] - culled.color[i]) > 1;
  EXPECT_LT(different, 4u * 30u); // at the outline, where splats stand out
  // Of a hollow ball the far wall is seen, lit by the lamp in front of the near one.
  const Image inside = render(-1.0, true);
  const std::size_t middle = 50 * 100 + 50;
  EXPECT_LT(inside.normal[3 * middle + 1], -0.99f); // towards the eye, at its back
  EXPECT_GT(inside.color[4 * middle], 100);
}

TEST(SplatTracing, CracksBetweenSplatsDoNotShowTheInsideOfWhatIsBehind)
{
  const Camera camera = looking({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, 0.01, {0, 1, 0});
  const auto isRed = [&](std::vector<pcl_uvol::PointSplat> splats, double behind) {
    std::vector<Rgba> colors(splats.size(), red);
    splats.push_back(discAt({0, 0, -5}, {0, 0, behind}, 1.0));
    colors.push_back(green);
    const Image image = trace(sceneOf(splats, colors), camera, 1);
    EXPECT_NEAR(1.0, channelAt(image, 0, 0, 0) + channelAt(image, 0, 0, 1), step);
    return channelAt(image, 0, 0, 0) > 0.5;
  };
  const auto ring = [](double distance, double up) {
    std::vector<pcl_uvol::PointSplat> splats;
    for (const auto& [x, y] : {std::pair(1.0, 0.0), {-0.6, 0.8}, {-0.6, -0.8}})
      splats.push_back(discAt({distance * x, distance * y, x}, {0.2 * x, 0, up}, 1.0));
    return splats;
  };
  EXPECT_TRUE(isRed(ring(1.3, 1.0), -1.0));
  EXPECT_TRUE(isRed(ring(1.7, 1.0), -1.0));
  // A hole, a front behind it, backs in front of it, and a rim.
  EXPECT_FALSE(isRed(ring(2.2, 1.0), -1.0));
  EXPECT_FALSE(isRed(ring(1.3, 1.0), 1.0));
  EXPECT_FALSE(isRed(ring(1.3, -1.0), -1.0));
  EXPECT_FALSE(isRed({discAt({1.3, 0.0, 0.0}, {0, 0, 1}, 1.0),
                      discAt({1.2, 0.6, 0.0}, {0, 0, 1}, 1.0),
                      discAt({1.2, -0.6, 0.0}, {0, 0, 1}, 1.0)},
                     -1.0));
}

TEST(SplatTracing, OutlinesDoNotShowTheBacksOfSplatsBeyondThem)
{
  // Past the last of three that look to the eye, with a back not far behind them or
  // far.
  const Camera camera = looking({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, 0.01, {0, 1, 0});
  const auto redness = [&](double behind, const Vector& normal) {
    std::vector<pcl_uvol::PointSplat> splats;
    for (const double y : {-0.5, 0.0, 0.5})
      splats.push_back(discAt({1.3, y, 0.0}, {-0.3, 0.0, 1.0}, 1.0));
    splats.push_back(discAt({-0.5, 0.0, -behind}, normal, 1.0));
    return channelAt(
        trace(sceneOf(splats, {red, red, red, green}), camera, 1), 0, 0, 0);
  };
  EXPECT_NEAR(1.0, redness(0.5, {-1.0, 0.0, -1.0}), step);
  EXPECT_NEAR(1.0, redness(3.0, {-1.0, 0.0, -1.0}), step);
  EXPECT_NEAR(0.0, redness(6.0, {-1.0, 0.0, -1.0}), step);
  EXPECT_NEAR(0.0, redness(0.5, {-1.0, 0.0, 1.0}), step); // not a back
}

TEST(SplatTracing, BacksAreNotAveragedWithFronts)
{
  // Over an edge of a right angle the splats of both sides stand out.
  const Camera camera = looking({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, 0.01, {0, 1, 0});
  for (const double behind : {-0.2, 0.2}) { // the back is met first or last
    const Image image =
        trace(sceneOf({discAt({0.3, 0.0, 0.0}, {-0.6, 0.0, 0.8}, 1.0),
                       discAt({-0.1, 0.0, -behind}, {-0.9, 0.0, -0.2}, 1.0)},
                      {red, green}),
              camera,
              1);
    EXPECT_NEAR(1.0, channelAt(image, 0, 0, 0), step) << behind;
    EXPECT_NEAR(0.0, channelAt(image, 0, 0, 1), step) << behind;
  }
}

/** A red disc of radius 2 that ends at 1 along its tangent and at -0.5 across, over a
 * green floor, tilted with it. */
struct CutDisc {
  pcl_uvol::PointSplat splat = discAt({1, 2, 3}, {0.3, -0.5, 1.0}, 2.0);
  Vector n = splat.getNormalVector3fMap().cast<double>(),
         u = splat.getTangentVector3fMap().cast<double>(), v = n.cross(u),
         center = splat.getVector3fMap().cast<double>();
  Scene scene = sceneOf({splat}, {red});

  CutDisc()
  {
    scene.splats[0].rims = {
        pcl_uvol::packRim({pcl_uvol::RimLine{Eigen::Vector2f(1.0f, 0.0f), 1.0f},
                           pcl_uvol::RimLine{Eigen::Vector2f(0.0f, -1.0f), 0.5f}},
                          2.0f)};
    scene.planes.push_back({center - n, n, glowing(0.0f, 1.0f, 0.0f), 0.0, {}});
  }

  /** A place in the plane of the disc, so high above it. */
  Vector
  at(double along, double across, double height) const
  {
    return center + along * u + across * v + height * n;
  }

  /** The channel of a ray straight down. */
  double
  seenAt(double along, double across, int channel) const
  {
    return channelAt(
        trace(scene, looking(at(along, across, 9), at(along, across, 0), 0.001, u), 1),
        0,
        0,
        channel);
  }
};

TEST(SplatTracing, DiscsEndAtTheLinesOfRims)
{
  const CutDisc disc;
  constexpr double near = 1e-3;
  for (const auto& [along, across] : {std::pair(1.0, 0.0), {1.0, 0.9}, {1.0, -0.4}}) {
    EXPECT_NEAR(1.0, disc.seenAt(along - near, across, 0), step);
    EXPECT_NEAR(1.0, disc.seenAt(along + near, across, 1), step);
  }
  for (const auto& [along, across] :
       {std::pair(0.0, -0.5), {0.9, -0.5}, {-1.5, -0.5}}) {
    EXPECT_NEAR(1.0, disc.seenAt(along, across + near, 0), step);
    EXPECT_NEAR(1.0, disc.seenAt(along, across - near, 1), step);
  }
  EXPECT_NEAR(1.0, disc.seenAt(-2.0 + near, 0.0, 0), step); // where no line is
  EXPECT_NEAR(1.0, disc.seenAt(-2.0 - near, 0.0, 1), step);
}

TEST(SplatTracing, WhatLinesOfRimsCutOffThrowsNoShadow)
{
  CutDisc disc;
  disc.scene.planes[0].material.ambient = 0.0;
  disc.scene.planes[0].material.diffuse = 1.0;
  disc.scene.lights = {lightFrom(disc.n, pcl_uvol::Light::Kind::Directional)};
  // From the side, below the disc, whose shadow is straight below it.
  const auto brightness = [&](double along, double across) {
    const Camera camera = looking(disc.at(along + 9.0, across, -0.9),
                                  disc.at(along, across, -1.0),
                                  0.001,
                                  disc.n);
    return channelAt(trace(disc.scene, camera, 1), 0, 0, 1);
  };
  constexpr double near = 1e-2;
  EXPECT_NEAR(0.0, brightness(1.0 - near, 0.0), step);
  EXPECT_NEAR(1.0, brightness(1.0 + near, 0.0), step);
  EXPECT_NEAR(0.0, brightness(0.0, -0.5 + near), step);
  EXPECT_NEAR(1.0, brightness(0.0, -0.5 - near), step);
  EXPECT_NEAR(0.0, brightness(-2.0 + near, 0.0), step);
  EXPECT_NEAR(1.0, brightness(-2.0 - near, 0.0), step);
}

TEST(SplatTracing, ThereAreAsManyRimsAsSplats)
{
  CutDisc disc;
  disc.scene.splats[0].rims.push_back(0);
  EXPECT_THROW(disc.seenAt(0.0, 0.0, 0), pcl_uvol::InvalidArgument);
}

TEST(SplatTracing, OpenSurfacesEndWhereTheyDoInImageSpace)
{
  const auto sheet = makeWaves(1500, 1);
  pcl_uvol::ImageSpaceRenderer<pcl::PointNormal> renderer;
  renderer.setInputCloud(sheet);
  pcl_uvol::SplatGeneration<pcl::PointNormal> generation;
  generation.setInputCloud(sheet);
  const pcl::PointCloud<pcl_uvol::PointSplat>::Ptr splats(
      new pcl::PointCloud<pcl_uvol::PointSplat>);
  generation.compute(*splats);
  const Camera camera = looking({0.5, -4.0, 6.0}, {0, 0, 0}, 22.0);
  constexpr int size = 400;
  renderer.setSize(size, size);
  renderer.setCamera(camera);
  renderer.settings().background.kind = pcl_uvol::Background::Kind::Transparent;
  Image flat;
  renderer.render(flat);
  const auto countDifferent = [&](const std::vector<std::uint32_t>& rims) {
    Scene scene;
    scene.background.kind = pcl_uvol::Background::Kind::Transparent;
    pcl_uvol::SplatObject object;
    object.splats = splats;
    object.rims = rims;
    scene.splats.push_back(object);
    const Image traced = trace(scene, camera, size);
    int different = 0;
    for (std::size_t i = 3; i < traced.color.size(); i += 4)
      different += (traced.color[i] > 127) != (flat.color[i] > 127) ? 1 : 0;
    return different;
  };
  const int whole = countDifferent({}), cut = countDifferent(generation.getRims());
  EXPECT_LT(20 * cut, whole);
}

TEST(SplatTracing, OverlappingSplatsAreAveraged)
{
  // Figure 4.4: 0.8 and 0.3 radii off their centres.
  const Camera camera = looking({0.8, 0.0, 10.0}, {0.8, 0.0, 0.0}, 0.01, {0, 1, 0});
  const Vector tilted(0.1, 0.0, 1.0);
  const Image image = trace(sceneOf({discAt({0, 0, 0}, {0, 0, 1}, 1.0),
                                     discAt({0.5, 0.0, -0.2}, tilted, 1.0)},
                                    {red, green}),
                            camera,
                            1);
  // On the tilted disc the place is a bit farther from the centre.
  const double offset = 0.3 * std::hypot(1.0, 0.1);
  const double near = 1.0 - 0.8, far = 1.0 - offset;
  EXPECT_NEAR(near / (near + far), channelAt(image, 0, 0, 0), step);
  EXPECT_NEAR(far / (near + far), channelAt(image, 0, 0, 1), step);
  const Vector normal =
      (near * Vector::UnitZ() + far * tilted.normalized()).normalized();
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(normal[axis], image.normal[static_cast<std::size_t>(axis)], 1e-5);
}

TEST(SplatTracing, ThinSheetsAreNotAveraged)
{
  // The back of a thin plate looks the other way.
  const Camera camera = looking({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, 0.01, {0, 1, 0});
  const Image image = trace(sceneOf({discAt({0, 0, 0}, {0, 0, 1}, 1.0),
                                     discAt({0, 0, -0.1}, {0, 0, -1}, 1.0)},
                                    {red, green}),
                            camera,
                            1);
  EXPECT_NEAR(1.0, channelAt(image, 0, 0, 0), step);
  EXPECT_NEAR(0.0, channelAt(image, 0, 0, 1), step);
}

TEST(SplatTracing, NormalsFollowTheField)
{
  pcl_uvol::PointSplat splat = discAt({0, 0, 0}, {0, 0, 1}, 2.0);
  splat.getTangentVector3fMap() = Eigen::Vector3f::UnitX();
  splat.tilt_u = 0.05f;
  splat.tilt_v = -0.1f;
  splat.slope_u = 0.3f;
  splat.slope_v = -0.2f;
  const Vector place(0.5, -0.7, 0.0);
  const Camera camera = looking(place + Vector(0.0, 0.0, 9.0), place, 0.001, {0, 1, 0});
  const Image image = trace(sceneOf({splat}, {}), camera, 1);
  const Vector normal = Vector(0.05 + 0.3 * 0.25, -0.1 - 0.2 * -0.35, 1.0).normalized();
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(normal[axis], image.normal[static_cast<std::size_t>(axis)], 1e-5);
}

/** What is seen of some splats along a ray, found by looking at all of them. */
std::optional<Vector>
colorByBruteForce(const std::vector<pcl_uvol::PointSplat>& splats,
                  const std::vector<Rgba>& colors,
                  const Vector& eye,
                  const Vector& d)
{
  struct Hit {
    double distance, offset;
    std::size_t splat;
  };
  std::vector<Hit> hits;
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const Vector n = splats[i].getNormalVector3fMap().cast<double>(),
                 c = splats[i].getVector3fMap().cast<double>();
    const double t = (c - eye).dot(n) / d.dot(n);
    const double offset = (eye + t * d - c).norm() / splats[i].radius;
    if (!(t > 0.0) || offset > 1.0)
      continue;
    hits.push_back({t, offset, i});
    limit = std::min(limit, t + 0.5 * splats[i].radius);
  }
  if (hits.empty())
    return std::nullopt;
  const auto first = std::min_element(hits.begin(), hits.end(), [](auto& a, auto& b) {
    return a.distance < b.distance;
  });
  Vector sum = Vector::Zero();
  double weights = 0.0;
  for (const Hit& hit : hits) {
    if (hit.distance > limit ||
        splats[hit.splat].getNormalVector3fMap().dot(
            splats[first->splat].getNormalVector3fMap()) <= 0.0f)
      continue;
    const Rgba color = colors[hit.splat];
    sum += (1.0 - hit.offset) *
           Vector(color & 0xff, color >> 8 & 0xff, color >> 16 & 0xff) / 255.0;
    weights += 1.0 - hit.offset;
  }
  return Vector(sum / weights);
}

TEST(SplatTracing, FindsWhatBruteForceFinds)
{
  // From few splats, which are one leaf, to a tree of three levels; of all sizes.
  for (const std::size_t count : {1u, 15u, 17u, 300u, 3000u}) {
    Random random(count);
    std::vector<pcl_uvol::PointSplat> splats;
    std::vector<Rgba> colors;
    const auto any = [&] {
      return Vector(random.uniform(), random.uniform(), random.uniform());
    };
    const Camera camera = looking({2.0, -1.5, 1.2}, {0.5, 0.5, 0.5}, 40.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double radius = (i % 10 == 0 ? 1.0 : 0.2) / std::cbrt(count);
      const Vector center = any(), normal = any() - Vector::Constant(0.5);
      // Backs have rules of their own.
      const bool looks_to_eye = normal.dot(camera.eye - center) > 0.0;
      splats.push_back(discAt(center, looks_to_eye ? normal : -normal, radius));
      colors.push_back(static_cast<Rgba>(random.uniform() * 0xffffff) | 0xff000000u);
    }
    constexpr int size = 48;
    const Image image = trace(sceneOf(splats, colors), camera, size);
    int seen = 0, different = 0;
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const auto expected = colorByBruteForce(
            splats, colors, camera.eye, rayThrough(camera, size, column, row));
        seen += expected ? 1 : 0;
        for (int channel = 0; channel < 3; ++channel)
          if (std::abs(expected.value_or(Vector::Zero())[channel] -
                       channelAt(image, column, row, channel)) > 1.01 * step) {
            ++different;
            break;
          }
      }
    EXPECT_GT(seen, 3) << count;
    // Rays that graze a border may fall to either side of it.
    EXPECT_LE(different, 3) << count;
  }
}

TEST(SplatTracing, SplatsAtOnePlaceAreATreeAsWell)
{
  const std::vector<pcl_uvol::PointSplat> splats(5000,
                                                 discAt({0, 0, 0}, {0, 0, 1}, 1.0));
  const Camera camera = looking({0.3, 0.0, 10.0}, {0.3, 0.0, 0.0}, 0.1, {0, 1, 0});
  const Image image = trace(sceneOf(splats, {}), camera, 2);
  EXPECT_EQ(1.0, channelAt(image, 0, 0));
}

/** The unit sphere of random points, covered. */
pcl_uvol::SplatObject
sphereOfSplats(std::size_t points, double delta, double lambda)
{
  const auto cloud = makeSphere(points, 1);
  pcl_uvol::SplatParameters parameters;
  parameters.delta = delta;
  parameters.lambda = lambda;
  std::vector<std::uint32_t> all(cloud->size());
  std::iota(all.begin(), all.end(), 0u);
  pcl_uvol::Report report;
  auto splats = pcl_uvol::detail::generateSplats(
      pcl_uvol::viewOf(*cloud), all, parameters, 0, report);
  pcl_uvol::SplatObject object;
  object.splats =
      pcl::make_shared<pcl::PointCloud<pcl_uvol::PointSplat>>(std::move(splats.cloud));
  return object;
}

TEST(SplatTracing, SplatsAtTheLimitOfTheirReachAreATree)
{
  constexpr double reach = pcl_uvol::most_splat_reach;
  std::vector<pcl_uvol::PointSplat> splats;
  splats.reserve(500);
  for (int i = 0; i < 500; ++i)
    splats.push_back(discAt({0.0, reach / 500.0 * i, 0.0}, {0, 0, 1}, 0.1 * reach));
  const Camera camera =
      looking({0.0, 0.5 * reach, reach}, {0.0, 0.5 * reach, 0.0}, 1.0, {0, 1, 0});
  const Image image = trace(sceneOf(splats, std::vector<Rgba>(500, red)), camera, 32);
  EXPECT_FALSE(image.color.empty());
  splats[7].y = 2.5e37f; // whose box would be infinite
  EXPECT_THROW(trace(sceneOf(splats, std::vector<Rgba>(500, red)), camera, 32),
               pcl_uvol::InvalidArgument);
}

TEST(SplatTracing, ASphereHasNoHoles)
{
  // Sparse points and dense ones, hardly overlapping splats as well.
  for (const auto& [points, delta, lambda] : {std::tuple(113682, 1e-4, 0.2),
                                              std::tuple(20000, 1e-3, 1.0),
                                              std::tuple(2000, 1e-4, 0.2)}) {
    Scene scene;
    scene.lights.clear();
    scene.background.color = {0.0f, 0.0f, 0.0f};
    scene.splats.push_back(
        sphereOfSplats(static_cast<std::size_t>(points), delta, lambda));
    scene.splats[0].material = glowing(1.0f, 1.0f, 1.0f);
    pcl_uvol::RayTracer tracer;
    tracer.setScene(scene);
    constexpr int size = 10;
    tracer.setSize(size, size);
    Random random(3);
    int missed = 0;
    for (int view = 0; view < 200; ++view) {
      const Vector eye =
          5.0 *
          Vector(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5)
              .normalized();
      // All rays pass the centre within 0.98 radii.
      tracer.setCamera(looking(eye, Vector::Zero(), 15.8, eye.unitOrthogonal()));
      Image image;
      tracer.render(image);
      for (int pixel = 0; pixel < size * size; ++pixel)
        missed += channelAt(image, pixel % size, pixel / size) == 0.0 ? 1 : 0;
    }
    EXPECT_EQ(0, missed) << points << " points, lambda " << lambda;
  }
}

TEST(SplatTracing, NormalsOfASphereAreSmooth)
{
  Scene scene;
  scene.splats.push_back(sphereOfSplats(113682, 1e-4, 0.2));
  const Camera camera = looking({0.0, -6.0, 0.0}, Vector::Zero(), 13.0);
  constexpr int size = 300;
  const Image image = trace(scene, camera, size);
  double sum = 0.0, largest_step = 0.0;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const auto pixel = static_cast<std::size_t>(row * size + column);
      const Eigen::Map<const Eigen::Vector3f> normal(&image.normal[3 * pixel]);
      const Vector d = rayThrough(camera, size, column, row);
      const double b = camera.eye.dot(d);
      const Vector truth =
          (camera.eye - (b + std::sqrt(b * b - camera.eye.squaredNorm() + 1.0)) * d)
              .normalized();
      const Vector off = normal.cast<double>() - truth;
      sum += off.norm();
      // Deviations of neighbouring pixels differ by little: no border is seen.
      if (column > 0) {
        const Vector before =
            Eigen::Map<const Eigen::Vector3f>(&image.normal[3 * pixel - 3])
                .cast<double>();
        const Vector d0 = rayThrough(camera, size, column - 1, row);
        const double b0 = camera.eye.dot(d0);
        const Vector truth0 =
            (camera.eye -
             (b0 + std::sqrt(b0 * b0 - camera.eye.squaredNorm() + 1.0)) * d0)
                .normalized();
        largest_step = std::max(largest_step, (off - (before - truth0)).norm());
      }
    }
  constexpr double degree = M_PI / 180.0;
  EXPECT_LT(sum / (size * size), 0.2 * degree);
  EXPECT_LT(largest_step, 0.2 * degree);
}

TEST(SplatTracing, ASphereDoesNotShadeItself)
{
  Scene scene;
  scene.background.color = {0.0f, 0.0f, 0.0f};
  scene.splats.push_back(sphereOfSplats(50000, 3e-4, 0.2));
  scene.lights = {lightFrom({1.0, -1.0, 1.0}, pcl_uvol::Light::Kind::Directional)};
  const Camera camera = looking({0.0, -6.0, 0.0}, Vector::Zero(), 18.0);
  constexpr int size = 200;
  pcl_uvol::RayTracer tracer;
  tracer.setScene(scene);
  tracer.setCamera(camera);
  tracer.setSize(size, size);
  Image with, without;
  tracer.render(with);
  tracer.settings().shadows = false;
  tracer.render(without);
  int different = 0;
  for (std::size_t i = 0; i < with.color.size(); ++i)
    different += std::abs(int{with.color[i]} - int{without.color[i]}) > 6 ? 1 : 0;
  EXPECT_EQ(0, different);
}

/** Discs of some thousand points that lie off a ball by parts of their distance, as
 * isopoints do. */
pcl_uvol::SplatObject
roughBall()
{
  std::vector<pcl_uvol::PointSplat> splats;
  std::mt19937_64 engine(4);
  std::normal_distribution<double> off(0.0, 0.004);
  const auto sphere = makeSphere(6000, 1);
  for (const pcl::PointNormal& point : *sphere) {
    const Vector normal = point.getNormalVector3fMap().cast<double>();
    const Vector tilted = normal + 10.0 * Vector(off(engine), off(engine), off(engine));
    splats.push_back(discAt((1.0 + off(engine)) * normal, tilted, 0.06));
  }
  pcl_uvol::SplatObject object = objectOf(splats);
  object.material = {};
  return object;
}

TEST(SplatTracing, ARoughSurfaceShadesItselfNowhereInTheLight)
{
  Scene scene;
  scene.background.color = {0.0f, 0.0f, 0.0f};
  scene.splats.push_back(roughBall());
  scene.lights = {lightFrom({1.0, -0.7, 0.3}, pcl_uvol::Light::Kind::Directional)};
  const Camera camera = looking({0.0, -6.0, 0.0}, Vector::Zero(), 18.0);
  pcl_uvol::RayTracer tracer;
  tracer.setScene(scene);
  tracer.setCamera(camera);
  tracer.setSize(300, 300);
  Image with, without;
  tracer.render(with);
  tracer.settings().shadows = false;
  tracer.render(without);
  std::size_t lit = 0, different = 0;
  for (std::size_t i = 0; i < with.pixels(); ++i) {
    // Well above the horizon.
    lit += without.color[4 * i] > 100 ? 1 : 0;
    different +=
        without.color[4 * i] > 100 && with.color[4 * i] != without.color[4 * i] ? 1 : 0;
  }
  EXPECT_GT(lit, 20000u);
  EXPECT_LE(different, lit / 50);
}

/** A cube of discs whose edges they stand out over, tilted by noise. */
pcl_uvol::SplatObject
cubeOfSplats()
{
  std::vector<pcl_uvol::PointSplat> splats;
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::normal_distribution<double> off(0.0, 0.003);
  for (int i = 0; i < 24000; ++i) {
    const int axis = i % 3;
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    Vector center(place(engine), place(engine), place(engine));
    center[axis] = side + off(engine);
    const Vector tilt(off(engine), off(engine), off(engine));
    splats.push_back(discAt(center, side * Vector::Unit(axis) + 30.0 * tilt, 0.04));
  }
  return objectOf(splats);
}

/** Pixels of an object in the light that its own shadows make darker. */
int
countDarker(const pcl_uvol::SplatObject& object, const Vector& light)
{
  Scene scene;
  scene.splats.push_back(object);
  scene.splats[0].material = {};
  scene.lights = {lightFrom(light, pcl_uvol::Light::Kind::Directional)};
  pcl_uvol::RayTracer tracer;
  tracer.setScene(scene);
  tracer.setCamera(looking({2.6, -5.0, 3.6}, Vector::Zero(), 30.0));
  tracer.setSize(400, 400);
  Image with, without;
  tracer.render(with);
  tracer.settings().shadows = false;
  tracer.render(without);
  int lit = 0, darker = 0;
  for (std::size_t i = 0; i < with.color.size(); i += 4) {
    lit += without.color[i] > 60 && without.color[i] < 255 ? 1 : 0;
    darker += without.color[i] > 60 && with.color[i] + 20 < without.color[i] ? 1 : 0;
  }
  EXPECT_GT(lit, 30000);
  return darker;
}

TEST(SplatTracing, EdgesAndOutlinesHaveNoDarkSpecks)
{
  EXPECT_LE(countDarker(cubeOfSplats(), {0.6, -1.0, 0.9}), 30);
  EXPECT_EQ(0, countDarker(sphereOfSplats(1500, 1e-4, 0.2), {3.6, -1.0, 0.9}));
}

/** Pixels that look otherwise where a ball of splats takes the place of one that is
 * round, under a bright dome and between two balls that shine. */
int
countUnlikeBall(const pcl_uvol::SplatObject& ball,
                const pcl_uvol::RayMaterial& material)
{
  Scene scene;
  scene.background.kind = pcl_uvol::Background::Kind::Gradient;
  scene.background.color = {0.2f, 0.1f, 0.0f};
  scene.background.top = {0.9f, 1.0f, 1.0f};
  scene.spheres.push_back({{1.5, -1.0, 0.5}, 0.7, glowing(1.0f, 0.0f, 0.0f)});
  scene.spheres.push_back({{-1.5, 1.0, -0.5}, 0.7, glowing(0.0f, 0.0f, 0.0f)});
  scene.spheres.push_back({{0.0, 0.0, 0.0}, 1.0, material});
  const Camera camera = looking({0.0, -6.0, 1.5}, Vector::Zero(), 22.0);
  constexpr int size = 200;
  const Image truth = trace(scene, camera, size);
  scene.spheres.pop_back();
  scene.splats.push_back(ball);
  scene.splats[0].material = material;
  const Image image = trace(scene, camera, size);
  int unlike = 0;
  for (std::size_t i = 0; i < image.color.size(); i += 4)
    unlike += std::abs(image.color[i] - truth.color[i]) > 12 ? 1 : 0;
  return unlike;
}

TEST(SplatTracing, MirrorsAndGlassOfSplatsAreThoseOfABall)
{
  // Splats with normals that turn, and flat ones, which know of no thickness.
  std::vector<pcl_uvol::PointSplat> flat;
  const auto points = makeSphere(60000, 1);
  for (const pcl::PointNormal& point : *points)
    flat.push_back(discAt(point.getNormalVector3fMap().cast<double>(),
                          point.getNormalVector3fMap().cast<double>(),
                          0.03));
  for (const auto& ball : {sphereOfSplats(60000, 1e-4, 0.2), objectOf(flat)}) {
    EXPECT_LE(countUnlikeBall(ball, clear(0.9, 0.0)), 100);
    EXPECT_LE(countUnlikeBall(ball, clear(0.0, 0.9, 1.5)), 300);
  }
}

TEST(SplatTracing, AWallShadesTheFloorBesideIt)
{
  // One object: what is near and on the same surface is left out, walls are not.
  Scene scene = sceneOf(
      {discAt({0, 0, 0}, {0, 0, 1}, 1.0), discAt({0.6, 0.0, 0.5}, {-1, 0, 0}, 0.5)},
      {red, green});
  scene.splats[0].material.ambient = 0.0;
  scene.splats[0].material.diffuse = 1.0;
  const Camera camera = looking({0.3, 0.0, 10.0}, {0.3, 0.0, 0.0}, 0.01, {0, 1, 0});
  const auto brightness = [&](const Vector& towards) {
    scene.lights = {lightFrom(towards, pcl_uvol::Light::Kind::Directional)};
    return channelAt(trace(scene, camera, 1), 0, 0);
  };
  EXPECT_NEAR(0.0, brightness({1.0, 0.0, 1.0}), step);
  EXPECT_NEAR(std::sqrt(0.5), brightness({-1.0, 0.0, 1.0}), step);
}

TEST(SplatTracing, AWallOfManySplatsShadesTheFloorUpToItsFoot)
{
  std::vector<pcl_uvol::PointSplat> splats;
  constexpr double spacing = 0.03, radius = 0.04, height = 0.6;
  for (double y = -1.0; y < 1.0; y += spacing) {
    for (double x = -1.0; x < 0.0; x += spacing)
      splats.push_back(discAt({x, y, 0.0}, {0, 0, 1}, radius));
    for (double z = 0.0; z < height; z += spacing)
      splats.push_back(discAt({0.0, y, z}, {-1, 0, 0}, radius));
  }
  Scene scene;
  scene.splats.push_back(objectOf(splats));
  scene.splats[0].material.ambient = 0.0;
  scene.splats[0].material.diffuse = 1.0;
  scene.lights = {lightFrom({1.0, 0.0, 1.0}, pcl_uvol::Light::Kind::Directional)};
  // A strip of the floor, from its lit part to just before the wall.
  const Camera camera = looking({-0.45, 0.0, 10.0}, {-0.45, 0.0, 0.0}, 5.0, {0, 1, 0});
  constexpr int size = 200;
  const Image image = trace(scene, camera, size);
  int unlike = 0;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const Vector d = rayThrough(camera, size, column, row);
      const double x = camera.eye.x() - camera.eye.z() / d.z() * d.x();
      if (x > -radius || std::abs(x + height) < radius)
        continue;
      const double expected = x > -height ? 0.0 : std::sqrt(0.5);
      unlike += std::abs(channelAt(image, column, row) - expected) > step ? 1 : 0;
    }
  EXPECT_EQ(0, unlike);
}

TEST(SplatTracing, CamerasFarAwaySeeAsSharp)
{
  Scene scene;
  scene.splats.push_back(sphereOfSplats(20000, 3e-4, 0.2));
  scene.lights = {lightFrom({1.0, -1.0, 1.0}, pcl_uvol::Light::Kind::Directional)};
  constexpr int size = 60;
  // The same picture from far away and from very far away.
  const auto from = [&](double distance) {
    const double fov = 2.0 * std::atan(1.2 / distance) * 180.0 / M_PI;
    return trace(scene, looking({0.0, -distance, 0.0}, Vector::Zero(), fov), size);
  };
  const Image far = from(1e4), farther = from(1e7);
  int different = 0;
  for (std::size_t i = 0; i < far.color.size(); ++i)
    different += std::abs(int{far.color[i]} - int{farther.color[i]}) > 3 ? 1 : 0;
  EXPECT_LE(different, 12);
}

TEST(SplatTracing, SameBytesForAnyNumberOfThreads)
{
  Scene scene;
  scene.splats.push_back(sphereOfSplats(5000, 1e-3, 0.2));
  scene.splats[0].material = {};
  scene.splats[0].material.reflectivity = 0.3;
  scene.lights[0].radius = 0.1;
  scene.planes.push_back({{0, 0, -1}, {0, 0, 1}, {}, 0.3, {}});
  const Camera camera = looking({2.0, -5.0, 1.0}, Vector::Zero(), 30.0);
  const Image one = trace(scene, camera, 70, 3, 1);
  for (const unsigned threads : {2u, 3u, 7u})
    EXPECT_EQ(one.color, trace(scene, camera, 70, 3, threads).color) << threads;
}

TEST(SplatTracing, CameraWithinASplat)
{
  const Camera camera = looking({0, 0, 0}, {1.0, 0.0, 0.2}, 60.0);
  const Image image = trace(
      sceneOf({discAt({0, 0, 0}, {0, 0, 1}, 1.0), discAt({2, 0, 0}, {1, 0, 0}, 0.5)},
              {red, green}),
      camera,
      9);
  EXPECT_EQ(0.0, channelAt(image, 4, 0, 0));
}

} // namespace test_splat_tracing
