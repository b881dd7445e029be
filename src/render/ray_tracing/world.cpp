// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracing/world.h"

#include "render/lighting.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace pcl_uvol {

namespace {

/** Rounding of places on splats, which are floats, in parts of the scene. */
constexpr double float_rounding = 1e-6;

/** A ray that starts on a splat which lies below the surface has to get over those that
 * lie above it. */
constexpr double lift_in_thicknesses = 2.0;

/** Distance to a sphere in front of the ray. */
std::optional<double>
meetSphere(const SphereObject& sphere, const Ray& ray)
{
  const Eigen::Vector3d offset = ray.origin - sphere.center;
  const double b = offset.dot(ray.direction);
  const Eigen::Vector3d nearest = offset - b * ray.direction;
  const double rest = sphere.radius * sphere.radius - nearest.squaredNorm();
  if (!(rest >= 0.0))
    return std::nullopt;
  const double half = std::sqrt(rest);
  if (-b - half > 0.0)
    return -b - half;
  if (-b + half > 0.0)
    return -b + half;
  return std::nullopt;
}

std::optional<double>
meetPlane(const PlaneObject& plane, const Ray& ray)
{
  const double distance =
      (plane.point - ray.origin).dot(plane.normal) / ray.direction.dot(plane.normal);
  if (distance > 0.0 && std::isfinite(distance))
    return distance;
  return std::nullopt;
}

/** One of two colours on a chessboard. */
Eigen::Vector3d
colorOf(const PlaneObject& plane, const Eigen::Vector3d& position)
{
  if (plane.square > 0.0) {
    const Eigen::Vector3d u = plane.normal.unitOrthogonal(),
                          v = plane.normal.cross(u).normalized(),
                          offset = position - plane.point;
    const double squares = std::floor(offset.dot(u) / plane.square) +
                           std::floor(offset.dot(v) / plane.square);
    if (std::fmod(squares, 2.0) != 0.0)
      return toVector(plane.other_color);
  }
  return toVector(plane.material.color);
}

bool
startsOn(const Ray& ray, std::size_t splat_object)
{
  return ray.start.splat_object == static_cast<int>(splat_object);
}

/** A ball around balls: about the centre of their box. */
BoundingSphere
findBounds(const Scene& scene, const std::vector<SplatTree>& trees)
{
  std::vector<BoundingSphere> balls;
  for (const SplatTree& tree : trees)
    balls.push_back(tree.bounds());
  for (const SphereObject& sphere : scene.spheres)
    balls.push_back({sphere.center, sphere.radius});
  if (balls.empty())
    return {scene.planes.front().point, 1.0};
  Eigen::Array3d low = balls[0].center.array() - balls[0].radius,
                 high = balls[0].center.array() + balls[0].radius;
  for (const BoundingSphere& ball : balls) {
    low = low.min(ball.center.array() - ball.radius);
    high = high.max(ball.center.array() + ball.radius);
  }
  BoundingSphere bounds{0.5 * (low + high), 0.0};
  for (const BoundingSphere& ball : balls)
    bounds.radius =
        std::max(bounds.radius, (ball.center - bounds.center).norm() + ball.radius);
  return bounds;
}

} // namespace

World::World(Scene&& scene, unsigned threads, Report& report)
{
  std::uint64_t splats = 0;
  for (const SplatObject& object : scene.splats)
    splats += object.splats->size();
  StepTimer step(report, "build", splats);
  for (const SplatObject& object : scene.splats)
    trees_.emplace_back(object, threads, step);
  scene_ = std::move(scene);
  for (PlaneObject& plane : scene_.planes)
    plane.normal.normalize();
  bounds_ = findBounds(scene_, trees_);
  rounding_ = float_rounding * bounds_.radius;
}

bool
World::intersect(const Ray& ray, std::vector<SplatHit>& hits, SurfaceHit& hit) const
{
  hit.distance = std::numeric_limits<double>::infinity();
  hit.normal.setZero();
  hit.material = nullptr;
  hit.lift = rounding_;
  hit.grazing = 0.0;
  hit.splat_object = -1;
  for (const SphereObject& sphere : scene_.spheres)
    if (const auto distance = meetSphere(sphere, ray))
      if (*distance < hit.distance) {
        hit.distance = *distance;
        hit.normal =
            (ray.origin + *distance * ray.direction - sphere.center) / sphere.radius;
        hit.color = toVector(sphere.material.color);
        hit.material = &sphere.material;
      }
  for (const PlaneObject& plane : scene_.planes)
    if (const auto distance = meetPlane(plane, ray))
      if (*distance < hit.distance) {
        hit.distance = *distance;
        hit.normal = plane.normal;
        hit.color = colorOf(plane, ray.origin + *distance * ray.direction);
        hit.material = &plane.material;
      }
  hit.plane_normal = hit.normal;
  SplatSurfaceHit splats;
  for (std::size_t i = 0; i < trees_.size(); ++i)
    if (trees_[i].intersect(
            ray, startsOn(ray, i), near(), hit.distance, hits, splats)) {
      hit.distance = splats.distance;
      hit.normal = splats.normal;
      hit.plane_normal = splats.plane_normal;
      hit.color = splats.color;
      hit.material = &scene_.splats[i].material;
      hit.grazing = splats.bend;
      hit.splat_object = static_cast<int>(i);
      hit.lift = rounding_ + lift_in_thicknesses * splats.thickness;
    }
  hit.position = ray.origin + hit.distance * ray.direction;
  return hit.material != nullptr;
}

bool
World::isBlockedBy(std::size_t splat_object, const Ray& ray, double distance) const
{
  return trees_[splat_object].isBlocked(
      ray, startsOn(ray, splat_object), near(), distance);
}

double
World::transmission(const Ray& ray, double distance) const
{
  double part = 1.0;
  for (const SphereObject& sphere : scene_.spheres)
    if (meetSphere(sphere, ray).value_or(distance) < distance)
      part *= sphere.material.transparency;
  for (const PlaneObject& plane : scene_.planes)
    if (meetPlane(plane, ray).value_or(distance) < distance)
      part *= plane.material.transparency;
  for (std::size_t i = 0; i < trees_.size() && part > 0.0; ++i)
    if (isBlockedBy(i, ray, distance))
      part *= scene_.splats[i].material.transparency;
  return part;
}

bool
World::isBlocked(const Ray& ray, double distance) const
{
  for (std::size_t i = 0; i < trees_.size(); ++i)
    if (isBlockedBy(i, ray, distance))
      return true;
  const auto meets = [&](const std::optional<double>& met) {
    return met.value_or(distance) < distance;
  };
  return std::any_of(
             scene_.spheres.begin(),
             scene_.spheres.end(),
             [&](const auto& sphere) { return meets(meetSphere(sphere, ray)); }) ||
         std::any_of(scene_.planes.begin(),
                     scene_.planes.end(),
                     [&](const auto& plane) { return meets(meetPlane(plane, ray)); });
}

} // namespace pcl_uvol
