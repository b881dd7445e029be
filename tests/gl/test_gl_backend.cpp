// SPDX-License-Identifier: BSD-3-Clause
// OpenGL against plain C++: both backends draw the same pictures.
#include "gl/gl_backend.h"
#include "gl/scenes.h"
#include "render/image_space/cpu_backend.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>
#include <map>
#include <memory>
#include <string>

namespace test_gl_backend {

using namespace uvol_test;
using pcl_uvol::Background;
using pcl_uvol::Camera;
using pcl_uvol::CpuBackend;
using pcl_uvol::GlBackend;
using pcl_uvol::Image;
using pcl_uvol::ImageSpaceSettings;
using pcl_uvol::Light;
using pcl_uvol::Report;
using pcl_uvol::SmoothingFilter;
using pcl_uvol::View;

std::unique_ptr<GlBackend>
makeBackend(const std::string& context)
{
  return std::make_unique<GlBackend>(
      context == "osmesa" ? pcl_uvol::createOsMesaContext()
                          : pcl_uvol::createEglContext(pcl_uvol::EglDevice::Software));
}

/** One backend per context for all tests: shaders are compiled once. They go before
 * main() ends, as drivers do not outlive it. */
class Backends : public testing::Environment {
public:
  GlBackend&
  get(const std::string& context)
  {
    std::unique_ptr<GlBackend>& backend = backends_[context];
    if (!backend)
      backend = makeBackend(context);
    return *backend;
  }

  void
  TearDown() override
  {
    backends_.clear();
  }

private:
  std::map<std::string, std::unique_ptr<GlBackend>> backends_;
};

auto* const backends = static_cast<Backends*>(
    testing::AddGlobalTestEnvironment(new Backends)); // gtest deletes it

GlBackend&
sharedBackend(const std::string& context)
{
  return backends->get(context);
}

const Scene&
sharedScene(const std::string& name)
{
  static std::map<std::string, Scene> scenes;
  auto found = scenes.find(name);
  if (found == scenes.end())
    found = scenes.emplace(name, makeScene(name)).first;
  return found->second;
}

Light
pointLight(const Eigen::Vector3d& position, bool follows_camera)
{
  Light light;
  light.kind = Light::Kind::Point;
  light.position = position;
  light.follows_camera = follows_camera;
  light.color = follows_camera ? pcl_uvol::Color{0.9f, 0.6f, 0.3f}
                               : pcl_uvol::Color{0.2f, 0.5f, 1.0f};
  return light;
}

std::vector<std::string>
modeNames()
{
  return {"plain", "lines", "transparent", "point_lights", "paper", "raw"};
}

ImageSpaceSettings
settingsOf(const std::string& mode)
{
  ImageSpaceSettings settings;
  if (mode == "lines") {
    settings.silhouettes = settings.feature_lines = true;
    settings.silhouette_thickness = 3;
    settings.background.kind = Background::Kind::Gradient;
  }
  else if (mode == "transparent") {
    settings.background.kind = Background::Kind::Transparent;
    settings.smoothing = SmoothingFilter::Box;
    settings.smoothing_iterations = 2;
  }
  else if (mode == "point_lights") {
    settings.lights = {pointLight({1.0, 2.0, -1.0}, true),
                       pointLight({-3.0, -4.0, 5.0}, false)};
    settings.smoothing = SmoothingFilter::Gaussian;
  }
  else if (mode == "paper") {
    settings.shading = false;
    settings.silhouettes = true;
    settings.cull_back_faces = false;
    settings.background.kind = Background::Kind::Transparent;
  }
  else if (mode == "raw") {
    settings.smoothing = SmoothingFilter::None;
    settings.anti_aliasing = false;
    settings.background_fill = 1;
    settings.occluded_fill = 2;
  }
  return settings;
}

/** Largest difference of two pixels in one channel. */
int
colorDifference(const Image& a, const Image& b, std::size_t pixel)
{
  int largest = 0;
  for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
    largest = std::max(largest, std::abs(int(a.color[k]) - int(b.color[k])));
  return largest;
}

/** Depth, colour and normal are the same but for rounding. */
bool
agreesAt(const Image& a, const Image& b, std::size_t pixel)
{
  float turn = 0.0f;
  for (std::size_t k = 3 * pixel; k < 3 * pixel + 3; ++k)
    turn = std::max(turn, std::abs(a.normal[k] - b.normal[k]));
  return std::abs(a.depth[pixel] - b.depth[pixel]) <= 1e-5f &&
         colorDifference(a, b, pixel) <= 2 && turn <= 2e-3f;
}

bool
isCovered(const Image& image, std::size_t pixel)
{
  return image.id[pixel] != Image::background;
}

/** Where points lie in the image. */
class Places {
public:
  Places(const Scene& scene, const View& view)
      : view_(view)
      , cloud_(*scene.cloud)
      , points_(cloud_.size())
  {
    for (std::uint32_t i = 0; i < cloud_.size(); ++i)
      points_[cloud_.getInputIndices()[i]] = i;
  }

