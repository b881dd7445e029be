// SPDX-License-Identifier: BSD-3-Clause
#include "gl/shaders.h"

namespace pcl_uvol::shaders {

namespace {

// Camera space: x right, y down, z forward.
const char* const camera = R"(
uniform vec2 center;
uniform float focal;
uniform float per_focal;
uniform float per_far;

// In the image, pixels.
vec2 placeOf(vec3 c)
{
  EXACT vec2 place = center + c.xy * (focal * (1.0 / c.z));
  return place;
}

// Side and surface, as the plain C++ backend numbers them.
uint sideOf(uint color, bool looks_away)
{
  return (color >> 24 & 63u) << 2 | uint(looks_away);
}

float depthOf(vec3 c)
{
  EXACT float depth = sqrt(c.x * c.x + c.y * c.y + c.z * c.z) * per_far;
  return depth;
}
)";

// What all kinds of points begin with.
const char* const projection = R"(
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in float z;
layout(location = 3) in uvec2 look; // packed normal, colour
layout(location = 4) in float footprint;
layout(location = 5) in float filler; // or footprint, among sparse points
layout(location = 6) in uint bend;    // of the surface over the footprint, packed
layout(location = 7) in uint rim;     // lines where the footprint ends, packed

uniform mat3 rotation;
uniform vec3 translation;
uniform vec3 eye; // in the cloud's coordinates
uniform vec2 origin; // pixel in the lower left corner of the viewport
uniform vec2 extent; // of the viewport, pixels
uniform float near;
uniform bool culls;
uniform bool is_two_sided;
uniform float outward; // factor that makes normals look outwards
uniform float smallest_footprint;
uniform float largest_filler;
uniform float smallest_bend;
uniform float smallest_turn;
uniform float per_bend; // packed bends are whole numbers of these
uniform float largest_reach; // of what is drawn as one point, pixels

const vec4 nowhere = vec4(2.0, 2.0, 2.0, 1.0);

vec4 atPixel(vec2 pixel)
{
  return vec4(2.0 * (pixel - origin) / extent - 1.0, 0.0, 1.0);
}

vec3 toCamera()
{
  EXACT vec3 c = rotation[0] * x + rotation[1] * y + rotation[2] * z + translation;
  return c;
}

bool isHidden(vec3 c, vec3 direction)
{
  EXACT float facing = direction.x * (eye.x - x) + direction.y * (eye.y - y) +
                       direction.z * (eye.z - z);
  return c.z < near || (culls && facing < 0.0);
}
)";

// A point goes to the middle of its pixel, so that all drivers agree on which that is.
const char* const points_vertex = R"(
flat out uvec2 point;

