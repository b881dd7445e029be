// SPDX-License-Identifier: BSD-3-Clause
#include "render/gaussian_splats.h"

#include "common/numbers.h"
#include "common/records.h"
#include "surface/splat_input.h"
#include <pcl_uvol/render/color_map.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pcl_uvol {

namespace {

constexpr std::array<const char*, 17> names = {"x",
                                               "y",
                                               "z",
                                               "nx",
                                               "ny",
                                               "nz",
                                               "f_dc_0",
                                               "f_dc_1",
                                               "f_dc_2",
                                               "opacity",
                                               "scale_0",
                                               "scale_1",
                                               "scale_2",
                                               "rot_0",
                                               "rot_1",
                                               "rot_2",
                                               "rot_3"};
using Record = std::array<float, names.size()>;

/** Light that reaches a disc: some from everywhere, and more the more it looks to a
 * wide source above, at the front and on the left. */
double
lightOn(const Eigen::Vector3d& normal)
{
  const Eigen::Vector3d light = Eigen::Vector3d(-0.4, -0.6, 0.7).normalized();
  constexpr double least = 0.35;
  return least + (1.0 - least) * (0.5 + 0.5 * normal.dot(light));
}

/** The rotation from the axes to the disc's: tangent, normal times tangent, normal. */
Eigen::Quaterniond
rotationOf(const Eigen::Vector3d& normal, const Eigen::Vector3d& tangent)
{
  Eigen::Matrix3d axes;
  axes.col(0) = (tangent - normal.dot(tangent) * normal).normalized();
  axes.col(1) = normal.cross(axes.col(0));
  axes.col(2) = normal;
  return Eigen::Quaterniond(axes).normalized();
}

Record
makeGaussian(const PointSplat& splat, Rgba color)
{
  constexpr double part = 0.70710678118654752, thickness = 0.01, opacity = 0.99;
  constexpr double harmonic = 0.28209479177387814; // of degree 0
  const Eigen::Vector3d normal(splat.normal_x, splat.normal_y, splat.normal_z),
      tangent(splat.tangent_x, splat.tangent_y, splat.tangent_z);
  const double light = lightOn(normal), radius = splat.radius;
  Record record{
      splat.x, splat.y, splat.z, splat.normal_x, splat.normal_y, splat.normal_z};
  for (std::size_t k = 0; k < 3; ++k) {
    const double channel = static_cast<double>(color >> (8 * k) & 0xffu) / 255.0;
    record[6 + k] = static_cast<float>((light * channel - 0.5) / harmonic);
  }
  record[9] = static_cast<float>(std::log(opacity / (1.0 - opacity)));
  record[10] = record[11] = static_cast<float>(std::log(part * radius));
  record[12] = static_cast<float>(std::log(thickness * radius));
  const Eigen::Quaterniond turn = rotationOf(normal, tangent);
  const std::array<double, 4> parts = {turn.w(), turn.x(), turn.y(), turn.z()};
  std::copy(parts.begin(), parts.end(), record.begin() + 13);
  return record;
}

} // namespace

pcl::PCLPointCloud2
toGaussians(const pcl::PointCloud<PointSplat>& splats, const std::vector<Rgba>& colors)
{
  std::vector<pcl::PCLPointField> fields;
  for (const char* const name : names)
    appendField(fields, name, pcl::PCLPointField::FLOAT32);
  pcl::PCLPointCloud2 cloud = makeRecords(fields, splats.size());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const Record record = makeGaussian(splats[i], colors[i]);
    std::memcpy(&cloud.data[i * sizeof record], record.data(), sizeof record);
  }
  return cloud;
}

Dataset
makeGaussians(const Dataset& splats,
              const std::string& field,
              const ColorMapping& mapping,
              Report& report)
{
  const CloudView view = viewOf(splats.cloud);
  warnOfLogarithms(view, field, mapping, report);
  Report counted_before;
  const Splats found = readSplats(view, counted_before);
  std::vector<Rgba> colors(found.cloud.size(), toRgba(Material().color));
  if (!field.empty()) {
    const PointColors all = colorPoints(view, field, mapping);
    for (std::size_t i = 0; i < colors.size(); ++i)
      colors[i] = all.colors[found.sources[i]];
  }
  if (splats.origin != std::array<double, 3>{})
    report.warn("gaussians_without_origin", {{"origin", joinNumbers(splats.origin)}});
  Dataset gaussians = withoutCloud(splats);
  gaussians.cloud = toGaussians(found.cloud, colors);
  gaussians.origin = {};
  gaussians.double_coordinates = false;
  return gaussians;
}

} // namespace pcl_uvol