  /** Pixels between the middle of a pixel and the point shown there, its disc taken
   * off. */
  double
  distance(std::size_t pixel, std::uint32_t id) const
  {
    const std::uint32_t point = points_[id];
    const Eigen::Vector3d c = placeOf(point);
    return pixelsBetween(c, rayThrough(pixel)) -
           2.0 * view_.focal / c.z() * discOf(point); // seen aslant, close to the eye
  }

  /** Whether a point, or a place on its disc, projects to within one pixel. */
  bool
  isWithinAPixel(std::size_t pixel, std::uint32_t id) const
  {
    const std::uint32_t point = points_[id];
    const Eigen::Vector3d c = placeOf(point), ray = rayThrough(pixel);
    Eigen::Vector3f normal;
    pcl_uvol::unpackNormal(cloud_.getNormals()[point], normal.data());
    const Eigen::Vector3d axis = turned(normal.cast<double>());
    Eigen::Vector3d nearest = axis.dot(c) / axis.dot(ray) * ray - c; // on the disc
    nearest *= std::min(1.0, discOf(point) / nearest.norm());
    return std::min(pixelsBetween(c, ray), pixelsBetween(c + nearest, ray)) <= 1.0;
  }

private:
  /** In camera space. */
  Eigen::Vector3d
  placeOf(std::uint32_t point) const
  {
    return turned({cloud_.getCoordinates(0)[point],
                   cloud_.getCoordinates(1)[point],
                   cloud_.getCoordinates(2)[point]}) +
           Eigen::Map<const Eigen::Vector3f>(view_.translation).cast<double>();
  }

  /** The distance of what two places in camera space project to. */
  double
  pixelsBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const
  {
    return view_.focal * (a / a.z() - b / b.z()).norm();
  }

  double
  discOf(std::uint32_t point) const
  {
    return cloud_.getFootprints().empty() ? 0.0 : cloud_.getFootprints()[point];
  }

  /** From the cloud's axes to the camera's. */
  Eigen::Vector3d
  turned(const Eigen::Vector3d& direction) const
  {
    using Rows = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
    return Eigen::Map<const Rows>(view_.rotation).cast<double>() * direction;
  }

  /** From the eye, z = 1. */
  Eigen::Vector3d
  rayThrough(std::size_t pixel) const
  {
    constexpr double middle = View::guard + 0.5;
    const auto column = static_cast<double>(pixel % view_.width);
    const auto row = static_cast<double>(pixel / view_.width);
    return {(column + middle - view_.center_x) / view_.focal,
            (row + middle - view_.center_y) / view_.focal,
            1.0};
  }

