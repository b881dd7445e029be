// SPDX-License-Identifier: BSD-3-Clause
// About how many nodes of a lattice it takes to fill gaps.
#include "common/stretch_axes.h"
#include "neighbors/sampling.h"
#include "pipeline/gap_filling.h"
#include "pipeline/gap_widths.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_uvol::detail {

namespace {

/** Nodes that a surface is followed beyond others, on either side. */
constexpr double band_width = 2.0;

/** Nodes of a surface over the area of the sides of the box, in squares of their
 * spacing, at most: real data and generated ones have up to 0.9. */
constexpr double nodes_per_area = 4.0;

/** The sides of the box around finite points, after scaling. */
Eigen::Array3d
findExtent(const CloudView& cloud, const Eigen::Array3f& scale)
{
  Eigen::AlignedBox3f box;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const Eigen::Map<const Eigen::Vector3f> place(cloud.xyz(i));
    if (place.allFinite())
      box.extend(place);
  }
  if (box.isEmpty())
    return Eigen::Array3d::Zero();
  return box.sizes().cast<double>().array() * scale.cast<double>();
}

} // namespace

double
estimateGapNodes(const CloudView& cloud,
                 const IsosurfacePipelineParameters& parameters,
                 unsigned threads)
{
  const IsosurfaceParameters& isosurface = parameters.isosurface;
  pcl::Indices every(cloud.count);
  std::iota(every.begin(), every.end(), 0);
  SamplingSummary sampling;
  try {
    sampling = summarizeSampling(
        cloud, every, isosurface.field, isosurface.scale, parameters.rotation, threads);
  }
  catch (const InvalidArgument&) {
    return 0.0; // whoever fills gaps will tell what is wrong
  }
  const double width =
      std::isfinite(sampling.across)
          ? static_cast<double>(sampling.across)
          : crossing_edge * static_cast<double>(sampling.along); // gaps are wider
  const Eigen::Array3d sides =
      findExtent(StretchAxes(parameters.rotation).turn(cloud), isosurface.scale) *
          (samples_per_gap / width) +
      2.0 * (hull_tolerance + band_width);
  const double area =
      2.0 * (sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0]);
  return std::min(
      {static_cast<double>(most_gap_nodes),
       sides.prod(),
       nodes_per_area * area * static_cast<double>(isosurface.isovalues.size())});
}

} // namespace pcl_uvol::detail
