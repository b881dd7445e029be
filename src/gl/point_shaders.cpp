// SPDX-License-Identifier: BSD-3-Clause
#include "shaders.h"

namespace pcl_uvol::shaders {

namespace {

// What all kinds of points begin with. Camera space: x right, y down, z forward.
const char* const projection = R"(
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in float z;
layout(location = 3) in uvec2 look; // packed normal, colour
layout(location = 4) in float footprint;

uniform mat3 rotation;
uniform vec3 translation;
uniform vec3 eye; // in the cloud's coordinates
uniform vec2 center;
uniform vec2 origin; // pixel in the lower left corner of the viewport
uniform vec2 extent; // of the viewport, pixels
uniform float focal;
uniform float near;
uniform float per_far;
uniform bool culls;
uniform bool is_two_sided;
uniform float smallest_footprint;
uniform float largest_reach; // of what is drawn as one point, pixels

const vec4 nowhere = vec4(2.0, 2.0, 2.0, 1.0);

vec4 atPixel(vec2 pixel)
{
  return vec4(2.0 * (pixel - origin) / extent - 1.0, 0.0, 1.0);
}

bool isHidden(vec3 c, vec3 normal)
{
  return c.z < near || (culls && dot(normal, eye - vec3(x, y, z)) < 0.0);
}
)";

// A point goes to the middle of its pixel, so that all drivers agree on which that is.
const char* const points_vertex = R"(
flat out uvec2 point;

void main()
{
  vec3 c = rotation * vec3(x, y, z) + translation;
  vec2 pixel = floor(center + c.xy * (focal / c.z));
  point = uvec2(floatBitsToUint(length(c) * per_far), uint(gl_VertexID));
  gl_PointSize = 1.0;
  gl_Position = isHidden(c, unpackNormal(look.x)) ? nowhere : atPixel(pixel + 0.5);
}
)";

// Depth is written rather than interpolated: bit by bit what is compared later.
const char* const points_fragment = R"(
flat in uvec2 point;
layout(location = 0) out uvec2 state;

void main()
{
  state = point;
  gl_FragDepth = uintBitsToFloat(point.x);
}
)";

// In as few numbers as possible, for software OpenGL pays for each. Where a disc is
// seen edge-on its plane is infinite, and no ray meets it.
const char* const disc_vertex = R"(
flat out vec4 disc_center; // and radius, 0 for a mere pixel
flat out uvec4 disc_plane; // 1 = dot(plane, place), as bits; index
#ifdef BLENDED
uniform float stretch; // discs reach so many of their radii
flat out vec3 disc_normal; // in the cloud's axes
flat out vec3 disc_color;
#else
const float stretch = 1.0;
#endif

void setDisc(uint index, vec3 c, float radius, vec3 normal)
{
  vec3 axis = rotation * normal;
  float along = dot(axis, c);
  disc_center = vec4(c, radius);
  disc_plane = uvec4(floatBitsToUint(axis / along), index);
#ifdef BLENDED
  disc_normal = is_two_sided && along > 0.0 ? -normal : normal;
  disc_color = unpackColor(look.y);
#endif
}

bool isDisc(vec3 c, float radius)
{
  return radius * (focal / c.z) > smallest_footprint;
}

// Half of the width and height in the image, pixels.
vec2 reach(vec3 c, float radius)
{
  vec2 slope = c.xy / c.z;
  return focal * radius * sqrt(1.0 + slope * slope) / (c.z - radius);
}

// Too large, or too near to the eye, for one point.
bool isLarge(vec3 c, float radius)
{
  vec2 size = reach(c, radius);
  return c.z - radius < near || max(size.x, size.y) > largest_reach;
}
)";

// One point, as large as the disc.
const char* const small_discs_vertex = R"(
void main()
{
  vec3 normal = unpackNormal(look.x);
  vec3 c = rotation * vec3(x, y, z) + translation;
  float radius = footprint * stretch;
  bool is_disc = isDisc(c, footprint) && !isLarge(c, radius);
  vec2 place = center + c.xy * (focal / c.z);
  setDisc(uint(gl_VertexID), c, is_disc ? radius : 0.0, normal);
  vec2 size = reach(c, radius);
  const float slack = 0.1; // hardware rounds corners
  gl_PointSize = is_disc ? 2.0 * max(size.x, size.y) + slack : 1.0;
  gl_Position = atPixel(is_disc ? place : floor(place) + 0.5);
#ifdef BLENDED
  if (!is_disc)
    gl_Position = nowhere;
#endif
  if (isHidden(c, normal))
    gl_Position = nowhere;
}
)";

