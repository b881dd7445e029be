// SPDX-License-Identifier: BSD-3-Clause
// How many natural neighbours the kd-tree and the discrete Voronoi diagram miss, how
// many they take that are none, and what that does to the surfaces of real samples.
#include "data_cases.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/neighbors/natural_neighbors.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace pcl_uvol;
using uvol_benchmark::DataCase;

/** A way to find neighbours. */
struct Way {
  const char* name;
  NeighborSource source;
  AngleCriterion criterion;
  bool has_surface; ///< it is one that surfaces are made by
};

/** The first is the truth; candidates are what the angle criterion chooses from. */
const Way ways[] = {
    {"exact", NeighborSource::Exact, AngleCriterion::None, true},
    {"kd-tree, candidates", NeighborSource::KdTree, AngleCriterion::None, false},
    {"kd-tree", NeighborSource::KdTree, AngleCriterion::Kept, true},
    {"voronoi, candidates", NeighborSource::Voronoi, AngleCriterion::None, false},
    {"voronoi", NeighborSource::Voronoi, AngleCriterion::Kept, true}};

/** Pairs of samples that are neighbours of either, each once, ascending. */
std::vector<std::pair<int, int>>
findPairs(const DataCase& data, const CloudView& cloud, const Way& way)
{
  pcl::PointCloud<pcl::PointXYZ> stretched;
  for (std::size_t i = 0; i < cloud.count; ++i)
    stretched.emplace_back(data.scale[0] * cloud.xyz(i)[0],
                           data.scale[1] * cloud.xyz(i)[1],
                           data.scale[2] * cloud.xyz(i)[2]);
  pcl::Indices all(cloud.count);
  std::iota(all.begin(), all.end(), 0);
  NaturalNeighborParameters parameters;
  parameters.source = way.source;
  parameters.criterion = way.criterion;
  Report report;
  const NeighborGraph graph =
      detail::computeNaturalNeighbors(viewOf(stretched), all, parameters, 0, report);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const std::uint32_t j : graph[i])
      pairs.push_back(std::minmax(static_cast<int>(i), static_cast<int>(j)));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

double
percent(std::size_t part, std::size_t all)
{
  return all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 0.0;
}

/** The surface by the way's neighbours, and how it does at samples left out. */
void
printSurface(const DataCase& data,
             const std::shared_ptr<Dataset>& samples,
             const Way& way,
             std::size_t folds)
{
  const CloudView cloud = viewOf(samples->cloud);
  IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = data.field.empty() ? "intensity" : data.field;
  parameters.isosurface.isovalues = {data.isovalue};
  parameters.isosurface.scale = data.scale;
  parameters.isosurface.neighbors = way.source;
  parameters.isosurface.criterion = way.criterion;
  parameters.validation.folds = folds;
  parameters.validation.by =
      data.by == "random" ? ValidateBy::Random : ValidateBy::Field;
  parameters.validation.field = data.by;
  IsosurfacePipeline pipeline;
  pipeline.setInput(samples);
  pipeline.setParameters(parameters);
  const IsosurfaceResult result = pipeline.run();
  const ValidationScore& score = result.validation.front();
  std::printf(" %zu | %.1f | %.1f |",
              result.isopoints.front(),
              100.0 * score.side.predicted,
              100.0 * score.side_everywhere);
}

void
printCase(DataCase data, std::size_t folds)
{
  const auto samples = uvol_benchmark::load(data);
  const CloudView cloud = viewOf(samples->cloud);
  data.scale = uvol_benchmark::findScale(data, cloud);
  const auto exact = findPairs(data, cloud, ways[0]);
  for (const Way& way : ways) {
    std::vector<std::pair<int, int>> pairs;
    try {
      pairs = findPairs(data, cloud, way);
    }
    catch (const InvalidArgument& refusal) {
      // Samples that crowd in few cells of a grid are refused by the Voronoi diagram.
      std::printf("| %s, %s %g | %s | refused | | | | | |\n",
                  data.file.c_str(),
                  data.field.c_str(),
                  data.isovalue,
                  way.name);
      continue;
    }
    std::vector<std::pair<int, int>> common;
    std::set_intersection(pairs.begin(),
                          pairs.end(),
                          exact.begin(),
                          exact.end(),
                          std::back_inserter(common));
    std::printf("| %s, %s %g | %s | %.1f | %.1f | %.1f |",
                data.file.c_str(),
                data.field.c_str(),
                data.isovalue,
                way.name,
                2.0 * static_cast<double>(pairs.size()) /
                    static_cast<double>(cloud.count),
                percent(exact.size() - common.size(), exact.size()),
                percent(pairs.size() - common.size(), pairs.size()));
    if (way.has_surface)
      printSurface(data, samples, way, folds);
    else
      std::printf(" | | |");
    std::printf("\n");
    std::fflush(stdout);
  }
}

} // namespace

/** missed_neighbors [FOLDS [PART OF A FILE'S NAME]] */
int
main(int argc, char** argv)
{
  const std::size_t folds = argc > 1 ? std::stoul(argv[1]) : 5;
  const std::string part = argc > 2 ? argv[2] : "";
  std::printf(
      "| samples and isovalue | neighbours | per sample | natural ones missed, %% | "
      "others taken, %% | isopoints | right side near the surface, %% | "
      "everywhere, %% |\n|---|---|---|---|---|---|---|---|\n");
  for (const DataCase& data : uvol_benchmark::listCases())
    if (data.file.find(part) != std::string::npos)
      printCase(data, folds);
  return 0;
}
