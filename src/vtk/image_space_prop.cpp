// SPDX-License-Identifier: BSD-3-Clause
#include "gl/gl_backend.h"
#include "render/image_space/cpu_backend.h"
#include "vtk/coarseness.h"
#include "vtk/scoped_gl_state.h"
#include "vtk/window_view.h"
#include <pcl_uvol/vtk/image_space_prop.h>

#include <vtkBoundingBox.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderer.h>

#include <chrono>
#include <cmath>

namespace pcl_uvol {

namespace {

/** Frames per second: what VTK asks for while nothing moves is far less than one, while
 * the mouse moves something 15. */
constexpr double least_hasty_rate = 1.0;

/** Milliseconds of drawing while a mouse drags: what shows it takes some 5 more. */
constexpr double drag_time = 20.0;

} // namespace

vtkStandardNewMacro(ImageSpaceProp);

ImageSpaceProp::ImageSpaceProp()
    : cpu_(std::make_unique<CpuBackend>())
    , coarseness_(std::make_unique<Coarseness>(drag_time))
{
}

ImageSpaceProp::~ImageSpaceProp()
{
  releaseBackend();
}

void
ImageSpaceProp::PrintSelf(std::ostream& out, vtkIndent indent)
{
  Superclass::PrintSelf(out, indent);
  out << indent << "Points: " << (cloud_ ? cloud_->width * cloud_->height : 0) << '\n';
}

void
ImageSpaceProp::setInputCloud(const pcl::PCLPointCloud2::ConstPtr& cloud,
                              const std::shared_ptr<PreparedSurface>& prepared)
{
  cloud_ = cloud;
  if (cloud) {
    renderer_.setInputCloud(cloud);
    renderer_.setPreparedSurface(prepared);
  }
  measured_ = false;
  reported_.clear();
  Modified();
}

void
ImageSpaceProp::setDragTime(double milliseconds)
{
  coarseness_->setGoal(milliseconds);
}

void
ImageSpaceProp::measure()
{
  if (measured_)
    return;
  const CloudView cloud = viewOf(*cloud_);
  vtkBoundingBox box;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const float* const p = cloud.xyz(i);
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))
      box.AddPoint(p[0], p[1], p[2]);
  }
  box.GetBounds(box_);
  measured_ = true;
}

double*
ImageSpaceProp::GetBounds()
{
  if (!cloud_)
    return nullptr;
  try {
    measure();
  }
  catch (const Exception& error) {
    report(error.message());
    return nullptr;
  }
  const vtkBoundingBox own(box_);
  if (!own.IsValid())
    return nullptr;
  vtkBoundingBox shown;
  for (int corner = 0; corner < 8; ++corner) {
    double p[4] = {0.0, 0.0, 0.0, 1.0};
    own.GetCorner(corner, p);
    GetMatrix()->MultiplyPoint(p, p);
    shown.AddPoint(p);
  }
  shown.GetBounds(Bounds);
  return Bounds;
}

std::string
ImageSpaceProp::describeBackend() const
{
  if (!backend_)
    return "none";
  return is_by_cpu_ ? cpu_->describe() : backend_->describe();
}

int
ImageSpaceProp::RenderOpaqueGeometry(vtkViewport* viewport)
{
  auto* const renderer = vtkRenderer::SafeDownCast(viewport);
  // A selector wants to read what was hit from the colours.
  if (!cloud_ || renderer == nullptr || renderer->GetSelector() != nullptr)
    return 0;
  try {
    draw(*renderer);
    reported_.clear();
    return 1;
  }
  catch (const Exception& error) {
    report(error.message());
  }
  catch (const std::exception& error) {
    report(error.what());
  }
  return 0;
}

void
ImageSpaceProp::draw(vtkRenderer& renderer)
{
  auto* const window = vtkOpenGLRenderWindow::SafeDownCast(renderer.GetRenderWindow());
  if (window == nullptr)
    throw InvalidArgument("no_opengl_window", {});
  WindowView shown = makeWindowView(renderer, *GetMatrix(), renderer_.getBounds());
  const std::shared_ptr<GlContext> context = wrapContext(*window);
  const ScopedGlState drawing(*window, *context);
  GlBackend& backend = backendFor(*window, context);
  shown.target.name = drawing.getFramebuffer();
  is_by_cpu_ = choice_ == WindowBackend::Cpu ||
               (choice_ == WindowBackend::Auto && !context->isHardware());
  factor_ = coarseness_->choose(is_by_cpu_ &&
                                window->GetDesiredUpdateRate() >= least_hasty_rate);
  const auto start = std::chrono::steady_clock::now();
  if (!renderer_.getOpacities().empty()) {
    ImageSpaceBackend& drawing_backend =
        is_by_cpu_ ? static_cast<ImageSpaceBackend&>(*cpu_) : backend;
    renderer_.drawLayers(shown.view.coarser(factor_), drawing_backend, image_);
    Report ignored; // of a frame that is drawn already
    backend.pasteToFramebuffer(shown.view, factor_, image_, shown.target, ignored);
  }
  else
    renderer_.draw(shown.view, [&](const Frame& frame, Report& report) {
      if (is_by_cpu_)
        paste(frame, shown.target, backend, report);
      else
        backend.renderToFramebuffer(frame, shown.target, report);
    });
  coarseness_->addTime(std::chrono::duration<double, std::milli>(
                           std::chrono::steady_clock::now() - start)
                           .count());
}

void
ImageSpaceProp::paste(const Frame& frame,
                      const GlFramebuffer& target,
                      GlBackend& backend,
                      Report& report)
{
  ImageSpaceSettings settings = frame.settings;
  settings.background.kind = Background::Kind::Transparent;
  ImagePlanes planes;
  planes.depth = true;
  const View view = frame.view.coarser(factor_);
  cpu_->render({frame.cloud, view, settings, planes, frame.threads}, image_, report);
  backend.pasteToFramebuffer(frame.view, factor_, image_, target, report);
}

GlBackend&
ImageSpaceProp::backendFor(vtkOpenGLRenderWindow& window,
                           const std::shared_ptr<GlContext>& context)
{
  if (window_ != &window)
    releaseBackend();
  if (!backend_) {
    window.MakeCurrent(); // releasing has made another one current
    backend_ = std::make_unique<GlBackend>(context);
    window_ = &window;
  }
  return *backend_;
}

void
ImageSpaceProp::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window_ == window)
    releaseBackend();
}

void
ImageSpaceProp::releaseBackend()
{
  if (backend_ && window_)
    window_->MakeCurrent();
  backend_.reset();
  window_ = nullptr;
}

void
ImageSpaceProp::report(const std::string& message)
{
  if (message == reported_)
    return;
  reported_ = message;
  vtkErrorMacro(<< message);
}

} // namespace pcl_uvol
