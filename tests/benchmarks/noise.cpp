// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of noisy samples: direct, after a local mean or a local fit of the
// values, and by level sets.
#include "support/clouds.h"
#include "support/noisy_shapes.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/neighbors/nearest_neighbors.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using uvol_test::NoisyCloud;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Surface = pcl::PointCloud<PointIso>;

void
printRow(const NoisyCloud& noisy, const std::string& method, const Surface& surface)
{
  const auto quality = uvol_test::measure(noisy, surface);
  std::printf("%-12s %-10s %4.2f  %-28s %7zu  %.4f  %+.4f  %7.3f  %zu\n",
              noisy.shape.name,
              noisy.clustered ? "clustered" : "uniform",
              noisy.noise,
              method.c_str(),
              surface.size(),
              quality.rms,
              quality.shift,
              quality.normal_rms,
              quality.components);
  std::fflush(stdout);
}

/** f replaced by its mean over a sample and its 26 nearest neighbours. */
Cloud::Ptr
localMean(const Cloud& cloud)
{
  pcl_uvol::Report report;
  const auto samples = uvol_test::buildSamples(cloud);
  const auto graph = pcl_uvol::computeNearestNeighbors(*samples, 26, 0, report);
  const Cloud::Ptr mean(new Cloud(cloud));
  for (std::size_t i = 0; i < graph.size(); ++i) {
    double sum = cloud[samples->getInputIndex(i)].intensity;
    for (const std::uint32_t j : graph[i])
      sum += cloud[samples->getInputIndex(j)].intensity;
    (*mean)[samples->getInputIndex(i)].intensity =
        static_cast<float>(sum / static_cast<double>(graph[i].size() + 1));
  }
  return mean;
}

struct Setting {
  const char* name;
  double mu;
  pcl_uvol::FitScheme scheme;
  pcl_uvol::CurvatureFlow flow;
};

void
evolveAndPrint(const NoisyCloud& noisy, const Setting& setting)
{
  pcl_uvol::LevelSetEvolution<pcl::PointXYZI> evolution;
  evolution.setInputCloud(noisy.cloud);
  evolution.setIsoValue(0.0);
  if (setting.mu >= 0.0)
    evolution.setMu(setting.mu);
  evolution.setScheme(setting.scheme);
  evolution.setCurvatureFlow(setting.flow);
  std::vector<float> phi;
  evolution.evolve(phi);
  const Cloud::Ptr level(new Cloud(*noisy.cloud));
  for (std::size_t i = 0; i < phi.size(); ++i)
    (*level)[i].intensity = phi[i];
  const auto& summary = evolution.getSummary();
  char name[80];
  std::snprintf(name,
                sizeof name,
                "%s mu %.3f, %zu steps",
                setting.name,
                summary.mu,
                summary.steps.size());
  printRow(noisy, name, uvol_test::isopoints(level, pcl_uvol::Interpolation::Smooth));
  std::printf("#   noise %.3f spacing %.3f time %.1f change %.4f slope error %.3f "
              "band %zu %s%.0f ms\n",
              summary.noise,
              summary.spacing,
              summary.steps.back().time,
              summary.steps.back().change,
              summary.steps.back().slope_error,
              static_cast<std::size_t>(evolution.getReport().getCount("band_samples")),
              summary.converged ? "" : "not converged ",
              evolution.getReport().milliseconds.back().second);
  std::fflush(stdout);
}

} // namespace

/** noise SHAPE uniform|clustered PERCENT MU...: one row per method; a negative MU
 * stands for the automatic one. */
int
main(int argc, char** argv)
{
  using pcl_uvol::CurvatureFlow;
  using pcl_uvol::FitScheme;
  using pcl_uvol::Interpolation;
  if (argc < 4) {
    std::fputs(
        "usage: noise sphere|torus|two_spheres uniform|clustered PERCENT MU...\n",
        stderr);
    return 2;
  }
  const auto noisy = uvol_test::makeNoisyCloud(
      argv[1], std::string(argv[2]) == "clustered", std::atof(argv[3]) / 100.0, 1);
  std::puts("# shape sampling noise method points rms shift normals_rms components");
  Surface direct = uvol_test::isopoints(noisy.cloud, Interpolation::Linear);
  pcl_uvol::Report report;
  pcl_uvol::replaceNormals(direct, {}, report);
  printRow(noisy, "direct linear, PCA", direct);
  printRow(
      noisy, "direct smooth", uvol_test::isopoints(noisy.cloud, Interpolation::Smooth));
  const auto mean = localMean(*noisy.cloud);
  printRow(
      noisy, "local mean, linear", uvol_test::isopoints(mean, Interpolation::Linear));
  printRow(
      noisy, "local mean, smooth", uvol_test::isopoints(mean, Interpolation::Smooth));
  for (int i = 4; i < argc; ++i) {
    const double mu = std::atof(argv[i]);
    evolveAndPrint(noisy,
                   {"relative", mu, FitScheme::Quadratic, CurvatureFlow::Relative});
    if (mu != 0.5)
      continue;
    // Where the thesis's schemes are measured: the smaller mu, the more they shrink.
    evolveAndPrint(noisy, {"mean", mu, FitScheme::Quadratic, CurvatureFlow::Mean});
    evolveAndPrint(noisy, {"thesis", mu, FitScheme::Linear, CurvatureFlow::Mean});
  }
  return 0;
}
