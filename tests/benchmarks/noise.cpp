// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of noisy samples: direct, after a local mean or a local fit of the
// values, and by level sets; and what level sets make of shapes that smoothing may take
// away.
#include "common/parallel.h"
#include "neighbors/nearest_neighbors.h"
#include "support/clouds.h"
#include "support/noisy_shapes.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/surface/surface_normals.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
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
 * nearest neighbours best, unweighted.
 * \param degree 0 for the mean, or 2 */
Cloud::Ptr
localFit(const Cloud& cloud, std::size_t k, int degree)
{
  pcl_uvol::Report report;
  const auto samples = uvol_test::buildSamples(cloud);
  const auto graph = pcl_uvol::computeNearestNeighbors(*samples, k, 0, report);
  Cloud::Ptr fitted(new Cloud(cloud));
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

/** What the table tells of one way to the surface: root mean squares over some clouds.
 */
struct Deviation {
  double rms = 0.0, whole_rms = 0.0;
  double mu = 0.0;
  std::size_t points = 0, steps = 0;
  double milliseconds = 0.0;
};

/** Clouds with the same shape. */
struct Clouds {
  std::vector<NoisyCloud> clouds;
  double isovalue = 0.0; ///< of the intensity, where the shape is
};

/** \param surface_of a cloud; tells the rest of the deviation as well */
template <typename SurfaceOf>
Deviation
averageOf(const Clouds& clouds, const SurfaceOf& surface_of)
{
  Deviation all;
  double squares = 0.0, whole_squares = 0.0;
  for (const NoisyCloud& noisy : clouds.clouds) {
    const Surface surface = surface_of(noisy, all);
    const auto quality = uvol_test::measure(noisy, surface);
    squares += surface.empty() ? std::numeric_limits<double>::infinity()
                               : quality.rms * quality.rms;
    whole_squares += quality.whole_rms * quality.whole_rms;
    all.points += surface.size();
  }
  const auto count = static_cast<double>(clouds.clouds.size());
  all.rms = std::sqrt(squares / count);
  all.whole_rms = std::sqrt(whole_squares / count);
  return all;
}

/** \param mu none: automatic
 * \param length, value units that the samples are given in
 */
Deviation
smooth(const Clouds& clouds,
       std::optional<double> mu,
       double length = 1.0,
       double value = 1.0)
{
  return averageOf(clouds, [&](const NoisyCloud& noisy, Deviation& told) {
    const Cloud::Ptr given(new Cloud(*noisy.cloud)), level(new Cloud(*noisy.cloud));
    for (auto& point : *given) {
      for (int axis = 0; axis < 3; ++axis)
        point.data[axis] = static_cast<float>(length * point.data[axis]);
      point.intensity = static_cast<float>(value * point.intensity);
    }
    pcl_uvol::LevelSetEvolution<pcl::PointXYZI> evolution;
    evolution.setInputCloud(given);
    evolution.setIsoValue(value * clouds.isovalue);
    if (mu)
      evolution.setMu(*mu);
    std::vector<float> phi;
    evolution.evolve(phi);
    for (std::size_t i = 0; i < phi.size(); ++i)
      (*level)[i].intensity = static_cast<float>(phi[i] / length);
    const auto& summary = evolution.getSummary();
    told.mu += summary.mu / static_cast<double>(clouds.clouds.size());
    told.steps += summary.steps.size();
    for (const auto& [step, spent] : evolution.getReport().milliseconds)
      told.milliseconds += spent;
    // As the pipeline does: what is not smoothed is extracted from the field itself.
    return summary.smoothed ? uvol_test::isopoints(level, pcl_uvol::Interpolation::Fit)
                            : uvol_test::isopoints(noisy.cloud,
                                                   pcl_uvol::Interpolation::Fit,
                                                   clouds.isovalue);
  });
}

void
printComparison(const std::string& name, const Clouds& clouds)
{
  const Deviation direct = averageOf(clouds, [&](const NoisyCloud& noisy, Deviation&) {
    return uvol_test::isopoints(
        noisy.cloud, pcl_uvol::Interpolation::Fit, clouds.isovalue);
  });
  const Deviation automatic = smooth(clouds, std::nullopt);
  Deviation best;
  best.rms = best.whole_rms = std::numeric_limits<double>::infinity();
  if (!std::getenv("NOISE_FAST"))
    for (const double mu : {0.7, 0.5, 0.35, 0.25, 0.18, 0.12, 0.06, 0.03, 0.015}) {
      const Deviation fixed = smooth(clouds, mu);
      const double whole_rms = std::min(best.whole_rms, fixed.whole_rms);
      if (fixed.rms < best.rms)
        best = fixed;
      best.whole_rms = whole_rms;
    }
  std::printf(
      "| %s | %.4f | %.4f, mu %.3f | %.4f, mu %.2f | %.2f | %.2f | %zu | %.0f | "
      "%zu, %zu | %.4f, %.2f |\n",
      name.c_str(),
      direct.rms,
      automatic.rms,
      automatic.mu,
      best.rms,
      best.mu,
      automatic.rms / best.rms,
      automatic.rms / direct.rms,
      automatic.steps / clouds.clouds.size(),
      automatic.milliseconds / static_cast<double>(clouds.clouds.size()),
      direct.points,
      automatic.points,
      automatic.whole_rms,
      automatic.whole_rms / best.whole_rms);
  std::fflush(stdout);
}

Clouds
draw(const char* shape, double size, double noise, std::uint64_t first_seed = 1)
{
  constexpr std::uint64_t seeds = 2;
  Clouds clouds;
  for (std::uint64_t seed = first_seed; seed < first_seed + seeds; ++seed)
    clouds.clouds.push_back(
        uvol_test::makeNoisyCloud(uvol_test::makeSmallShape(shape, size), noise, seed));
  return clouds;
}

void
printTable(const std::string& word, std::uint64_t first_seed)
{
  std::puts("| shape | direct | automatic mu | best fixed mu | automatic / best | "
            "automatic / direct | steps | ms | isopoints, direct and automatic | "
            "with those near the border: automatic, automatic / best |\n"
            "|---|---|---|---|---|---|---|---|---|---|");
  const struct {
    const char* shape;
    double size;
  } shapes[] = {{"sphere", 2.0},
                {"sphere", 3.0},
                {"sphere", 4.0},
                {"cylinder", 2.0},
                {"cylinder", 3.0},
                {"sheet", 4.0},
                {"sheet", 6.0},
                {"waves", 6.0},
                {"waves", 9.0},
                {"torus", 4.0}};
  for (const auto& [shape, size] : shapes)
    for (const double noise : {0.0, 0.1, 0.3, 1.0}) {
      char name[80];
      std::snprintf(name, sizeof name, "%s %g, noise %.1f", shape, size, noise);
      if (std::string(name).find(word) == std::string::npos)
        continue;
      printComparison(name, draw(shape, size, noise, first_seed));
    }
  for (const double spike : {1e3, 1e10}) {
    Clouds clouds = draw("sphere", 8.0, 0.1, first_seed);
    for (const NoisyCloud& noisy : clouds.clouds)
      for (std::size_t i = 0; i < noisy.cloud->size(); i += 100)
        (*noisy.cloud)[i].intensity = static_cast<float>(spike);
    char name[80];
    std::snprintf(name, sizeof name, "sphere 8, noise 0.1, 1 %% of values %.0e", spike);
    if (std::string(name).find(word) != std::string::npos)
      printComparison(name, clouds);
  }
}

/** Values that grow by a factor from spacing to spacing: noise of the distance is a
 * share of them. */
void
printGrowth(const std::string& word, std::uint64_t first_seed)
{
  for (const double factor : {2.0, 3.0})
    for (const double noise : {0.0, 0.1, 0.3}) {
      char name[80];
      std::snprintf(
          name, sizeof name, "sphere 8, growth %g, noise %.1f", factor, noise);
      if (std::string(name).find(word) == std::string::npos)
        continue;
      Clouds clouds = draw("sphere", 8.0, noise, first_seed);
      for (const NoisyCloud& noisy : clouds.clouds)
        for (auto& point : *noisy.cloud)
          point.intensity = std::pow(static_cast<float>(factor), point.intensity);
      clouds.isovalue = 1.0;
      printComparison(name, clouds);
    }
}

/** One row per pair of units. */
void
printUnits()
{
  const Clouds clouds = draw("sphere", 4.0, 0.3);
  std::puts("| unit of length | of values | automatic mu |\n|---|---|---|");
  for (const double length : {1e-30, 1e-10, 1.0, 1e10, 1e30})
    for (const double value : {1e-30, 1e-10, 1.0, 1e10, 1e30}) {
      const Deviation deviation = smooth(clouds, std::nullopt, length, value);
      std::printf("| %.0e | %.0e | %.6f, mu %.4f |\n",
                  length,
                  value,
                  deviation.rms,
                  deviation.mu);
    }
}

} // namespace

/** noise table [WORD [SEED]]: the rows whose names hold the word, of the clouds with
 * the seed, by default 1, and the next. noise units: other units. noise SHAPE
 * uniform|clustered PERCENT MU...: one row per method; a negative MU stands for the
 * automatic one. */
int
main(int argc, char** argv)
{
  using pcl_uvol::CurvatureFlow;
  using pcl_uvol::FitScheme;
  using pcl_uvol::Interpolation;
  if (argc >= 2 && std::string(argv[1]) == "table") {
    const std::string word = argc > 2 ? argv[2] : "";
    const auto seed = static_cast<std::uint64_t>(argc > 3 ? std::atoi(argv[3]) : 1);
    printTable(word, seed);
    printGrowth(word, seed);
    return 0;
  }
  if (argc == 2 && std::string(argv[1]) == "units") {
    printUnits();
    return 0;
  }
  if (argc < 4) {
    std::fputs("usage: noise table [WORD [SEED]]\n       noise units\n       noise "
               "sphere|torus|two_spheres "
               "uniform|clustered PERCENT MU...\n",
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
