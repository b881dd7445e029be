// SPDX-License-Identifier: BSD-3-Clause
// Image-space rendering among the actors of a VTK window, pcl::visualization's
// included.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/parameters.h>
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <pcl/PCLPointCloud2.h>
#include <vtkProp3D.h>
#include <vtkWeakPointer.h>

#include <array>
#include <memory>
#include <string>

class vtkOpenGLRenderWindow;
class vtkRenderer;

namespace pcl_uvol {

class Coarseness;
class CpuBackend;
class GlBackend;
class GlContext;
struct GlFramebuffer;

/** \brief What draws the frames of a window. */
enum class WindowBackend {
  Auto,   ///< OpenGL on a graphics card, else the CPU (default)
  OpenGl, ///< OpenGL, be it software
  Cpu     ///< plain C++; OpenGL only shows its picture
};

/** \return The words for its values in JSON and options. */
constexpr std::array<EnumWord<WindowBackend>, 3>
listWords(WindowBackend)
{
  return {{{WindowBackend::Auto, "auto"},
           {WindowBackend::OpenGl, "gl"},
           {WindowBackend::Cpu, "cpu"}}};
}

/** \brief A surface given as points, drawn by image-space rendering.
 *
 * \code
 * vtkNew<pcl_uvol::ImageSpaceProp> prop;
 * prop->setInputCloud(cloud);
 * renderer->AddViewProp(prop);
 * \endcode
 * It hides and is hidden by other props pixel by pixel, frames itself by its bounds and
 * may be in several windows, of which each change costs an upload. Position,
 * orientation, origin and a scale that is the same along all axes are honoured. Shading
 * takes the lights of the settings, not those of VTK's renderer; anti-aliased borders
 * blend with what was drawn before. Where OpenGL is software the CPU draws, several
 * times as fast. VTK's errors (vtkErrorMacro) report, once each and without an image, a
 * bad cloud or bad settings, another scale, pixels that are not square, a failing
 * OpenGL. Memory of the graphics card as GlBackend. */
class PCL_UVOL_EXPORTS ImageSpaceProp : public vtkProp3D {
public:
  vtkTypeMacro(ImageSpaceProp, vtkProp3D);
  /** \return A new object, to be held by a vtkNew or vtkSmartPointer. */
  static ImageSpaceProp*
  New();

  /** \brief Write the settings, as VTK's classes do.
   * \param out where to
   * \param indent in front of each line */
  void
  PrintSelf(std::ostream& out, vtkIndent indent) override;

  /** \brief The surface: x, y, z as float32, and normals as of ImageSpaceRenderer. It
   * must not change until the next call.
   * \param cloud null (default): nothing is drawn
   * \param prepared of the cloud; null: the first frame prepares it */
  void
  setInputCloud(const pcl::PCLPointCloud2::ConstPtr& cloud,
                const std::shared_ptr<PreparedSurface>& prepared = nullptr);

  /** \brief Settings of the passes, colours, threads, report of the last frame. Camera,
   * size, background and backend are the window's: those of this object are not used.
   * Opacities are: isovalues are then drawn one by one and laid over each other. */
  ImageSpaceRendererBase&
  renderer()
  {
    return renderer_;
  }

  /** \brief What draws from now on; the pictures are the same but for rounding. */
  void
  setBackend(WindowBackend backend)
  {
    choice_ = backend;
    Modified();
  }

  /** \brief Let the CPU draw up to four times as coarsely while the mouse turns the
   * view, if frames take longer than so many milliseconds. Default 20, to which windows
   * add about 5. Infinite: never. */
  void
  setDragTime(double milliseconds);

  /** \brief What drew the last frame, see ImageSpaceBackend::describe; "none" before.
   */
  std::string
  describeBackend() const;

  /** \brief Box around the finite points of the cloud where it is shown; null without
   * any. */
  double*
  GetBounds() override;

  /** \brief Draw into a window, as VTK's renderer asks for.
   * \param viewport the renderer
   * \return 1 where something was drawn, else 0 */
  int
  RenderOpaqueGeometry(vtkViewport* viewport) override;

  /** \return 0: the surface is drawn with what is opaque. */
  vtkTypeBool
  HasTranslucentPolygonalGeometry() override
  {
    return 0;
  }

  /** \brief Free the memory on the graphics card.
   * \param window whose resources they are */
  void
  ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  ImageSpaceProp();
  ~ImageSpaceProp() override;

private:
  ImageSpaceProp(const ImageSpaceProp&) = delete;
  void
  operator=(const ImageSpaceProp&) = delete;

  /** The box of the cloud in its own coordinates. */
  void
  measure();

  void
  draw(vtkRenderer& renderer);

  /** Draw by the CPU what the backend shows. */
  void
  paste(const Frame& frame,
        const GlFramebuffer& target,
        GlBackend& backend,
        Report& report);

  /** The backend in the context of a window, which is current. */
  GlBackend&
  backendFor(vtkOpenGLRenderWindow& window, const std::shared_ptr<GlContext>& context);

  void
  releaseBackend();

  /** Report an error unless it is the last one reported. */
  void
  report(const std::string& message);

  pcl::PCLPointCloud2::ConstPtr cloud_;
  ImageSpaceRenderer<pcl::PCLPointCloud2> renderer_;
  bool measured_ = false;
  double box_[6]; // as VTK's: lower and upper x, y, z
  WindowBackend choice_ = WindowBackend::Auto;
  std::unique_ptr<CpuBackend> cpu_;
  Image image_; // of cpu_, or of what lets light through
  std::unique_ptr<Coarseness> coarseness_;
  int factor_ = 1;         // by which the frame that is drawn is coarser
  bool is_by_cpu_ = false; // the last frame
  std::unique_ptr<GlBackend> backend_;
  vtkWeakPointer<vtkOpenGLRenderWindow> window_; // that backend_ draws in
  std::string reported_;
};

} // namespace pcl_uvol
