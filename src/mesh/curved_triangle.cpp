// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/curved_triangle.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl_uvol::detail {

namespace {

/** Cosine of the angle between normals, and sine of that between a normal and the plane
 * at right angles to the edge, beyond which an edge stays straight. @{ */
constexpr double least_bend_agreement = 0.5, steepest = 0.7071067811865476;
/** @} */

/** Share of the bulge of a triangle, and of its area, per square and per fourth power
 * of the angle between normals: more than quadratic triangles leave out on spheres and
 * tori.
 * @{ */
constexpr double missed_bulge = 0.1, missed_area = 0.01;
/** @} */

constexpr double far_place = 0.44594849091596488632,
                 far_weight = 0.22338158967801146570;
constexpr double near_place = 0.09157621350977074346,
                 near_weight = 0.10995174365532186764;
constexpr std::array<QuadraturePoint, 6> quadrature = {{
    {{far_place, far_place, 1.0 - 2.0 * far_place}, far_weight},
    {{far_place, 1.0 - 2.0 * far_place, far_place}, far_weight},
    {{1.0 - 2.0 * far_place, far_place, far_place}, far_weight},
    {{near_place, near_place, 1.0 - 2.0 * near_place}, near_weight},
    {{near_place, 1.0 - 2.0 * near_place, near_place}, near_weight},
    {{1.0 - 2.0 * near_place, near_place, near_place}, near_weight},
}};

bool
isBent(const SurfaceCorner& a, const SurfaceCorner& b)
{
  const Eigen::Vector3d edge = b.place - a.place;
  const double most = steepest * edge.norm();
  return a.normal.dot(b.normal) >= least_bend_agreement &&
         std::abs(edge.dot(a.normal)) <= most && std::abs(edge.dot(b.normal)) <= most;
}

/** From the middle of an edge to that of the arc at right angles to the mean of the
 * normals; sines of the half angle that it spans are those of edge and normals. */
Eigen::Vector3d
bulgeOf(const SurfaceCorner& a, const SurfaceCorner& b)
{
  const Eigen::Vector3d edge = b.place - a.place;
  const double length = edge.norm();
  if (length == 0.0)
    return Eigen::Vector3d::Zero();
  const double sine = (edge.dot(b.normal) - edge.dot(a.normal)) / (2.0 * length);
  const double height = 0.5 * length * sine / (1.0 + std::sqrt(1.0 - sine * sine));
  return height * (a.normal + b.normal).normalized();
}

} // namespace

bool
isOnCap(const std::array<SurfaceCorner, 3>& corners)
{
  return corners[0].is_on_cap || corners[1].is_on_cap || corners[2].is_on_cap;
}

const std::array<QuadraturePoint, 6>&
triangleQuadrature()
{
  return quadrature;
}

void
SurfaceIntegrals::add(const SurfaceIntegrals& other, double part)
{
  area += part * other.area;
  area_moment += part * other.area_moment;
  area_products += part * other.area_products;
  volume += part * other.volume;
  moment += part * other.moment;
  products += part * other.products;
  below += part * other.below;
  flux += part * other.flux;
  is_solid = is_solid && other.is_solid;
  // What a negative part takes away is no better known than what it is taken from.
  area_error += std::abs(part) * other.area_error;
  volume_error += std::abs(part) * other.volume_error;
  undetermined_area += std::abs(part) * other.undetermined_area;
  undetermined_volume += std::abs(part) * other.undetermined_volume;
}

SurfaceIntegrals
SurfaceIntegrals::shifted(const Eigen::Vector3d& offset) const
{
  SurfaceIntegrals result = *this;
  const auto shift =
      [&](double whole, Eigen::Vector3d& first, Eigen::Matrix3d& second) {
        const Eigen::Matrix3d mixed = offset * first.transpose();
        second += mixed + mixed.transpose() + whole * offset * offset.transpose();
        first += whole * offset;
      };
  shift(area, result.area_moment, result.area_products);
  shift(volume, result.moment, result.products);
  return result;
}

CurvedTriangle::CurvedTriangle(const std::array<SurfaceCorner, 3>& corners,
                               const Eigen::Vector3d& center,
                               const EdgePlanes& planes)
{
  const bool is_cap = isOnCap(corners);
  for (std::size_t i = 0; i < 3; ++i) {
    SurfaceCorner a = corners[(i + 1) % 3], b = corners[(i + 2) % 3];
    flat_[i] = bent_[i] = corners[i].place - center;
    flat_[3 + i] = bent_[3 + i] = 0.5 * (a.place + b.place) - center;
    const bool is_bound = !planes[i].isZero(0.0);
    if (is_bound)
      for (SurfaceCorner* const end : {&a, &b})
        end->normal =
            (end->normal - planes[i].dot(end->normal) * planes[i]).stableNormalized();
    if ((is_cap && !is_bound) || !isBent(a, b))
      continue;
    bent_[3 + i] += bulgeOf(a, b);
    sq_turn_ = std::max(sq_turn_, (b.normal - a.normal).squaredNorm());
  }
}

SurfaceIntegrals
CurvedTriangle::integrate(const Nodes& nodes, std::array<double, 3>& shares)
{
  SurfaceIntegrals sum;
  shares.fill(0.0);
  for (const auto& [lambda, weight] : quadrature) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    std::array<Eigen::Vector3d, 3> slope; // by each of the three coordinates
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      place += lambda[i] * (2.0 * lambda[i] - 1.0) * nodes[i] +
               4.0 * lambda[j] * lambda[k] * nodes[3 + i];
      slope[i] = (4.0 * lambda[i] - 1.0) * nodes[i] +
                 4.0 * (lambda[k] * nodes[3 + j] + lambda[j] * nodes[3 + k]);
    }
    const Eigen::Vector3d normal =
        0.5 * weight * (slope[1] - slope[0]).cross(slope[2] - slope[0]);
    const double area = normal.norm(), cone = place.dot(normal);
    const Eigen::Matrix3d product = place * place.transpose();
    sum.area += area;
    sum.area_moment += area * place;
    sum.area_products += area * product;
    sum.volume += cone / 3.0;
    sum.moment += cone / 4.0 * place;
    sum.products += cone / 5.0 * product;
    sum.below += place[2] * normal[2];
    sum.flux += normal[2];
    for (std::size_t i = 0; i < 3; ++i)
      shares[i] += area * lambda[i];
  }
  return sum;
}

SurfaceIntegrals
CurvedTriangle::integrate(std::array<double, 3>& shares) const
{
  SurfaceIntegrals sum = integrate(bent_, shares);
  double bulge = 0.0;
  for (std::size_t i = 3; i < 6; ++i)
    bulge += (bent_[i] - flat_[i]).norm() / 3.0;
  sum.volume_error = missed_bulge * sq_turn_ * bulge * sum.area;
  sum.area_error = missed_area * sq_turn_ * sq_turn_ * sum.area;
  return sum;
}

SurfaceIntegrals
CurvedTriangle::integrateFlat(std::array<double, 3>& shares) const
{
  const SurfaceIntegrals bent = integrate(bent_, shares);
  SurfaceIntegrals sum = integrate(flat_, shares);
  sum.area_error = std::abs(bent.area - sum.area);
  sum.volume_error = std::abs(bent.volume - sum.volume);
  return sum;
}

} // namespace pcl_uvol::detail
