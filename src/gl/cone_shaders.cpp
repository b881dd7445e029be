// SPDX-License-Identifier: BSD-3-Clause
#include "gl/cone_shaders.h"

namespace pcl_uvol::shaders {

const char* const cone_vertex = R"(#version 330 core
layout(location = 0) in vec3 corner; // from the site, in cells; depth
layout(location = 1) in uvec2 cell; // of the site

uniform vec2 size; // of a layer, in cells
uniform int first; // site of the first instance

flat out uint site;

void main()
{
  site = uint(first + gl_InstanceID);
  vec2 place = vec2(cell) + 0.5 + corner.xy;
  gl_Position = vec4(2.0 * place / size - 1.0, 2.0 * corner.z - 1.0, 1.0);
}
)";

// Depth comes from the triangle: a driver may reject pixels before this.
const char* const cone_fragment = R"(#version 330 core
flat in uint site;

layout(location = 0) out uint nearest;

void main()
{
  nearest = site;
}
)";

} // namespace pcl_uvol::shaders
