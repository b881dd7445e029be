// SPDX-License-Identifier: BSD-3-Clause
#include "gl/shaders.h"

namespace pcl_uvol::shaders {

const char* const prelude = R"(
// What decides between points is computed as written, in the order of the plain C++
// backend and with reciprocals for divisions: where these and roots are rounded
// correctly, both backends agree to the last bit.
#ifdef GL_ARB_gpu_shader5
#extension GL_ARB_gpu_shader5 : enable
#define EXACT precise
#else
#define EXACT
#endif

const float margin = 1.0;

const uint background_bits = 0x3f800000u; // depth 1
const uvec2 background = uvec2(background_bits, 0xffffffffu);

// The octahedral map, as packNormal() has it: a normal of any length.
vec3 unpackDirection(uint bits)
{
  vec2 uv = vec2(int(bits << 16) >> 16, int(bits) >> 16) * (1.0 / 32767.0);
  EXACT float z = 1.0 - abs(uv.x) - abs(uv.y);
  float fold = max(-z, 0.0);
  uv.x -= uv.x < 0.0 ? -fold : fold;
  uv.y -= uv.y < 0.0 ? -fold : fold;
  return vec3(uv, z);
}

vec3 unpackNormal(uint bits)
{
  return normalize(unpackDirection(bits));
}

vec3 unpackColor(uint rgba)
{
  return vec3(rgba & 255u, (rgba >> 8) & 255u, (rgba >> 16) & 255u) / 255.0;
}
)";

// Boxes of tiles, one per instance.
const char* const tiles = R"(
layout(location = 0) in vec4 box; // left, top, right, bottom, in tiles

uniform vec2 per_tile; // part of the target that a tile is

void main()
{
  vec2 corner = mix(box.xy, box.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
  gl_Position = vec4(2.0 * corner * per_tile - 1.0, 0.0, 1.0);
}
)";

const char* const full_screen = R"(
void main()
{
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
)";

} // namespace pcl_uvol::shaders
