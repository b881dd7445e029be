// SPDX-License-Identifier: BSD-3-Clause
// What explains a picture on the command line: axes, box, directions, lengths, a title,
// and several views side by side.
#pragma once

#include "charts/data_box.h"
#include "shared/options.h"
#include <pcl_uvol/render/camera.h>
#include <pcl_uvol/render/image.h>

#include <string>
#include <vector>

namespace uvol_tools {

/** \brief A part of a picture that a camera draws into, in pixels. */
struct PictureCell {
  int left, top, width, height;
  std::string view; ///< the side that it is seen from; "": as the options say
};

/** \brief -ticks, -box, -triad, -scale-bar, -unit, -title and -views. */
class FigureOptions {
public:
  void
  declare(Options& options);

  /** \brief The names of these options. */
  static const std::vector<std::string>&
  names();

  /** \brief What must parse, and fit together and into a picture of that size.
   * \throws UsageError */
  void
  check(const Options& options, int width, int height);

  /** \brief True if something lies behind the surface, which then has to be drawn
   * without a background. */
  bool
  drawsMarks() const
  {
    return has_ticks_ || has_box_ || has_triad_ || has_scale_bar_ || views_.size() > 1;
  }

  /** \brief True if cameras have to see a box around the surface. */
  bool
  hasBox() const
  {
    return has_ticks_ || has_box_;
  }

  /** \brief Part of a view that what is drawn may fill. */
  double
  getFill(const PictureCell& cell) const;

  /** \brief The parts of a picture, of which the columns on the right are taken. */
  std::vector<PictureCell>
  layOut(int width, int height) const;

  /** \brief Draw what is behind a surface, or beside it. */
  void
  drawBehind(pcl_uvol::Image& image,
             const PictureCell& cell,
             const pcl_uvol::Camera& camera,
             const DataBox& box) const;

  /** \brief Draw what lies before it. */
  void
  drawBefore(pcl_uvol::Image& image,
             const PictureCell& cell,
             const pcl_uvol::Camera& camera,
             const DataBox& box) const;

  /** \brief Write the title over the middle of a picture. */
  void
  drawTitle(pcl_uvol::Image& image) const;

  const std::string&
  getUnit() const
  {
    return unit_;
  }

private:
  bool has_ticks_ = false, has_box_ = false, has_triad_ = false, has_scale_bar_ = false;
  std::string title_, unit_, views_text_;
  std::vector<std::string> views_;
};

} // namespace uvol_tools
