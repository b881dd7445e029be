// SPDX-License-Identifier: BSD-3-Clause
// Whether the error of isopoints is one: how many deviations from the true surface lie
// below it, and how much larger than them it is.
#include "support/noisy_shapes.h"
#include "support/stretched_samples.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Surface = pcl::PointCloud<pcl_uvol::PointIso>;

/** One row, as CSV, for the isopoints of a kind. */
void
printRow(const std::string& name,
         const Surface& surface,
         const std::vector<double>& deviations,
         const std::function<bool(const pcl_uvol::PointIso&)>& counts)
{
  std::vector<double> ratios;
  for (std::size_t i = 0; i < surface.size(); ++i)
    if (counts(surface[i]))
      ratios.push_back(surface[i].error / std::max(deviations[i], 1e-30));
  if (ratios.empty()) {
    std::printf("\"%s\",0,,\n", name.c_str());
    return;
  }
  const auto covered =
      std::count_if(ratios.begin(), ratios.end(), [](double r) { return r >= 1.0; });
  std::printf("\"%s\",%zu,%.1f,%.3g\n",
              name.c_str(),
              ratios.size(),
              100.0 * static_cast<double>(covered) / static_cast<double>(ratios.size()),
              uvol_test::quantile(ratios, 0.5));
  std::fflush(stdout);
}

bool
isAny(const pcl_uvol::PointIso&)
{
  return true;
}

bool
isBridged(const pcl_uvol::PointIso& point)
{
  return point.support == static_cast<std::uint8_t>(pcl_uvol::IsoSupport::Bridged);
}

bool
isRim(const pcl_uvol::PointIso& point)
{
  return point.support == static_cast<std::uint8_t>(pcl_uvol::IsoSupport::Rim);
}

bool
hasFit(const pcl_uvol::PointIso& point)
{
  return !std::isnan(point.mean_curvature);
}

bool
isOnEdge(const pcl_uvol::PointIso& point)
{
  return !hasFit(point);
}

bool
isPredicted(const pcl_uvol::PointIso& point)
{
  return point.support == static_cast<std::uint8_t>(pcl_uvol::IsoSupport::Predicted);
}

Surface
extract(const Cloud::ConstPtr& cloud, double isovalue)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValue(isovalue);
  Surface surface;
  extraction.extract(surface);
  return surface;
}

void
printScattered(std::size_t n, std::uint64_t seed)
{
  for (const char* const name :
       {"radial", "waves", "gyroid", "decay", "fourth_power", "growth"})
    for (const bool clustered : {false, true}) {
      const auto field = uvol_test::makeSmoothField(name, n);
      const Surface surface = extract(
          uvol_test::sampleSmoothField(field, n, seed, clustered), field.isovalue);
      printRow(std::string(name) + (clustered ? ", clustered" : ", uniform"),
               surface,
               uvol_test::deviations(field, surface),
               isAny);
    }
}

void
printStretched(const std::string& name,
               const std::string& shape,
               double ratio,
               int side)
{
  const auto field =
      uvol_test::makeSmoothField(name, static_cast<std::size_t>(side) * side * side);
  const auto samples = uvol_test::makeStretchedSamples(shape, ratio, side);
  const Surface surface = extract(samples.sample(field, side, 1), field.isovalue);
  auto moved = field;
  moved.value = [&](const Eigen::Vector3d& x) {
    return field.value(samples.to_index(x));
  };
  char row[80];
  std::snprintf(row,
                sizeof row,
                "%s%s, 1 : 1 : %g",
                name == "radial" ? "" : (name + ", ").c_str(),
                shape.c_str(),
                ratio);
  printRow(row, surface, uvol_test::deviations(moved, surface), isAny);
}

/** Samples with holes on the surface, as wide as some of the neighbourhoods. */
void
printHoles(std::size_t n, std::uint64_t seed)
{
  const auto field = uvol_test::makeSmoothField("radial", n);
  for (const double radius : {2.0, 4.0}) {
    Cloud::Ptr cloud(new Cloud);
    const auto samples = uvol_test::sampleSmoothField(field, n, seed, false);
    for (const auto& point : *samples) {
      const Eigen::Vector3d x = point.getVector3fMap().cast<double>();
      bool is_in_hole = false;
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
          is_in_hole =
              is_in_hole ||
              (x - side * field.isovalue * Eigen::Vector3d::Unit(axis)).norm() < radius;
      if (!is_in_hole)
        cloud->push_back(point);
    }
    const Surface surface = extract(cloud, field.isovalue);
    const auto deviations = uvol_test::deviations(field, surface);
    char name[80];
    std::snprintf(name, sizeof name, "holes of radius %g, ", radius);
    printRow(std::string(name) + "bridged", surface, deviations, isBridged);
    printRow(std::string(name) + "rim", surface, deviations, isRim);
  }
}

