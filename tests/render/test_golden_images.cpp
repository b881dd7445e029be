// SPDX-License-Identifier: BSD-3-Clause
// Every mode of rendering as a small picture that somebody has looked at: see
// golden_image.h.
#include "golden_image.h"
#include "support/surfaces.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

namespace test_golden_images {

using pcl_uvol::Image;
using pcl_uvol::ImageSpaceSettings;
using Renderer = pcl_uvol::ImageSpaceRenderer<pcl::PointNormal>;

struct Mode {
  const char* name;
  std::function<void(Renderer&)> apply;
};

void
PrintTo(const Mode& mode, std::ostream* out)
{
  *out << mode.name;
}

/** Projected and filled, nothing else. */
void
onlyLit(ImageSpaceSettings& settings)
{
  settings.smoothing = pcl_uvol::SmoothingFilter::None;
  settings.anti_aliasing = false;
}

const Mode modes[] = {
    {"points",
     [](Renderer& r) {
       onlyLit(r.settings());
       r.settings().footprints = false;
       r.settings().background_fill = r.settings().occluded_fill = 0;
     }},
    {"lit", [](Renderer& r) { onlyLit(r.settings()); }},
    {"smoothed",
     [](Renderer& r) {
       onlyLit(r.settings());
       r.settings().smoothing = pcl_uvol::SmoothingFilter::Gaussian;
       r.settings().smoothing_iterations = 2;
     }},
    {"anti_aliased", [](Renderer&) {}},
    {"silhouettes",
     [](Renderer& r) {
       r.settings().silhouettes = true;
       r.settings().silhouette_thickness = 2;
     }},
    {"feature_lines", [](Renderer& r) { r.settings().feature_lines = true; }},
    {"illustrative",
     [](Renderer& r) {
       r.settings().silhouettes = r.settings().feature_lines = true;
       r.settings().shading = false;
     }},
    {"coloured", [](Renderer& r) { r.setColorField("curvature"); }},
    {"gradient",
     [](Renderer& r) {
       r.settings().background.kind = pcl_uvol::Background::Kind::Gradient;
     }},
    {"transparent",
     [](Renderer& r) {
       r.settings().background.kind = pcl_uvol::Background::Kind::Transparent;
     }},
    {"supersampled", [](Renderer& r) { r.setSupersampling(2); }},
    {"zoomed",
     [](Renderer& r) {
       pcl_uvol::Camera camera =
           pcl_uvol::Camera::fit(r.getBounds(), "front", 30.0, 4.0 / 3.0);
       camera.vertical_fov = 6.0;
       camera.at = Eigen::Vector3d(1.2, 1.2, 0.0);
       r.setCamera(camera);
     }},
};

class GoldenImage : public testing::TestWithParam<Mode> {};

TEST_P(GoldenImage, IsWhatItWas)
{
  const auto cloud = uvol_test::makeTorusKnot(9000, 3);
  for (auto& point : *cloud)
    point.curvature = point.z;
  Renderer renderer;
  renderer.setInputCloud(cloud);
  renderer.setSize(uvol_test::golden_width, uvol_test::golden_height);
  GetParam().apply(renderer);
  Image image;
  renderer.render(image);
  EXPECT_GE(uvol_test::partLikeGolden(GetParam().name, image), uvol_test::golden_part);
}

INSTANTIATE_TEST_SUITE_P(Modes,
                         GoldenImage,
                         testing::ValuesIn(modes),
                         [](const auto& tested) { return tested.param.name; });

} // namespace test_golden_images
