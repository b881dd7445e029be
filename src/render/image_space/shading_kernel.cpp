// SPDX-License-Identifier: BSD-3-Clause
#include "render/image_space/shading_kernel.h"

#include "render/image_space/camera_lanes.h"

namespace pcl_uvol::PCL_UVOL_SIMD {

namespace {

Vector
scaled(const Vector& a, const Floats& factor)
{
  return {a.x * factor, a.y * factor, a.z * factor};
}

Vector
normalized(const Vector& a)
{
  return scaled(a, 1.0f / squareRoot(dot(a, a)));
}

/** Binary logarithm of positive numbers, to 1e-7. */
Floats
log2(const Floats& a)
{
  constexpr std::int32_t half_root = 0x3f3504f3; // sqrt(1/2)
  constexpr std::int32_t mantissa = 0x007fffff;
  const Ints shifted = bitsOf(a) - half_root;
  const Floats exponent = toFloats(shifted >> 23);
  const Floats m = fromBits((shifted & mantissa) + half_root); // sqrt(1/2) .. sqrt(2)
  // 2 artanh(t) / ln 2
  const Floats t = (m - 1.0f) / (m + 1.0f), t2 = t * t;
  return exponent +
         t * (2.8853901f + t2 * (0.96179669f + t2 * (0.57707802f + t2 * 0.41219859f)));
}

/** Power of two, to 1e-6; 0 for exponents below -126, none is above 127. */
Floats
exp2(const Floats& a)
{
  const Floats x = maximum(a, fill(-126.0f));
  const Ints whole = toInts(x - 0.5f); // rounds numbers up to zero
  const Floats f = (x - toFloats(whole)) * 0.69314718f;
  const Floats series =
      1.0f +
      f * (1.0f + f * (0.5f + f * (0.16666667f +
                                   f * (0.041666667f +
                                        f * (0.0083333333f + f * 0.0013888889f)))));
  const Floats power = series * fromBits((whole + 127) << 23);
  return a < -126.0f ? Floats{} : power;
}

/** Ids and depths of a register of pixels. */
struct Pixels {
  Ints id;
  Floats depth;

