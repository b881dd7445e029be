// SPDX-License-Identifier: BSD-3-Clause
// What pictures have in common on the command line, however they are drawn: camera,
// size, background, colours and lights.
#pragma once

#include "render/camera_choice.h"
#include "render/point_colors.h"
#include "shared/color_options.h"
#include "shared/figure_options.h"
#include "shared/options.h"
#include "shared/size_option.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/renderer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace uvol_tools {

/** \brief What several pictures have in common. */
struct SharedView {
  Eigen::AlignedBox3d box; ///< of all surfaces, with their origins added
  /** Values at the ends of the colours; none: no surface has a field. */
  std::optional<std::array<double, 2>> range;
  bool are_categories = true; ///< the values of every surface

  /** \brief Make the range hold that of a scale. */
  void
  extendRange(const pcl_uvol::ColorScale& scale);
};

/** \brief Options of a picture or window. */
class ViewOptions {
public:
  /** What has a size: a window is not printed. */
  enum class SizeOf { Picture, Window };

  /** \brief Camera, culling, size, background, colours. */
  void
  declareScene(Options& options, SizeOf size = SizeOf::Picture);

  /** \brief -exaggerate, for tools that call exaggerate() or getFactors(). */
  void
  declareExaggeration(Options& options);

  /** \brief What explains a picture, for tools that call drawFrames(). */
  void
  declareFigure(Options& options);

  /** \brief -supersample and -dpi. */
  void
  declareResolution(Options& options);

  void
  declareOrbit(Options& options);

  void
  declareLighting(Options& options);

  /** \brief What only some combinations allow, and what must parse: to be called before
   * work whose result would be lost.
   * \param may_have_camera the input may say a place of the camera
   * \throws UsageError */
  void
  check(const Options& options, bool may_have_camera = false);

  /** \brief True if the axes of pictures have factors. */
  bool
  isExaggerated() const
  {
    return !exaggeration_.empty();
  }

  /** \brief The factors of -exaggerate. */
  Eigen::Vector3d
  getFactors() const
  {
    return isExaggerated() ? Eigen::Vector3d(exaggeration_.data())
                           : Eigen::Vector3d::Ones();
  }

  /** \brief Stretch a surface by the factors of -exaggerate: positions, its normals as
   * covectors and lengths of edges by the largest factor. Fields keep their values.
   * \throws InvalidArgument for splats */
  void
  exaggerate(pcl_uvol::Dataset& surface) const;

  /** \brief
   * \param seen what fills the image, unless the camera has its place
   * \param origin what was subtracted from the coordinates of the cloud: places on the
   * command line are meant before that
   * \param cell what the camera draws into
   * \param frame of a full turn */
  pcl_uvol::Camera
  makeCamera(const pcl_uvol::SeenSurface& seen,
             const std::array<double, 3>& origin,
             const PictureCell& cell,
             std::uint64_t frame = 0) const;

  /** \brief False if options say all that pictures of a series would have in common. */
  bool
  sharesView() const
  {
    return eye_.empty() || at_.empty() || !colors_.getRange() ||
           figure_.get().showsBox();
  }

  /** \brief Add a surface to what pictures have in common.
   * \throws InvalidArgument as findColorScale */
  void
  addTo(SharedView& shared, const pcl_uvol::Dataset& surface) const;

  /** \brief From now on the camera sees what pictures have in common, and the colours
   * have one scale, where options do not say which. */
  void
  share(const SharedView& shared)
  {
    shared_ = shared;
  }

  /** \brief A camera with what options say in the place of what it says, one by one.
   * Not for -view.
   * \param origin what was subtracted from its places */
  pcl_uvol::Camera
  adjusted(const Options& options,
           pcl_uvol::Camera camera,
           const std::array<double, 3>& origin) const;

  /** \brief Frames of a full turn; 1 without -orbit. */
  std::uint64_t
  countFrames() const
  {
    return frames_;
  }

  /** \brief A camera that has its place, turned for a frame. */
  pcl_uvol::Camera
  turned(const pcl_uvol::Camera& camera, std::uint64_t frame) const;

  /** \brief Gives the values at the ends of the colours, once a view is drawn. */
  using FindRange = std::function<std::array<double, 2>()>;

  /** \brief Draw and write all frames of a surface, with what explains them.
   * \param surface cloud, and the origin of its coordinates
   * \param report gets the time of writing */
  void
  drawFrames(const Options& options,
             const Subject& surface,
             const Figure::DrawView& draw,
             const FindRange& range,
             const std::string& output,
             pcl_uvol::Report& report) const;

  /** \brief out.png, or out_007.png for a frame of several. */
  std::string
  frameName(const std::string& output, std::uint64_t frame) const;

  /** \brief All of a picture of this size. */
  static PictureCell
  wholePicture(int width, int height)
  {
    return {0, 0, width, height, ""};
  }

