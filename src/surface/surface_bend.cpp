// SPDX-License-Identifier: BSD-3-Clause
#include "surface/surface_bend.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

namespace {

/** In parts of the squares of all values: what a bend has to explain of them. */
constexpr float least_explained = 0.5f;

} // namespace

Eigen::Matrix<float, 3, 2>
tangentAxes(PackedNormal normal)
{
  // Duff et al. 2017, with the sign of what kernels unpack: to the last bit, for
  // normals of flat drawings have no third coordinate.
  constexpr float scale = 1.0f / packed_normal_scale;
  const auto part = [](std::uint32_t bits) {
    return std::abs(static_cast<float>(static_cast<std::int16_t>(bits)) * scale);
  };
  const float sign =
      1.0f - part(normal & 0xffff) - part(normal >> 16) < 0.0f ? -1.0f : 1.0f;
  float n[3];
  unpackNormal(normal, n);
  const float a = -1.0f / (sign + n[2]), b = n[0] * n[1] * a;
  Eigen::Matrix<float, 3, 2> axes;
  axes << 1.0f + sign * n[0] * n[0] * a, b, sign * b, sign + n[1] * n[1] * a,
      -sign * n[0], -n[1];
  return axes;
}

PackedBend
packBend(const SurfaceBend& bend, float radius)
{
  const SurfaceBend over_disc = bend * radius;
  const float largest = over_disc.cwiseAbs().maxCoeff();
  const float scale = packed_bend_scale * most_bend / std::max(largest, most_bend);
  PackedBend packed = 0;
  for (int i = 0; i < 3; ++i) {
    const auto whole = static_cast<std::uint32_t>(std::lround(scale * over_disc[i]));
    packed |= (whole & 0x3ff) << (10 * i);
  }
  return packed;
}

void
BendFit::addEquation(const Eigen::Vector3f& row, float value, float weight)
{
  squares_ += weight * row * row.transpose();
  products_ += weight * value * row;
  sq_values_ += weight * value * value;
}

void
BendFit::add(const Eigen::Vector2f& offset, const Eigen::Vector2f& turn, float height)
{
  const float length = offset.norm();
  if (length == 0.0f)
    return;
  const float u = offset[0], v = offset[1];
  const float weight = 1.0f / std::max(length * length, sq_near_);
  addEquation({u, v, 0.0f}, turn[0], weight);
  addEquation({0.0f, u, v}, turn[1], weight);
  addEquation(Eigen::Vector3f(u * u, 2.0f * u * v, v * v) / length,
              -2.0f * height / length,
              weight);
}

SurfaceBend
BendFit::solve() const
{
  const SurfaceBend bend = squares_.fullPivLu().solve(products_);
  return bend.dot(products_) >= least_explained * sq_values_ ? bend
                                                             : SurfaceBend::Zero();
}

} // namespace pcl_uvol
