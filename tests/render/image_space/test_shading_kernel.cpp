// SPDX-License-Identifier: BSD-3-Clause
// Blinn-Phong shading of a row of pixels against its formula in double precision.
#include "pixel_setup.h"
#include "src/render/image_space/shading_kernel.h"
#include "support/simd_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace test_shading_kernel {

using namespace pcl_uvol;
using Eigen::Vector3d;
using uvol_test::makeKey;
using uvol_test::PixelRandom;
using uvol_test::readDepth;
using uvol_test::readPoint;
using uvol_test::TestCamera;

const KernelTable<ShadingKernel> kernels{
    baseline::shadeRow, avx2::shadeRow, avx512::shadeRow};

constexpr int count = 96, first_column = 2, row = 30;
constexpr std::uint32_t points = 40;
constexpr double rounding = 3e-6;

Vector3d
toVector(const float* v)
{
  return {v[0], v[1], v[2]};
}

/** A row of pixels of random points, and lights. */
struct Picture {
  TestCamera camera;
  std::vector<std::uint32_t> looks;
  std::vector<PixelKey> keys;
  std::vector<float> blended = std::vector<float>(blended_values * count);
  std::vector<std::uint8_t> marks = std::vector<std::uint8_t>(count / blend_segment);
  std::array<ShadingLight, 2> lights{};
  Shading shading{};

  Picture()
  {
    PixelRandom random(3);
    for (std::uint32_t i = 0; i < points; ++i) {
      const Eigen::Vector3f normal = random.direction().cast<float>();
      looks.push_back(packNormal(normal.data()));
      looks.push_back(random.below(1u << 24) | 0xff000000);
    }
    for (int i = 0; i < count; ++i)
      keys.push_back(i % 7 == 0
                         ? background_key
                         : makeKey(random.between(0.2, 0.9), random.below(points)));
    for (std::size_t i = 0; i < blended.size(); ++i)
      blended[i] = i % blended_values < 3   ? random.between(-1.0, 1.0)
                   : i % blended_values < 6 ? random.between(0.0, 400.0)
                                            : 2.0f;
    // In a marked segment there are pixels that no disc reached.
    for (std::size_t i = 0; i < count; i += 5)
      std::fill_n(&blended[blended_values * i], blended_values, 0.0f);
    marks[1] = marks[3] = 1;

    const Eigen::Matrix3d& r = camera.rotation;
    for (int i = 0; i < 9; ++i)
      shading.rotation[i] = static_cast<float>(r(i / 3, i % 3));
    shading.looks = looks.data();
    shading.center_x = camera.projection.center_x;
    shading.center_y = camera.projection.center_y;
    shading.per_focal = 1.0f / camera.projection.focal;
    shading.far = 8.0f;
    shading.ambient = 0.18f;
    shading.diffuse = 0.55f;
    shading.specular = 0.4f;
    shading.shininess = 12.5f;
    shading.least_base = std::pow(1e-4f, 1.0f / shading.shininess);
    const Vector3d from = -(r.transpose() * Vector3d(0.2, 0.3, 1.0)).normalized();
    lights[0] = {{static_cast<float>(from[0]),
                  static_cast<float>(from[1]),
                  static_cast<float>(from[2])},
                 {0.7f, 0.8f, 0.6f},
                 false};
    lights[1] = {{1.0f, 0.5f, -2.0f}, {0.2f, 0.1f, 0.3f}, true};
    shading.lights = lights.data();
    shading.light_count = 2;
    shading.is_lit = true;
  }
};

struct Pixel {
  Vector3d color, normal;
  bool is_clear = true; ///< of the threshold below which no highlight is reckoned
};

