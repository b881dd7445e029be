// SPDX-License-Identifier: BSD-3-Clause
#include "gl/functions.h"

namespace pcl_uvol {

namespace {

template <typename Function>
void
load(const GlContext& context, const char* name, Function& function)
{
  function = reinterpret_cast<Function>(context.getFunction(name));
  if (function == nullptr)
    throw GlError("gl_context_without_function",
                  {{"context", context.getName()},
                   {"version", context.getVersion()},
                   {"function", name}});
}

} // namespace

GlFunctions::GlFunctions(const GlContext& context)
{
#define PCL_UVOL_GL_LOAD(name) load(context, "gl" #name, name);
  PCL_UVOL_GL_FUNCTIONS(PCL_UVOL_GL_LOAD)
#undef PCL_UVOL_GL_LOAD
}

} // namespace pcl_uvol