void main()
{
  vec3 c = toCamera();
  point = uvec2(floatBitsToUint(depthOf(c)), uint(gl_VertexID));
  gl_PointSize = 1.0;
  gl_Position = isHidden(c, unpackDirection(look.x)) ? nowhere
                                                     : atPixel(floor(placeOf(c)) + 0.5);
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
// seen edge-on its tilt is infinite, and no pixel is covered.
const char* const disc_vertex = R"(
flat out vec4 disc_center; // and radius, 0 for a mere pixel
flat out uvec3 disc_tilt;  // change of 1 / z per pixel, as bits; index
flat out vec4 disc_axes;   // change of the place in both of its axes per pixel
flat out vec3 disc_slant;  // the way to the eye in these, inverse of that to the plane
flat out vec3 disc_bend;   // of the surface in these, 0 where no pixel shows it
#ifdef BLENDED
uniform float stretch; // discs reach so many of their radii
uniform bool has_sides;
flat out vec3 disc_normal; // in the cloud's axes
flat out vec3 disc_turn_a; // by what it changes along the axes of the disc
flat out vec3 disc_turn_b;
flat out vec3 disc_color;
flat out uint disc_side;
#else
const float stretch = 1.0;
uniform float back;       // how much deeper than they are discs lie, in radii
uniform float away_depth; // and how much more, if they look away
flat out float disc_back; // of this disc
flat out uvec2 disc_rim;  // lines where it ends, packed; footprint, as bits
#endif
#ifdef WITH_PIXELS
uniform float smallest_cover; // larger discs replace the pixel of a point, in pixels
flat out uint disc_has_pixel;
#endif

vec3 rotate(vec3 v)
{
  EXACT vec3 rotated = rotation[0] * v.x + rotation[1] * v.y + rotation[2] * v.z;
  return rotated;
}

float dotExactly(vec3 a, vec3 b)
{
  EXACT float product = a.x * b.x + a.y * b.y + a.z * b.z;
  return product;
}

// Bends as the surface does where pixels show it, which depends on the unstretched
// radius; the plain C++ backend tells more.
void setDisc(uint index, vec3 c, float unstretched, float radius)
{
  vec3 direction = unpackDirection(look.x);
  EXACT float per_length = 1.0 / sqrt(dotExactly(direction, direction));
  EXACT vec3 n = direction * per_length;
  float sign = n.z < 0.0 ? -1.0 : 1.0;
  EXACT float p = -(1.0 / (sign + n.z));
  EXACT float q = n.x * n.y * p;
  EXACT float tangent_a = 1.0 + sign * (n.x * n.x * p);
  EXACT float tangent_b = sign + n.y * n.y * p;
  vec3 of_a = vec3(tangent_a, sign * q, -(sign * n.x));
  vec3 of_b = vec3(q, tangent_b, -n.y);
  vec3 a = rotate(of_a), b = rotate(of_b), axis = rotate(direction);
  float along = dotExactly(axis, c);
  float facing = outward * along;
  EXACT float per_along = 1.0 / along;
  EXACT float size = c.z * per_focal;
  EXACT vec2 tilt = axis.xy * (size * per_along);
  EXACT float towards = per_along * (1.0 / per_length);
  float ca = dotExactly(a, c), cb = dotExactly(b, c);
  EXACT vec2 eye_ward = vec2(ca, cb) * towards;
  EXACT vec2 line_a = size * a.xy - tilt * ca;
  EXACT vec2 line_b = size * b.xy - tilt * cb;
  EXACT float per_radius = 1.0 / (per_bend * footprint);
  EXACT vec3 whole = vec3(ivec3(uvec3(bend << 22, bend << 12, bend << 2)) >> 22) *
                     per_radius;
  EXACT float turn = (max(abs(whole.x), abs(whole.z)) + abs(whole.y)) * unstretched;
  EXACT float height = turn * (unstretched * (focal * (1.0 / c.z)));
  EXACT float steepness = dotExactly(c, c) * (towards * towards) - 1.0;
  EXACT float turning = turn * turn * steepness;
  bool is_bent = height > smallest_bend && turning > smallest_turn;
  disc_center = vec4(c, radius);
  disc_tilt = uvec3(floatBitsToUint(tilt), index);
  disc_axes = vec4(line_a, line_b);
  disc_slant = vec3(eye_ward, towards);
  disc_bend = is_bent ? whole : vec3(0.0);
#ifdef BLENDED
  float side = is_two_sided && facing > 0.0 ? -outward : outward;
  disc_normal = side * n;
  disc_turn_a = side * (whole.x * of_a + whole.y * of_b);
  disc_turn_b = side * (whole.y * of_a + whole.z * of_b);
  disc_color = unpackColor(look.y);
  disc_side = sideOf(look.y, has_sides && facing > 0.0);
#else
  disc_back = facing > 0.0 ? back + away_depth : back;
  disc_rim = uvec2(rim, floatBitsToUint(footprint));
#endif
}

float discRadius(vec3 c)
{
  EXACT float size = footprint * (focal * (1.0 / c.z));
  return size > largest_filler ? footprint : filler;
}

bool isDisc(vec3 c, float radius)
{
  EXACT float size = radius * (focal * (1.0 / c.z));
  return size > smallest_footprint;
}

#ifdef WITH_PIXELS
bool hasPixel(vec3 c, float radius)
{
  EXACT float size = radius * (focal * (1.0 / c.z));
  return !isDisc(c, radius) || size <= smallest_cover;
}
#endif

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
  vec3 c = toCamera();
  float unstretched = discRadius(c), radius = unstretched * stretch;
  bool is_disc = isDisc(c, unstretched) && !isLarge(c, radius);
  vec2 place = placeOf(c);
  setDisc(uint(gl_VertexID), c, unstretched, is_disc ? radius : 0.0);
  vec2 size = reach(c, radius);
  const float slack = 0.1; // hardware rounds corners
  gl_PointSize = is_disc ? 2.0 * max(size.x, size.y) + slack : 1.0;
  gl_Position = atPixel(is_disc ? place : floor(place) + 0.5);
  bool is_drawn = is_disc;
#ifdef WITH_PIXELS
  disc_has_pixel = uint(hasPixel(c, unstretched));
  is_drawn = is_drawn || disc_has_pixel == 1u;
#endif
  if (!is_drawn)
    gl_Position = nowhere;
  if (isHidden(c, outward * unpackDirection(look.x)))
    gl_Position = nowhere;
}
)";

