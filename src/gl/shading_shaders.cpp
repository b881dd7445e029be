// SPDX-License-Identifier: BSD-3-Clause
#include "gl/shaders.h"

namespace pcl_uvol::shaders {

namespace {

// Directions are in the cloud's axes, positions relative to the eye.
const char* const shade_fragment = R"(
uniform usampler2DRect state;
uniform usamplerBuffer looks;  // packed normal, colour
uniform sampler2DRect blended_normals; // and weights
uniform sampler2DRect blended_colors;
uniform samplerBuffer lights; // for each: position or direction, is it a point; colour
uniform int light_count;
uniform mat3 rotation; // from the cloud's axes to the camera's
uniform vec2 center;
uniform float per_focal;
uniform float far;
uniform bool is_two_sided;
uniform float ambient;
uniform float diffuse;
uniform float specular;
uniform float shininess;

layout(location = 0) out vec4 color;
#ifdef WITH_NORMALS
layout(location = 1) out vec4 normal_depth;
#endif

// Blinn-Phong.
vec3 light(vec3 surface, vec3 position, vec3 normal, vec3 to_eye)
{
  vec3 sum = surface * ambient;
  for (int i = 0; i < light_count; ++i) {
    vec4 source = texelFetch(lights, 2 * i);
    vec3 light_color = texelFetch(lights, 2 * i + 1).rgb;
    vec3 to_light = normalize(source.xyz - source.w * position);
    float cosine = dot(normal, to_light);
    float highlight = max(dot(normal, normalize(to_light + to_eye)), 1e-30);
    float gloss = cosine > 0.0 ? specular * pow(highlight, shininess) : 0.0;
    sum += light_color * (surface * diffuse * max(cosine, 0.0) + gloss);
  }
  return clamp(sum, 0.0, 1.0);
}

#ifdef WITH_OCCLUSION
uniform sampler2DRect cells; // openness, depth
uniform vec2 cell_count;
uniform float half_cell;
uniform float per_cell;
uniform float tolerance; // in parts of a depth
uniform float strength;

// Light that arrives, from the cells around that show the same surface.
float lightThere(float depth)
{
  vec2 place = (floor(gl_FragCoord.xy) - margin - half_cell) * per_cell;
  vec2 before = floor(place);
  vec2 part = place - before;
  float sum = open_weight, weights = open_weight;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      vec2 cell = before + vec2(x, y) + 0.5;
      bool is_inside =
          all(greaterThan(cell, vec2(0.0))) && all(lessThan(cell, cell_count));
      vec2 there = is_inside ? texture(cells, cell).xy : vec2(1.0, no_depth);
      float likeness = max(1.0 - abs(there.y - depth) / (tolerance * depth), 0.0);
      float weight = (y == 1 ? part.y : 1.0 - part.y) *
                     (x == 1 ? part.x : 1.0 - part.x) * likeness;
      sum += weight * there.x;
      weights += weight;
    }
  return 1.0 - strength * (1.0 - sum / weights);
}
#endif

void main()
{
  uvec2 point = texture(state, gl_FragCoord.xy).xy;
  bool is_surface = point.x != background_bits;
  uvec2 look = texelFetch(looks, is_surface ? int(point.y) : 0).xy;
  float depth = uintBitsToFloat(point.x);
  vec3 ray = vec3((gl_FragCoord.xy - margin - center) * per_focal, 1.0);
  vec3 direction = normalize(ray * rotation); // the transposed matrix
  vec3 normal = unpackNormal(look.x);
  vec3 surface = unpackColor(look.y);
#ifdef WITH_DISCS
  vec4 normal_weight = texture(blended_normals, gl_FragCoord.xy);
  if (normal_weight.w > 0.0) {
    normal = normalize(normal_weight.xyz);
    surface = texture(blended_colors, gl_FragCoord.xy).rgb / normal_weight.w;
  }
#endif
  if (is_two_sided && dot(normal, direction) > 0.0)
    normal = -normal;
#ifdef LIT
  vec3 lit = light(surface, direction * (depth * far), normal, -direction);
#else
  vec3 lit = vec3(1.0);
#endif
#ifdef WITH_OCCLUSION
  lit *= lightThere(depth);
#endif
  color = is_surface ? vec4(lit, 1.0) : vec4(0.0);
#ifdef WITH_NORMALS
  normal_depth = vec4(is_surface ? normal : vec3(0.0), depth);
#endif
}
)";

} // namespace

extern const Pass shade{{tiles}, {occlusion_constants, shade_fragment}};

} // namespace pcl_uvol::shaders
