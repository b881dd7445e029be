// SPDX-License-Identifier: BSD-3-Clause
// About how many nodes of a lattice it takes to fill gaps.
#include "common/random.h"
#include "common/scalar_field.h"
#include "common/stretch_axes.h"
#include "neighbors/nearest_finder.h"
#include "neighbors/sampling.h"
#include "pipeline/gap_filling.h"
#include "pipeline/gap_widths.h"
#include "pipeline/stretched_edges.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace pcl_uvol::detail {

namespace {

/** Nodes that are looked at. Surfaces of noise are counted up to four times, since the
 * kriged field is smoother than the nearest samples. */
constexpr std::size_t drawn_nodes = std::size_t{1} << 13;

/** Layers of nodes around a surface: those of the cells that it crosses, and of the
 * cells beside them. */
constexpr double layers = 4.0;

/** Nodes of a lattice that a surface runs beside, in the box of the samples.
 *
 * Of nodes at random the share is counted that lie on another side of the isovalue than
 * the next one along an axis: as many edges of the lattice the surface crosses for each
 * of its columns. The side of a node is that of the sample nearest to it.
 * \param values of the samples in leaf order
 * \param spacing in the unit of the samples */
double
countCrossed(const SampleSet& samples,
             const std::vector<double>& values,
             const std::vector<double>& isovalues,
             double spacing)
{
  Eigen::AlignedBox3d box;
  for (const Position& place : samples.getPositions())
    box.extend(Eigen::Vector3d(place[0], place[1], place[2]));
  const Eigen::Array3d low = box.min().array() - hull_tolerance * spacing,
                       sides = box.sizes().array() + 2.0 * hull_tolerance * spacing;
  NearestFinder nearest(samples, 1);
  const auto valueAt = [&](const Eigen::Array3d& place) {
    const Position position{{static_cast<float>(place[0]),
                             static_cast<float>(place[1]),
                             static_cast<float>(place[2])}};
    return values[nearest.find(position, static_cast<float>(spacing)).samples[0]];
  };
  std::size_t crossed = 0;
  for (std::size_t i = 0; i < drawn_nodes; ++i) {
    Eigen::Array3d place;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      place[axis] =
          low[axis] +
          sides[axis] * 0x1p-64 *
              static_cast<double>(mixBits(3 * i + static_cast<std::uint64_t>(axis)));
    const double value = valueAt(place);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      Eigen::Array3d next = place;
      next[axis] += spacing;
      const double beside = valueAt(next);
      crossed += std::any_of(isovalues.begin(), isovalues.end(), [&](double isovalue) {
        return (value > isovalue) != (beside > isovalue);
      });
    }
  }
  const double nodes = (sides / spacing + 1.0).prod();
  return nodes * std::min(1.0, layers * static_cast<double>(crossed) / drawn_nodes);
}

} // namespace

double
estimateGapNodes(const std::shared_ptr<const Dataset>& samples,
                 const IsosurfacePipelineParameters& parameters,
                 unsigned threads)
{
  const IsosurfaceParameters& isosurface = parameters.isosurface;
  const StretchAxes axes(parameters.rotation);
  pcl::PCLPointCloud2::ConstPtr cloud(samples, &samples->cloud);
  if (axes.areTurned()) {
    const auto turned = std::make_shared<pcl::PCLPointCloud2>(*cloud);
    axes.turn(*turned);
    cloud = turned;
  }
  IsosurfaceExtraction<pcl::PCLPointCloud2> extraction;
  extraction.setInputCloud(cloud);
  extraction.setParameters(isosurface);
  extraction.setInterpolation(Interpolation::Linear);
  extraction.setNumberOfThreads(threads);
  pcl::PointCloud<PointIso> roots;
  try {
    extraction.extract(roots);
  }
  catch (const InvalidArgument&) {
    return 0.0; // whoever fills gaps will tell what is wrong
  }
  const CloudView view = viewOf(*cloud);
  std::vector<double> lengths;
  for (const IsoEdge& edge : extraction.getEdges())
    lengths.push_back(stretchedLength(view, edge, isosurface.scale));
  const SampleSet& measured = *extraction.getSamples();
  const double width =
      findGapWidth(summarizeSampling(measured, threads), std::move(lengths));
  if (width == 0.0)
    return 0.0;
  const ScalarField field(view.fields, isosurface.field);
  std::vector<double> values(measured.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = field.read(view.point(measured.getInputIndex(i)));
  const double nodes =
      countCrossed(measured,
                   values,
                   isosurface.isovalues,
                   width / samples_per_gap * measured.getUnit().factor);
  return std::min(static_cast<double>(most_gap_nodes), nodes);
}

} // namespace pcl_uvol::detail
