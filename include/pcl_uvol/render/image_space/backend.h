// SPDX-License-Identifier: BSD-3-Clause
// The door between image-space rendering and what carries out its passes: plain C++ or
// OpenGL (gl/context.h). All give the same picture.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/render/image.h>

#include <string>

namespace pcl_uvol {

struct Frame;

/** \brief Which planes of an image are filled in besides color. */
struct ImagePlanes {
  bool depth = false, normal = false, id = false;
};

/** \brief Carries out the passes. */
class PCL_UVOL_EXPORTS ImageSpaceBackend {
public:
  virtual ~ImageSpaceBackend() = default;

  /** \brief What it runs on: "cpu (avx512)", or context, version and renderer of GL. */
  virtual std::string
  describe() const = 0;

  /** \brief Draw a frame.
   * \param report gets the time of every pass and the counts "background_iterations"
   * and "occluded_iterations"
   * \param frame camera, points and settings
   * \param image gets the pixels */
  virtual void
  render(const Frame& frame, Image& image, Report& report) = 0;
};

} // namespace pcl_uvol
