// SPDX-License-Identifier: BSD-3-Clause
// What scenes as text say: every item, and the places and colours of clouds.
#include "scene_text.h"

#include <pcl/conversions.h>

#include <algorithm>
#include <filesystem>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_scene_file {

/** A splat whose numbers are all different. */
pcl_uvol::PointSplat
makeSplat(float x, float y, float z)
{
  pcl_uvol::PointSplat splat;
  splat.getVector3fMap() = Eigen::Vector3f(x, y, z);
  splat.getNormalVector3fMap() = Eigen::Vector3f(0.0f, 0.6f, 0.8f);
  splat.getTangentVector3fMap() = Eigen::Vector3f(1.0f, 0.0f, 0.0f);
  splat.radius = 0.5f;
  splat.error = 0.01f;
  splat.tilt_u = 0.1f;
  splat.tilt_v = 0.2f;
  splat.slope_u = 0.3f;
  splat.slope_v = -0.4f;
  return splat;
}

const pcl::PointCloud<pcl_uvol::PointSplat>&
twoSplats()
{
  static const pcl::PointCloud<pcl_uvol::PointSplat> splats = [] {
    pcl::PointCloud<pcl_uvol::PointSplat> made;
    made.push_back(makeSplat(1.0f, 2.0f, 3.0f));
    made.push_back(makeSplat(3.0f, 2.0f, 7.0f));
    return made;
  }();
  return splats;
}

/** \param origin added to the coordinates of the file */
void
saveSplats(const std::string& path, const std::array<double, 3>& origin = {{0, 0, 0}})
{
  Dataset dataset;
  pcl::toPCLPointCloud2(twoSplats(), dataset.cloud);
  dataset.origin = origin;
  dataset.double_coordinates = origin[0] != 0.0;
  saveDataset(path, dataset);
}

/** A bent sheet of n x n points with normals, one unit wide. */
std::string
sheetTable(int n)
{
  std::string text = "x,y,z,normal_x,normal_y,normal_z\n";
  for (int i = 0; i < n * n; ++i) {
    const double x = double(i % n) / (n - 1), y = double(i / n) / (n - 1);
    text += std::to_string(x) + "," + std::to_string(y) + "," +
            std::to_string(0.25 * x * x) + "," + std::to_string(-0.5 * x) + ",0,1\n";
  }
  return text;
}

void
expectColor(const Color& color, float r, float g, float b)
{
  EXPECT_EQ(color.r, r);
  EXPECT_EQ(color.g, g);
  EXPECT_EQ(color.b, b);
}

template <typename Vector>
void
expectNear(const Vector& vector, double x, double y, double z)
{
  EXPECT_NEAR(vector[0], x, 1e-6);
  EXPECT_NEAR(vector[1], y, 1e-6);
  EXPECT_NEAR(vector[2], z, 1e-6);
}

class SceneItems : public SceneText {
protected:
  const pcl_uvol::PointSplat&
  firstSplat(const std::string& text)
  {
    loaded_ = load(text);
    return loaded_.scene.splats.at(0).splats->at(0);
  }

  SceneFile loaded_;
};

TEST_F(SceneItems, WhatItDoesNotSayIsAsEver)
{
  const SceneFile file = load("sphere 1 2 3 4");
  EXPECT_FALSE(file.camera);
  EXPECT_FALSE(file.size);
  EXPECT_EQ(file.origin, (std::array<double, 3>{{0.0, 0.0, 0.0}}));
  const RayTracingSettings defaults;
  EXPECT_EQ(file.settings.depth, defaults.depth);
  EXPECT_EQ(file.supersampling, 1);
  EXPECT_EQ(file.settings.shadows, defaults.shadows);
  EXPECT_EQ(file.settings.light_samples, defaults.light_samples);
  EXPECT_EQ(file.settings.occlusion_samples, defaults.occlusion_samples);
  EXPECT_EQ(file.settings.occlusion_distance, defaults.occlusion_distance);
  EXPECT_EQ(file.scene.lights.size(), defaultLights().size());
  EXPECT_EQ(file.scene.background.kind, Background::Kind::Plain);
  ASSERT_EQ(file.scene.spheres.size(), 1u);
  expectNear(file.scene.spheres[0].center, 1, 2, 3);
  EXPECT_EQ(file.scene.spheres[0].radius, 4.0);
  EXPECT_EQ(file.scene.spheres[0].material.diffuse, Material().diffuse);
  EXPECT_TRUE(file.scene.planes.empty());
  EXPECT_TRUE(file.scene.splats.empty());
}

