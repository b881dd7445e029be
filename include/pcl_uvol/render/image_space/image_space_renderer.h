// SPDX-License-Identifier: BSD-3-Clause
// Image-space point-cloud rendering (thesis 4.3): a smooth, lit picture straight from
// points with normals. What takes time before the first frame can be done by threads
// that have it.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/render/image_space/backend.h>
#include <pcl_uvol/render/renderer.h>

#include <pcl/PCLPointCloud2.h>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace pcl_uvol {

class SurfaceCloud;
struct Footprints;

/** \brief A surface that is ready to be drawn: a window takes it from the thread that
 * has made its points, and goes on meanwhile. For one renderer.
 *
 * \code
 * const auto prepared = std::make_shared<pcl_uvol::PreparedSurface>(*cloud); // there
 * prop->setInputCloud(cloud, prepared); // in the window's thread
 * prepared->findFootprints();           // there, while the window draws without
 * \endcode
 */
class PCL_UVOL_EXPORTS PreparedSurface {
public:
  /** \brief Sort the points.
   * \param cloud as of ImageSpaceRenderer
   * \param threads 0 (default) = all cores, here and for footprints
   * \param progress called with the progress of the steps
   * \throws InvalidArgument if there is no point to draw */
  explicit PreparedSurface(const pcl::PCLPointCloud2& cloud,
                           unsigned threads = 0,
                           const ProgressCallback& progress = {});
  PreparedSurface(const PreparedSurface&) = delete;
  PreparedSurface&
  operator=(const PreparedSurface&) = delete;
  ~PreparedSurface();

  /** \brief Find the discs of the points; frames that need them have them from then on.
   * The surface may be drawn meanwhile.
   * \param progress called with the progress of the steps */
  void
  findFootprints(const ProgressCallback& progress = {});

  /** \brief What a camera is fitted to: the discs of the points, of radius NaN for
   * points that are isolated, lie in gaps of the sampling or are not drawn, unless
   * these are most. Finds the discs unless findFootprints() has.
   * \param camera that sees all points
   * \param width of the picture, pixels
   * \param height of the picture, pixels
   * \return none if the points are too dense for discs in that picture */
  const std::vector<FittedDisc>&
  findFittedDiscs(const Camera& camera, int width, int height);

  /** \brief A ball around the points. */
  const BoundingSphere&
  getBounds() const;

private:
  friend class ImageSpaceRendererBase;

  /** Keep footprints that were found until a frame applies them. */
  void
  keepFootprints(std::unique_ptr<Footprints>&& footprints, Report&& report);

  /** Give footprints that were found, and their report, to the surface.
   * \return false if they are not found yet */
  bool
  applyFootprints(Report& report);

  unsigned threads_;
  std::size_t count_; // of the cloud's points
  std::shared_ptr<SurfaceCloud> surface_;
  Report report_; // of the points
  std::mutex mutex_;
  std::unique_ptr<Footprints> footprints_; // that wait to be applied
  std::vector<FittedDisc> fitted_discs_;   // once footprints are found, for good
  Report footprints_report_;
};

class PreparedSurface;
class SurfaceCloud;
struct View;

/** \brief Parameters and the kernel of ImageSpaceRenderer, for any point type.
 *
 * Counts of the report: points, non_finite, without_normal, duplicates; times of every
 * pass. */
class PCL_UVOL_EXPORTS ImageSpaceRendererBase : public Renderer {
public:
  /** \brief Draws a prepared frame, and adds counts and times to the report. */
  using Painter = std::function<void(const Frame& frame, Report& report)>;

  /** \brief Colour by a scalar field, as in ScalarField; "rgb" for the cloud's own
   * colours, "" (default) for the material's. */
  void
  setColorField(const std::string& field)
  {
    color_field_ = field;
    colored_ = false;
  }

  /** \return What setColorField() was given. */
  const std::string&
  getColorField() const
  {
    return color_field_;
  }

  /** \brief Colours that somebody else has made, whatever the field is.
   * \param colors one for each point of the cloud, drawn or not; none (default): those
   * of the field */
  void
  setPointColors(const std::vector<Rgba>& colors)
  {
    point_colors_ = colors;
    colored_ = false;
  }

  /** \brief Default: viridis. */
  void
  setColorMap(const ColorMap& map)
  {
    color_map_ = map;
    colored_ = false;
  }

  /** \return The colour map. */
  const ColorMap&
  getColorMap() const
  {
    return color_map_;
  }

  /** \brief Values of the ends of the colour map; default: those of the field.
   * \param low value of the first colour
   * \param high value of the last colour, >= low */
  void
  setColorRange(double low, double high)
  {
    color_range_ = {low, high};
    colored_ = false;
  }

