// SPDX-License-Identifier: BSD-3-Clause
// What level sets do to noise (thesis chapter 3), beside the direct surface of the same
// samples.
#include "levelset/level_set_setup.h"
#include "support/noisy_shapes.h"
#include <pcl_uvol/surface/surface_normals.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace test_level_set_noise {

using pcl_uvol::Interpolation;
using uvol_test::Evolution;
using uvol_test::evolve;
using uvol_test::makeBall;
using uvol_test::NoisyCloud;
using uvol_test::withValues;
using Vector = Eigen::Vector3d;

struct NoisyCase {
  const char* shape;
  bool clustered;
  double noise; ///< part of the radius
};

class LevelSetOfNoise : public testing::TestWithParam<NoisyCase> {};

/** The default against the direct surface: at most a half of its deviation, where the
 * noise is strong a third. */
TEST_P(LevelSetOfNoise, IsSmoothAndInItsPlace)
{
  const auto [shape, clustered, noise] = GetParam();
  const auto noisy = uvol_test::makeNoisyCloud(shape, clustered, noise, 1);
  auto direct = uvol_test::isopoints(noisy.cloud, Interpolation::Linear);
  pcl_uvol::Report report;
  pcl_uvol::detail::replaceNormals(direct, {}, 0, report);
  const auto before = uvol_test::measure(noisy, direct);
  Evolution evolution;
  const auto phi = evolve(evolution, noisy.cloud);
  EXPECT_TRUE(evolution.getSummary().converged);
  // Between two surfaces there is hardly a slope to tell it by.
  const double part = noisy.shape.components == 1 ? 0.1 : 0.4;
  EXPECT_NEAR(noisy.noise, evolution.getSummary().noise, part * noisy.noise);
  const auto after = uvol_test::measure(
      noisy, uvol_test::isopoints(withValues(*noisy.cloud, phi), Interpolation::Fit));
  EXPECT_LT(after.rms, (noise < 0.03 ? 1.0 / 2.0 : 1.0 / 3.0) * before.rms);
  EXPECT_LT(after.normal_rms, before.normal_rms / 3.0);
  EXPECT_LT(std::abs(after.shift), 0.01 * 22.0);
  EXPECT_EQ(noisy.shape.components, after.components);
}

INSTANTIATE_TEST_SUITE_P(LevelSetNoise,
                         LevelSetOfNoise,
                         testing::Values(NoisyCase{"sphere", false, 0.02},
                                         NoisyCase{"sphere", false, 0.05},
                                         NoisyCase{"sphere", true, 0.02},
                                         NoisyCase{"sphere", true, 0.05},
                                         NoisyCase{"torus", false, 0.02},
                                         NoisyCase{"torus", false, 0.05},
                                         NoisyCase{"torus", true, 0.02},
                                         NoisyCase{"torus", true, 0.05},
                                         NoisyCase{"two_spheres", false, 0.02},
                                         NoisyCase{"two_spheres", false, 0.05},
                                         NoisyCase{"two_spheres", true, 0.02},
                                         NoisyCase{"two_spheres", true, 0.05}),
                         [](const auto& test) {
                           std::string name = test.param.shape;
                           name += test.param.clustered ? "_clustered" : "_uniform";
                           name += test.param.noise < 0.03 ? "_2" : "_5";
                           // Noise takes many steps: two shapes stand for all.
                           return name == "torus_clustered_5" ||
                                          name == "sphere_uniform_2"
                                      ? name
                                      : name + "_long";
                         });

/** A torus so thin that smoothing as much as its noise asks for would take it away. */
NoisyCloud
makeThinTorus()
{
  NoisyCloud noisy{{"thin_torus",
                    16.0,
                    1,
                    [](const Vector& x) {
                      return 4.0 - std::hypot(std::hypot(x[0], x[1]) - 10.0, x[2]);
                    }},
                   false,
                   0.4,
                   makeBall(0.0, 16.0)};
  uvol_test::Random random(9);
  for (auto& point : *noisy.cloud)
    point.intensity =
        static_cast<float>(noisy.shape.distance(point.getVector3fMap().cast<double>()) +
                           noisy.noise * std::sqrt(12.0) * (random.uniform() - 0.5));
  return noisy;
}

TEST(LevelSetNoise, AutomaticWeightIsNearlyTheBest_long)
{
  for (const auto& noisy :
       {uvol_test::makeNoisyCloud("torus", false, 0.02, 1), makeThinTorus()}) {
    const auto deviation = [&, &noisy = noisy](double mu) {
      Evolution evolution;
      if (mu >= 0.0)
        evolution.setMu(mu);
      const auto phi = evolve(evolution, noisy.cloud);
      return uvol_test::measure(noisy,
                                uvol_test::isopoints(withValues(*noisy.cloud, phi),
                                                     Interpolation::Fit))
          .rms;
    };
    double best = deviation(0.4);
    for (const double mu : {0.2, 0.1, 0.03, 0.01})
      best = std::min(best, deviation(mu));
    EXPECT_LT(deviation(-1.0), 1.2 * best) << noisy.shape.name;
  }
}

} // namespace test_level_set_noise