TEST_F(SceneItems, Settings)
{
  const SceneFile file =
      load("\xEF\xBB\xBFsize 640 480 # pixels\r\n\t depth  7\r\n\r\nsupersampling 3\n"
           "shadows off\nlight-samples 9\nocclusion 64 distance 0.5\nsphere 0 0 0 1");
  EXPECT_EQ(*file.size, (std::array<int, 2>{{640, 480}}));
  EXPECT_EQ(file.settings.depth, 7);
  EXPECT_EQ(file.supersampling, 3);
  EXPECT_FALSE(file.settings.shadows);
  EXPECT_EQ(file.settings.light_samples, 9);
  EXPECT_EQ(file.settings.occlusion_samples, 64);
  EXPECT_EQ(file.settings.occlusion_distance, 0.5);
}

TEST_F(SceneItems, ALaterItemReplacesTheFormer)
{
  const SceneFile file =
      load("size 1 2\nsize 3 4\nocclusion 64 distance 0.5\nocclusion 8\nshadows off\n"
           "shadows on\nbackground gradient 0 0 0 0 0 0\nbackground 0.5 0.25 1\n"
           "camera eye 9 9 9 at 0 0 0 fov 50\ncamera eye 1 0 0 at 0 0 0\n"
           "sphere 0 0 0 1");
  EXPECT_EQ(*file.size, (std::array<int, 2>{{3, 4}}));
  EXPECT_EQ(file.settings.occlusion_samples, 8);
  EXPECT_EQ(file.settings.occlusion_distance, 0.0);
  EXPECT_TRUE(file.settings.shadows);
  EXPECT_EQ(file.scene.background.kind, Background::Kind::Plain);
  expectColor(file.scene.background.color, 0.5f, 0.25f, 1.0f);
  expectColor(file.scene.background.top,
              Background().top.r,
              Background().top.g,
              Background().top.b);
  expectNear(file.camera->eye, 1, 0, 0);
  EXPECT_EQ(file.camera->vertical_fov, 30.0);
}

TEST_F(SceneItems, Camera)
{
  const SceneFile plain = load("sphere 0 0 0 1\ncamera at 1 2 3 eye -4 5.5 6e1");
  expectNear(plain.camera->eye, -4, 5.5, 60);
  expectNear(plain.camera->at, 1, 2, 3);
  expectNear(plain.camera->up, 0, 0, 1);
  EXPECT_EQ(plain.camera->vertical_fov, 30.0);
  const SceneFile full =
      load("camera fov 179.5 up 0 2 0 eye 1 0 0 at 0 0 0\nsphere 0 0 0 1");
  expectNear(full.camera->up, 0, 2, 0);
  EXPECT_EQ(full.camera->vertical_fov, 179.5);
}

TEST_F(SceneItems, Backgrounds)
{
  const Background gradient =
      load("background gradient 0.25 0.5 0.75 1 2 3\nsphere 0 0 0 1").scene.background;
  EXPECT_EQ(gradient.kind, Background::Kind::Gradient);
  expectColor(gradient.color, 0.25f, 0.5f, 0.75f);
  expectColor(gradient.top, 1.0f, 2.0f, 3.0f);
  EXPECT_EQ(load("background transparent\nsphere 0 0 0 1").scene.background.kind,
            Background::Kind::Transparent);
}

