// SPDX-License-Identifier: BSD-3-Clause
// The camera that users ask for in a few words: from a side, or from a place.
#pragma once

#include "render/camera_fit.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Core>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief What is asked for of a camera. Places are those of coordinates with their
 * origin added. */
struct CameraChoice {
  std::string view = "iso";           ///< one of Camera::viewNames()
  std::optional<Eigen::Vector3d> eye; ///< takes the place of view
  std::optional<Eigen::Vector3d> at;  ///< with eye; none: the centre
  /** None: z, or y for a camera that looks along z. A view turns to it. */
  std::optional<Eigen::Vector3d> up;
  double fov = 30.0; ///< vertical, degrees
  /** Parallel projection; with eye it shows what a field of view of fov would show
   * around the point looked at. */
  bool is_parallel = false;
  double zoom = 1.0; ///< of the middle of the picture
  ImageFill fill;    ///< by a view
  /** The camera turns all around: a view fills the picture from everywhere. */
  bool turns = false;
};

/** \brief What a camera sees. */
struct SeenSurface {
  BoundingSphere bounds;
  /** That fills the picture unless the camera has its place; null: the bounds do. */
  const CloudView* cloud = nullptr;
  /** Gives the discs of the points as a camera sees them; none: all points count, and
   * have no discs. */
  std::function<std::vector<FittedDisc>(const Camera&)> find_discs = nullptr;
};

/** \brief Move a camera to where a surface fills the picture, as fitToPoints() does.
 * The discs of points are found only if they are to be seen: from where all points are.
 * \param aspect width / height
 * \param axis the camera turns all around it: the picture is filled from everywhere */
PCL_UVOL_EXPORTS Camera
fitToSurface(const Camera& camera,
             const SeenSurface& seen,
             double aspect,
             const ImageFill& fill = {},
             const std::optional<Eigen::Vector3d>& axis = std::nullopt);

/** \brief The camera of a choice.
 * \param seen what it is chosen for
 * \param origin what was subtracted from its coordinates
 * \param aspect width / height
 * \throws InvalidArgument for another view, and for an upward direction of no length */
PCL_UVOL_EXPORTS Camera
chooseCamera(const CameraChoice& choice,
             const SeenSurface& seen,
             const std::array<double, 3>& origin,
             double aspect);

/** \brief The camera of a choice turned about the direction that is upwards, which for
 * views is that of all of them: one from the top still looks from there.
 * \param angle degrees */
PCL_UVOL_EXPORTS Camera
orbit(const CameraChoice& choice, Camera camera, double angle);

/** \brief The same camera with the middle of its picture enlarged. */
PCL_UVOL_EXPORTS Camera
zoomed(Camera camera, double zoom);

} // namespace pcl_uvol
