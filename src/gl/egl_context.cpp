// SPDX-License-Identifier: BSD-3-Clause
#include "gl/headless_context.h"
#include "gl/shared_library.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <algorithm>
#include <cstring>
#include <vector>

namespace pcl_uvol {

namespace {

const char* const egl_advice = "install libegl1 and libegl-mesa0 or the driver of the "
                               "graphics card, or use the cpu backend instead";

/** EGL's functions; those of extensions may be null. */
struct Egl {
  decltype(&::eglGetProcAddress) getProcAddress;
  decltype(&::eglQueryString) queryString;
  decltype(&::eglInitialize) initialize;
  decltype(&::eglBindAPI) bindApi;
  decltype(&::eglChooseConfig) chooseConfig;
  decltype(&::eglCreateContext) createContext;
  decltype(&::eglDestroyContext) destroyContext;
  decltype(&::eglMakeCurrent) makeCurrent;
  decltype(&::eglReleaseThread) releaseThread;
  PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay;
  PFNEGLQUERYDEVICESEXTPROC queryDevices;
  PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString;

  explicit Egl(const SharedLibrary& library)
  {
    library.load("eglGetProcAddress", getProcAddress);
    library.load("eglQueryString", queryString);
    library.load("eglInitialize", initialize);
    library.load("eglBindAPI", bindApi);
    library.load("eglChooseConfig", chooseConfig);
    library.load("eglCreateContext", createContext);
    library.load("eglDestroyContext", destroyContext);
    library.load("eglMakeCurrent", makeCurrent);
    library.load("eglReleaseThread", releaseThread);
    loadExtension("eglGetPlatformDisplayEXT", getPlatformDisplay);
    loadExtension("eglQueryDevicesEXT", queryDevices);
    loadExtension("eglQueryDeviceStringEXT", queryDeviceString);
  }

private:
  template <typename Function>
  void
  loadExtension(const char* name, Function& function) const
  {
    function = reinterpret_cast<Function>(getProcAddress(name));
  }
};

/** \param list names separated by blanks, or null */
bool
hasExtension(const char* list, const std::string& name)
{
  const std::string names = list ? " " + std::string(list) + " " : std::string();
  return names.find(" " + name + " ") != std::string::npos;
}

class EglContext : public HeadlessContext {
public:
  EglContext(EglDevice device, const std::string& library, std::optional<int> card)
      : HeadlessContext("egl")
      , egl_(SharedLibrary({library}, egl_advice))
  {
    run([&] {
      if (!createOn(device, card)) {
        destroy();
        throw GlError("egl_without_context",
                      {{"has_card", card.has_value()},
                       {"card", card.value_or(0)},
                       {"is_hardware", device == EglDevice::Hardware},
                       {"advice", egl_advice}});
      }
    });
  }

  ~EglContext() override
  {
    run([this] { destroy(); });
  }

  Function
  getFunction(const char* name) const override
  {
    return egl_.getProcAddress(name);
  }

private:
  bool
  createOn(EglDevice device, std::optional<int> card)
  {
    if (egl_.getPlatformDisplay == nullptr)
      return false;
    if (card) {
      const auto cards = findCards();
      const auto number = static_cast<std::size_t>(*card);
      return number < cards.size() && createOnCard(cards[number]);
    }
    return (device != EglDevice::Software && createOnHardware()) ||
           (device != EglDevice::Hardware && createWithoutDevice());
  }

  /** All devices but those of software. */
  std::vector<EGLDeviceEXT>
  findCards() const
  {
    if (egl_.queryDevices == nullptr || egl_.queryDeviceString == nullptr)
      return {};
    EGLint count = 0;
    egl_.queryDevices(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count)), cards;
    egl_.queryDevices(count, devices.data(), &count);
    for (EGLDeviceEXT device : devices)
      if (!hasExtension(egl_.queryDeviceString(device, EGL_EXTENSIONS),
                        "EGL_MESA_device_software"))
        cards.push_back(device);
    return cards;
  }

  bool
  createOnCard(EGLDeviceEXT card)
  {
    if (create(EGL_PLATFORM_DEVICE_EXT, card) && isHardware())
      return true;
    destroy();
    return false;
  }

  bool
  createOnHardware()
  {
    const auto cards = findCards();
    return std::any_of(cards.begin(), cards.end(), [this](EGLDeviceEXT card) {
      return createOnCard(card);
    });
  }

  bool
  createWithoutDevice()
  {
    const char* const client = egl_.queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    return hasExtension(client, "EGL_MESA_platform_surfaceless") &&
           create(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
  }

  /** A context on a display, current on this thread; false if that fails. */
  bool
  create(EGLenum platform, void* native_display)
  {
    display_ = egl_.getPlatformDisplay(platform, native_display, nullptr);
    if (display_ == EGL_NO_DISPLAY || !egl_.initialize(display_, nullptr, nullptr) ||
        !egl_.bindApi(EGL_OPENGL_API))
      return false;
    // Surfaces of no kind are asked for; windows would be the default.
    const EGLint wanted[] = {
        EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint configs = 0;
    if (!egl_.chooseConfig(display_, wanted, &config, 1, &configs) || configs == 0)
      return false;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 3,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 3,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    context_ = egl_.createContext(display_, config, EGL_NO_CONTEXT, attributes);
    if (context_ == EGL_NO_CONTEXT ||
        !egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      return false;
    return isUsable();
  }

  bool
  isUsable()
  {
    try {
      identify();
      return true;
    }
    catch (const GlError&) {
      return false;
    }
  }

  /** The display is not terminated: all contexts of the process share it. */
  void
  destroy()
  {
    if (context_ == EGL_NO_CONTEXT)
      return;
    egl_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl_.destroyContext(display_, context_);
    egl_.releaseThread();
    context_ = EGL_NO_CONTEXT;
  }

  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::shared_ptr<GlContext>
createEglContext(EglDevice device, const std::string& library, std::optional<int> card)
{
  return std::make_shared<EglContext>(
      device, library.empty() ? "libEGL.so.1" : library, card);
}

} // namespace pcl_uvol
