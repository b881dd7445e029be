// SPDX-License-Identifier: BSD-3-Clause
#include "gl/headless_context.h"
#include "gl/shared_library.h"

#include <GL/glcorearb.h>
#include <array>

namespace pcl_uvol {

namespace {

// What is used of GL/osmesa.h, which comes with a package that only this would need.
constexpr int osmesa_format = 0x22;
constexpr int osmesa_depth_bits = 0x30;
constexpr int osmesa_profile = 0x33;
constexpr int osmesa_core_profile = 0x34;
constexpr int osmesa_major_version = 0x36;
constexpr int osmesa_minor_version = 0x37;
using OsMesaHandle = struct osmesa_context*;

const char* const osmesa_advice =
    "install libosmesa6, or use the egl or the cpu backend instead";

/** OSMesa's functions. */
struct OsMesa {
  OsMesaHandle (*create)(const int* attributes, OsMesaHandle shared);
  void (*destroy)(OsMesaHandle);
  GLboolean (*makeCurrent)(
      OsMesaHandle, void* buffer, GLenum type, GLsizei width, GLsizei height);
  GlContext::Function (*getFunction)(const char* name);

  explicit OsMesa(const SharedLibrary& library)
  {
    library.load("OSMesaCreateContextAttribs", create);
    library.load("OSMesaDestroyContext", destroy);
    library.load("OSMesaMakeCurrent", makeCurrent);
    library.load("OSMesaGetProcAddress", getFunction);
  }
};

class OsMesaContext : public HeadlessContext {
public:
  explicit OsMesaContext(const std::vector<std::string>& libraries)
      : HeadlessContext("osmesa")
      , osmesa_(SharedLibrary(libraries, osmesa_advice))
  {
    try {
      run([this] { create(); });
    }
    catch (...) {
      run([this] { destroy(); });
      throw;
    }
  }

  ~OsMesaContext() override
  {
    run([this] { destroy(); });
  }

  Function
  getFunction(const char* name) const override
  {
    return osmesa_.getFunction(name);
  }

private:
  void
  create()
  {
    const int attributes[] = {osmesa_format,
                              GL_RGBA,
                              osmesa_depth_bits,
                              0,
                              osmesa_profile,
                              osmesa_core_profile,
                              osmesa_major_version,
                              3,
                              osmesa_minor_version,
                              3,
                              0};
    handle_ = osmesa_.create(attributes, nullptr);
    if (handle_ == nullptr)
      throw GlError("osmesa_without_context", {});
    // A buffer of its own is asked for, although drawing goes to framebuffer objects.
    if (!osmesa_.makeCurrent(handle_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1))
      throw GlError("osmesa_context_refused", {});
    identify();
  }

  void
  destroy()
  {
    if (handle_ == nullptr)
      return;
    osmesa_.makeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    osmesa_.destroy(handle_);
    handle_ = nullptr;
  }

  OsMesa osmesa_;
  OsMesaHandle handle_ = nullptr;
  std::array<unsigned char, 4> pixel_{};
};

} // namespace

std::shared_ptr<GlContext>
createOsMesaContext(const std::string& library)
{
  const std::vector<std::string> known = {
      "libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  return std::make_shared<OsMesaContext>(library.empty() ? known
                                                         : std::vector{library});
}

} // namespace pcl_uvol
