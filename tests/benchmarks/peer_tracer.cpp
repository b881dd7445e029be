// SPDX-License-Identifier: BSD-3-Clause
#include "peer_tracer.h"

#include "common/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace uvol_bench {

namespace {

constexpr float lift = 1e-5f;

} // namespace

bool
PeerTracer::intersect(const PeerRay& ray,
                      Eigen::Vector3f& place,
                      Eigen::Vector3f& normal,
                      Eigen::Vector3f& plane_normal) const
{
  Hits hits;
  collect(ray, hits);
  normal.setZero();
  const Hit* nearest = nullptr;
  const Hit* first = nullptr;
  for (int i = 0; i < hits.count; ++i)
    if (first == nullptr || hits.items[i].distance < first->distance)
      first = &hits.items[i];
  if (first == nullptr)
    return false;
  const Eigen::Vector3f side = splats_[first->splat].getNormalVector3fMap();
  float offset_of_nearest = infinity;
  for (int i = 0; i < hits.count; ++i) {
    const Hit& hit = hits.items[i];
    const pcl_uvol::PointSplat& splat = splats_[hit.splat];
    if (hit.distance > hits.limit || !(splat.getNormalVector3fMap().dot(side) > 0.0f))
      continue;
    const float offset = std::sqrt(hit.sq_offset) / splat.radius;
    if (offset < offset_of_nearest) {
      offset_of_nearest = offset;
      nearest = &hit;
    }
    const Eigen::Vector3f u = splat.getTangentVector3fMap(),
                          n = splat.getNormalVector3fMap(), v = n.cross(u),
                          d = ray.origin + hit.distance * ray.direction -
                              splat.getVector3fMap();
    normal += std::max(0.0f, 1.0f - offset) *
              (n + (splat.tilt_u + splat.slope_u * d.dot(u) / splat.radius) * u +
               (splat.tilt_v + splat.slope_v * d.dot(v) / splat.radius) * v)
                  .normalized();
  }
  normal.normalize();
  place = ray.origin + nearest->distance * ray.direction;
  plane_normal = splats_[nearest->splat].getNormalVector3fMap();
  return true;
}

void
PeerTracer::render(const pcl_uvol::Camera& camera,
                   int size,
                   int depth,
                   float mirrored,
                   unsigned threads,
                   pcl_uvol::Image& image) const
{
  image.width = image.height = static_cast<std::uint32_t>(size);
  image.color.resize(4 * image.pixels());
  const Eigen::Matrix3f axes = camera.rotation().cast<float>();
  const Eigen::Vector3f light =
      (axes.transpose() * Eigen::Vector3f(-0.4f, -0.5f, -0.8f)).normalized();
  const auto half =
      static_cast<float>(std::tan(camera.vertical_fov * 3.14159265358979 / 360.0));
  constexpr int tile = 16;
  const int columns = (size + tile - 1) / tile;
  pcl_uvol::parallelBlocks(
      static_cast<std::size_t>(columns * columns),
      1,
      threads,
      [&](std::size_t number, std::size_t) {
        const int left = static_cast<int>(number) % columns * tile;
        const int top = static_cast<int>(number) / columns * tile;
        for (int row = top; row < std::min(size, top + tile); ++row)
          for (int column = left; column < std::min(size, left + tile); ++column) {
            const float x = (2.0f * (column + 0.5f) / size - 1.0f) * half;
            const float y = (2.0f * (row + 0.5f) / size - 1.0f) * half;
            PeerRay ray{camera.eye.cast<float>(),
                        (axes.row(2) + x * axes.row(0) + y * axes.row(1))
                            .transpose()
                            .normalized()};
            Eigen::Vector3f color = Eigen::Vector3f::Zero();
            float weight = 1.0f;
            for (int bounce = 0; bounce <= depth; ++bounce) {
              Eigen::Vector3f place, normal, plane_normal;
              if (!intersect(ray, place, normal, plane_normal)) {
                color.array() += weight;
                break;
              }
              if (plane_normal.dot(ray.direction) > 0.0f) {
                normal = -normal;
                plane_normal = -plane_normal;
              }
              ray.origin = place + lift * plane_normal;
              ray.own_normal = plane_normal;
              float shade = 0.18f, highlight = 0.0f;
              const float cosine = normal.dot(light);
              if (cosine > 0.0f && !isBlocked({ray.origin, light, ray.own_normal})) {
                shade += 0.75f * cosine;
                const Eigen::Vector3f halfway = (light - ray.direction).normalized();
                highlight =
                    0.22f * std::pow(std::max(0.0f, normal.dot(halfway)), 40.0f);
              }
              color += weight * ((1.0f - mirrored) * shade *
                                     Eigen::Vector3f(0.8f, 0.78f, 0.74f) +
                                 Eigen::Vector3f::Constant(highlight));
              weight *= mirrored;
              ray.direction -= 2.0f * ray.direction.dot(normal) * normal;
            }
            std::uint8_t* const pixel =
                &image.color[4 * static_cast<std::size_t>(row * size + column)];
            for (int k = 0; k < 3; ++k)
              pixel[k] = static_cast<std::uint8_t>(
                  std::lround(255.0f * std::min(color[k], 1.0f)));
            pixel[3] = 255;
          }
      });
}

} // namespace uvol_bench
