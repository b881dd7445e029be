// SPDX-License-Identifier: BSD-3-Clause
#include "gl/shaders.h"

namespace pcl_uvol::shaders {

namespace {

// Sum of the texels around one, by weights of the centre, the edges and the corners.
const char* const filter = R"(
vec4 filtered(sampler2DRect source, vec2 texel, vec3 weights)
{
  vec4 edges = texture(source, texel + vec2(0, -1)) +
               texture(source, texel + vec2(-1, 0)) +
               texture(source, texel + vec2(1, 0)) +
               texture(source, texel + vec2(0, 1));
  vec4 corners = texture(source, texel + vec2(-1, -1)) +
                 texture(source, texel + vec2(1, -1)) +
                 texture(source, texel + vec2(-1, 1)) +
                 texture(source, texel + vec2(1, 1));
  return weights.x * texture(source, texel) + weights.y * edges +
         weights.z * corners;
}
)";

// Background is zero and has no weight.
const char* const smooth_fragment = R"(
uniform sampler2DRect colors;
uniform sampler2DRect normals;
uniform vec3 weights;

layout(location = 0) out vec4 color;
#ifdef WITH_NORMALS
layout(location = 1) out vec4 normal_depth;
#endif

void main()
{
  vec2 texel = gl_FragCoord.xy;
  float opacity = texture(colors, texel).a;
  vec4 sum = filtered(colors, texel, weights);
  color = opacity > 0.0 ? vec4(sum.rgb / sum.a, opacity) : vec4(0.0);
#ifdef WITH_NORMALS
  vec3 normal = filtered(normals, texel, weights).xyz;
  normal *= inversesqrt(max(dot(normal, normal), 1e-30));
  normal_depth = vec4(opacity > 0.0 ? normal : vec3(0.0), texture(normals, texel).w);
#endif
}
)";

// Table 4.2.
const char* const laplace = R"(
uniform usampler2DRect state;

float depthAt(vec2 texel)
{
  return uintBitsToFloat(texture(state, texel).x);
}

float laplace(vec2 texel)
{
  return 4.0 * depthAt(texel) - depthAt(texel - vec2(1, 0)) -
         depthAt(texel + vec2(1, 0)) - depthAt(texel - vec2(0, 1)) -
         depthAt(texel + vec2(0, 1));
}
)";

// 0 below the edge, 1 above twice of it.
const char* const smooth_step = R"(
float smoothStep(float value, float edge)
{
  float t = clamp((value - edge) / edge, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
)";

// On the near side of the steps in depth.
const char* const silhouettes_fragment = R"(
uniform float silhouette_threshold;

layout(location = 0) out float strength;

void main()
{
  strength = smoothStep(-laplace(gl_FragCoord.xy), silhouette_threshold);
}
)";

const char* const lines_fragment = R"(
uniform sampler2DRect colors;
uniform sampler2DRect normals; // and depth
uniform sampler2DRect silhouettes;
uniform int reach; // of silhouettes, pixels
uniform float silhouette_threshold;
uniform float feature_threshold;
uniform vec3 line_color;

layout(location = 0) out vec4 color;

float silhouette(vec2 texel)
{
  float strongest = 0.0;
  float sq_radius = (float(reach) + 0.5) * (float(reach) + 0.5);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      float strength = texture(silhouettes, texel + vec2(x, y)).r;
      if (float(x * x + y * y) <= sq_radius)
        strongest = max(strongest, strength);
    }
  return strongest;
}

// Second largest turn of the normal to a neighbour on the same layer of surface: one
// that differs alone is an outlier.
float feature(vec2 texel)
{
  vec4 here = texture(normals, texel);
  float largest = 0.0, turn = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      vec4 there = texture(normals, texel + vec2(x, y));
      bool is_same = (x != 0 || y != 0) && there.w < 1.0 && abs(there.w - here.w) <= silhouette_threshold;
      float turn_there = is_same ? 1.0 - dot(here.xyz, there.xyz) : 0.0;
      turn = max(turn, min(largest, turn_there));
      largest = max(largest, turn_there);
    }
  return here.w < 1.0 ? smoothStep(turn, feature_threshold) : 0.0;
}

void main()
{
  vec2 texel = gl_FragCoord.xy;
  float line = 0.0;
#ifdef WITH_SILHOUETTES
  line = silhouette(texel);
#endif
#ifdef WITH_FEATURES
  line = max(line, feature(texel));
#endif
  color = mix(texture(colors, texel), vec4(line_color, 1.0), line);
}
)";

const char* const anti_alias_fragment = R"(
uniform sampler2DRect colors;
uniform float threshold;

layout(location = 0) out vec4 color;

void main()
{
  vec2 texel = gl_FragCoord.xy;
  vec4 mean = filtered(colors, texel, vec3(4.0, 2.0, 1.0) / 16.0);
  bool is_edge = abs(laplace(texel)) >= threshold;
  color = is_edge ? mean : texture(colors, texel);
}
)";

} // namespace

extern const Pass smooth{{tiles}, {filter, smooth_fragment}};
extern const Pass silhouettes{{tiles}, {laplace, smooth_step, silhouettes_fragment}};
extern const Pass lines{{tiles}, {smooth_step, lines_fragment}};
extern const Pass anti_alias{{tiles}, {laplace, filter, anti_alias_fragment}};

} // namespace pcl_uvol::shaders
