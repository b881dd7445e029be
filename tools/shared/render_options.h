// SPDX-License-Identifier: BSD-3-Clause
// Image-space rendering on the command line: what pictures and windows have in common,
// and every pass.
#pragma once

#include "shared/view_options.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <string>
#include <vector>

namespace uvol_tools {

/** \brief Options of a picture, and a renderer set up by them. */
class RenderOptions : public ViewOptions {
public:
  /** \brief Camera, size, background, colours, supersampling and backend. */
  void
  declareView(Options& options);

  /** \brief -opacity, for tools that call drawCloud() or take getOpacities(). */
  void
  declareOpacity(Options& options);

  /** \brief Every pass with its threshold, lights and material. */
  void
  declarePasses(Options& options);

  /** \brief The names of these passes and thresholds, which rays do not have. */
  static const std::vector<std::string>&
  passNames();

  /** \brief Opacities of the isovalues, the lowest first, or one for all; none: all are
   * opaque. */
  const std::vector<double>&
  getOpacities() const
  {
    return opacities_;
  }

  /** \brief As ViewOptions::check. */
  void
  check(const Options& options);

  /** \brief Apply passes, colours and threads to a renderer of this cloud. */
  void
  applyLook(const Options& options,
            const pcl_uvol::CloudView& cloud,
            pcl_uvol::ImageSpaceRendererBase& renderer) const;

  /** \brief Draw all frames of a surface.
   * \return what they were drawn on */
  std::string
  drawCloud(const Options& options,
            const pcl_uvol::Dataset& surface,
            const std::string& output,
            pcl_uvol::Report& report) const;

  /** \brief Write a surface as a web page that turns in any browser.
   * \throws UsageError for what pages cannot show */
  void
  writePage(const Options& options,
            const pcl_uvol::Dataset& surface,
            const std::string& output,
            pcl_uvol::Report& report) const;

private:
  std::string smoothing_ = "alleviated", backend_ = "auto";
  int card_ = -1; ///< not given
  std::vector<double> line_color_, opacities_;
  pcl_uvol::ImageSpaceSettings settings_;
};

} // namespace uvol_tools