  explicit Pixels(const PixelKey* keys)
  {
    const Longs left = load<Longs>(keys), right = load<Longs>(keys + lanes / 2);
    id = lowerHalves(left, right);
    depth = fromBits(upperHalves(left, right));
  }
};

/** From the eye through the middle of a register of pixels. */
Vector
rays(const Shading& s, int column, int row)
{
  const Floats qx =
      (toFloats(laneNumbers() + column) + 0.5f - s.center_x) * s.per_focal;
  const float qy = (static_cast<float>(row) + 0.5f - s.center_y) * s.per_focal;
  const float* const r = s.rotation;
  return {qx * r[0] + (qy * r[3] + r[6]),
          qx * r[1] + (qy * r[4] + r[7]),
          qx * r[2] + (qy * r[5] + r[8])};
}

/** Light from one source added to the colours of a register of pixels. */
void
addLight(const Shading& s,
         const ShadingLight& light,
         const Vector& position,
         const Vector& normal,
         const Vector& to_eye,
         const Floats* surface,
         Floats* color)
{
  Vector l = {
      fill(light.position[0]), fill(light.position[1]), fill(light.position[2])};
  if (light.is_point)
    l = normalized({l.x - position.x, l.y - position.y, l.z - position.z});
  const Floats cosine = dot(normal, l);
  const Floats diffuse = maximum(cosine, Floats{}) * s.diffuse;
  Floats specular{};
  if (s.specular > 0.0f) {
    const Vector half = normalized({l.x + to_eye.x, l.y + to_eye.y, l.z + to_eye.z});
    const Floats toward = minimum(dot(normal, half), fill(1.0f));
    const Ints is_lit = (cosine > 0.0f) & (toward >= s.least_base);
    const Floats base = maximum(toward, fill(s.least_base));
    if (laneBits(is_lit) != 0)
      specular = is_lit ? exp2(log2(base) * s.shininess) * s.specular : Floats{};
  }
  for (int k = 0; k < 3; ++k)
    color[k] += light.color[k] * (surface[k] * diffuse + specular);
}

/** Normal, of any length, and colour of a register of pixels: what discs blended to, or
 * those of the point. */
void
look(const Shading& s,
     const Ints& id,
     const float* blended,
     Floats* normal,
     Floats* surface)
{
  unpackDirection(gatherEven(s.looks, id), normal);
  const Ints rgba = gatherEven(s.looks + 1, id);
  for (int k = 0; k < 3; ++k)
    surface[k] = toFloats((rgba >> (8 * k)) & 0xff);
  if (blended != nullptr) {
    alignas(64) float by_value[blended_values][lanes];
    for (int lane = 0; lane < lanes; ++lane)
      for (int k = 0; k < blended_values; ++k)
        by_value[k][lane] = blended[blended_values * lane + k];
    const auto sum = [&](int k) { return load<Floats>(by_value[k]); };
    const Ints is_blended = sum(6) > 0.0f;
    const Floats per_weight = 1.0f / sum(6);
    for (int k = 0; k < 3; ++k) {
      normal[k] = is_blended ? sum(k) : normal[k];
      surface[k] = is_blended ? sum(3 + k) * per_weight : surface[k];
    }
  }
  for (int k = 0; k < 3; ++k)
    surface[k] *= 1.0f / 255.0f;
}

/** The lit surface of a register of pixels. */
void
light(const Shading& s,
      const Pixels& pixels,
      const Vector& ray,
      const Vector& normal,
      const Floats* surface,
      Floats* color)
{
  const Floats distance = pixels.depth * s.far;
  const Vector position = scaled(ray, distance);
  for (int k = 0; k < 3; ++k)
    color[k] = surface[k] * s.ambient;
  const Vector to_eye = scaled(ray, fill(-1.0f));
  for (int i = 0; i < s.light_count; ++i)
    addLight(s, s.lights[i], position, normal, to_eye, surface, color);
}

void
storePixels(const ShadedRow& shaded,
            int i,
            const Ints& is_surface,
            const Floats* color,
            const Floats* normal)
{
  for (int k = 0; k < 3; ++k) {
    store(shaded.color[k] + i, is_surface ? clamp01(color[k]) : Floats{});
    if (shaded.normal[k] != nullptr)
      store(shaded.normal[k] + i, is_surface ? normal[k] : Floats{});
  }
}

} // namespace

void
shadeRow(const Shading& s,
         const PixelKey* keys,
         int column,
         int row,
         int count,
         const BlendSums& blended,
         const ShadedRow& shaded)
{
  for (int i = 0; i < count; i += lanes) {
    const Pixels pixels(keys + i);
    const Ints is_surface = pixels.id != -1;
    store(shaded.depth + i, is_surface ? pixels.depth : fill(1.0f));
    store(shaded.opacity + i, is_surface ? fill(1.0f) : Floats{});
    Floats color[3] = {fill(1.0f), fill(1.0f), fill(1.0f)}, n[3] = {};
    if (laneBits(is_surface) != 0) {
      const Ints id = is_surface ? pixels.id : Ints{};
      const bool has_discs =
          blended.marks != nullptr && blended.marks[i / blend_segment] != 0;
      Floats surface[3];
      look(
          s, id, has_discs ? blended.values + blended_values * i : nullptr, n, surface);
      Vector normal = normalized({n[0], n[1], n[2]});
      const Vector ray = normalized(rays(s, column + i, row));
      if (s.two_sided)
        normal = scaled(normal, dot(normal, ray) > 0.0f ? fill(-1.0f) : fill(1.0f));
      if (s.is_lit)
        light(s, pixels, ray, normal, surface, color);
      n[0] = normal.x;
      n[1] = normal.y;
      n[2] = normal.z;
    }
    storePixels(shaded, i, is_surface, color, n);
  }
}

} // namespace pcl_uvol::PCL_UVOL_SIMD
