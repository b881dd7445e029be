// SPDX-License-Identifier: BSD-3-Clause
// What explains a picture of a surface: axes, box, directions, lengths, a title, and
// several views side by side.
#pragma once

#include "charts/data_box.h"
#include "render/camera_choice.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief A part of a picture that a camera draws into, in pixels. */
struct PictureCell {
  int left, top, width, height;
  std::string view; ///< the side that it is seen from; "": as the options say
  pcl_uvol::ImageFill fill = {}; ///< by what is drawn
};

/** \brief What a picture is drawn of. */
struct Subject {
  const pcl_uvol::CloudView& cloud;
  pcl_uvol::BoundingSphere bounds;
  std::array<double, 3> origin; ///< of its coordinates
  /** What cameras see and marks show, in its coordinates; none: the cloud. */
  std::optional<Eigen::AlignedBox3d> box = std::nullopt;
  /** Gives the discs that a camera is fitted to, see SeenSurface; none: all points
   * count, and have no discs. */
  std::function<std::vector<pcl_uvol::FittedDisc>(const pcl_uvol::Camera&,
                                                  const PictureCell&)>
      find_discs = nullptr;
};

/** \brief The box around the points of a cloud that have a place.
 * \param counts says whether a point does; none: all do */
Eigen::AlignedBox3d
boxAround(const pcl_uvol::CloudView& cloud,
          const std::function<bool(std::size_t point)>& counts = nullptr);

/** \brief Gives the camera of a view.
 * \param seen what it has to see */
using FindCamera = std::function<pcl_uvol::Camera(const pcl_uvol::SeenSurface& seen,
                                                  const PictureCell& cell)>;

/** \brief The camera that sees a subject, or its box if it has one. */
pcl_uvol::Camera
findCameraOf(const Subject& subject,
             const PictureCell& cell,
             const FindCamera& find_camera);

/** \brief What a picture is drawn on. */
struct Ground {
  pcl_uvol::Background background;
  int width, height; ///< pixels
  int views_width;   ///< of the width, on the left, what is left to the views
  /** Along the axes, that the subject is stretched by. */
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();
  bool turns = false; ///< the cameras turn all around: all frames have one size
  double zoom = 1.0;  ///< of the cameras: nothing is fitted to what they enlarge
};

/** \brief Marks, a title and views of a picture. */
struct Figure {
  bool has_ticks = false, has_box = false, has_triad = false, has_scale_bar = false;
  std::string unit; ///< of the coordinates; "": none
  std::string title;
  std::vector<std::string> views; ///< sides; none: one view, as the options say
  int least_letters = 0;          ///< see letterSize()

  /** \brief True if views and a title have room in a picture of that size. */
  bool
  fits(int width, int height) const;

  /** \brief The background of views: none if marks are drawn there beforehand. */
  pcl_uvol::Background
  getBackgroundOfViews(pcl_uvol::Background background) const;

  /** \brief Draws a view of a size with a camera, on getBackgroundOfViews(). */
  using DrawView = std::function<void(
      const pcl_uvol::Camera& camera, const PictureCell& cell, pcl_uvol::Image& image)>;

  /** \brief Draw all views with their marks. */
  pcl_uvol::Image
  drawViews(const Subject& subject,
            const Ground& ground,
            const FindCamera& find_camera,
            const DrawView& draw) const;

  /** \brief Write the title over the middle of a picture. */
  void
  drawTitle(pcl_uvol::Image& image) const;

  /** \brief True if cameras have to see a box around the surface. */
  bool
  showsBox() const
  {
    return has_ticks || has_box;
  }

private:
  /** True if something lies behind the surface, or beside it. */
  bool
  drawsMarks() const
  {
    return has_ticks || has_box || has_triad || has_scale_bar || views.size() > 1;
  }

  /** The lines of the title over a picture. */
  std::vector<std::string>
  wrapTitle(int width, int height) const;

  /** The parts of a picture.
   * \param views_width of the width, on the left, what is left to them */
  std::vector<PictureCell>
  layOut(int width, int height, int views_width) const;

  /** How letters look in a cell. */
  MarkStyle
  styleOf(const PictureCell& cell, const pcl_uvol::Image& ground) const;

  /** The part of a cell, from its corner, that letters of axes may take: without the
   * strips of other marks. */
  Eigen::AlignedBox2d
  findFreePart(const PictureCell& cell, int font) const;

  /** What may be filled of a cell, so that letters of axes have room beside it. */
  pcl_uvol::ImageFill
  findFill(const Subject& seen,
           const PictureCell& cell,
           const FindCamera& find_camera,
           const DataBox& box,
           const Ground& ground) const;

  /** Write from which side a view is seen. */
  static void
  nameView(pcl_uvol::Image& image,
           const pcl_uvol::Image& ground,
           const PictureCell& cell,
           const MarkStyle& style);

  /** Draw what is behind a surface, or beside it.
   * \param ground the picture before anything was drawn */
  void
  drawBehind(pcl_uvol::Image& image,
             const pcl_uvol::Image& ground,
             const PictureCell& cell,
             const pcl_uvol::Camera& camera,
             const DataBox& box) const;

  /** Draw what lies before it. */
  void
  drawBefore(pcl_uvol::Image& image,
             const pcl_uvol::Image& ground,
             const PictureCell& cell,
             const pcl_uvol::Camera& camera,
             const DataBox& box) const;
};

} // namespace uvol_tools
