// SPDX-License-Identifier: BSD-3-Clause
// The functions of OpenGL 3.3 that are used here, from any context.
#pragma once

#include "gl/context.h"

// Prototypes are for their types alone: nothing is linked.
#define GL_GLEXT_PROTOTYPES 1
#include <GL/glcorearb.h>

#define PCL_UVOL_GL_FUNCTIONS(X)                                                       \
  X(ActiveTexture)                                                                     \
  X(AttachShader)                                                                      \
  X(BindBuffer)                                                                        \
  X(BindFramebuffer)                                                                   \
  X(BindSampler)                                                                       \
  X(BindTexture)                                                                       \
  X(BindVertexArray)                                                                   \
  X(BlendEquation)                                                                     \
  X(BlendFunc)                                                                         \
  X(BufferData)                                                                        \
  X(CheckFramebufferStatus)                                                            \
  X(ClearBufferfv)                                                                     \
  X(ClearBufferuiv)                                                                    \
  X(ColorMask)                                                                         \
  X(CompileShader)                                                                     \
  X(CreateProgram)                                                                     \
  X(CreateShader)                                                                      \
  X(DeleteBuffers)                                                                     \
  X(DeleteFramebuffers)                                                                \
  X(DeleteProgram)                                                                     \
  X(DeleteShader)                                                                      \
  X(DeleteTextures)                                                                    \
  X(DeleteVertexArrays)                                                                \
  X(DepthFunc)                                                                         \
  X(DepthMask)                                                                         \
  X(DepthRange)                                                                        \
  X(Disable)                                                                           \
  X(DrawArrays)                                                                        \
  X(DrawArraysInstanced)                                                               \
  X(DrawBuffers)                                                                       \
  X(DrawElementsInstancedBaseVertex)                                                   \
  X(Enable)                                                                            \
  X(EnableVertexAttribArray)                                                           \
  X(Finish)                                                                            \
  X(FramebufferTexture2D)                                                              \
  X(GenBuffers)                                                                        \
  X(GenFramebuffers)                                                                   \
  X(GenTextures)                                                                       \
  X(GenVertexArrays)                                                                   \
  X(GetFloatv)                                                                         \
  X(GetError)                                                                          \
  X(GetIntegerv)                                                                       \
  X(GetProgramInfoLog)                                                                 \
  X(GetProgramiv)                                                                      \
  X(GetShaderInfoLog)                                                                  \
  X(GetShaderiv)                                                                       \
  X(GetUniformLocation)                                                                \
  X(LinkProgram)                                                                       \
  X(MultiDrawArrays)                                                                   \
  X(PixelStorei)                                                                       \
  X(PolygonMode)                                                                       \
  X(ReadBuffer)                                                                        \
  X(ReadPixels)                                                                        \
  X(Scissor)                                                                           \
  X(ShaderSource)                                                                      \
  X(TexBuffer)                                                                         \
  X(TexImage2D)                                                                        \
  X(TexParameteri)                                                                     \
  X(Uniform1f)                                                                         \
  X(Uniform1i)                                                                         \
  X(Uniform2f)                                                                         \
  X(Uniform3f)                                                                         \
  X(Uniform4f)                                                                         \
  X(UniformMatrix3fv)                                                                  \
  X(UseProgram)                                                                        \
  X(VertexAttribDivisor)                                                               \
  X(VertexAttribIPointer)                                                              \
  X(VertexAttribPointer)                                                               \
  X(Viewport)

namespace pcl_uvol {

/** \brief gl.DrawArrays is glDrawArrays of one context. */
struct GlFunctions {
// NOLINTNEXTLINE: the name that is declared cannot stand in parentheses
#define PCL_UVOL_GL_MEMBER(name) decltype(&::gl##name) name;
  PCL_UVOL_GL_FUNCTIONS(PCL_UVOL_GL_MEMBER)
#undef PCL_UVOL_GL_MEMBER

  /** \throws GlError that names a function if it is missing */
  explicit GlFunctions(const GlContext& context);
};

} // namespace pcl_uvol
