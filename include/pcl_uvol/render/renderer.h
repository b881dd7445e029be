// SPDX-License-Identifier: BSD-3-Clause
// What the renderers have in common: the pinhole camera, and pictures in memory.
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief A ball around what is to be seen, in units of the cloud. */
struct BoundingSphere {
  Eigen::Vector3d center{0.0, 0.0, 0.0};
  double radius = 0.0;
};

/** \brief Clouds are drawn in their own unit of length, which is 1, but for those whose
 * radius is beyond 2^-20 to 2^20: a power of two brings it near 1, so that squares of
 * lengths are numbers in float.
 * \param bounds of the cloud */
PCL_UVOL_EXPORTS double
chooseLengthUnit(const BoundingSphere& bounds);

/** \brief The disc of a point, as cameras are fitted to it. */
struct FittedDisc {
  float radius;                ///< NaN: the point does not count
  std::array<float, 3> normal; ///< of length 1
};

/** \brief Perspective projection from a point, in the coordinates of the cloud.
 *
 * Parallel projection is that from far away: in a picture of 1024 pixels that an object
 * fills with the field of view parallel_fov, none of its points is more than 0.3 pixels
 * off. */
struct PCL_UVOL_EXPORTS Camera {
  /** A vertical field of view, in degrees, that shows no perspective. */
  static constexpr double parallel_fov = 0.05;

  Eigen::Vector3d eye{0.0, 0.0, 1.0};
  Eigen::Vector3d at{0.0, 0.0, 0.0}; ///< looked at: the centre of the image
  Eigen::Vector3d up{0.0, 1.0, 0.0}; ///< upwards in the image, of any length
  double vertical_fov = 30.0;        ///< degrees, in (0, 180)

  /** \brief Right, down, forward: orthonormal rows of the rotation from the cloud's to
   * the camera's directions.
   * \throws InvalidArgument for non-finite numbers, eye = at, up along the line of
   * sight, or a field of view outside (0, 180) */
  Eigen::Matrix3d
  rotation() const;

  /** \brief Look at the centre of a sphere from a direction, so far away that the
   * sphere fills that part of the image's smaller side.
   * \param from towards the eye, of any length
   * \param aspect width / height
   * \param fill in (0, 1]
   * \param sphere what shall be seen
   * \param up direction that is upwards in the image, not along from
   * \param vertical_fov field of view in degrees, in (0, 180) */
  static Camera
  fit(const BoundingSphere& sphere,
      const Eigen::Vector3d& from,
      const Eigen::Vector3d& up,
      double vertical_fov,
      double aspect,
      double fill = 0.9);

  /** \brief A camera by the name of its side: front, back, left, right, top, bottom,
   * iso (from the front, the right and above). x points to the right of the front view,
   * z upwards.
   * \param sphere what shall be seen
   * \param view name of the side
   * \param vertical_fov field of view in degrees, in (0, 180)
   * \param aspect width / height
   * \param fill part of the smaller side of the image, in (0, 1]
   * \throws InvalidArgument for another name */
  static Camera
  fit(const BoundingSphere& sphere,
      const std::string& view,
      double vertical_fov,
      double aspect,
      double fill = 0.9);

  /** \brief The names of the sides. */
  static const std::vector<std::string>&
  viewNames();

  /** \brief The same view by parallel projection: objects near the centre of the view
   * keep their size. */
  Camera
  parallel() const;

  /** \brief Turned about the upward axis through the point looked at.
   * \param angle degrees, counter-clockwise as seen from above */
  Camera
  orbited(double angle) const;
};

/** \brief Pixels row by row, the first row on top. Planes that were not asked for are
 * empty. */
struct Image {
  /** In id: no point is seen there. */
  static constexpr std::uint32_t background = 0xffffffff;

  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> color; ///< red, green, blue, opacity (not premultiplied)
  std::vector<float> depth;        ///< distance to the eye / far distance; background 1
  std::vector<float> normal;       ///< x, y, z; background 0
  std::vector<std::uint32_t> id;   ///< index of the point in the input cloud

  /** \return The number of pixels. */
  std::size_t
  pixels() const
  {
    return static_cast<std::size_t>(width) * height;
  }
};

/** \brief Base of the renderers. */
class PCL_UVOL_EXPORTS Renderer : public Stage {
public:
  static constexpr int largest_size = 16384; ///< of a picture's sides, in pixels

  /** \brief Default: from the front and above ("iso"), everything in view. */
  void
  setCamera(const Camera& camera)
  {
    camera_ = camera;
  }

  /** \return The camera that was set; none: the default one. */
  const std::optional<Camera>&
  getCamera() const
  {
    return camera_;
  }

  /** \brief Pixels, each in [1, largest_size], somewhat less in image space; default
   * 1024 x 1024.
   * \param width from left to right
   * \param height from top to bottom */
  void
  setSize(int width, int height)
  {
    width_ = width;
    height_ = height;
  }

  /** \brief Sample the picture that many times finer in each direction, and average:
   * in [1, 8], default 1. */
  void
  setSupersampling(int factor)
  {
    supersampling_ = factor;
  }

  /** \return The width of the picture in pixels. */
  int
  getWidth() const
  {
    return width_;
  }

  /** \return The height of the picture in pixels. */
  int
  getHeight() const
  {
    return height_;
  }

  /** \return How many times finer each direction is sampled. */
  int
  getSupersampling() const
  {
    return supersampling_;
  }

protected:
  Renderer() = default;
  ~Renderer() = default;

  /** \throws InvalidArgument for a size, or supersampling, out of its range
   * \param largest pixels along a side */
  void
  checkPictureSize(int largest) const;

  /** \brief The camera that was set, else the default one.
   * \param bounds of what is drawn */
  Camera
  cameraFor(const BoundingSphere& bounds) const;

  int width_ = 1024, height_ = 1024, supersampling_ = 1;

private:
  std::optional<Camera> camera_;
};

} // namespace pcl_uvol