// A rectangle around each large disc; all others have no extent.
const char* const large_discs_vertex = R"(
uniform int first; // index of the first instance

void main()
{
  vec3 c = toCamera();
  float unstretched = discRadius(c), radius = unstretched * stretch;
  setDisc(uint(first + gl_InstanceID), c, unstretched, radius);
  gl_Position = nowhere;
  if (isHidden(c, outward * unpackDirection(look.x)) || !isDisc(c, unstretched) || !isLarge(c, radius))
    return;
  vec2 low = origin, high = origin + extent;
  if (c.z - radius >= near) {
    vec2 place = placeOf(c);
    vec2 size = 1.0 + reach(c, radius);
    low = max(low, place - size);
    high = min(high, place + size);
  }
  if (all(lessThan(low, high)))
    gl_Position = atPixel(mix(low, high, vec2(gl_VertexID & 1, gl_VertexID >> 1)));
}
)";

const char* const disc_fragment = R"(
flat in vec4 disc_center;
flat in uvec3 disc_tilt;
flat in vec4 disc_axes;
flat in vec3 disc_slant;
flat in vec3 disc_bend;

// Where a ray meets the surface about a disc.
struct Place {
  bool is_covered;
  float depth;
  vec2 on_disc; // in the axes of the disc
  float part;   // of the squared radius
};

// As the plain C++ backend has it, which tells why.
Place findPlace()
{
  vec3 c = disc_center.xyz;
  vec2 tilt = uintBitsToFloat(disc_tilt.xy);
  vec3 bend = disc_bend;
  EXACT vec2 e = gl_FragCoord.xy - margin - placeOf(c);
  EXACT float toward = 1.0 + tilt.y * e.y + tilt.x * e.x;
  EXACT float per_toward = 1.0 / toward;
  EXACT float flat_a = (disc_axes.x * e.x + disc_axes.y * e.y) * per_toward;
  EXACT float flat_b = (disc_axes.z * e.x + disc_axes.w * e.y) * per_toward;
  EXACT float eye_a = disc_slant.x + flat_a * disc_slant.z;
  EXACT float eye_b = disc_slant.y + flat_b * disc_slant.z;
  EXACT float turn_a = bend.x * eye_a + bend.y * eye_b;
  EXACT float turn_b = bend.y * eye_a + bend.z * eye_b;
  EXACT float ahead = 1.0 + (turn_a * flat_a + turn_b * flat_b);
  EXACT float height = (bend.x * flat_a + 2.0 * (bend.y * flat_b)) * flat_a +
                       bend.z * flat_b * flat_b;
  EXACT float square = ahead * ahead - (eye_a * turn_a + eye_b * turn_b) * height;
  EXACT float sum = ahead + sqrt(max(square, 0.0));
  EXACT float sunk = height * (1.0 / sum);
  EXACT float a = flat_a - eye_a * sunk;
  EXACT float b = flat_b - eye_b * sunk;
  EXACT float sq_distance = a * a + b * b + sunk * sunk;
  EXACT float sq_radius = disc_center.w * disc_center.w;
  EXACT vec2 ray = (gl_FragCoord.xy - margin - center) * per_focal;
  EXACT float ray_length = sqrt(ray.x * ray.x + (ray.y * ray.y + 1.0));
  EXACT float there = c.z * (per_toward * (1.0 - sunk * disc_slant.z));
  EXACT float depth = there * ray_length * per_far;
  return Place(toward > 0.0 && sum > 0.0 && square >= 0.0 && sq_distance <= sq_radius,
               depth, vec2(a, b), sq_distance / sq_radius);
}
)";

// The pixel of the point itself is the nearer one of point and disc.
const char* const discs_fragment = R"(
flat in float disc_back;
flat in uvec2 disc_rim;
uniform int rim_depth_bits;
uniform int rim_directions;
#ifdef WITH_PIXELS
flat in uint disc_has_pixel;
#endif
layout(location = 0) out uvec2 state;

bool isOwnPixel()
{
  vec2 own = floor(placeOf(disc_center.xyz));
  return disc_center.w == 0.0 || floor(gl_FragCoord.xy - margin) == own;
}

// Along the axis of a corner of the square, of a place so many steps from it.
float towardsCorner(int steps)
{
  int half_way = rim_directions / 2;
  return float(abs((steps & (rim_directions - 1)) - half_way) - half_way / 2);
}