TEST_F(SceneItems, TheFirstLightReplacesTheDefaults)
{
  const SceneFile file = load("light point 1 2 3 radius 0.5 color 1 0.5 0\n"
                              "light directional 0 0 -2\nlight camera 1 0 0 radius 2\n"
                              "sphere 0 0 0 1");
  const std::vector<Light>& lights = file.scene.lights;
  ASSERT_EQ(lights.size(), 3u);
  EXPECT_EQ(lights[0].kind, Light::Kind::Point);
  EXPECT_FALSE(lights[0].follows_camera);
  expectNear(lights[0].position, 1, 2, 3);
  expectColor(lights[0].color, 1.0f, 0.5f, 0.0f);
  EXPECT_EQ(lights[0].radius, 0.5);
  EXPECT_EQ(lights[1].kind, Light::Kind::Directional);
  EXPECT_FALSE(lights[1].follows_camera);
  expectNear(lights[1].position, 0, 0, -2);
  expectColor(lights[1].color, 1.0f, 1.0f, 1.0f);
  EXPECT_EQ(lights[1].radius, 0.0);
  EXPECT_EQ(lights[2].kind, Light::Kind::Directional);
  EXPECT_TRUE(lights[2].follows_camera);
  EXPECT_EQ(lights[2].radius, 2.0);
}

TEST_F(SceneItems, Materials)
{
  const SceneFile file = load(
      "material \"old glass\" index 1.5 transparent 0.75 reflect 0.25 shininess 99 "
      "specular 1.5 diffuse 0.5 ambient 0 color 0.25 0.5 1\nmaterial plain\n"
      "sphere 0 0 0 1 material \"old glass\"\nplane 0 0 0 0 0 1 material plain\n"
      "sphere 0 0 0 1");
  const RayMaterial& glass = file.scene.spheres[0].material;
  EXPECT_EQ(glass.refractive_index, 1.5);
  EXPECT_EQ(glass.transparency, 0.75);
  EXPECT_EQ(glass.reflectivity, 0.25);
  EXPECT_EQ(glass.shininess, 99.0);
  EXPECT_EQ(glass.specular, 1.5);
  EXPECT_EQ(glass.diffuse, 0.5);
  EXPECT_EQ(glass.ambient, 0.0);
  expectColor(glass.color, 0.25f, 0.5f, 1.0f);
  const RayMaterial defaults;
  EXPECT_EQ(file.scene.planes[0].material.transparency, defaults.transparency);
  EXPECT_EQ(file.scene.planes[0].material.specular, defaults.specular);
  EXPECT_EQ(file.scene.spheres[1].material.reflectivity, defaults.reflectivity);
}

TEST_F(SceneItems, Planes)
{
  const SceneFile file = load("material m diffuse 0.125\nplane 1 2 3 0 0 -5\n"
                              "plane 0 0 0 1 1 0 checker 0.5 0.25 0.5 0.75 material m");
  ASSERT_EQ(file.scene.planes.size(), 2u);
  expectNear(file.scene.planes[0].point, 1, 2, 3);
  expectNear(file.scene.planes[0].normal, 0, 0, -5);
  EXPECT_EQ(file.scene.planes[0].square, 0.0);
  EXPECT_EQ(file.scene.planes[1].square, 0.5);
  expectColor(file.scene.planes[1].other_color, 0.25f, 0.5f, 0.75f);
  EXPECT_EQ(file.scene.planes[1].material.diffuse, 0.125);
}

