// SPDX-License-Identifier: BSD-3-Clause
// Discrete Voronoi diagrams and the kd-tree as sources of neighbours: thesis Tables 2.7
// to 2.9 and Figure 2.16.
#include "generation/analytic_fields.h"
#include "neighbors/neighborhood_finder.h"
#include "support/clouds.h"
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <string>

namespace {

using pcl_uvol::AngleCriterion;
using pcl_uvol::Report;
using pcl_uvol::VoronoiCandidateSettings;

double
secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

/** \param cells 0: the kd-tree */
std::optional<VoronoiCandidateSettings>
settingsFor(int cells)
{
  if (cells == 0)
    return std::nullopt;
  return VoronoiCandidateSettings{static_cast<std::uint32_t>(cells), nullptr};
}

/** Table 2.9: linear isopoints of the radial function, from samples to isopoints. */
void
printDeviations(std::size_t n, std::uint64_t seed, int cells)
{
  const auto radial = uvol_test::makeRadialCloud(n, seed);
  for (const auto criterion : {AngleCriterion::Kept, AngleCriterion::All}) {
    pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
    extraction.setInputCloud(radial.cloud);
    extraction.setIsoValue(radial.radius);
    extraction.setInterpolation(pcl_uvol::Interpolation::Linear);
    extraction.setAngleCriterion(criterion);
    if (const auto settings = settingsFor(cells))
      extraction.setNeighborSource(pcl_uvol::NeighborSource::Voronoi, settings->cells);
    pcl::PointCloud<pcl_uvol::PointIso> surface;
    const auto start = std::chrono::steady_clock::now();
    extraction.extract(surface);
    const double seconds = secondsSince(start);
    double sum = 0.0, largest = 0.0;
    const Eigen::Vector3f center =
        Eigen::Vector3f::Constant(static_cast<float>(radial.center));
    for (const pcl_uvol::PointIso& point : surface) {
      const double deviation =
          std::abs((point.getVector3fMap() - center).norm() - radial.radius);
      sum += deviation;
      largest = std::max(largest, deviation);
    }
    std::printf("%d %s %zu %zu %.5f %.4f %.2f\n",
                cells,
                criterion == AngleCriterion::Kept ? "kept" : "all",
                n,
                surface.size(),
                sum / static_cast<double>(surface.size()),
                largest,
                seconds);
    std::fflush(stdout);
  }
}

/** Tables 2.7 and 2.8: neighbours of all samples of a star with two arms. */
void
printPipeline(std::size_t n, int cells)
{
  const auto& field = pcl_uvol::findAnalyticField("star");
  std::vector<float> xyz;
  for (std::size_t i = 0; i < n; ++i)
    for (const double along : pcl_uvol::scatterAt(
             pcl_uvol::Scatter::Clustered, 1, i, n, field.lower, field.upper))
      xyz.push_back(static_cast<float>(along));
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0u);
  Report report;
  auto start = std::chrono::steady_clock::now();
  const auto samples = pcl_uvol::SampleSet::build(
      xyz.data(), 3, all, pcl_uvol::Position{{1.0f, 1.0f, 1.0f}}, 0, report);
  const double tree = secondsSince(start);
  start = std::chrono::steady_clock::now();
  const auto candidates =
      pcl_uvol::makeCandidates(*samples, settingsFor(cells), 0, report);
  const double diagram = secondsSince(start);
  start = std::chrono::steady_clock::now();
  pcl_uvol::computeNaturalNeighbors(
      *samples, *candidates, AngleCriterion::Kept, 0, report);
  const double neighbors = secondsSince(start);
  const auto perSample = [&](const char* count) {
    return static_cast<double>(report.getCount(count)) / static_cast<double>(n);
  };
  std::printf("%d %zu %zu %.2f %.2f %.2f %.1f %.1f\n",
              cells,
              n,
              static_cast<std::size_t>(report.getCount("sites")),
              tree,
              diagram,
              neighbors,
              perSample("candidates"),
              perSample("neighbors"));
  std::fflush(stdout);
}

} // namespace

/** voronoi radial|star SAMPLES CELLS...: one row per grid, 0 for the kd-tree. */
int
main(int argc, char** argv)
{
  const std::string table = argc < 4 ? "" : argv[1];
  if (table != "radial" && table != "star") {
    std::fputs("usage: voronoi radial|star SAMPLES CELLS...\n", stderr);
    return 2;
  }
  const auto n = static_cast<std::size_t>(std::atof(argv[2]));
  std::puts(table == "radial"
                ? "# cells criterion samples points mean maximum seconds"
                : "# cells samples sites tree_s diagram_s neighbors_s candidates kept");
  for (int i = 3; i < argc; ++i)
    if (table == "radial")
      printDeviations(n, 1, std::atoi(argv[i]));
    else
      printPipeline(n, std::atoi(argv[i]));
  return 0;
}
