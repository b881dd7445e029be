// SPDX-License-Identifier: BSD-3-Clause
// The axes that a space is stretched along where these are not those of the
// coordinates: layers of rock that dip, currents that run askew.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>

#include <Eigen/Core>

namespace pcl_uvol::detail {

/** \brief Three axes at right angles, with x to the east, y to the north and z upwards.
 *
 * They are given as a plane and a line in it, by angles in degrees:
 * - strike: the horizontal direction of the plane, clockwise from the north; the plane
 *   goes down to the right of it;
 * - dip: how steeply the plane goes down, 0 (flat) to 90;
 * - plunge: how steeply the line goes down from the strike, -dip to dip.
 *
 * The second axis is the line, the first one lies in the plane as well, at a right
 * angle to it, on the side that the plane goes down to, and the third one is the normal
 * of the plane, upwards. Without angles they are x, y and z. */
class PCL_UVOL_EXPORTS StretchAxes {
public:
  /** \param rotation strike, dip and plunge
   * \throws InvalidArgument for angles out of their range */
  explicit StretchAxes(const Eigen::Array3d& rotation);

  /** \brief Whether they are others than those of the coordinates. */
  bool
  areTurned() const
  {
    return !rows_.isIdentity(0.0);
  }

  /** \brief The axes, one in each row: takes a vector to its components along them. */
  const Eigen::Matrix3d&
  getRows() const
  {
    return rows_;
  }

  /** \brief The points of a cloud as they are seen along the axes: positions, and
   * normals if there are any, rounded to float. Axes that are not turned give the cloud
   * itself. */
  CloudView
  turn(const CloudView& cloud) const;

  /** \brief The same in place, of a cloud as viewOf() takes it without a copy. */
  void
  turn(pcl::PCLPointCloud2& cloud) const;

  /** \brief Points that are seen along the axes, back to the coordinates. */
  void
  turnBack(pcl::PCLPointCloud2& cloud) const;

private:
  Eigen::Matrix3d rows_;
};

/** \brief A linear map as a rotation and factors along the rotated axes. */
struct PCL_UVOL_EXPORTS Stretch {
  Eigen::Array3f scale{1.0f, 1.0f, 1.0f};
  Eigen::Array3d rotation{0.0, 0.0, 0.0}; ///< see StretchAxes

  /** \brief The rotation and the factors that measure the same lengths as a map of
   * vectors, by its singular values. The factor of an axis is nearest to that axis.
   * \throws InvalidArgument for a map that is not finite, or that leaves a direction
   * without length */
  static Stretch
  ofMap(const Eigen::Matrix3d& map);
};

} // namespace pcl_uvol::detail
