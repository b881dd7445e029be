// SPDX-License-Identifier: BSD-3-Clause
#include "gl/shaders.h"

namespace pcl_uvol::shaders {

namespace {

// The pixels in the middle of cells, in camera space.
const char* const place_fragment = R"(
uniform usampler2DRect state;
uniform usamplerBuffer looks; // packed normal, colour
uniform float cell;           // pixels
uniform float half_cell;
uniform mat3 rotation; // from the cloud's axes to the camera's
uniform vec2 center;
uniform float per_focal;
uniform float far;
uniform bool is_two_sided;

layout(location = 0) out vec4 position_depth;
layout(location = 1) out vec4 normal;

void main()
{
  vec2 pixel = floor(gl_FragCoord.xy) * cell + half_cell + 0.5;
  uvec2 point = texture(state, pixel + margin).xy;
  bool is_surface = point.x != background_bits;
  uint look = texelFetch(looks, is_surface ? int(point.y) : 0).x;
  float depth = uintBitsToFloat(point.x);
  vec3 ray = vec3((pixel - center) * per_focal, 1.0);
  vec3 seen = rotation * unpackNormal(look);
  if (is_two_sided && dot(seen, ray) > 0.0)
    seen = -seen;
  position_depth = is_surface ? vec4(normalize(ray) * (depth * far), depth)
                              : vec4(vec3(beyond_all), no_depth);
  normal = vec4(seen, 0.0);
}
)";

const char* const open_fragment = R"(
uniform sampler2DRect positions; // and depths
uniform sampler2DRect normals;
uniform samplerBuffer offsets; // to other cells, direction by direction
uniform vec2 size;             // cells
uniform int directions;
uniform int steps;
uniform float radius; // in parts of the distance along the line of sight
uniform float least_sine;
uniform float roughness; // heights up to this one are none

layout(location = 0) out vec2 openness_depth;

vec3 positionAt(vec2 place)
{
  bool is_inside = all(greaterThan(place, vec2(0.0))) && all(lessThan(place, size));
  return is_inside ? texture(positions, place).xyz : vec3(beyond_all);
}

void main()
{
  vec4 here = texture(positions, gl_FragCoord.xy);
  vec3 normal = texture(normals, gl_FragCoord.xy).xyz;
  float reach = here.z * radius;
  float closed = 0.0;
  for (int direction = 0; direction < directions; ++direction) {
    float highest = 0.0;
    for (int i = 0; i < steps; ++i) {
      vec2 offset = texelFetch(offsets, direction * steps + i).xy;
      vec3 step = positionAt(gl_FragCoord.xy + offset) - here.xyz;
      float sq_distance = dot(step, step);
      float sine =
          (dot(step, normal) - roughness) / sqrt(max(sq_distance, 1e-30));
      float nearness = clamp(falloff * (1.0 - sq_distance / (reach * reach)), 0.0, 1.0);
      highest = max(highest, (sine - least_sine) / (1.0 - least_sine) * nearness);
    }
    closed += highest;
  }
  bool is_surface = here.w < no_depth;
  openness_depth = vec2(is_surface ? 1.0 - closed / float(directions) : 1.0, here.w);
}
)";

} // namespace

// As occlusion_kernel.h has them.
const char* const occlusion_constants = R"(
const float no_depth = 16.0;
const float beyond_all = 1e18;
const float falloff = 3.0;
const float open_weight = 1e-3;
)";

extern const Pass place_cells{{full_screen}, {occlusion_constants, place_fragment}};
extern const Pass open_cells{{full_screen}, {occlusion_constants, open_fragment}};

} // namespace pcl_uvol::shaders
