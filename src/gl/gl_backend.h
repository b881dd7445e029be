// SPDX-License-Identifier: BSD-3-Clause
// Image-space rendering in OpenGL 3.3: off screen into an image, or into a window.
#pragma once

#include "gl/context.h"
#include "render/image_space/frame.h"

#include <memory>
#include <string>

namespace pcl_uvol {

/** \brief A framebuffer of somebody else's, and what his camera does to depths. */
struct GlFramebuffer {
  unsigned name = 0; ///< of OpenGL; 0 is the window itself
  int x = 0, y = 0;  ///< of the lower left corner of the image in it, pixels
  /** From camera space (View: x right, y down, z forward) to clip space, row by row.
   * Its rows for z and w give the depth of a pixel; places come from the View. */
  float projection[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

/** \brief Keeps the last cloud and the textures of the last size on the graphics card:
 * 20 bytes per point, 32 with footprints; 42 per pixel, and 32 more each for normals or
 * feature lines and for footprints. Larger pictures are drawn in tiles. All members may
 * be called from any thread that the context can be used from, one at a time. */
class PCL_UVOL_EXPORTS GlBackend : public ImageSpaceBackend {
public:
  /** \throws GlError if the context lacks a function, InvalidArgument without one */
  explicit GlBackend(const std::shared_ptr<GlContext>& context);
  ~GlBackend() override;
  GlBackend(const GlBackend&) = delete;
  GlBackend&
  operator=(const GlBackend&) = delete;

  /** \brief "osmesa, OpenGL 4.5 (Core Profile) Mesa 22.3.6, llvmpipe (...)". */
  std::string
  describe() const override;

  /** \brief Draw pictures in tiles whose sides have at most so many pixels.
   * \param pixels at least 256; default 4096, for which 2 GB of textures do. No more
   * than OpenGL can draw are taken.
   * \throws InvalidArgument for fewer */
  void
  setLargestSide(int pixels);

  /** \throws GlError if a cloud has too many points for a texture, or the driver fails
   */
  void
  render(const Frame& frame, Image& image, Report& report) override;

  /** \brief Draw a frame over what a framebuffer holds already, hidden by what is
   * nearer. The settings' background and the planes of the frame have no meaning here.
   * Most of the state of OpenGL is different afterwards: save and restore what you
   * need.
   * \throws as render(), and GlError if the image is too large for OpenGL */
  void
  renderToFramebuffer(const Frame& frame, const GlFramebuffer& target, Report& report);

  /** \brief Draw an image over what a framebuffer holds already, as
   * renderToFramebuffer() does: where OpenGL is software, another backend is faster.
   * \param image with depths, on a transparent background
   * \param view that it was made for, View::coarser() by a factor
   * \throws as render() */
  void
  pasteToFramebuffer(const View& view,
                     int factor,
                     const Image& image,
                     const GlFramebuffer& target,
                     Report& report);

private:
  void
  renderTiles(const Frame& frame, Image& image, Report& report);

  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
  int largest_side_ = 4096;
};

} // namespace pcl_uvol