  /** \brief Colours by the logarithm of the values, which then count above 0 only;
   * default false. */
  void
  setLogarithmicColors(bool is_logarithmic)
  {
    logarithmic_colors_ = is_logarithmic;
    colored_ = false;
  }

  /** \return Whether colours go by the logarithm of the values. */
  bool
  hasLogarithmicColors() const
  {
    return logarithmic_colors_;
  }

  /** \brief Let light through surfaces: each isovalue of the cloud (its field
   * "isovalue") is drawn by itself, of which the nearest layer is seen, and these are
   * laid over each other. Default: none, all surfaces are opaque.
   * \param opacities in [0, 1], of the isovalues in ascending order, or one for all;
   * drawLayers() uses them, draw() does not */
  void
  setOpacities(const std::vector<double>& opacities)
  {
    opacities_ = opacities;
  }

  /** \brief Opacities of the isovalues; none: all surfaces are opaque. */
  const std::vector<double>&
  getOpacities() const
  {
    return opacities_;
  }

  /** \brief Draw all points of the input with this preparation, until the next input.
   * \param prepared of the same cloud; null: each frame prepares the points */
  void
  setPreparedSurface(const std::shared_ptr<PreparedSurface>& prepared);

  /** \brief Do without footprints that are still to be found, by somebody else, rather
   * than let a frame wait for them; default false. */
  void
  setHasty(bool is_hasty)
  {
    is_hasty_ = is_hasty;
  }

  /** \return Whether frames wait for no footprints. */
  bool
  isHasty() const
  {
    return is_hasty_;
  }

  /** \brief Steps and thresholds. */
  ImageSpaceSettings&
  settings()
  {
    return settings_;
  }

  /** \brief Fill in depth, normal or id as well; default: colour alone. */
  void
  setPlanes(const ImagePlanes& planes)
  {
    planes_ = planes;
  }

  /** \return Which planes of a picture are filled in. */
  const ImagePlanes&
  getPlanes() const
  {
    return planes_;
  }

  /** \brief Default: a CpuBackend. */
  void
  setBackend(const std::shared_ptr<ImageSpaceBackend>& backend)
  {
    backend_ = backend;
  }

  /** \brief What the last render() ran on; see ImageSpaceBackend::describe. */
  std::string
  describeBackend() const
  {
    return backend_ ? backend_->describe() : "none";
  }

  /** \brief Range of values of the colours of the last render(). */
  const std::array<double, 2>&
  getColorRange() const
  {
    return used_range_;
  }

protected:
  ImageSpaceRendererBase();
  ~ImageSpaceRendererBase();

  /** \brief ImageSpaceRenderer::render() of any cloud.
   * \param cloud what is drawn
   * \param indices of its points
   * \param image gets the pixels */
  void
  renderFrom(const CloudView& cloud, const pcl::IndicesConstPtr& indices, Image& image);

  /** \brief ImageSpaceRenderer::draw() of any cloud.
   * \param cloud what is drawn
   * \param indices of its points
   * \param view made for findBounds()
   * \param painter called once, with the prepared frame */
  void
  drawFrom(const CloudView& cloud,
           const pcl::IndicesConstPtr& indices,
           const View& view,
           const Painter& painter);

  /** \brief ImageSpaceRenderer::drawLayers() of any cloud.
   * \param cloud what is drawn
   * \param indices of its points
   * \param view made for findBounds()
   * \param backend that draws
   * \param image gets colours and depths */
  void
  renderLayersFrom(const CloudView& cloud,
                   const pcl::IndicesConstPtr& indices,
                   const View& view,
                   ImageSpaceBackend& backend,
                   Image& image);

  /** \brief ImageSpaceRenderer::getBounds() of any cloud.
   * \param cloud what is drawn
   * \param indices of its points */
  BoundingSphere
  findBounds(const CloudView& cloud, const pcl::IndicesConstPtr& indices);

  /** \brief The next frame reads the cloud anew. */
  void
  forgetSurface();

private:
  const SurfaceCloud&
  prepare(const CloudView& cloud, const pcl::IndicesConstPtr& indices);

  void
  colorSurface(const CloudView& cloud);

  /** Colour what is drawn, unless nothing has changed. */
  void
  updateColors(const CloudView& cloud);

  /** One surface for each isovalue. */
  void
  prepareLayers(const CloudView& cloud, const pcl::Indices& indices);

  /** How layers become a picture. */
  struct LayerPicture {
    std::function<View(const BoundingSphere& part)> find_view;
    const ImageSpaceSettings& settings;
    ImageSpaceBackend& backend;
    bool with_depth;
  };

  void
  renderLayers(const CloudView& cloud,
               const pcl::Indices& indices,
               const LayerPicture& picture,
               Image& image);

