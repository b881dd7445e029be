// SPDX-License-Identifier: BSD-3-Clause
// What the renderers have in common: camera and size of the picture.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/camera.h>

#include <optional>

namespace pcl_uvol {

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
