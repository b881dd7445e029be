// SPDX-License-Identifier: BSD-3-Clause
#include "render/ray_tracing/ray_shader.h"

#include "common/constants.h"
#include "common/random.h"
#include "render/lighting.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_uvol {

namespace {

/** Angle between the points of a sunflower (Vogel 1979), which fill a disc evenly. */
const double golden_angle = pi * (3.0 - std::sqrt(5.0));

/** Rays that give less than a quarter of the finest step of an image are not sent. */
constexpr double least_weight = 1.0 / 1024.0;

/** Ambient light comes from surfaces no farther than this part of the scene's radius.
 */
constexpr double near_part = 0.2;

/** Least cosine to the plane of a surface at which a mirrored ray leaves it, which
 * normals that are not those of the plane might send it into. */
constexpr double least_rise = 1e-3;

/** Part of unpolarised light that is mirrored at the border of glass (Fresnel), and the
 * cosine of the angle behind it. */
struct Fresnel {
  double mirrored, cosine_behind;

  /** \param ratio of refractive indices, in front over behind
   * \param cosine of the angle of incidence */
  Fresnel(double ratio, double cosine)
  {
    const double sq_cosine = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if (sq_cosine <= 0.0) { // total reflection
      mirrored = 1.0;
      cosine_behind = 0.0;
      return;
    }
    cosine_behind = std::sqrt(sq_cosine);
    const double across =
        (ratio * cosine - cosine_behind) / (ratio * cosine + cosine_behind);
    const double along =
        (cosine - ratio * cosine_behind) / (cosine + ratio * cosine_behind);
    mirrored = 0.5 * (across * across + along * along);
  }
};

/** \param rotation from the scene's directions to the camera's: right, down, forward */
Light
inScene(Light light, const Camera& camera, const Eigen::Matrix3d& rotation)
{
  if (!light.follows_camera)
    return light;
  const Eigen::Vector3d& p = light.position;
  light.position = rotation.transpose() * Eigen::Vector3d(p.x(), -p.y(), -p.z());
  if (light.kind == Light::Kind::Point)
    light.position += camera.eye;
  light.follows_camera = false;
  return light;
}

/** Two directions perpendicular to a third one and to each other, of length 1. */
struct Axes {
  Eigen::Vector3d u, v;

  explicit Axes(const Eigen::Vector3d& direction)
      : u(direction.unitOrthogonal())
      , v(direction.cross(u))
  {
  }
};

} // namespace

RayShader::RayShader(const World& world,
                     const RayTracingSettings& settings,
                     const Camera& camera)
    : world_(world)
    , settings_(settings)
    , eye_(settings.cull_back_faces ? &camera.eye : nullptr)
    , occlusion_distance_(settings.occlusion_distance > 0.0
                              ? settings.occlusion_distance
                              : near_part * world.bounds().radius)
{
  const Eigen::Matrix3d rotation = camera.rotation();
  for (const Light& light : world.scene().lights)
    lights_.push_back(inScene(light, camera, rotation));
}

double
RayShader::random()
{
  return uniformAt(ray_number_, draws_++, 0);
}

RayStart
RayShader::startOn(const Seen& seen)
{
  return {seen.hit.splat_object, seen.plane_normal, seen.from_outside};
}

Eigen::Vector3d
RayShader::backgroundAt(double height) const
{
  const Background& background = world_.scene().background;
  const Eigen::Vector3d below = toVector(background.color);
  if (background.kind != Background::Kind::Gradient)
    return below;
  return below + height * (toVector(background.top) - below);
}

double
RayShader::visibility(const Light& light,
                      const Seen& seen,
                      const Eigen::Vector3d& towards)
{
  if (!settings_.shadows)
    return 1.0;
  const Eigen::Vector3d start = seen.hit.position + seen.hit.lift * seen.plane_normal;
  const bool is_point = light.kind == Light::Kind::Point;
  const Eigen::Vector3d to_center =
      is_point ? Eigen::Vector3d(light.position - start) : towards.normalized();
  const auto transmission = [&](const Eigen::Vector3d& to_source) {
    const double distance = to_source.norm();
    ++counts_.shadow;
    return world_.transmission({start, to_source / distance, eye_, startOn(seen)},
                               is_point ? distance
                                        : std::numeric_limits<double>::infinity());
  };
  if (light.radius == 0.0)
    return transmission(to_center);
  const Axes axes(to_center.normalized());
  const double turn = 2.0 * pi * random();
  double sum = 0.0;
  for (int i = 0; i < settings_.light_samples; ++i) {
    const double r = light.radius * std::sqrt((i + 0.5) / settings_.light_samples);
    const double angle = turn + i * golden_angle;
    sum += transmission(to_center + r * std::cos(angle) * axes.u +
                        r * std::sin(angle) * axes.v);
  }
  return sum / settings_.light_samples;
}

double
RayShader::openness(const Seen& seen)
{
  if (settings_.occlusion_samples == 0)
    return 1.0;
  const Eigen::Vector3d start = seen.hit.position + seen.hit.lift * seen.plane_normal;
  const Axes axes(seen.normal);
  const double turn = 2.0 * pi * random();
  int open = 0;
  for (int i = 0; i < settings_.occlusion_samples; ++i) {
    // As many to a direction as its cosine is large: points of a disc, seen from below.
    const double sq_r = (i + 0.5) / settings_.occlusion_samples;
    const double angle = turn + i * golden_angle, r = std::sqrt(sq_r);
    const Eigen::Vector3d direction = r * std::cos(angle) * axes.u +
                                      r * std::sin(angle) * axes.v +
                                      std::sqrt(1.0 - sq_r) * seen.normal;
    ++counts_.shadow;
    open += direction.dot(seen.plane_normal) > 0.0 &&
                    !world_.isBlocked({start, direction, eye_, startOn(seen)},
                                      occlusion_distance_)
                ? 1
                : 0;
  }
  return static_cast<double>(open) / settings_.occlusion_samples;
}

