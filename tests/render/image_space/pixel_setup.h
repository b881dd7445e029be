// SPDX-License-Identifier: BSD-3-Clause
// What the tests of image-space kernels share: keys of pixels, a camera, random
// numbers.
#pragma once

#include "src/render/image_space/projection_kernel.h"
#include "surface/packed_normal.h"
#include "surface/rim_lines.h"
#include "surface/surface_bend.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace uvol_test {

inline pcl_uvol::PixelKey
makeKey(float depth, std::uint32_t point)
{
  std::uint32_t bits;
  std::memcpy(&bits, &depth, sizeof bits);
  return static_cast<pcl_uvol::PixelKey>(std::uint64_t(bits) << 32 | point);
}

inline float
readDepth(pcl_uvol::PixelKey key)
{
  const auto bits = static_cast<std::uint32_t>(static_cast<std::uint64_t>(key) >> 32);
  float depth;
  std::memcpy(&depth, &bits, sizeof depth);
  return depth;
}

inline std::uint32_t
readPoint(pcl_uvol::PixelKey key)
{
  return static_cast<std::uint32_t>(key);
}

/** \brief Numbers of a seed. */
class PixelRandom {
public:
  explicit PixelRandom(std::uint64_t seed)
      : engine_(seed)
  {
  }

  /** \brief A multiple of 1 / 4096 of the range. */
  float
  between(double low, double high)
  {
    return static_cast<float>(low + (high - low) *
                                        static_cast<double>(engine_() % 4096) / 4096.0);
  }

  std::uint32_t
  below(std::uint32_t end)
  {
    return static_cast<std::uint32_t>(engine_() % end);
  }

  Eigen::Vector3d
  direction()
  {
    for (;;) {
      const Eigen::Vector3d v(between(-1, 1), between(-1, 1), between(-1, 1));
      if (v.norm() > 0.1 && v.norm() < 1.0)
        return v.normalized();
    }
  }

private:
  std::mt19937_64 engine_;
};

/** \brief What kernels read of points. */
struct PointArrays {
  std::vector<float> x[3], radii, footprints;
  std::vector<std::uint32_t> normals, bends, rims;

  void
  add(const Eigen::Vector3d& place,
      const Eigen::Vector3d& normal,
      float radius,
      const pcl_uvol::SurfaceBend& bend = pcl_uvol::SurfaceBend::Zero(),
      const pcl_uvol::RimLines& rim = {})
  {
    const Eigen::Vector3f n = normal.cast<float>();
    for (int axis = 0; axis < 3; ++axis)
      x[axis].push_back(static_cast<float>(place[axis]));
    normals.push_back(pcl_uvol::packNormal(n.data()));
    radii.push_back(radius);
    footprints.push_back(radius);
    bends.push_back(pcl_uvol::packBend(bend, radius));
    rims.push_back(pcl_uvol::packRim(rim, radius));
  }

  std::size_t
  size() const
  {
    return radii.size();
  }

  Eigen::Vector3d
  place(std::size_t i) const
  {
    return {x[0][i], x[1][i], x[2][i]};
  }

  Eigen::Vector3d
  normal(std::size_t i) const
  {
    Eigen::Vector3f n;
    pcl_uvol::unpackNormal(normals[i], n.data());
    return n.cast<double>();
  }

  pcl_uvol::ProjectedPoints
  view(float stretch) const
  {
    return {{x[0].data(), x[1].data(), x[2].data()},
            normals.data(),
            radii.data(),
            footprints.data(),
            bends.data(),
            rims.data(),
            stretch,
            std::numeric_limits<float>::max()};
  }
};

/** \brief A camera at (0.5, -0.3, 4) that looks about at the origin, 120 pixels per
 * unit of slope, the farthest depth at distance 8. */
struct TestCamera {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d eye{0.5, -0.3, 4.0};
  pcl_uvol::Projection projection{};

  TestCamera()
  {
    rotation = (Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(M_PI + 0.1, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
    const Eigen::Vector3d shift = -(rotation * eye);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        projection.rotation[3 * i + j] = static_cast<float>(rotation(i, j));
      projection.translation[i] = static_cast<float>(shift[i]);
      projection.eye[i] = static_cast<float>(eye[i]);
    }
    projection.focal = 120.0f;
    projection.center_x = 40.5f;
    projection.center_y = 33.25f;
    projection.near = 0.5f;
    projection.per_far = 1.0f / 8.0f;
    projection.outward = 1.0f;
    projection.smallest_footprint = 1.4f;
    projection.largest_filler = 2.8f;
  }

  Eigen::Vector3d
  toCamera(const Eigen::Vector3d& place) const
  {
    return rotation * (place - eye);
  }
};

/** \brief Rows of background keys with room around them: whole segments of BlendSums.
 */
struct PixelRows {
  static constexpr int width = 81, height = 67, margin = 64;
  static constexpr std::ptrdiff_t stride = 96 + 2 * margin;
  std::vector<pcl_uvol::PixelKey> keys;

  PixelRows()
      : keys(static_cast<std::size_t>(stride * (height + 2)), pcl_uvol::background_key)
  {
  }

  pcl_uvol::PixelKey*
  first()
  {
    return keys.data() + stride + margin;
  }

  pcl_uvol::PixelKey
  at(int column, int row) const
  {
    return keys[static_cast<std::size_t>((row + 1) * stride + margin + column)];
  }

  pcl_uvol::PixelBand
  band(int first_row, int last_row)
  {
    return {first(), stride, width, first_row, last_row};
  }
};

} // namespace uvol_test