Pixel
shade(const Picture& picture, std::size_t i)
{
  const Shading& s = picture.shading;
  const std::uint32_t point = readPoint(picture.keys[i]);
  Pixel pixel;
  Eigen::Vector3f unpacked;
  unpackNormal(picture.looks[2 * point], unpacked.data());
  Vector3d surface;
  pixel.normal = unpacked.cast<double>();
  for (int k = 0; k < 3; ++k)
    surface[k] = picture.looks[2 * point + 1] >> (8 * k) & 0xff;
  const float* const sums = &picture.blended[blended_values * i];
  if (picture.marks[i / blend_segment] != 0 && sums[6] > 0.0f) {
    pixel.normal = toVector(sums).normalized();
    surface = toVector(sums + 3) / static_cast<double>(sums[6]);
  }
  surface /= 255.0;
  const double column = first_column + static_cast<double>(i);
  const Vector3d ray =
      (picture.camera.rotation.transpose() *
       Vector3d((column + 0.5 - s.center_x) * static_cast<double>(s.per_focal),
                (row + 0.5 - s.center_y) * static_cast<double>(s.per_focal),
                1.0))
          .normalized();
  if (s.two_sided && pixel.normal.dot(ray) > 0.0)
    pixel.normal = -pixel.normal;
  pixel.color = Vector3d::Ones();
  if (!s.is_lit)
    return pixel;
  const Vector3d place = ray * readDepth(picture.keys[i]) * s.far;
  pixel.color = surface * s.ambient;
  for (const ShadingLight& light : picture.lights) {
    Vector3d to_light = toVector(light.position);
    if (light.is_point)
      to_light = (to_light - place).normalized();
    const double cosine = pixel.normal.dot(to_light);
    if (std::abs(cosine) < 1e-5)
      pixel.is_clear = false;
    if (cosine <= 0.0)
      continue;
    const double toward =
        std::min(1.0, pixel.normal.dot((to_light - ray).normalized()));
    if (std::abs(toward - s.least_base) < 1e-4)
      pixel.is_clear = false;
    const double highlight = toward >= s.least_base
                                 ? s.specular * std::pow(toward, double(s.shininess))
                                 : 0.0;
    pixel.color +=
        toVector(light.color)
            .cwiseProduct(surface * s.diffuse * cosine + Vector3d::Constant(highlight));
  }
  pixel.color = pixel.color.cwiseMin(1.0);
  return pixel;
}

TEST(ShadingKernel, IsBlinnPhong)
{
  Picture picture;
  for (const auto& [is_lit, two_sided] :
       {std::pair(true, false), std::pair(true, true), std::pair(false, false)}) {
    picture.shading.is_lit = is_lit;
    picture.shading.two_sided = two_sided;
    uvol_test::forLevels(kernels, [&](ShadingKernel kernel) {
      std::array<std::vector<float>, 8> planes;
      for (auto& plane : planes)
        plane.assign(count, -1.0f);
      kernel(picture.shading,
             picture.keys.data(),
             first_column,
             row,
             count,
             {picture.blended.data(), picture.marks.data()},
             {{planes[0].data(), planes[1].data(), planes[2].data()},
              planes[3].data(),
              planes[4].data(),
              {planes[5].data(), planes[6].data(), planes[7].data()}});
      int bright = 0;
      for (std::size_t i = 0; i < count; ++i) {
        if (picture.keys[i] == background_key) {
          for (std::size_t k = 0; k < planes.size(); ++k)
            EXPECT_EQ(k == 4 ? 1.0f : 0.0f, planes[k][i]);
          continue;
        }
        EXPECT_EQ(1.0f, planes[3][i]);
        EXPECT_EQ(readDepth(picture.keys[i]), planes[4][i]);
        const Pixel pixel = shade(picture, i);
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(pixel.normal[long(k)], planes[5 + k][i], rounding);
          if (pixel.is_clear) {
            EXPECT_NEAR(pixel.color[long(k)], planes[k][i], rounding);
          }
        }
        bright += pixel.color.maxCoeff() > 0.5 ? 1 : 0;
      }
      EXPECT_GT(bright, 5);
    });
  }
}

} // namespace test_shading_kernel