Eigen::Vector3d
RayShader::reflectLight(const Seen& seen)
{
  const RayMaterial& material = *seen.hit.material;
  // What is mirrored or let through is not scattered.
  const double scattered = 1.0 - material.reflectivity - material.transparency;
  Eigen::Vector3d color = Eigen::Vector3d::Zero();
  if (scattered > 0.0 && material.ambient > 0.0)
    color = scattered * material.ambient * openness(seen) * seen.hit.color;
  for (const Light& light : lights_) {
    const bool is_point = light.kind == Light::Kind::Point;
    const Eigen::Vector3d towards =
        is_point ? Eigen::Vector3d(light.position - seen.hit.position) : light.position;
    const Eigen::Vector3d direction = towards.normalized();
    const double cosine = seen.normal.dot(direction);
    if (!(cosine > 0.0))
      continue;
    const double visible = visibility(light, seen, towards);
    if (visible == 0.0)
      continue;
    const Eigen::Vector3d half = (direction + seen.towards_eye).normalized();
    const double highlight =
        material.specular *
        std::pow(std::max(0.0, seen.normal.dot(half)), material.shininess);
    color += visible *
             toVector(light.color)
                 .cwiseProduct(scattered * material.diffuse * cosine * seen.hit.color +
                               Eigen::Vector3d::Constant(highlight));
  }
  return color;
}

void
RayShader::send(const Seen& seen,
                const Eigen::Vector3d& direction,
                bool to_same_side,
                const Eigen::Vector3d& weight,
                int depth)
{
  if (!(weight.maxCoeff() > least_weight))
    return;
  const Eigen::Vector3d out = to_same_side ? seen.plane_normal : -seen.plane_normal;
  Eigen::Vector3d leaving = direction;
  const double rise = direction.dot(out);
  if (rise < least_rise)
    leaving = (direction + (least_rise - rise) * out).normalized();
  ++counts_.secondary;
  pending_.push_back({{seen.hit.position + seen.hit.lift * out,
                       leaving,
                       eye_,
                       {seen.hit.splat_object, out, seen.from_outside == to_same_side}},
                      weight,
                      depth});
}

void
RayShader::sendOn(const Seen& seen, const Pending& from)
{
  const RayMaterial& material = *seen.hit.material;
  if (from.depth >= settings_.depth ||
      material.reflectivity + material.transparency == 0.0)
    return;
  const Eigen::Vector3d& d = from.ray.direction;
  const double cosine = std::clamp(-d.dot(seen.normal), 0.0, 1.0);
  const double index = material.refractive_index;
  const double ratio = seen.from_outside ? 1.0 / index : index;
  double mirrored = material.reflectivity, let_through = material.transparency;
  if (let_through > 0.0) {
    const Fresnel fresnel(ratio, cosine);
    mirrored += let_through * fresnel.mirrored;
    let_through *= 1.0 - fresnel.mirrored;
    // Snell's law as vectors.
    const Eigen::Vector3d behind =
        (ratio * d + (ratio * cosine - fresnel.cosine_behind) * seen.normal)
            .normalized();
    send(seen, behind, false, let_through * from.weight, from.depth + 1);
  }
  const Eigen::Vector3d mirror = d + 2.0 * cosine * seen.normal;
  send(seen, mirror.normalized(), true, mirrored * from.weight, from.depth + 1);
}

ShadedRay
RayShader::shade(const Ray& ray, double height, std::uint64_t number)
{
  ray_number_ = number;
  draws_ = 0;
  ++counts_.primary;
  Eigen::Vector3d color = Eigen::Vector3d::Zero(), normal = color;
  double opacity = 1.0;
  pending_.push_back({{ray.origin, ray.direction, eye_}, Eigen::Vector3d::Ones(), 0});
  while (!pending_.empty()) {
    const Pending next = pending_.back();
    pending_.pop_back();
    Seen seen;
    if (!world_.intersect(next.ray, hits_, seen.hit)) {
      const bool is_primary = next.depth == 0;
      if (is_primary && world_.scene().background.kind == Background::Kind::Transparent)
        opacity = 0.0;
      // What mirrors show is a dome of the same colours.
      const double at = is_primary ? height : 0.5 * (1.0 + next.ray.direction.z());
      color += next.weight.cwiseProduct(backgroundAt(at));
      continue;
    }
    if (next.depth == 0)
      normal = seen.hit.normal;
    seen.from_outside =
        next.ray.direction.dot(seen.hit.plane_normal) < seen.hit.grazing;
    const double side = seen.from_outside ? 1.0 : -1.0;
    seen.towards_eye = -next.ray.direction;
    seen.normal = side * seen.hit.normal;
    seen.plane_normal = side * seen.hit.plane_normal;
    color += next.weight.cwiseProduct(reflectLight(seen));
    sendOn(seen, next);
  }
  return {{color[0], color[1], color[2], opacity}, normal};
}

} // namespace pcl_uvol