  /** \brief What is behind a view: nothing if marks are drawn there afterwards. */
  pcl_uvol::Background
  getBackgroundOfViews() const
  {
    return figure_.get().getBackgroundOfViews(background_);
  }

  /** \brief Compute the field of -color at the points of a surface where it is an
   * expression, see addDerivedField; derivatives are refused. Legends name the labels
   * of these points. */
  void
  addColor(const Options& options, pcl_uvol::Dataset& points, pcl_uvol::Report& report);

  /** \brief The same from samples, for what a surface of them cannot give: derivatives.
   * The surface gets the field with all others.
   * \param periodic see DerivedFieldOptions::periodic */
  void
  addColorOfSamples(const Options& options,
                    pcl_uvol::Dataset& samples,
                    pcl_uvol::Report& report,
                    const std::array<double, 3>& periodic = {});

  /** \brief True if -color can be computed from samples only. */
  bool
  hasColorOfSamples() const;

  /** \brief The field that colours the cloud; "" for one colour. */
  std::string
  colorField(const pcl_uvol::CloudView& cloud) const;

  /** \brief How the field of -color becomes colours. */
  pcl_uvol::ColorMapping
  colorMapping(const pcl_uvol::CloudView& cloud) const;

  /** \brief How a field becomes colours: unasked, labels of names as categories. */
  pcl_uvol::ColorMapping
  mapColors(const pcl_uvol::CloudView& cloud, const std::string& field) const;

  const ColorOptions&
  getColors() const
  {
    return colors_;
  }

  /** \brief True if there is nothing behind the surface, after check(). */
  bool
  isTransparent() const
  {
    return background_.kind == pcl_uvol::Background::Kind::Transparent;
  }

  /** \brief True if what looks away from the eye is left out. */
  bool
  culls() const
  {
    return culls_;
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
    return size_.get().width;
  }

  int
  getHeight() const
  {
    return size_.get().height;
  }
  /** @} */

  /** \brief After check(): how fine pictures are printed; 0: nobody says. */
  double
  getDotsPerInch() const
  {
    return size_.get().dots_per_inch;
  }

  /** \brief In each direction, after check(): in image space, and by ray tracing. @{ */
  int
  getSupersampling() const;

  int
  getRaySupersampling() const
  {
    return std::max(supersampling_, 1);
  }
  /** @} */

  /** \brief After check(). @{ */
  const pcl_uvol::Background&
  getBackground() const
  {
    return background_;
  }

  const pcl_uvol::Material&
  getMaterial() const
  {
    return material_;
  }

  const std::vector<pcl_uvol::Light>&
  getLights() const
  {
    return lights_;
  }
  /** @} */

  const pcl_uvol::LabelNames&
  getLabels() const
  {
    return labels_;
  }

protected:
  /** \brief True if the colours of a picture of this cloud need an explanation. */
  bool
  drawsBar(const pcl_uvol::CloudView& cloud) const;

  /** \brief A surface with the box that pictures have in common, if they have one. */
  Subject
  withSharedBox(Subject surface) const;

private:
  /** Degrees that a frame is turned by. */
  double
  angleOf(std::uint64_t frame) const;

  /** Columns that are left to the surface: its colour bar stands beside it. */
  int
  viewsWidth(const pcl_uvol::CloudView& cloud) const;

  pcl_uvol::Image
  drawFrame(const Subject& surface,
            std::uint64_t frame,
            const Figure::DrawView& draw,
            std::vector<pcl_uvol::ImageText>& texts) const;

  void
  parseBackground();

  void
  parseLights();

  std::string view_ = "iso", background_text_ = "white";
  SizeOption size_{"1024x1024"};
  std::string color_ = "auto", lights_text_;
  pcl_uvol::LabelNames labels_; ///< of the points that are drawn
  ColorOptions colors_;
  FigureOptions figure_;
  std::vector<double> eye_, at_, up_, surface_color_, exaggeration_;
  double fov_ = 30.0, zoom_ = 1.0;
  int supersampling_ = 0;
  std::uint64_t frames_ = 1;
  bool has_bar_ = true, is_parallel_ = false, culls_ = false;
  pcl_uvol::Background background_;
  pcl_uvol::Material material_;
  std::vector<pcl_uvol::Light> lights_ = pcl_uvol::defaultLights();
  std::optional<SharedView> shared_;
};

/** \brief Add isovalues to what a picture tells of itself, if there are any. */
void
addIsovalues(const std::vector<double>& isovalues,
             std::vector<pcl_uvol::ImageText>& texts);

/** \brief The options that give the same view again: -eye, -at, -up and -fov.
 * \param data what is added to coordinates, and divides them */
std::string
describeCamera(const pcl_uvol::Camera& camera, const DataBox& data);

/** \brief The colour that three numbers say.
 * \throws UsageError that names the option unless they lie in [0, 1] */
pcl_uvol::Color
toColor(const std::string& option, const std::vector<double>& numbers);

} // namespace uvol_tools
