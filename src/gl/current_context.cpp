// SPDX-License-Identifier: BSD-3-Clause
// Which of the ways to OpenGL a context that is current came by: its functions have to
// come by the same one.
#include "gl/context.h"

#include <array>
#include <dlfcn.h>

namespace pcl_uvol {

namespace {

/** A way to OpenGL. */
struct Interface {
  const char* library;      ///< null: what all of the process sees
  const char* get_current;  ///< gives the context that is current, or null
  const char* get_function; ///< gives functions of OpenGL
};

constexpr const char* egl[] = {"eglGetCurrentContext", "eglGetProcAddress"};
constexpr const char* osmesa[] = {"OSMesaGetCurrentContext", "OSMesaGetProcAddress"};
constexpr const char* glx[] = {"glXGetCurrentContext", "glXGetProcAddressARB"};

constexpr std::array<Interface, 8> interfaces = {
    {{"libEGL.so.1", egl[0], egl[1]},
     {"libOSMesa.so.8", osmesa[0], osmesa[1]},
     {"libOSMesa.so.6", osmesa[0], osmesa[1]},
     {"libGL.so.1", glx[0], glx[1]},
     {"libGLX.so.0", glx[0], glx[1]},
     {nullptr, egl[0], egl[1]},
     {nullptr, osmesa[0], osmesa[1]},
     {nullptr, glx[0], glx[1]}}};

/** The function that gives functions, if a context of this interface is current. The
 * library is none that is loaded for that: whoever made the context has it. */
void*
findWayTo(const Interface& interface)
{
  void* const library = dlopen(interface.library, RTLD_LAZY | RTLD_LOCAL | RTLD_NOLOAD);
  if (library == nullptr)
    return nullptr;
  const auto get_current =
      reinterpret_cast<void* (*)()>(dlsym(library, interface.get_current));
  void* const found = get_current != nullptr && get_current() != nullptr
                          ? dlsym(library, interface.get_function)
                          : nullptr;
  dlclose(library);
  return found;
}

} // namespace

std::shared_ptr<GlContext>
wrapCurrentContext(const std::string& name)
{
  for (const Interface& interface : interfaces)
    if (void* const found = findWayTo(interface)) {
      const auto get_function =
          reinterpret_cast<GlContext::Function (*)(const char*)>(found);
      return wrapCurrentContext(name, get_function);
    }
  throw GlError("gl_no_current_context", {{"context", name}});
}

} // namespace pcl_uvol
