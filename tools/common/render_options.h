// SPDX-License-Identifier: BSD-3-Clause
// What the tools that draw pictures have in common: camera, colours and passes on the
// command line.
#pragma once

#include "common/options.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <array>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief Options of a picture, and a renderer set up by them. */
class RenderOptions {
public:
  /** \brief Camera, size, background, colours: what pictures and windows have. */
  void
  declareScene(Options& options);

  /** \brief The same, supersampling and backend. */
  void
  declareView(Options& options);

  /** \brief Every pass with its threshold, lights and material. */
  void
  declarePasses(Options& options);

  /** \brief What only some combinations allow, and what must parse: to be called before
   * work whose result would be lost. \throws UsageError */
  void
  check(const Options& options);

  /** \brief Apply passes, colours and threads to a renderer of this cloud. */
  void
  applyLook(const Options& options,
            const pcl_uvol::CloudView& cloud,
            pcl_uvol::ImageSpaceRendererBase& renderer) const;

  /** \brief Apply everything but the camera. */
  void
  configure(const Options& options,
            const pcl_uvol::CloudView& cloud,
            pcl_uvol::ImageSpaceRendererBase& renderer) const;

  /** \brief \param origin what was subtracted from the coordinates of the cloud: places
   * on the command line are meant before that */
  pcl_uvol::Camera
  makeCamera(const pcl_uvol::BoundingSphere& bounds,
             const std::array<double, 3>& origin) const;

  /** \brief Draw the colour bar of a picture that is coloured by a scalar field. */
  void
  decorate(const pcl_uvol::CloudView& cloud,
           const pcl_uvol::ImageSpaceRendererBase& renderer,
           pcl_uvol::Image& image) const;

  /** \brief The field that colours the cloud; "" for one colour. */
  std::string
  colorField(const pcl_uvol::CloudView& cloud) const;

  pcl_uvol::ColorMap
  colorMap() const
  {
    return pcl_uvol::ColorMap(color_map_);
  }

  /** \brief Values at the ends of the colours; empty: those of the field. */
  const std::vector<double>&
  getRange() const
  {
    return range_;
  }

  /** \brief True if there is nothing behind the surface, after check(). */
  bool
  isTransparent() const
  {
    return settings_.background.kind == pcl_uvol::Background::Kind::Transparent;
  }

  /** \brief True if a colour bar is wanted. */
  bool
  hasBar() const
  {
    return has_bar_;
  }

  /** \brief Pixels. @{ */
  int
  getWidth() const
  {
    return width_;
  }

  int
  getHeight() const
  {
    return height_;
  }
  /** @} */

private:
  void
  parseBackground();

  void
  parseLights();

  std::string view_ = "iso", size_text_ = "1024x1024", background_text_ = "white";
  std::string color_ = "auto", color_map_ = "viridis", smoothing_ = "alleviated";
  std::string backend_ = "auto", lights_text_;
  std::vector<double> eye_, at_, up_, range_, surface_color_, line_color_;
  double fov_ = 30.0;
  int width_ = 0, height_ = 0, supersampling_ = 1;
  bool has_bar_ = true;
  pcl_uvol::ImageSpaceSettings settings_;
};

} // namespace uvol_tools
