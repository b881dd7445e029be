// SPDX-License-Identifier: BSD-3-Clause
// Samples, values and parameters of any kind: level sets, interpolation, Voronoi grids
// and convex hulls.
#include "pipeline/sample_hull.h"
#include "promises.h"
#include "random_cloud.h"
#include "targets.h"
#include <pcl_uvol/interpolation/field_interpolation.h>
#include <pcl_uvol/levelset/level_set_evolution.h>
#include <pcl_uvol/neighbors/voronoi_diagram.h>

#include <cmath>
#include <numeric>

namespace uvol_fuzz {

namespace {

using Cloud = pcl::PCLPointCloud2;

/** Cells are nearest to their sites, but for what the transform rounds. */
void
requireNearest(const pcl_uvol::VoronoiGrid& grid)
{
  constexpr double rounding = 1.0 + 1e-4;
  const auto& shape = grid.getShape();
  const auto& sites = grid.getSites();
  for (std::uint64_t i = 0; i < shape.size(); ++i) {
    require(grid.getNearest()[i] < sites.size(), "every cell has a site");
    const auto cell = shape.cellOf(i);
    const double distance = shape.distance(cell, sites[grid.getNearest()[i]]);
    for (const auto& site : sites)
      require(distance <= rounding * shape.distance(cell, site), "it is the nearest");
  }
}

} // namespace

void
evolveLevelSet(const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::size_t most_steps = 10; // for speed
  Bytes input(bytes, size);
  pcl_uvol::LevelSetParameters parameters;
  parameters.scheme = chooseOne(input, listWords(pcl_uvol::FitScheme()));
  parameters.flow = chooseOne(input, listWords(pcl_uvol::CurvatureFlow()));
  parameters.bound = chooseOne(input, listWords(pcl_uvol::StepBound()));
  parameters.integration = chooseOne(input, listWords(pcl_uvol::Integration()));
  parameters.reinitialization =
      chooseOne(input, listWords(pcl_uvol::Reinitialization()));
  parameters.max_steps = input.choose(most_steps);
  if (input.flip())
    parameters.mu = input.choose(11) / 10.0;
  parameters.band_width = input.flip() ? 0.0 : 4.0;
  parameters.scale = takeScale(input);
  parameters.isovalue = 0.5 * input.take<std::int8_t>();
  pcl_uvol::LevelSetEvolution<Cloud> evolution;
  const auto cloud = takeCloud(input, sample_fields);
  evolution.setInputCloud(cloud);
  evolution.setParameters(parameters);
  evolution.setNumberOfThreads(1);
  refusalOf([&] {
    std::vector<float> phi;
    evolution.evolve(phi);
    require(phi.size() == cloud->width, "phi has a value per point");
    for (const float value : phi)
      require(!std::isinf(value), "phi is finite or missing");
  });
}

void
interpolateFields(const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::size_t most_queries = 8;
  Bytes input(bytes, size);
  pcl_uvol::InterpolationParameters parameters;
  parameters.model = chooseOne(input, listWords(pcl_uvol::InterpolationModel()));
  parameters.extrapolate = input.flip();
  parameters.kriging.variogram = chooseOne(input, listWords(pcl_uvol::VariogramKind()));
  parameters.kriging.trend = static_cast<int>(input.choose(3));
  parameters.kriging.octants = input.flip();
  parameters.sph.kernel = chooseOne(input, listWords(pcl_uvol::SphKernel()));
  parameters.scale = takeScale(input);
  std::vector<std::array<double, 3>> queries(input.choose(most_queries));
  for (auto& query : queries)
    for (double& coordinate : query)
      coordinate = input.flip() ? input.take<float>() : input.take<std::int8_t>();
  pcl_uvol::FieldInterpolation<Cloud> interpolation;
  interpolation.setInputCloud(takeCloud(input, sample_fields));
  interpolation.setParameters(parameters);
  interpolation.setNumberOfThreads(1);
  refusalOf([&] {
    pcl_uvol::InterpolatedFields fields;
    interpolation.interpolateAt(queries, fields);
    require(fields.size == queries.size() && fields.support.size() == queries.size(),
            "every query is answered");
    for (const double error : fields.errors)
      require(!(error < 0.0), "standard errors are not negative");
  });
}

void
divideSpace(const std::uint8_t* bytes, std::size_t size)
{
  constexpr std::size_t most_cells = 8;
  Bytes input(bytes, size);
  pcl_uvol::VoronoiParameters parameters;
  parameters.cells_x = static_cast<std::uint32_t>(input.choose(most_cells));
  if (input.flip()) {
    parameters.cells_y = static_cast<std::uint32_t>(input.choose(most_cells));
    parameters.cells_z = static_cast<std::uint32_t>(input.choose(most_cells));
  }
  parameters.margin = static_cast<std::uint32_t>(input.choose(2));
  pcl_uvol::VoronoiDiagram<Cloud> diagram;
  const auto cloud = takeCloud(input, sample_fields);
  diagram.setInputCloud(cloud);
  diagram.setParameters(parameters);
  diagram.setNumberOfThreads(1);
  refusalOf([&] {
    const auto grid = diagram.compute();
    requireNearest(*grid);
    require(grid->getMembers().size() == grid->getSites().size(), "sites have members");
    for (const float distance : grid->computeDistances(1))
      require(distance >= 0.0f, "distances are numbers");
    const auto adjacent = grid->findAdjacentRegions(1);
    for (std::size_t site = 0; site < adjacent.size(); ++site)
      for (const std::uint32_t other : adjacent[site])
        require(other < adjacent.size() && other != site,
                "regions are adjacent to others");
  });
}

void
wrapSamples(const std::uint8_t* bytes, std::size_t size)
{
  Bytes input(bytes, size);
  const double tolerance = std::pow(0.5, input.choose(20));
  const auto cloud = takeCloud(input, std::array<const char*, 3>{"x", "y", "z"});
  std::vector<std::uint32_t> all(cloud->width);
  std::iota(all.begin(), all.end(), 0);
  refusalOf([&] {
    pcl_uvol::Report report;
    const auto view = pcl_uvol::viewOf(*cloud);
    const auto samples = pcl_uvol::SampleSet::build(
        view.xyz(0), view.stride(), all, {{1.0f, 1.0f, 1.0f}}, 1, report);
    const auto& tree = samples->getTree();
    const auto box = tree.getBox(tree.getRoot());
    double extent = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      extent = std::max(extent, double(box.high[axis]) - box.low[axis]);
    if (!(extent > 0.0))
      return;
    const pcl_uvol::detail::SampleHull hull(*samples, tolerance * extent);
    for (const auto& position : samples->getPositions())
      require(hull.contains(position), "a hull contains its samples");
  });
}

} // namespace uvol_fuzz
