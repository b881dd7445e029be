// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of noisy samples: direct, after a local mean or a local fit of the
// values, and by level sets.
#include "common/parallel.h"
#include "neighbors/nearest_neighbors.h"
#include "support/clouds.h"
#include "support/noisy_shapes.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <Eigen/QR>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using uvol_test::NoisyCloud;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Surface = pcl::PointCloud<pcl_uvol::PointIso>;

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

/** f replaced by the value at each sample of the polynomial that fits it and its k
 * nearest neighbours best, unweighted. \param degree 0 for the mean, or 2 */
Cloud::Ptr
localFit(const Cloud& cloud, std::size_t k, int degree)
{
  pcl_uvol::Report report;
  const auto samples = uvol_test::buildSamples(cloud);
  const auto graph = pcl_uvol::computeNearestNeighbors(*samples, k, 0, report);
  const Cloud::Ptr fitted(new Cloud(cloud));
  pcl_uvol::parallelBlocks(graph.size(), 1024, 0, [&](auto begin, auto end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto center = samples->getInputIndex(i);
      std::vector<std::uint32_t> points{center};
      for (const std::uint32_t j : graph[i])
        points.push_back(samples->getInputIndex(j));
      Eigen::MatrixXd terms(points.size(), degree == 0 ? 1 : 10);
      Eigen::VectorXd values(points.size());
      for (std::size_t j = 0; j < points.size(); ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        const Eigen::Vector3d u =
            (cloud[points[j]].getVector3fMap() - cloud[center].getVector3fMap())
                .cast<double>();
        terms(row, 0) = 1.0;
        if (degree == 2)
          terms.row(row).tail(9) << u.transpose(), u[0] * u[0], u[1] * u[1],
              u[2] * u[2], u[0] * u[1], u[0] * u[2], u[1] * u[2];
        values[row] = cloud[points[j]].intensity;
      }
      (*fitted)[center].intensity =
          static_cast<float>(terms.householderQr().solve(values)[0]);
    }
  });
  return fitted;
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
  printRow(noisy, name, uvol_test::isopoints(level, pcl_uvol::Interpolation::Fit));
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
  pcl_uvol::detail::replaceNormals(direct, {}, 0, report);
  printRow(noisy, "direct linear, PCA", direct);
  printRow(
      noisy, "direct smooth", uvol_test::isopoints(noisy.cloud, Interpolation::Fit));
  const struct {
    const char* name;
    std::size_t k;
    int degree;
  } fits[] = {{"mean of 27", 26, 0},
              {"mean of 101", 100, 0},
              {"quadratic fit of 27", 26, 2},
              {"quadratic fit of 101", 100, 2}};
  for (const auto& fit : fits)
    printRow(noisy,
             fit.name,
             uvol_test::isopoints(localFit(*noisy.cloud, fit.k, fit.degree),
                                  Interpolation::Fit));
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
