// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/point_picking.h"

#include "common/records.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/cloud_view.h>

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace uvol_tools {

namespace {

/** Pixels around the one that is asked for. */
constexpr double reach = 8.0;

/** Part of the distance to the eye: points of one layer of a surface, about. */
constexpr double same_layer = 0.01;

/** Fields that are told of at most: a window has no room for more. */
constexpr std::size_t most_fields = 24;

} // namespace

std::optional<std::size_t>
findPointAt(const pcl::PCLPointCloud2& points,
            vtkRenderer& renderer,
            double column,
            double row)
{
  const int *const size = renderer.GetSize(), *const corner = renderer.GetOrigin();
  const vtkMatrix4x4& to_clip =
      *renderer.GetActiveCamera()->GetCompositeProjectionTransformMatrix(
          renderer.GetTiledAspectRatio(), 0.0, 1.0);
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(points);
  std::optional<std::size_t> nearest;
  double nearest_depth = std::numeric_limits<double>::infinity();
  double nearest_offset = reach;
  for (std::size_t i = 0; i < cloud.count; ++i) {
    const float* const p = cloud.xyz(i);
    std::array<double, 4> clip{};
    for (int k = 0; k < 4; ++k)
      clip[static_cast<std::size_t>(k)] =
          to_clip.GetElement(k, 0) * static_cast<double>(p[0]) +
          to_clip.GetElement(k, 1) * static_cast<double>(p[1]) +
          to_clip.GetElement(k, 2) * static_cast<double>(p[2]) +
          to_clip.GetElement(k, 3);
    const double depth = clip[3]; // the distance along the view
    if (!(depth > 0.0))
      continue;
    const double x = corner[0] + 0.5 * (1.0 + clip[0] / depth) * size[0],
                 y = corner[1] + 0.5 * (1.0 + clip[1] / depth) * size[1],
                 offset = std::hypot(x - column, y - row);
    if (!(offset < reach))
      continue;
    const bool is_in_front = depth < (1.0 - same_layer) * nearest_depth;
    const bool is_closer =
        depth < (1.0 + same_layer) * nearest_depth && offset < nearest_offset;
    if (!is_in_front && !is_closer)
      continue;
    nearest = i;
    nearest_depth = depth;
    nearest_offset = offset;
  }
  return nearest;
}

std::string
describePoint(const pcl::PCLPointCloud2& points,
              const std::array<double, 3>& origin,
              std::size_t point)
{
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(points);
  std::ostringstream text;
  text.precision(10); // coordinates may be large and their differences small
  const float* const p = cloud.xyz(point);
  for (std::size_t axis = 0; axis < 3; ++axis)
    text << (axis == 0 ? "" : "   ") << "xyz"[axis] << " "
         << static_cast<double>(p[axis]) + origin[axis];
  text.precision(6);
  std::size_t listed = 0;
  for (const pcl::PCLPointField& field : points.fields) {
    if (pcl_uvol::isPadding(field) || pcl_uvol::axisOf(field.name) >= 0 ||
        field.name == "rgb" || field.name == "rgba")
      continue;
    if (++listed > most_fields)
      break;
    text << '\n' << field.name;
    for (std::size_t k = 0; k < field.count && k < 3; ++k)
      text << ' '
           << pcl_uvol::ScalarField(points.fields,
                                    field.count == 1
                                        ? field.name
                                        : field.name + "[" + std::to_string(k) + "]")
                  .read(cloud.point(point));
  }
  return text.str();
}

} // namespace uvol_tools