TEST_F(SceneItems, SplatsOfAFileAreKept)
{
  for (const char* const name : {"s.ply", "s.pcd", "s.vtp"}) {
    saveSplats(folder_ / name);
    const SceneFile file =
        load("material m diffuse 0.125\ncloud " + std::string(name) + " material m");
    ASSERT_EQ(file.scene.splats.size(), 1u);
    const SplatObject& object = file.scene.splats[0];
    ASSERT_EQ(object.splats->size(), 2u);
    EXPECT_TRUE(object.colors.empty());
    EXPECT_EQ(object.material.diffuse, 0.125);
    const pcl_uvol::PointSplat& splat = object.splats->at(1);
    expectNear(splat.getVector3fMap(), 3, 2, 7);
    expectNear(splat.getNormalVector3fMap(), 0, 0.6, 0.8);
    expectNear(splat.getTangentVector3fMap(), 1, 0, 0);
    EXPECT_EQ(splat.radius, 0.5f);
    EXPECT_EQ(splat.error, 0.01f);
    EXPECT_EQ(splat.tilt_u, 0.1f);
    EXPECT_EQ(splat.tilt_v, 0.2f);
    EXPECT_EQ(splat.slope_u, 0.3f);
    EXPECT_EQ(splat.slope_v, -0.4f);
    ASSERT_FALSE(report_.milliseconds.empty());
    EXPECT_EQ(report_.milliseconds[0].first, "read");
    EXPECT_EQ(report_.getCount("splats"), 2u);
  }
}

TEST_F(SceneItems, FittedTurnedAndMoved)
{
  saveSplats(folder_ / "s.ply");
  for (const char* const text : {"cloud s.ply fit 10 20 30 8 turn 0 0 7 90",
                                 "cloud s.ply turn 0 0 -1 -90 fit 10 20 30 8"}) {
    // The centre of the box is (2, 2, 5), its longest side is 4.
    const pcl_uvol::PointSplat& splat = firstSplat(text);
    expectNear(splat.getVector3fMap(), 10, 18, 26);
    expectNear(splat.getNormalVector3fMap(), -0.6, 0, 0.8);
    expectNear(splat.getTangentVector3fMap(), 0, 1, 0);
    EXPECT_NEAR(splat.radius, 1.0, 1e-6);
    EXPECT_NEAR(splat.error, 0.02, 1e-6);
    EXPECT_EQ(splat.tilt_u, 0.1f);
    EXPECT_EQ(splat.slope_v, -0.4f);
  }
}

TEST_F(SceneItems, ScaledTurnedAndMoved)
{
  saveSplats(folder_ / "s.ply");
  const pcl_uvol::PointSplat splat =
      firstSplat("cloud s.ply at 1 1 1 scale 2 turn 1 0 0 90");
  expectNear(splat.getVector3fMap(), 3, -5, 5);
  expectNear(splat.getNormalVector3fMap(), 0, -0.8, 0.6);
  expectNear(splat.getTangentVector3fMap(), 1, 0, 0);
  EXPECT_NEAR(splat.radius, 1.0, 1e-6);
  EXPECT_NEAR(splat.error, 0.02, 1e-6);
  EXPECT_EQ(loaded_.origin, (std::array<double, 3>{{0.0, 0.0, 0.0}}));
}