  const View& view_;
  const pcl_uvol::SurfaceCloud& cloud_;
  std::vector<std::uint32_t> points_; // by input index
};

/** Every pixel shows a point from one pixel beside it, or from as far as it was filled
 * from. */
void
expectPointsNearTheirPixels(const Image& image,
                            const Places& places,
                            const Report& report)
{
  const auto fills = static_cast<double>(report.getCount("background_iterations") +
                                         report.getCount("occluded_iterations"));
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (!isCovered(image, i))
      continue;
    ASSERT_LE(places.distance(i, image.id[i]), std::sqrt(2.0) * (1.0 + fills))
        << "pixel " << i;
  }
}

struct Case {
  std::string context, scene, mode;
};

std::vector<Case>
allCases()
{
  std::vector<Case> cases;
  for (const char* context : {"osmesa", "egl"})
    for (const std::string& scene : sceneNames())
      for (const std::string& mode : modeNames())
        cases.push_back({context, scene, mode});
  return cases;
}

class GlBackendDraws : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(GlBackend,
                         GlBackendDraws,
                         testing::ValuesIn(allCases()),
                         [](const auto& test) {
                           const Case& c = test.param;
                           return c.context + "_" + c.scene + "_" + c.mode;
                         });

TEST_P(GlBackendDraws, WhatTheCpuDraws)
{
  const Scene& scene = sharedScene(GetParam().scene);
  const ImageSpaceSettings settings = settingsOf(GetParam().mode);
  CpuBackend cpu;
  Report cpu_report, gl_report;
  const Image expected = draw(cpu, scene, settings, cpu_report);
  const Image image =
      draw(sharedBackend(GetParam().context), scene, settings, gl_report);

  // Software OpenGL computes what the pixels are decided by to the same bits.
  EXPECT_TRUE(expected.depth == image.depth);
  const View view(scene.camera, scene.cloud->getBounds(), 300, 300);
  const Places places(scene, view);
  std::size_t covered = 0, agreeing = 0, other_background = 0, other_point = 0;
  for (std::size_t i = 0; i < expected.pixels(); ++i) {
    const bool agrees = agreesAt(expected, image, i);
    if (!isCovered(expected, i)) {
      other_background += !agrees;
      continue;
    }
    ++covered;
    agreeing += agrees;
    if (expected.id[i] == image.id[i])
      continue;
    ++other_point;
    ASSERT_TRUE(places.isWithinAPixel(i, image.id[i]) &&
                places.isWithinAPixel(i, expected.id[i]))
        << "pixel " << i;
  }
  EXPECT_GT(covered, expected.pixels() / 10);
  EXPECT_GE(double(agreeing), 0.99 * double(covered));
  // Where discs of several sizes are equally deep to the last bit, either is right:
  // smoothing then spreads its colour over its surroundings.
  const int reach = settings.smoothing_iterations;
  const auto spread = static_cast<std::size_t>((2 * reach + 1) * (2 * reach + 1));
  EXPECT_LE(covered - agreeing, spread * other_point);
  EXPECT_LE(double(other_point), 1e-4 * double(covered));
  EXPECT_EQ(other_background, 0u);
  expectPointsNearTheirPixels(expected, places, cpu_report);
  expectPointsNearTheirPixels(image, places, gl_report);
  for (const char* count : {"background_iterations", "occluded_iterations"})
    EXPECT_EQ(cpu_report.getCount(count), gl_report.getCount(count)) << count;
}

class GlBackendOn : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(GlBackend,
                         GlBackendOn,
                         testing::Values("osmesa", "egl"),
                         [](const auto& test) { return test.param; });

void
expectSameBytes(const Image& a, const Image& b)
{
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_TRUE(a.color == b.color);
  EXPECT_TRUE(a.depth == b.depth);
  EXPECT_TRUE(a.normal == b.normal);
  EXPECT_TRUE(a.id == b.id);
}

TEST_P(GlBackendOn, SaysWhatItRunsOn)
{
  EXPECT_THAT(sharedBackend(GetParam()).describe(),
              testing::AllOf(testing::StartsWith(GetParam() + ", OpenGL "),
                             testing::HasSubstr("Core")));
}

