// SPDX-License-Identifier: BSD-3-Clause
// How large the disc of a point must be so that the discs of all points leave no hole.
#pragma once

#include <pcl_uvol/common/report.h>
#include <pcl_uvol/neighbors/sample_set.h>
#include <pcl_uvol/render/surface_cloud.h>

#include <vector>

namespace pcl_uvol {

/** \brief Radius of the disc of every point, in leaf order: the distance to the
 * farthest corner of its Voronoi cell among its neighbours in its tangent plane. Discs
 * of that size, and no smaller ones, cover a plane. Corners at infinity, at the rim of
 * a surface, do not count, and outliers gets at most three times what their nearest
 * neighbour has. \param two_sided normals have no meaningful sign; else points that
 * look to the other side are no neighbours */
std::vector<float>
computeFootprints(const SampleSet& samples,
                  const std::vector<PackedNormal>& normals,
                  bool two_sided,
                  unsigned threads,
                  Report& report);

} // namespace pcl_uvol