TEST_F(SceneItems, LargeCoordinatesKeepTheirDigits)
{
  saveSplats(folder_ / "far.ply", {{5000000.125, 300000.01, 0.0}});
  saveSplats(folder_ / "near.ply");
  const SceneFile file =
      load("sphere 5000002.25 300001 4 1\nplane 5000002.25 300001 4 0 0 1\n"
           "camera eye 5000002.25 300001 90 at 5000002.25 300001 4 up 0 1 0\n"
           "cloud near.ply fit 5000002.25 300001 4 4\ncloud far.ply\n"
           "light point 5000002.25 300001 4\nlight directional 1 2 3\n");
  const Eigen::Vector3d origin(file.origin[0], file.origin[1], file.origin[2]);
  EXPECT_NEAR(origin.x(), 5000000.0, 100.0);
  EXPECT_NEAR(origin.y(), 300000.0, 100.0);
  const auto expectPlace = [&](const auto& point, double x, double y, double z) {
    const Eigen::Vector3d seen = point.template cast<double>();
    EXPECT_LT(seen.norm(), 200.0) << "float keeps the digits of small numbers only";
    expectNear(Eigen::Vector3d(seen + origin), x, y, z);
  };
  expectPlace(file.scene.spheres[0].center, 5000002.25, 300001, 4);
  expectPlace(file.scene.planes[0].point, 5000002.25, 300001, 4);
  expectPlace(file.camera->eye, 5000002.25, 300001, 90);
  expectPlace(file.camera->at, 5000002.25, 300001, 4);
  expectPlace(file.scene.lights[0].position, 5000002.25, 300001, 4);
  expectNear(file.scene.lights[1].position, 1, 2, 3);
  const auto& fitted = *file.scene.splats[0].splats;
  expectPlace(fitted[0].getVector3fMap(), 5000001.25, 300001, 2);
  const auto& far = *file.scene.splats[1].splats;
  expectPlace(far[0].getVector3fMap(), 5000001.125, 300002.01, 3);
  expectPlace(far[1].getVector3fMap(), 5000003.125, 300002.01, 7);
}

TEST_F(SceneItems, LargeCoordinatesThatAreMovedAwayKeepTheirDigits)
{
  saveSplats(folder_ / "far.ply", {{5000000.125, 300000.01, 0.0}});
  const auto placeOf = [&](const std::string& options) -> Eigen::Vector3d {
    const pcl_uvol::PointSplat& splat = firstSplat("cloud far.ply " + options);
    const auto& origin = loaded_.origin;
    return splat.getVector3fMap().cast<double>() +
           Eigen::Vector3d(origin[0], origin[1], origin[2]);
  };
  expectNear(placeOf("at -5000000 -300000 0"), 1.125, 2.01, 3);
  expectNear(placeOf("scale 0.001"), 5000.001125, 300.00201, 0.003);
  expectNear(placeOf("turn 0 0 1 90"), -300002.01, 5000001.125, 3);
}

TEST_F(SceneItems, ColorsOfTheFieldOfThePointThatASplatStandsFor)
{
  writeFile(folder_ / "s.csv", splatTable(",value", {",0", "!,7", ",1"}));
  const auto colorsOf = [&](const std::string& options) {
    const SceneFile file = load("cloud s.csv " + options);
    EXPECT_EQ(file.scene.splats[0].splats->size(), 2u);
    return file.scene.splats[0].colors;
  };
  EXPECT_TRUE(colorsOf("").empty());
  EXPECT_EQ(report_.getCount("bad_splats"), 1u);
  EXPECT_EQ(colorsOf("color value"), ColorMap().apply({0.0f, 1.0f}, 0.0, 7.0));
  EXPECT_EQ(colorsOf("range -1 2 colormap gray color value"),
            ColorMap("gray").apply({0.0f, 1.0f}, -1.0, 2.0));
  EXPECT_EQ(colorsOf("color |value,y|"), ColorMap().apply({0.0f, 1.0f}, 0.0, 7.0));
}

TEST_F(SceneItems, ColorsOfTheCloudItself)
{
  const std::string blue = "," + std::to_string(0x102030);
  writeFile(folder_ / "s.csv", splatTable(",rgb", {blue, ",255"}));
  const std::vector<Rgba> expected{0xff302010u, 0xffff0000u};
  EXPECT_EQ(load("cloud s.csv").scene.splats[0].colors, expected);
  EXPECT_EQ(load("cloud s.csv color rgb").scene.splats[0].colors, expected);
  EXPECT_NE(load("cloud s.csv color x").scene.splats[0].colors, expected);
}