TEST_P(GlBackendOn, RepeatedFramesAreTheSameBytes)
{
  const Scene& scene = sharedScene("sparse");
  const auto settings = settingsOf("lines");
  Report report;
  GlBackend& backend = sharedBackend(GetParam());
  const Image first = draw(backend, scene, settings, report);
  draw(backend, sharedScene("knot"), settingsOf("plain"), report);
  expectSameBytes(first, draw(backend, scene, settings, report));
}

/** What an earlier frame has left behind is not seen. */
TEST_P(GlBackendOn, EveryFrameStartsAnew)
{
  const Scene& scene = sharedScene("knot");
  const auto bounds = scene.cloud->getBounds();
  const Scene small{scene.cloud, Camera::fit(bounds, "front", 30.0, 1.0, 0.3)};
  Scene aside = small;
  aside.camera.at += Eigen::Vector3d(0.5 * bounds.radius, 0.0, 0.5 * bounds.radius);
  GlBackend& used = sharedBackend(GetParam());
  for (const std::string& mode : modeNames())
    for (const Scene& next : {scene, aside, small}) {
      Report report;
      const auto fresh = makeBackend(GetParam());
      const Image image = draw(used, next, settingsOf(mode), report);
      expectSameBytes(draw(*fresh, next, settingsOf(mode), report), image);
    }
}

TEST_P(GlBackendOn, SizesMayChange)
{
  const Scene& scene = sharedScene("waves");
  CpuBackend cpu;
  for (const auto& [width, height] :
       {std::pair(200, 120), {64, 250}, {1, 1}, {17, 1}}) {
    Report report;
    const auto settings = settingsOf("lines");
    const Image expected = draw(cpu, scene, settings, report, width, height);
    const Image image =
        draw(sharedBackend(GetParam()), scene, settings, report, width, height);
    ASSERT_EQ(expected.color.size(), image.color.size());
    std::size_t agreeing = 0;
    for (std::size_t i = 0; i < expected.pixels(); ++i)
      agreeing += agreesAt(expected, image, i);
    EXPECT_GE(double(agreeing), 0.99 * double(expected.pixels()))
        << width << " x " << height;
  }
}

/** What points in the middle of discs need beside the image may not be there. */
TEST_P(GlBackendOn, SidesAsLongAsTexturesMayBe)
{
  CpuBackend cpu;
  for (const char* name : {"sphere", "near"})
    for (const int side : {16340, View::largest_size}) {
      const Scene& scene = sharedScene(name);
      Report report;
      const auto settings = settingsOf("raw");
      const Image expected = draw(cpu, scene, settings, report, 40, side);
      const Image image =
          draw(sharedBackend(GetParam()), scene, settings, report, 40, side);
      std::size_t covered = 0, agreeing = 0;
      for (std::size_t i = 0; i < expected.pixels(); ++i) {
        covered += isCovered(expected, i) ? 1 : 0;
        agreeing += isCovered(expected, i) && expected.id[i] == image.id[i] ? 1 : 0;
      }
      EXPECT_GT(covered, 100u);
      EXPECT_GE(double(agreeing), 0.99 * double(covered)) << name << ' ' << side;
    }
}

TEST_P(GlBackendOn, TilesMakeThePictureThatTheyArePartsOf)
{
  const auto backend = makeBackend(GetParam());
  backend->setLargestSide(512);
  EXPECT_THROW(backend->setLargestSide(255), pcl_uvol::InvalidArgument);
  auto settings = settingsOf("lines"); // before a gradient
  settings.ambient_occlusion = 0.9;
  for (const char* name : {"knot", "near"}) {
    const Scene& scene = sharedScene(name);
    Report report;
    const Image whole =
        draw(sharedBackend(GetParam()), scene, settings, report, 600, 400);
    const Image image = draw(*backend, scene, settings, report, 600, 400);
    ASSERT_EQ(whole.color.size(), image.color.size());
    std::size_t covered = 0, agreeing = 0, other_background = 0;
    for (std::size_t i = 0; i < whole.pixels(); ++i) {
      const bool agrees = agreesAt(whole, image, i);
      covered += isCovered(whole, i) ? 1 : 0;
      agreeing += isCovered(whole, i) && agrees ? 1 : 0;
      other_background += !isCovered(whole, i) && !agrees ? 1 : 0;
    }
    EXPECT_GT(covered, 1000u);
    // Places in pixels are rounded otherwise in a tile.
    EXPECT_GE(double(agreeing), 0.998 * double(covered)) << name;
    EXPECT_LE(double(other_background), 1e-4 * double(whole.pixels())) << name;
  }
}

