// SPDX-License-Identifier: BSD-3-Clause
// Samples of fields in a box that repeats.
#pragma once

#include "common/random.h"
#include "common/records.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/pipeline/isosurface_pipeline.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace uvol_test {

using Place = std::array<double, 3>;
using Field = std::function<double(const Place&)>;

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double side = 8.0;

inline double
gyroid(const Place& p)
{
  const double k = 2.0 * pi / side;
  return std::sin(k * p[0]) * std::cos(k * p[1]) +
         std::sin(k * p[1]) * std::cos(k * p[2]) +
         std::sin(k * p[2]) * std::cos(k * p[0]);
}

/** \brief Distance to the nearest corner of the boxes. */
inline double
distanceToCorner(const Place& p)
{
  double sum = 0.0;
  for (const double x : p)
    sum += std::pow(x - side * std::round(x / side), 2);
  return std::sqrt(sum);
}

/** \brief Samples with the field f.
 * \param xyz three numbers each */
inline std::shared_ptr<pcl_uvol::Dataset>
makeSamplesAt(const std::vector<double>& xyz, const std::vector<double>& values)
{
  auto samples = std::make_shared<pcl_uvol::Dataset>();
  samples->cloud = pcl_uvol::makeRecords({}, values.size());
  pcl_uvol::setCoordinates(*samples, xyz);
  pcl_uvol::setField(*samples, "f", values);
  return samples;
}

/** \brief Random places of which float holds sums and differences exactly, moved and
 * wrapped into the box. The field is that of the places before. */
inline std::shared_ptr<pcl_uvol::Dataset>
makePeriodicSamples(std::size_t count, const Field& field, const Place& shift = {})
{
  std::vector<double> xyz, values;
  for (std::uint64_t i = 0; i < count; ++i) {
    Place place{};
    for (std::uint64_t axis = 0; axis < 3; ++axis) {
      place[axis] =
          std::floor(pcl_uvol::uniformAt(7, i, axis) * 0x1p16) * 0x1p-16 * side;
      const double moved = std::fmod(place[axis] + shift[axis], side);
      xyz.push_back(moved < 0.0 ? moved + side : moved);
    }
    values.push_back(field(place));
  }
  return makeSamplesAt(xyz, values);
}

inline pcl_uvol::IsosurfacePipelineParameters
makePeriodicParameters(double isovalue)
{
  pcl_uvol::IsosurfacePipelineParameters parameters;
  parameters.isosurface.field = "f";
  parameters.isosurface.isovalues = {isovalue};
  parameters.periodic = Eigen::Array3d::Constant(side);
  return parameters;
}

inline Place
placeOf(const pcl_uvol::Dataset& dataset, std::size_t i)
{
  const pcl_uvol::CloudView view = pcl_uvol::viewOf(dataset.cloud);
  return {{view.xyz(i)[0] + dataset.origin[0],
           view.xyz(i)[1] + dataset.origin[1],
           view.xyz(i)[2] + dataset.origin[2]}};
}

} // namespace uvol_test