// A rectangle around each large disc; all others have no extent.
const char* const large_discs_vertex = R"(
uniform int first; // index of the first instance

void main()
{
  vec3 normal = unpackNormal(look.x);
  vec3 c = rotation * vec3(x, y, z) + translation;
  float radius = footprint * stretch;
  setDisc(uint(first + gl_InstanceID), c, radius, normal);
  gl_Position = nowhere;
  if (isHidden(c, normal) || !isDisc(c, footprint) || !isLarge(c, radius))
    return;
  vec2 low = origin, high = origin + extent;
  if (c.z - radius >= near) {
    vec2 place = center + c.xy * (focal / c.z);
    vec2 size = 1.0 + reach(c, radius);
    low = max(low, place - size);
    high = min(high, place + size);
  }
  if (all(lessThan(low, high)))
    gl_Position = atPixel(mix(low, high, vec2(gl_VertexID & 1, gl_VertexID >> 1)));
}
)";

const char* const disc_fragment = R"(
uniform vec2 center;
uniform float focal;
uniform float per_focal;
uniform float per_far;

flat in vec4 disc_center;
flat in uvec4 disc_plane;

// Does the disc cover this pixel? Its depth there, and the part of the squared radius.
bool isCovered(out float depth, out float part)
{
  vec3 ray = vec3((gl_FragCoord.xy - margin - center) * per_focal, 1.0);
  float along = 1.0 / dot(uintBitsToFloat(disc_plane.xyz), ray);
  vec3 offset = along * ray - disc_center.xyz;
  part = dot(offset, offset) / (disc_center.w * disc_center.w);
  depth = along * length(ray) * per_far;
  return along > 0.0 && part <= 1.0;
}
)";

// The pixel of the point itself is the nearer one of point and disc.
const char* const discs_fragment = R"(
uniform float back; // how much deeper than they are discs lie, in radii

layout(location = 0) out uvec2 state;

bool isOwnPixel()
{
  vec2 own = floor(center + disc_center.xy * (focal / disc_center.z));
  return disc_center.w == 0.0 || floor(gl_FragCoord.xy - margin) == own;
}

void main()
{
  float depth, part;
  bool is_covered = isCovered(depth, part);
  depth = is_covered ? depth + disc_center.w * (back * per_far) : 1.0;
#ifdef WITH_PIXELS
  depth = isOwnPixel() ? min(depth, length(disc_center.xyz) * per_far) : depth;
#endif
  if (depth >= 1.0)
    discard;
  state = uvec2(floatBitsToUint(depth), disc_plane.w);
  gl_FragDepth = depth;
}
)";

// The weight of a disc falls smoothly to zero at its rim.
const char* const blend_fragment = R"(
uniform usampler2DRect states;

flat in vec3 disc_normal;
flat in vec3 disc_color;
layout(location = 0) out vec4 normal_weight;
layout(location = 1) out vec4 color;

void main()
{
  float depth, part;
  bool is_covered = isCovered(depth, part);
  float seen = uintBitsToFloat(texture(states, gl_FragCoord.xy).x);
  if (!is_covered || abs(depth - seen) > disc_center.w * per_far)
    discard;
  float weight = (1.0 - part) * (1.0 - part);
  normal_weight = weight * vec4(disc_normal, 1.0);
  color = weight * vec4(disc_color, 1.0);
}
)";

} // namespace

extern const Pass points{{projection, points_vertex}, {points_fragment}};
extern const Pass small_discs{{projection, disc_vertex, small_discs_vertex},
                              {disc_fragment, discs_fragment}};
extern const Pass large_discs{{projection, disc_vertex, large_discs_vertex},
                              {disc_fragment, discs_fragment}};
extern const Pass blend_small{{projection, disc_vertex, small_discs_vertex},
                              {disc_fragment, blend_fragment}};
extern const Pass blend_large{{projection, disc_vertex, large_discs_vertex},
                              {disc_fragment, blend_fragment}};

} // namespace pcl_uvol::shaders