bool isInside(vec2 on_disc, uint line)
{
  int steps = 1 << rim_depth_bits;
  int depth = int(line) & (steps - 1);
  int direction = int(line >> rim_depth_bits);
  float a = towardsCorner(direction);
  float b = towardsCorner(direction - rim_directions / 4);
  float part = float(steps - depth) * (1.0 / float(steps));
  EXACT float most = uintBitsToFloat(disc_rim.y) * part * sqrt(a * a + b * b);
  EXACT float ahead = a * on_disc.x + b * on_disc.y;
  return depth == 0 || ahead <= most;
}

bool isBeforeRim(vec2 on_disc)
{
  return disc_rim.x == 0u || (isInside(on_disc, disc_rim.x & 0xffffu) &&
                              isInside(on_disc, disc_rim.x >> 16));
}

void main()
{
  Place place = findPlace();
  EXACT float disc_depth = place.depth + disc_center.w * (disc_back * per_far);
  float depth = place.is_covered && isBeforeRim(place.on_disc) ? disc_depth : 1.0;
#ifdef WITH_PIXELS
  if (disc_has_pixel == 1u && isOwnPixel())
    depth = min(depth, depthOf(disc_center.xyz));
#endif
  if (depth >= 1.0)
    discard;
  state = uvec2(floatBitsToUint(depth), disc_tilt.z);
  gl_FragDepth = depth;
}
)";

// The weight of a disc falls smoothly to zero at its rim. Where what is seen looks
// away, but lies behind discs that look to the eye, these are blended.
const char* const blend_fragment = R"(
uniform usampler2DRect states;
uniform usamplerBuffer looks; // packed normal, colour
uniform mat3 rotation;
uniform bool has_sides;
uniform samplerBuffer footprints;
uniform float outward;
uniform float away_depth;
uniform float edge_on_cosine;
uniform float facing_weight;
uniform float facing_reach;

flat in vec3 disc_normal;
flat in vec3 disc_turn_a;
flat in vec3 disc_turn_b;
flat in vec3 disc_color;
flat in uint disc_side;
layout(location = 0) out vec4 normal_weight;
layout(location = 1) out vec4 color;

void main()
{
  Place place = findPlace();
  uvec2 state = texture(states, gl_FragCoord.xy).xy;
  float seen = uintBitsToFloat(state.x);
  int point = state.x != background_bits ? int(state.y) : 0;
  uvec2 look = texelFetch(looks, point).xy;
  vec3 ray = vec3((gl_FragCoord.xy - margin - center) * per_focal, 1.0);
  vec3 direction = outward * unpackDirection(look.x);
  float along = dot(direction, ray * rotation);
  bool looks_away = has_sides && along > 0.0;
  bool is_edge_on = along * along < dot(direction, direction) * dot(ray, ray) *
                                        edge_on_cosine * edge_on_cosine;
  float room = disc_center.w * per_far;
  uint difference = sideOf(look.y, looks_away) ^ disc_side;
  // What looks away was drawn deeper than it is.
  float shift = texelFetch(footprints, point).r * (away_depth * per_far);
  bool is_before = difference == 1u && looks_away && is_edge_on &&
                   seen - shift > depthOf(disc_center.xyz);
  float most = is_before ? facing_reach * room : room;
  if (!place.is_covered || abs(place.depth - seen) > most || !(difference == 0u || is_before))
    discard;
  float rest = 1.0 - place.part;
  float weight = rest * rest * (is_before ? facing_weight : 1.0);
  vec3 normal =
    disc_normal + disc_turn_a * place.on_disc.x + disc_turn_b * place.on_disc.y;
  normal_weight = weight * vec4(normal, 1.0);
  color = weight * vec4(disc_color, 1.0);
}
)";

} // namespace

extern const Pass points{{camera, projection, points_vertex}, {points_fragment}};
extern const Pass small_discs{{camera, projection, disc_vertex, small_discs_vertex},
                              {camera, disc_fragment, discs_fragment}};
extern const Pass large_discs{{camera, projection, disc_vertex, large_discs_vertex},
                              {camera, disc_fragment, discs_fragment}};
extern const Pass blend_small{{camera, projection, disc_vertex, small_discs_vertex},
                              {camera, disc_fragment, blend_fragment}};
extern const Pass blend_large{{camera, projection, disc_vertex, large_discs_vertex},
                              {camera, disc_fragment, blend_fragment}};

} // namespace pcl_uvol::shaders
