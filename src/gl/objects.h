// SPDX-License-Identifier: BSD-3-Clause
// Objects of OpenGL that go with their owners. All of it, destructors as well, runs
// with the context current.
#pragma once

#include "gl/functions.h"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace pcl_uvol {

/** \brief The name of an object, which is deleted with it. */
class GlName {
public:
  using Release = void (*)(const GlFunctions& gl, GLuint name);

  GlName() = default;
  GlName(const GlFunctions& gl, GLuint name, Release release)
      : gl_(&gl)
      , name_(name)
      , release_(release)
  {
  }

  GlName(GlName&& other) noexcept
  {
    swap(other);
  }

  GlName&
  operator=(GlName&& other) noexcept
  {
    swap(other);
    return *this;
  }

  ~GlName()
  {
    if (name_ != 0)
      release_(*gl_, name_);
  }

  GLuint
  get() const
  {
    return name_;
  }

private:
  void
  swap(GlName& other) noexcept
  {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    std::swap(release_, other.release_);
  }

  const GlFunctions* gl_ = nullptr;
  GLuint name_ = 0;
  Release release_ = nullptr;
};

GlName
makeBuffer(const GlFunctions& gl);

GlName
makeVertexArray(const GlFunctions& gl);

/** \brief A texture that is sampled texel by texel: a rectangle, as software OpenGL is
 * half as fast at texelFetch().
 *
 * \param texels row by row: of GL_RGBA8 bytes, of integers unsigned ints, else floats;
 * null: it is not filled */
GlName
makeTexture(const GlFunctions& gl,
            GLenum format,
            int width,
            int height,
            const void* texels = nullptr);

/** \brief A texture over the bytes of a buffer. */
GlName
makeBufferTexture(const GlFunctions& gl, GLenum format, const GlName& buffer);

/** \brief Numbers that a shader reads four by four from a texture. */
class NumberTable {
public:
  NumberTable() = default;

  /** \param numbers a multiple of four, or none */
  NumberTable(const GlFunctions& gl, std::vector<float> numbers);

  const GlName&
  getTexture() const
  {
    return texture_;
  }

private:
  GlName buffer_, texture_;
};

/** \param colors attached in this order
 * \param depth may be empty
 * \throws GlError if the driver cannot draw into them */
GlName
makeFramebuffer(const GlFunctions& gl,
                std::initializer_list<const GlName*> colors,
                const GlName* depth = nullptr);

/** \brief A linked program and its uniforms, by name. Those that the linker has left
 * out are passed over. */
class Program {
public:
  /** \throws GlError with the compiler's words */
  Program(const GlFunctions& gl,
          const std::string& vertex,
          const std::string& fragment);

  void
  use() const
  {
    gl_->UseProgram(name_.get());
  }

  // To be called after use().
  void
  set(const char* uniform, int value) const
  {
    gl_->Uniform1i(find(uniform), value);
  }

  void
  set(const char* uniform, double value) const
  {
    gl_->Uniform1f(find(uniform), static_cast<float>(value));
  }

  void
  set(const char* uniform, float x, float y) const
  {
    gl_->Uniform2f(find(uniform), x, y);
  }

  void
  set(const char* uniform, float x, float y, float z) const
  {
    gl_->Uniform3f(find(uniform), x, y, z);
  }

  void
  set(const char* uniform, float x, float y, float z, float w) const
  {
    gl_->Uniform4f(find(uniform), x, y, z, w);
  }

  /** \param matrix 9 numbers, row by row */
  void
  setMatrix(const char* uniform, const float* matrix) const
  {
    gl_->UniformMatrix3fv(find(uniform), 1, GL_TRUE, matrix);
  }

  /** \brief Let a sampler read a texture through a unit of its own. */
  void
  setTexture(const char* uniform,
             int unit,
             const GlName& texture,
             GLenum target = GL_TEXTURE_RECTANGLE) const
  {
    gl_->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_->BindTexture(target, texture.get());
    set(uniform, unit);
  }

private:
  GLint
  find(const char* uniform) const
  {
    return gl_->GetUniformLocation(name_.get(), uniform);
  }

  const GlFunctions* gl_;
  GlName name_;
};

} // namespace pcl_uvol
