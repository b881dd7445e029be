// SPDX-License-Identifier: BSD-3-Clause
#include "gl/shaders.h"

namespace pcl_uvol::shaders {

namespace {

// Software OpenGL takes no branch: all of it is computed for every pixel.
const char* const fill_fragment = R"(
uniform usampler2DRect state;
uniform float layer_distance;

layout(location = 0) out uvec2 filled;

uvec2 nearest(uvec2 a, uvec2 b)
{
  return b.x < a.x || (b.x == a.x && b.y < a.y) ? b : a;
}

// Is one of the eight masks of Figure 4.8 all open: four bits of the ring in a row?
bool matchesMask(uint open)
{
  uint twice = open | open << 8;
  uint pairs = twice & twice >> 1;
  return (pairs & pairs >> 2) != 0u;
}

void main()
{
  vec2 texel = gl_FragCoord.xy;
  uvec2 here = texture(state, texel).xy;
  uvec2 a = texture(state, texel + vec2(-1, -1)).xy;
  uvec2 b = texture(state, texel + vec2(0, -1)).xy;
  uvec2 c = texture(state, texel + vec2(1, -1)).xy;
  uvec2 d = texture(state, texel + vec2(1, 0)).xy;
  uvec2 e = texture(state, texel + vec2(1, 1)).xy;
  uvec2 f = texture(state, texel + vec2(0, 1)).xy;
  uvec2 g = texture(state, texel + vec2(-1, 1)).xy;
  uvec2 h = texture(state, texel + vec2(-1, 0)).xy;
#ifdef OCCLUDED
  bool is_candidate = here.x != background_bits;
  // Depths are positive: their bits compare as they do.
  uint limit = floatBitsToUint(max(uintBitsToFloat(here.x) - layer_distance, 0.0));
#else
  bool is_candidate = here.x == background_bits;
  uint limit = background_bits;
#endif
  uint open = uint(a.x >= limit) | uint(b.x >= limit) << 1 | uint(c.x >= limit) << 2 |
              uint(d.x >= limit) << 3 | uint(e.x >= limit) << 4 |
              uint(f.x >= limit) << 5 | uint(g.x >= limit) << 6 |
              uint(h.x >= limit) << 7;
  uvec2 front = nearest(nearest(nearest(a, b), nearest(c, d)),
                        nearest(nearest(e, f), nearest(g, h)));
  filled = is_candidate && !matchesMask(open) ? front : here;
}
)";

// Two steps, as software OpenGL has little to share out in one: rows of a tile, tiles.
const char* const row_changes_fragment = R"(
uniform usampler2DRect before;
uniform usampler2DRect after;

layout(location = 0) out uint changed;

void main()
{
  vec2 first = vec2(floor(gl_FragCoord.x) * float(TILE) + 0.5, gl_FragCoord.y);
  uint difference = 0u;
  for (int x = 0; x < TILE; ++x) {
    vec2 texel = first + vec2(x, 0);
    difference |= texture(before, texel).x ^ texture(after, texel).x;
  }
  changed = min(difference, 1u);
}
)";

const char* const tile_changes_fragment = R"(
uniform usampler2DRect rows;

layout(location = 0) out uint changed;

void main()
{
  vec2 first = vec2(gl_FragCoord.x, floor(gl_FragCoord.y) * float(TILE) + 0.5);
  changed = 0u;
  for (int y = 0; y < TILE; ++y)
    changed |= texture(rows, first + vec2(0, y)).x;
}
)";

} // namespace

extern const Pass fill{{tiles}, {fill_fragment}};
extern const Pass row_changes{{tiles}, {row_changes_fragment}};
extern const Pass tile_changes{{tiles}, {tile_changes_fragment}};

} // namespace pcl_uvol::shaders
