// SPDX-License-Identifier: BSD-3-Clause
// The points of a surface with their normals: what splats and pictures are made of.
#pragma once

#include "neighbors/sample_set.h"
#include "surface/packed_normal.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Finite, distinct points in leaf order, each with a normal. */
struct OrientedPoints {
  SampleSet::ConstPtr samples;
  std::vector<PackedNormal> normals; ///< per sample
  /** Normals have no meaningful sign: back faces are as good as front faces. */
  bool two_sided = false;
  /** Per sample, in its unit: the length of the edge that an isopoint lies on, infinite
   * where it is not known. Empty for points that are no isopoints. */
  std::vector<float> edge_lengths;
  /** Per sample: the number of its isovalue, in ascending order, which starts again at
   * 0 after 255. Empty for points of one surface. */
  std::vector<std::uint8_t> surfaces;
  /** Per sample: 1 for an isopoint in a gap of the sampling, IsoSupport::Bridged. Empty
   * where there are none. */
  std::vector<std::uint8_t> bridged;
};

/** \brief 1 for the points of a cloud that are isopoints in gaps of the sampling, as
 * their field support tells; empty where there are none. */
PCL_UVOL_EXPORTS std::vector<std::uint8_t>
findBridged(const CloudView& cloud);

/** \brief Take points and normals from a cloud. Points with a non-finite coordinate or
 * without a usable normal are left out and counted as "non_finite" and
 * "without_normal", exact duplicates merged. A cloud that has no normals at all gets
 * estimated ones, which have no meaningful sign, with a warning. The fields
 * edge_length, isovalue and support of a PointIso are read where the cloud has them.
 * \param use indices of the points to take
 * \throws InvalidArgument if no point is left */
PCL_UVOL_EXPORTS OrientedPoints
orientPoints(const CloudView& cloud,
             const std::vector<std::uint32_t>& use,
             unsigned threads,
             Report& report);

} // namespace pcl_uvol
