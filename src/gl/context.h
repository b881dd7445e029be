// SPDX-License-Identifier: BSD-3-Clause
// Where OpenGL runs: off screen through OSMesa or EGL, or in somebody's window. No GL
// types here: whoever draws loads what it needs through getFunction().
#pragma once

#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/common/export.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace pcl_uvol {

/** \brief OpenGL that is missing, too old, or fails. */
class PCL_UVOL_EXPORTS GlError : public Exception {
public:
  using Exception::Exception;
};

/** \brief An OpenGL context of at least version 3.3, core profile.
 *
 * Contexts of our own live on a thread of their own each: a thread can have one current
 * context only, and that of the caller's may be somebody else's. They must go before
 * main() ends, as drivers do not outlive it. */
class PCL_UVOL_EXPORTS GlContext {
public:
  /** \brief Any function of GL, to be cast to its type. */
  using Function = void (*)();
  /** \brief Finds a function of GL by its name; null if there is none. */
  using FunctionFinder = std::function<Function(const char* name)>;

  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext&
  operator=(const GlContext&) = delete;

  /** \brief Execute a task with this context current, and wait for its end. Tasks come
   * from any thread, one runs at a time; an exception of the task reaches the caller.
   * A task may run another one.
   * \param task what to execute */
  virtual void
  run(const std::function<void()>& task) = 0;

  /** \brief Null if there is no such function.
   * \param name of a function of OpenGL, as glDrawArrays */
  virtual Function
  getFunction(const char* name) const = 0;

  /** \brief "osmesa", "egl", or what a window's context was called. */
  const std::string&
  getName() const
  {
    return name_;
  }

  /** \brief As the driver tells it: "4.5 (Core Profile) Mesa 22.3.6". */
  const std::string&
  getVersion() const
  {
    return version_;
  }

  /** \brief As the driver tells it: "llvmpipe (LLVM 15.0.6, 256 bits)". */
  const std::string&
  getRenderer() const
  {
    return renderer_;
  }

  /** \brief Not one of the known software renderers. */
  bool
  isHardware() const;

protected:
  /** \param name what getName() tells */
  explicit GlContext(std::string name);

  /** \brief Ask the current context for its version and renderer.
   * \throws GlError if it is older than 3.3 */
  void
  identify();

private:
  std::string name_, version_, renderer_;
};

/** \brief A context of Mesa's off-screen library.
 * \param library to be loaded; "": libOSMesa of any known version
 * \throws GlError if the library is missing or cannot make a context */
PCL_UVOL_EXPORTS std::shared_ptr<GlContext>
createOsMesaContext(const std::string& library = "");

/** \brief Which of the renderers behind EGL. */
enum class EglDevice {
  Hardware, ///< the first graphics card that works
  Software, ///< Mesa without any device
  Any       ///< hardware, else software
};

/** \brief A context of EGL without window or surface.
 * \param library to be loaded; "": libEGL.so.1
 * \param device which renderer
 * \param card which of several graphics cards, from 0, and nothing else; none: see
 * device
 * \throws GlError if the library is missing or none of these devices has a context */
PCL_UVOL_EXPORTS std::shared_ptr<GlContext>
createEglContext(EglDevice device = EglDevice::Any,
                 const std::string& library = "",
                 std::optional<int> card = std::nullopt);

/** \brief A context by name: "osmesa" or "egl" (a graphics card if there is one).
 * \param name "osmesa" or "egl"
 * \param card see createEglContext
 * \throws InvalidArgument for another name, and a card that is not of EGL; GlError as
 * the above */
PCL_UVOL_EXPORTS std::shared_ptr<GlContext>
createHeadlessContext(const std::string& name, std::optional<int> card = std::nullopt);

/** \brief A context of a graphics card, or null if there is none. */
PCL_UVOL_EXPORTS std::shared_ptr<GlContext>
findHardwareContext();

/** \brief A context that somebody else owns, such as a window's. Tasks run on the
 * calling thread, and the caller sees to it that the context is current there: now, at
 * every use, and when what was made in it is destroyed.
 * \param name what getName() tells
 * \param find gives functions of OpenGL by their names
 * \throws GlError if no context is current or it is too old */
PCL_UVOL_EXPORTS std::shared_ptr<GlContext>
wrapCurrentContext(const std::string& name, const GlContext::FunctionFinder& find);

/** \brief The same for a context of EGL, OSMesa or GLX, whichever is current on this
 * thread.
 * \param name what getName() tells
 * \throws GlError if none is current or it is too old */
PCL_UVOL_EXPORTS std::shared_ptr<GlContext>
wrapCurrentContext(const std::string& name);

} // namespace pcl_uvol
