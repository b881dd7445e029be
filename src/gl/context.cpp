// SPDX-License-Identifier: BSD-3-Clause
#include "gl/context.h"

#include <GL/glcorearb.h>
#include <algorithm>
#include <array>
#include <utility>

namespace pcl_uvol {

namespace {

/** Version 3.3 as a number. */
constexpr GLint least_version = 33;

/** Parts of the names of renderers that are none of hardware. */
constexpr std::array<const char*, 5> software_renderers = {
    "llvmpipe", "softpipe", "swrast", "SWR", "Software"};

/** A window's context: it is current wherever a task comes from. */
class BorrowedContext : public GlContext {
public:
  BorrowedContext(const std::string& name, FunctionFinder find)
      : GlContext(name)
      , find_(std::move(find))
  {
    identify();
  }

  void
  run(const std::function<void()>& task) override
  {
    task();
  }

  Function
  getFunction(const char* name) const override
  {
    return find_(name);
  }

private:
  FunctionFinder find_;
};

} // namespace

GlContext::GlContext(std::string name)
    : name_(std::move(name))
{
}

bool
GlContext::isHardware() const
{
  return std::none_of(software_renderers.begin(),
                      software_renderers.end(),
                      [this](const char* software) {
                        return renderer_.find(software) != std::string::npos;
                      });
}

void
GlContext::identify()
{
  const auto get_string =
      reinterpret_cast<PFNGLGETSTRINGPROC>(getFunction("glGetString"));
  const auto get_integer =
      reinterpret_cast<PFNGLGETINTEGERVPROC>(getFunction("glGetIntegerv"));
  const auto text = [&](GLenum name) {
    const GLubyte* const answer = get_string ? get_string(name) : nullptr;
    return answer ? std::string(reinterpret_cast<const char*>(answer)) : std::string();
  };
  version_ = text(GL_VERSION);
  renderer_ = text(GL_RENDERER);
  if (version_.empty() || get_integer == nullptr)
    throw GlError("gl_context_silent", {{"context", name_}});
  GLint major = 0, minor = 0;
  get_integer(GL_MAJOR_VERSION, &major);
  get_integer(GL_MINOR_VERSION, &minor);
  if (10 * major + minor < least_version)
    throw GlError("gl_context_too_old", {{"context", name_}, {"version", version_}});
}

std::shared_ptr<GlContext>
createHeadlessContext(const std::string& name, std::optional<int> card)
{
  if (card && name != "egl")
    throw InvalidArgument("gl_card_without_egl", {{"context", name}});
  if (name == "osmesa")
    return createOsMesaContext();
  if (name == "egl")
    return createEglContext(EglDevice::Any, "", card);
  throw InvalidArgument("unknown_gl_context", {{"context", name}});
}

std::shared_ptr<GlContext>
findHardwareContext()
{
  try {
    return createEglContext(EglDevice::Hardware);
  }
  catch (const GlError&) {
    return nullptr;
  }
}

std::shared_ptr<GlContext>
wrapCurrentContext(const std::string& name, const GlContext::FunctionFinder& find)
{
  return std::make_shared<BorrowedContext>(name, find);
}

} // namespace pcl_uvol