/** The surface that the pipeline makes, as it does for the tools. */
Surface
extract(const Cloud& cloud,
        double isovalue,
        pcl_uvol::IsosurfacePipelineParameters parameters)
{
  const auto samples = std::make_shared<pcl_uvol::Dataset>();
  pcl::toPCLPointCloud2(cloud, samples->cloud);
  parameters.isosurface.isovalues = {isovalue};
  pcl_uvol::IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(parameters);
  Surface surface;
  pcl::fromPCLPointCloud2(pipeline.run().surface.cloud, surface);
  return surface;
}

/** A gyroid whose period is half the side of the cube. */
void
printLines(std::uint64_t n, std::uint64_t seed)
{
  using pcl_uvol::Scatter;
  const auto field = uvol_test::makeSmoothField("gyroid", n);
  for (const auto& [name, lines] : {std::pair("tracks", Scatter::Tracks),
                                    std::pair("casts", Scatter::Casts),
                                    std::pair("holes", Scatter::Holes)}) {
    const auto cloud = uvol_test::sampleOnLines(field, lines, n, seed);
    const auto print = [&, name = name](const char* kind,
                                        const Surface& surface,
                                        bool (*counts)(const pcl_uvol::PointIso&)) {
      printRow(std::string(name) + " of " + std::to_string(n) + kind,
               surface,
               uvol_test::deviations(field, surface),
               counts);
    };
    pcl_uvol::IsosurfacePipelineParameters parameters;
    const Surface surface = extract(*cloud, field.isovalue, parameters);
    print(", fits", surface, hasFit);
    print(", on edges", surface, isOnEdge);
    parameters.fill_gaps = true;
    parameters.automatic_scale = false;
    print(", filled", extract(*cloud, field.isovalue, parameters), isPredicted);
  }
}

/** \param mu of the level set; none: automatic */
Surface
smoothAndExtract(const Cloud& cloud, const std::optional<double>& mu)
{
  pcl_uvol::IsosurfacePipelineParameters parameters;
  parameters.smooth = true;
  parameters.level_set.mu = mu;
  return extract(cloud, 0.0, parameters);
}

void
printNoise(const std::string& name, const uvol_test::NoisyCloud& noisy)
{
  const auto distances = [&](const Surface& surface) {
    std::vector<double> found;
    for (const auto& point : surface)
      found.push_back(
          std::abs(noisy.shape.distance(point.getVector3fMap().cast<double>())));
    return found;
  };
  const auto isInside = [&](const pcl_uvol::PointIso& point) {
    return point.getVector3fMap().cwiseAbs().maxCoeff() < noisy.shape.extent - 3.0;
  };
  const Surface direct = extract(noisy.cloud, 0.0);
  printRow(name + ", direct", direct, distances(direct), isInside);
  const Surface smoothed = smoothAndExtract(*noisy.cloud, std::nullopt);
  printRow(name + ", smoothed", smoothed, distances(smoothed), isInside);
  const Surface by_weight = smoothAndExtract(*noisy.cloud, 0.1);
  printRow(name + ", mu 0.1", by_weight, distances(by_weight), isInside);
}

void
printNoise(double noise, std::uint64_t seed)
{
  char text[40];
  std::snprintf(text, sizeof text, ", noise %g", noise);
  const auto row = [&](const std::string& name, const uvol_test::NoisyCloud& noisy) {
    printNoise(name + text, noisy);
  };
  row("sphere", uvol_test::makeNoisyCloud(uvol_test::makeShape("sphere"), noise, seed));
  row("sphere, clustered",
      uvol_test::makeNoisyCloud("sphere", true, noise / 22.0, seed));
  for (const auto& [name, size] : {std::pair("sphere", 4.0), std::pair("waves", 10.0)})
    row(std::string("small ") + name,
        uvol_test::makeNoisyCloud(uvol_test::makeSmallShape(name, size), noise, seed));
}

} // namespace

/** calibration [SAMPLES [SEED [GROUP]]]: all groups of rows, or one of them. */
int
main(int argc, char** argv)
{
  const auto n = static_cast<std::size_t>(argc > 1 ? std::atof(argv[1]) : 64000.0);
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoi(argv[2]) : 1);
  const auto isWanted = [&](const char* group) {
    return argc <= 3 || std::string(argv[3]) == group;
  };
  std::puts("samples,isopoints,covered,median ratio");
  if (isWanted("scattered"))
    printScattered(n, seed);
  const int side = static_cast<int>(std::cbrt(static_cast<double>(n)) + 1e-9);
  if (isWanted("stretched"))
    for (const char* const field : {"radial", "waves", "gyroid"})
      for (const char* const shape :
           {"lattice", "rotated", "wall", "jittered", "shaken"})
        for (const double ratio : {1.0, 10.0, 100.0})
          printStretched(field, shape, ratio, side);
  if (isWanted("holes"))
    printHoles(n, seed);
  if (isWanted("lines"))
    for (const std::uint64_t samples : {2500, 20000, 160000})
      printLines(samples, seed);
  if (isWanted("noise"))
    for (const double noise : {0.1, 0.3, 1.0})
      printNoise(noise, seed);
  return 0;
}
