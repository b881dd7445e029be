// SPDX-License-Identifier: BSD-3-Clause
#include "gl/objects.h"

#include <vector>

namespace pcl_uvol {

namespace {

/** What the compiler or the linker has to say. */
template <typename GetParameter, typename GetLog>
std::string
readLog(GLuint object, GetParameter get_parameter, GetLog get_log)
{
  GLint length = 0;
  get_parameter(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  get_log(object, length, nullptr, log.data());
  return log;
}

/** A name that GL gives out and takes back by two functions such as GenBuffers and
 * DeleteBuffers. */
template <auto generate, auto release>
GlName
makeName(const GlFunctions& gl)
{
  GLuint name = 0;
  (gl.*generate)(1, &name);
  return {gl, name, [](const GlFunctions& functions, GLuint given) {
            (functions.*release)(1, &given);
          }};
}

GlName
makeTextureName(const GlFunctions& gl)
{
  return makeName<&GlFunctions::GenTextures, &GlFunctions::DeleteTextures>(gl);
}

GlName
compile(const GlFunctions& gl, GLenum kind, const std::string& source)
{
  GlName shader(
      gl, gl.CreateShader(kind), [](const GlFunctions& functions, GLuint name) {
        functions.DeleteShader(name);
      });
  const char* const text = source.c_str();
  gl.ShaderSource(shader.get(), 1, &text, nullptr);
  gl.CompileShader(shader.get());
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader.get(), GL_COMPILE_STATUS, &compiled);
  if (compiled != GL_TRUE)
    throw GlError(
        "gl_shader_not_compiled",
        {{"log", readLog(shader.get(), gl.GetShaderiv, gl.GetShaderInfoLog)}});
  return shader;
}

/** Any kind of pixels that a texture of this format may be made from. */
GLenum
transferFormat(GLenum format)
{
  switch (format) {
  case GL_RG32UI:
    return GL_RG_INTEGER;
  case GL_R8UI:
    return GL_RED_INTEGER;
  case GL_R32F:
    return GL_RED;
  case GL_DEPTH_COMPONENT32F:
    return GL_DEPTH_COMPONENT;
  default:
    return GL_RGBA;
  }
}

} // namespace

GlName
makeBuffer(const GlFunctions& gl)
{
  return makeName<&GlFunctions::GenBuffers, &GlFunctions::DeleteBuffers>(gl);
}

GlName
makeVertexArray(const GlFunctions& gl)
{
  return makeName<&GlFunctions::GenVertexArrays, &GlFunctions::DeleteVertexArrays>(gl);
}

GlName
makeTexture(
    const GlFunctions& gl, GLenum format, int width, int height, const void* texels)
{
  GlName texture = makeTextureName(gl);
  const GLenum transfer = transferFormat(format);
  const bool is_integer = transfer == GL_RG_INTEGER || transfer == GL_RED_INTEGER;
  const GLenum type = is_integer           ? GL_UNSIGNED_INT
                      : format == GL_RGBA8 ? GL_UNSIGNED_BYTE
                                           : GL_FLOAT;
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_RECTANGLE, texture.get());
  gl.TexImage2D(GL_TEXTURE_RECTANGLE,
                0,
                static_cast<GLint>(format),
                width,
                height,
                0,
                transfer,
                type,
                texels);
  gl.TexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_RECTANGLE, GL_TEXTURE_MAX_LEVEL, 0);
  return texture;
}

GlName
makeBufferTexture(const GlFunctions& gl, GLenum format, const GlName& buffer)
{
  GlName texture = makeTextureName(gl);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_BUFFER, texture.get());
  gl.TexBuffer(GL_TEXTURE_BUFFER, format, buffer.get());
  return texture;
}

NumberTable::NumberTable(const GlFunctions& gl, std::vector<float> numbers)
    : buffer_(makeBuffer(gl))
{
  numbers.resize(std::max<std::size_t>(numbers.size(), 4)); // none may be empty
  gl.BindBuffer(GL_TEXTURE_BUFFER, buffer_.get());
  gl.BufferData(GL_TEXTURE_BUFFER,
                static_cast<GLsizeiptr>(numbers.size() * sizeof(float)),
                numbers.data(),
                GL_STREAM_DRAW);
  texture_ = makeBufferTexture(gl, GL_RGBA32F, buffer_);
}

GlName
makeFramebuffer(const GlFunctions& gl,
                std::initializer_list<const GlName*> colors,
                const GlName* depth)
{
  GlName framebuffer =
      makeName<&GlFunctions::GenFramebuffers, &GlFunctions::DeleteFramebuffers>(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  GLenum attachment = GL_COLOR_ATTACHMENT0;
  for (const GlName* color : colors)
    gl.FramebufferTexture2D(
        GL_FRAMEBUFFER, attachment++, GL_TEXTURE_RECTANGLE, color->get(), 0);
  if (depth != nullptr)
    gl.FramebufferTexture2D(
        GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_RECTANGLE, depth->get(), 0);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw GlError("gl_buffers_refused", {});
  return framebuffer;
}

Program::Program(const GlFunctions& gl,
                 const std::string& vertex,
                 const std::string& fragment)
    : gl_(&gl)
    , name_(gl, gl.CreateProgram(), [](const GlFunctions& functions, GLuint name) {
      functions.DeleteProgram(name);
    })
{
  const GlName shaders[] = {compile(gl, GL_VERTEX_SHADER, vertex),
                            compile(gl, GL_FRAGMENT_SHADER, fragment)};
  for (const GlName& shader : shaders)
    gl.AttachShader(name_.get(), shader.get());
  gl.LinkProgram(name_.get());
  GLint linked = GL_FALSE;
  gl.GetProgramiv(name_.get(), GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE)
    throw GlError(
        "gl_shader_not_linked",
        {{"log", readLog(name_.get(), gl.GetProgramiv, gl.GetProgramInfoLog)}});
}

} // namespace pcl_uvol
