// SPDX-License-Identifier: BSD-3-Clause
// Samples that lie denser along one direction than along others: slices, stretched
// cells, layers that grow from a wall.
#pragma once

#include "support/smooth_fields.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <string>

namespace uvol_test {

/** \brief A lattice of spacing 1 about the origin of an index space, moved by a smooth
 * map into space. The field is as smooth as the samples are dense: it is a function of
 * the index space, where deviations are measured, in spacings. */
struct StretchedSamples {
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> to_space, to_index;
  double jitter = 0.0; ///< part of a spacing, to both sides, that samples are moved by

  /** \brief side^3 samples of a field, at positions in single precision. */
  pcl::PointCloud<pcl::PointXYZI>::Ptr
  sample(const SmoothField& field, int side, std::uint64_t seed) const;

  /** \brief Isopoints in the index space: their positions alone. */
  pcl::PointCloud<pcl_uvol::PointIso>
  inIndexSpace(const pcl::PointCloud<pcl_uvol::PointIso>& surface) const;
};

/** \brief Cells of 1 : 1 : ratio.
 * \param shape "lattice", along the axes; "rotated", along none of them; "wall", layers
 * that grow by 1.25 from a thickness of 1 / ratio on up to 1, halfway up; "curved",
 * such layers around a cylinder; "jittered", a lattice each sample of which lies
 * anywhere in its cell; "shaken", the same within a tenth of it
 * \param side samples along each axis */
StretchedSamples
makeStretchedSamples(const std::string& shape, double ratio, int side);

} // namespace uvol_test
