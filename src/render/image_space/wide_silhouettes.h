// SPDX-License-Identifier: BSD-3-Clause
// Silhouettes of pictures that are averaged: lines of any width.
#pragma once

#include "render/image_space/frame.h"

namespace pcl_uvol {

/** \brief Draws as another backend does, and silhouettes in lines that are as wide as
 * those of a picture whose pixels are so many of the frame's. */
class PCL_UVOL_EXPORTS WideSilhouettes : public ImageSpaceBackend {
public:
  /** \param backend draws all but the lines, and outlives this one */
  WideSilhouettes(ImageSpaceBackend& backend, int supersampling)
      : backend_(backend)
      , supersampling_(supersampling)
  {
  }

  std::string
  describe() const override
  {
    return backend_.describe();
  }

  void
  render(const Frame& frame, Image& image, Report& report) override;

private:
  ImageSpaceBackend& backend_;
  int supersampling_;
};

/** \brief Draw a line on the near side of every step in the depths of an image (thesis
 * 4.3.5), which it has.
 * \param width of the line, pixels */
PCL_UVOL_EXPORTS void
drawSilhouettes(const ImageSpaceSettings& settings,
                int width,
                unsigned threads,
                Image& image);

} // namespace pcl_uvol
