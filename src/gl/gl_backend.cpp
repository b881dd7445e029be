// SPDX-License-Identifier: BSD-3-Clause
#include "gl/gl_backend.h"

#include "gl/canvas.h"
#include "gl/errors.h"
#include "gl/image_passes.h"
#include "gl/picture_tiles.h"

#include <algorithm>
#include <optional>

namespace pcl_uvol {

struct GlBackend::Implementation {
  /** What lives in the context. */
  struct Objects {
    explicit Objects(const GlContext& context)
        : gl(context)
        , passes(gl)
    {
    }

    GlFunctions gl;
    ImagePasses passes;
  };

  explicit Implementation(const std::shared_ptr<GlContext>& shared_context)
      : context(shared_context)
  {
    context->run([this] {
      objects.emplace(*context);
      largest_image = findLargestImage(objects->gl);
    });
  }

  ~Implementation()
  {
    context->run([this] { objects.reset(); });
  }

  /** Run a task in the context.
   * \throws GlError if OpenGL complains about it */
  template <typename Task>
  void
  run(const Task& task)
  {
    context->run([&] {
      forgetErrors(objects->gl);
      task(objects->passes);
      checkErrors(objects->gl, "a smaller image or fewer points", "the cpu backend");
    });
  }

  std::shared_ptr<GlContext> context;
  int largest_image = 0; ///< pixels along a side
  std::optional<Objects> objects;
};

GlBackend::GlBackend(const std::shared_ptr<GlContext>& context)
{
  if (!context)
    throw InvalidArgument("gl_backend_without_context", {});
  implementation_ = std::make_unique<Implementation>(context);
  setLargestSide(largest_side_);
}

GlBackend::~GlBackend() = default;

void
GlBackend::setLargestSide(int pixels)
{
  constexpr int least = 256;
  if (pixels < least)
    throw InvalidArgument("gl_tiles_too_small", {{"least", least}});
  largest_side_ = std::min(pixels, implementation_->largest_image);
}

std::string
GlBackend::describe() const
{
  const GlContext& context = *implementation_->context;
  return context.getName() + ", OpenGL " + context.getVersion() + ", " +
         context.getRenderer();
}

void
GlBackend::render(const Frame& frame, Image& image, Report& report)
{
  const View& view = frame.view;
  if (std::max(view.width, view.height) <= largest_side_)
    implementation_->run([&](ImagePasses& passes) {
      passes.draw(frame, report);
      passes.finish(frame, image, report);
    });
  else
    renderTiles(frame, image, report);
}

void
GlBackend::renderTiles(const Frame& frame, Image& image, Report& report)
{
  const View& view = frame.view;
  resizePlanes(frame, image);
  ImageSpaceSettings settings = frame.settings;
  Image drawn;
  for (const PictureTile& tile :
       splitPicture(view.width, view.height, largest_side_, findReach(frame))) {
    const View part = cutView(view, tile.drawn);
    settings.background =
        cutBackground(frame.settings.background, tile.drawn, view.height);
    render({frame.cloud, part, settings, frame.planes, frame.threads}, drawn, report);
    copyTile(tile, drawn, image);
  }
}

void
GlBackend::renderToFramebuffer(const Frame& frame,
                               const GlFramebuffer& target,
                               Report& report)
{
  implementation_->run([&](ImagePasses& passes) {
    passes.draw(frame, report);
    passes.compose(frame, target, report);
  });
}

void
GlBackend::pasteToFramebuffer(const View& view,
                              int factor,
                              const Image& image,
                              const GlFramebuffer& target,
                              Report& report)
{
  implementation_->run(
      [&](ImagePasses& passes) { passes.paste(view, factor, image, target, report); });
}

} // namespace pcl_uvol
