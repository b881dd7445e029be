// SPDX-License-Identifier: BSD-3-Clause
#include "gl/shaders.h"

namespace pcl_uvol::shaders {

namespace {

// Over the background, cut to the image.
const char* const output_fragment = R"(
uniform sampler2DRect colors;
uniform float border; // texels around the image
uniform float height; // of the image
uniform vec3 top;
uniform vec3 bottom;

layout(location = 0) out vec4 color;

void main()
{
  vec4 surface = texture(colors, gl_FragCoord.xy + border);
#ifdef IS_TRANSPARENT
  color = surface.a > 0.0 ? vec4(surface.rgb / surface.a, surface.a) : vec4(0.0);
#else
  vec3 background = mix(top, bottom, gl_FragCoord.y / height);
  color = vec4(surface.rgb + (1.0 - surface.a) * background, 1.0);
#endif
}
)";

// Into a window, whose row 0 is at the bottom.
const char* const composite_fragment = R"(
uniform sampler2DRect colors;
uniform vec2 origin;   // of the image in the window
uniform float height;  // of the image
uniform float border; // texels around the image, of buffers
uniform vec2 center;
uniform float per_focal;
uniform float far;
uniform vec4 clip_z; // rows of the projection from camera to clip space
uniform vec4 clip_w;

layout(location = 0) out vec4 color;

#ifdef OF_IMAGE
uniform sampler2DRect depths;
uniform float scale; // texels by pixels
#define TEXEL (1.0 / scale)

float depthAt(vec2 pixel)
{
  return texture(depths, pixel * scale).x;
}

vec4 colorAt(vec2 pixel)
{
  vec4 straight = texture(colors, pixel * scale);
  return vec4(straight.rgb * straight.a, straight.a);
}
#else
uniform usampler2DRect state;
#define TEXEL 1.0

float depthAt(vec2 pixel)
{
  return uintBitsToFloat(texture(state, pixel + border).x);
}

vec4 colorAt(vec2 pixel)
{
  return texture(colors, pixel + border);
}
#endif

// A pixel of background that shows a part of a surface lies as deep as that.
float nearestAround(vec2 pixel)
{
  float depth = 1.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      depth = min(depth, depthAt(pixel + TEXEL * vec2(x, y)));
  return depth;
}

void main()
{
  vec2 pixel = gl_FragCoord.xy - origin;
  pixel.y = height - pixel.y;
  color = colorAt(pixel);
  if (color.a == 0.0)
    discard;
  float depth = depthAt(pixel);
  depth = depth < 1.0 ? depth : nearestAround(pixel);
  vec3 ray = normalize(vec3((pixel + border - margin - center) * per_focal, 1.0));
  vec4 position = vec4(ray * (depth * far), 1.0);
  gl_FragDepth =
      depth < 1.0 ? 0.5 + 0.5 * dot(clip_z, position) / dot(clip_w, position) : 1.0;
}
)";

} // namespace

extern const Pass output{{full_screen}, {output_fragment}};
extern const Pass composite{{full_screen}, {composite_fragment}};

} // namespace pcl_uvol::shaders