TEST_F(SceneItems, PointsAreCoveredBySplats)
{
  writeFile(folder_ / "s.csv", sheetTable(21));
  const auto countOf = [&](const std::string& options) {
    loaded_ = load("cloud s.csv " + options);
    const std::size_t count = loaded_.scene.splats[0].splats->size();
    EXPECT_EQ(report_.getCount("splats"), count);
    return count;
  };
  EXPECT_EQ(countOf("lambda 0"), 441u);
  const std::size_t few = countOf("lambda 1 delta-abs 0.05");
  EXPECT_LT(few, 441u);
  for (const pcl_uvol::PointSplat& splat : *loaded_.scene.splats[0].splats) {
    EXPECT_GT(splat.radius, 0.0f);
    EXPECT_LE(splat.error, 0.0501f);
    EXPECT_GT(splat.normal_z, 0.8f);
  }
  EXPECT_EQ(countOf("delta 0.05 lambda 1"), few) << "the longest side is 1";
  EXPECT_EQ(countOf("delta 0.05 lambda 1 fit 0 0 0 100"), few);
  EXPECT_GT(countOf("delta-abs 1e-5 lambda 1"), few);
  const std::vector<Rgba> colors =
      load("cloud s.csv lambda 0 color x").scene.splats[0].colors;
  EXPECT_EQ(colors.size(), 441u);
}

TEST_F(SceneItems, OpenSurfacesEndAtTheirRims)
{
  writeFile(folder_ / "sheet.csv", sheetTable(30));
  for (const char* const place : {"", " turn 0 1 0 40 scale 3"}) {
    const SplatObject object =
        load(std::string("cloud sheet.csv") + place).scene.splats.at(0);
    ASSERT_EQ(object.splats->size(), object.rims.size());
    EXPECT_GE(std::count_if(object.rims.begin(),
                            object.rims.end(),
                            [](std::uint32_t rim) { return rim != 0; }),
              4 * 29 - 4);
  }
}

TEST_F(SceneItems, WarningsNameTheFile)
{
  writeFile(folder_ / "my s.csv", splatTable(",label", {",a", ",b"}));
  load("cloud \"my s.csv\" lambda 0.5");
  ASSERT_EQ(report_.warnings.size(), 1u);
  EXPECT_EQ(report_.warnings[0].code, "ready_splats");
  EXPECT_EQ(report_.warnings[0].about, "my s.csv");
}

TEST_F(SceneItems, IncludesAndFolders)
{
  std::filesystem::create_directories(folder_ / "sub/deep");
  writeFile(folder_ / "sub/part.txt",
            "include \"deep/more # parts.txt\"\ncloud s.ply\nmaterial shared diffuse "
            "0.5\nlight camera 0 0 1");
  writeFile(folder_ / "sub/deep/more # parts.txt",
            "size 5 6\nlight point 0 0 1\nsphere 0 0 0 1");
  saveSplats(folder_ / "sub/s.ply");
  const std::string text = "include sub/part.txt\nlight directional 0 0 1\n"
                           "sphere 0 0 0 2 material shared";
  const SceneFile file = load(text);
  EXPECT_EQ(file.scene.lights.size(), 3u);
  ASSERT_EQ(file.scene.spheres.size(), 2u);
  EXPECT_EQ(file.scene.spheres[1].material.diffuse, 0.5);
  EXPECT_EQ(file.scene.splats.size(), 1u);
  EXPECT_EQ((*file.size)[1], 6);

  std::filesystem::rename(folder_ / "sub/s.ply", folder_ / "sub/deep/s.ply");
  EXPECT_THROW(load(text), IOError);
  EXPECT_EQ(load(text, folder_ / "sub/deep").scene.splats.size(), 1u);
  const std::string absolute = "cloud \"" + (folder_ / "sub/deep/s.ply") + "\"";
  EXPECT_EQ(load(absolute, folder_ / "sub").scene.splats.size(), 1u);
  // the same file may come twice, but not within itself
  writeFile(folder_ / "ball.txt", "sphere 0 0 0 1");
  EXPECT_EQ(load("include ball.txt\ninclude ball.txt").scene.spheres.size(), 2u);
}

} // namespace test_scene_file