TEST_P(GlBackendOn, NothingInView)
{
  Scene scene = sharedScene("sphere");
  scene.camera.at = 2.0 * scene.camera.eye - scene.camera.at; // behind the eye
  Report report;
  const Image image = draw(sharedBackend(GetParam()), scene, {}, report, 40, 30);
  EXPECT_THAT(image.color, testing::Each(255));
  EXPECT_THAT(image.id, testing::Each(Image::background));
  EXPECT_THAT(image.depth, testing::Each(1.0f));
  EXPECT_THAT(image.normal, testing::Each(0.0f));
}

TEST_P(GlBackendOn, AChangedCloudIsUploadedAgain)
{
  const auto hasUpload = [](const Report& report) {
    return std::any_of(report.milliseconds.begin(),
                       report.milliseconds.end(),
                       [](const auto& step) { return step.first == "upload"; });
  };
  const auto cloud = makeSurface(*makeSphere(20000, 9), false);
  const Scene scene{cloud, Camera::fit(cloud->getBounds(), "front", 30.0, 1.0)};
  const auto backend = makeBackend(GetParam());
  Report first, same, red, discs;
  const Image colorful = draw(*backend, scene, {}, first, 100, 100);
  EXPECT_TRUE(hasUpload(first));
  expectSameBytes(colorful, draw(*backend, scene, {}, same, 100, 100));
  EXPECT_FALSE(hasUpload(same));

  cloud->setColor(pcl_uvol::toRgba({1.0f, 0.0f, 0.0f}));
  const Image image = draw(*backend, scene, {}, red, 100, 100);
  EXPECT_TRUE(hasUpload(red));
  const std::size_t middle = 4 * (50 * 100 + 50);
  EXPECT_GT(image.color[middle], 2 * image.color[middle + 1]);
  EXPECT_NE(colorful.color, image.color);

  cloud->computeFootprints(0, discs);
  draw(*backend, scene, {}, discs, 100, 100);
  EXPECT_TRUE(hasUpload(discs));
}

TEST_P(GlBackendOn, PlanesAreFilledInOnDemand)
{
  const Scene& scene = sharedScene("sphere");
  const View view(scene.camera, scene.cloud->getBounds(), 50, 50);
  Image image;
  Report report;
  sharedBackend(GetParam()).render({*scene.cloud, view, {}, {}, 0}, image, report);
  EXPECT_EQ(4u * 50u * 50u, image.color.size());
  EXPECT_TRUE(image.depth.empty() && image.normal.empty() && image.id.empty());
}

TEST_P(GlBackendOn, ReportsTheTimeOfEveryPass)
{
  Report report;
  draw(*makeBackend(GetParam()), sharedScene("sparse"), settingsOf("lines"), report);
  std::vector<std::string> passes;
  for (const auto& [pass, milliseconds] : report.milliseconds) {
    passes.push_back(pass);
    EXPECT_GT(milliseconds, 0.0) << pass;
  }
  EXPECT_THAT(passes,
              testing::ElementsAre("upload",
                                   "project",
                                   "fill_background",
                                   "fill_occluded",
                                   "blend",
                                   "shade",
                                   "smooth",
                                   "lines",
                                   "anti_alias",
                                   "output",
                                   "read_back"));
}

TEST(GlBackend, NeedsAContext)
{
  EXPECT_THROW(GlBackend(nullptr), pcl_uvol::InvalidArgument);
}

} // namespace test_gl_backend
