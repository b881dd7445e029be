// SPDX-License-Identifier: BSD-3-Clause
#include "render/stretch_surface.h"

#include "common/scalar_field.h"
#include "surface/splat_input.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <optional>

namespace pcl_uvol {

namespace {

/** Floats side by side or apart, at the same places of every point. */
template <std::size_t N>
using Offsets = std::array<std::size_t, N>;

template <std::size_t N>
std::optional<Offsets<N>>
findFloats(const pcl::PCLPointCloud2& cloud, const std::array<const char*, N>& names)
{
  Offsets<N> offsets{};
  for (std::size_t i = 0; i < N; ++i) {
    const pcl::PCLPointField* const field = findField(cloud.fields, names[i]);
    if (field == nullptr || field->datatype != pcl::PCLPointField::FLOAT32)
      return std::nullopt;
    offsets[i] = field->offset;
  }
  return offsets;
}

float&
floatAt(pcl::PCLPointCloud2& cloud, std::size_t point, std::size_t offset)
{
  return *reinterpret_cast<float*>(&cloud.data[point * cloud.point_step + offset]);
}

void
stretchPositions(pcl::PCLPointCloud2& cloud,
                 std::size_t count,
                 const Offsets<3>& places,
                 const Eigen::Vector3d& factors)
{
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float& coordinate = floatAt(cloud, i, places[axis]);
      coordinate =
          static_cast<float>(coordinate * factors[static_cast<Eigen::Index>(axis)]);
    }
}

/** A normal is a covector: it shrinks where positions are stretched. */
void
stretchNormals(pcl::PCLPointCloud2& cloud,
               std::size_t count,
               const Offsets<3>& places,
               const Eigen::Vector3d& factors)
{
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d normal;
    for (std::size_t axis = 0; axis < 3; ++axis)
      normal[static_cast<Eigen::Index>(axis)] = floatAt(cloud, i, places[axis]);
    normal = normal.cwiseQuotient(factors).eval();
    const double length = normal.norm();
    if (!(length > 0.0))
      continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      floatAt(cloud, i, places[axis]) =
          static_cast<float>(normal[static_cast<Eigen::Index>(axis)] / length);
  }
}

} // namespace

void
stretchSurface(Dataset& surface, const Eigen::Vector3d& factors)
{
  pcl::PCLPointCloud2& cloud = surface.cloud;
  const CloudView view = viewOf(cloud);
  if (hasSplats(view))
    throw InvalidArgument("stretched_splats", {});
  if (const auto places = findFloats<3>(cloud, {"x", "y", "z"}))
    stretchPositions(cloud, view.count, *places, factors);
  if (const auto places = findFloats<3>(cloud, {"normal_x", "normal_y", "normal_z"}))
    stretchNormals(cloud, view.count, *places, factors);
  if (const auto places = findFloats<1>(cloud, {"edge_length"}))
    for (std::size_t i = 0; i < view.count; ++i) {
      float& length = floatAt(cloud, i, (*places)[0]);
      length = static_cast<float>(length * factors.maxCoeff());
    }
  for (int axis = 0; axis < 3; ++axis)
    surface.origin[static_cast<std::size_t>(axis)] *= factors[axis];
}

} // namespace pcl_uvol