  void
  findFootprints(SurfaceCloud& surface, const View& view);

  /** Whether all points have the material's colour. */
  bool
  isUniform() const
  {
    return color_field_.empty() && point_colors_.empty();
  }

  std::string color_field_;
  std::vector<Rgba> point_colors_; // instead of those of the field
  ColorMap color_map_;
  std::optional<std::array<double, 2>> color_range_;
  bool logarithmic_colors_ = false;
  std::array<double, 2> used_range_{{0.0, 1.0}};
  ImageSpaceSettings settings_;
  ImagePlanes planes_;
  std::shared_ptr<ImageSpaceBackend> backend_;
  std::vector<double> opacities_;
  std::shared_ptr<SurfaceCloud> surface_;
  std::shared_ptr<PreparedSurface> prepared_; // that surface_ is of; null: its own
  std::vector<std::shared_ptr<SurfaceCloud>> layers_; // by ascending isovalue
  pcl::IndicesConstPtr drawn_;                        // input points behind surface_
  Report surface_report_;                             // what preparing it counted
  bool is_hasty_ = false;
  bool colored_ = false;
  Rgba uniform_color_ = 0; // of surface_ without other colours
  Rgba color_behind_ = 0;  // that bridged isopoints of surface_ are mixed with
  Image fine_;             // for supersampling
};

/** \brief Pictures of a surface given as points.
 *
 * \code
 * pcl_uvol::ImageSpaceRenderer<PointIso> renderer;
 * renderer.setInputCloud(surface);
 * pcl_uvol::Image image;
 * renderer.render(image);
 * \endcode
 * Normals point outwards: points that face away from the eye are not drawn. The cloud
 * is sorted once, further frames reuse it; it, and indices, must not change between.
 * \tparam PointT any registered point type with x, y, z, or pcl::PCLPointCloud2 */
template <typename PointT>
class ImageSpaceRenderer : public CloudStage<PointT>, public ImageSpaceRendererBase {
public:
  using Ptr = std::shared_ptr<ImageSpaceRenderer<PointT>>;
  using ConstPtr = std::shared_ptr<const ImageSpaceRenderer<PointT>>;
  using Cloud = typename CloudStage<PointT>::Cloud;

  /** \brief Draw the cloud.
   * \param image gets the pixels, and the planes that were asked for
   * \throws InvalidArgument for a missing or empty cloud, a cloud without a finite
   * point, a bad camera, size or threshold, an unknown field */
  void
  render(Image& image);

  /** \brief Prepare the cloud and let somebody else draw it, into a window say. Camera,
   * size, supersampling and backend of this object are not used.
   * \param view made for getBounds()
   * \param painter called once, with the prepared frame
   * \throws as render(), and what the painter throws */
  void
  draw(const View& view, const Painter& painter);

  /** \brief Draw what setOpacities() lets light through, for somebody else to show:
   * colours on a transparent ground, and depths of the nearest surfaces. Camera, size,
   * supersampling, background and backend of this object are not used.
   * \param view made for getBounds()
   * \param backend that draws
   * \param image gets the pixels
   * \throws as render() */
  void
  drawLayers(const View& view, ImageSpaceBackend& backend, Image& image);

  /** \brief A ball around what render() draws: for cameras.
   * \throws as render() */
  BoundingSphere
  getBounds();

private:
  void
  forgetInput() override
  {
    forgetSurface();
  }
};

template <typename PointT>
void
ImageSpaceRenderer<PointT>::render(Image& image)
{
  this->withInput("ImageSpaceRenderer",
                  [&](const CloudView& cloud, const pcl::Indices&) {
                    renderFrom(cloud, this->indices_, image);
                  });
}

template <typename PointT>
void
ImageSpaceRenderer<PointT>::draw(const View& view, const Painter& painter)
{
  this->withInput("ImageSpaceRenderer",
                  [&](const CloudView& cloud, const pcl::Indices&) {
                    drawFrom(cloud, this->indices_, view, painter);
                  });
}

template <typename PointT>
void
ImageSpaceRenderer<PointT>::drawLayers(const View& view,
                                       ImageSpaceBackend& backend,
                                       Image& image)
{
  this->withInput("ImageSpaceRenderer",
                  [&](const CloudView& cloud, const pcl::Indices&) {
                    renderLayersFrom(cloud, this->indices_, view, backend, image);
                  });
}

template <typename PointT>
BoundingSphere
ImageSpaceRenderer<PointT>::getBounds()
{
  BoundingSphere bounds;
  this->withInput("ImageSpaceRenderer",
                  [&](const CloudView& cloud, const pcl::Indices&) {
                    bounds = findBounds(cloud, this->indices_);
                  });
  return bounds;
}

} // namespace pcl_uvol
