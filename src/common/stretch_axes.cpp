// SPDX-License-Identifier: BSD-3-Clause
#include "common/stretch_axes.h"

#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>

#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

namespace pcl_uvol::detail {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

/** A singular value below that part of the largest one leaves its direction without
 * length. */
constexpr double least_singular_value = 1e-12;

/** Sine and cosine of an angle in degrees, exact where it is right. */
struct Direction {
  double sine, cosine;

  explicit Direction(double degrees)
      : sine(std::sin(degree * degrees))
      , cosine(std::cos(degree * degrees))
  {
    const double quarters = std::fmod(degrees, 360.0) / 90.0;
    if (quarters == std::round(quarters)) {
      sine = std::round(sine) + 0.0;
      cosine = std::round(cosine) + 0.0;
    }
  }
};

void
check(const Eigen::Array3d& rotation)
{
  const double strike = rotation[0], dip = rotation[1], plunge = rotation[2];
  if (!std::isfinite(strike))
    throw InvalidArgument("strike_not_finite", {{"strike", strike}});
  if (!(dip >= 0.0 && dip <= 90.0))
    throw InvalidArgument("dip_out_of_range", {{"dip", dip}});
  if (!(std::abs(plunge) <= dip))
    throw InvalidArgument("plunge_too_steep", {{"plunge", plunge}, {"dip", dip}});
}

/** The components of vectors: of positions, and of normals, which files may hold in
 * double. */
std::vector<std::array<FieldComponent, 3>>
findVectors(const CloudView& cloud)
{
  constexpr std::array<std::array<const char*, 3>, 2> names = {
      {{"x", "y", "z"}, {"normal_x", "normal_y", "normal_z"}}};
  std::vector<std::array<FieldComponent, 3>> vectors;
  for (const auto& of_vector : names) {
    std::array<FieldComponent, 3> components{};
    std::size_t found = 0;
    for (const char* const name : of_vector)
      if (const auto* const field = findField(cloud.fields, name);
          field && (field->datatype == pcl::PCLPointField::FLOAT32 ||
                    field->datatype == pcl::PCLPointField::FLOAT64))
        components[found++] = {field->offset, field->datatype};
    if (found == 3)
      vectors.push_back(components);
  }
  return vectors;
}

template <typename Number>
void
put(double number, std::uint8_t* place)
{
  const auto rounded = static_cast<Number>(number);
  std::memcpy(place, &rounded, sizeof(Number));
}

void
apply(const Matrix3d& map, const CloudView& cloud, std::uint8_t* points)
{
  const auto vectors = findVectors(cloud);
  for (std::size_t i = 0; i < cloud.count; ++i)
    for (const auto& components : vectors) {
      std::uint8_t* const point = points + i * cloud.point_step;
      const Vector3d mapped = map * Vector3d(components[0].read(point),
                                             components[1].read(point),
                                             components[2].read(point));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const FieldComponent& to = components[axis];
        (to.datatype == pcl::PCLPointField::FLOAT64
             ? put<double>
             : put<float>)(mapped[static_cast<Eigen::Index>(axis)], point + to.offset);
      }
    }
}

/** Strike, dip and plunge of axes of which each may look either way. */
Eigen::Array3d
anglesOf(const Matrix3d& rows)
{
  const Vector3d normal = (rows(2, 2) < 0.0 ? -1.0 : 1.0) * rows.row(2);
  const Vector3d line = rows.row(1);
  const double steep = std::hypot(normal[0], normal[1]);
  const double dip = std::atan2(steep, normal[2]);
  if (steep == 0.0)
    return {std::atan2(line[0], line[1]) / degree, 0.0, 0.0};
  // The plane goes down to where its normal leans, and that is to the right.
  const double downwards = std::atan2(normal[0], normal[1]);
  const Vector3d strike(-normal[1] / steep, normal[0] / steep, 0.0);
  const double side = line.dot(strike) < 0.0 ? -1.0 : 1.0;
  const double plunge = std::asin(std::clamp(-side * line[2], -1.0, 1.0)) / degree;
  const double largest = std::min(dip / degree, 90.0);
  return {downwards / degree - 90.0, largest, std::clamp(plunge, -largest, largest)};
}

} // namespace

StretchAxes::StretchAxes(const Eigen::Array3d& rotation)
{
  check(rotation);
  const Direction strike(rotation[0]), dip(rotation[1]);
  const Vector3d along(strike.sine, strike.cosine, 0.0);
  const Vector3d down(dip.cosine * strike.cosine, -dip.cosine * strike.sine, -dip.sine);
  const Vector3d normal(dip.sine * strike.cosine, -dip.sine * strike.sine, dip.cosine);
  // In the plane, the line is turned from the strike by more than it plunges.
  const double sine =
      dip.sine > 0.0 ? std::clamp(Direction(rotation[2]).sine / dip.sine, -1.0, 1.0)
                     : 0.0;
  const double cosine = std::sqrt(1.0 - sine * sine);
  rows_.row(0) = cosine * down - sine * along;
  rows_.row(1) = cosine * along + sine * down;
  rows_.row(2) = normal;
}

CloudView
StretchAxes::turn(const CloudView& cloud) const
{
  if (!areTurned())
    return cloud;
  auto points = std::make_shared<std::vector<std::uint8_t>>(
      cloud.data, cloud.data + cloud.count * cloud.point_step);
  apply(rows_, cloud, points->data());
  CloudView turned = cloud;
  turned.data = points->data();
  turned.copy = points;
  return turned;
}

void
StretchAxes::turn(pcl::PCLPointCloud2& cloud) const
{
  if (areTurned())
    apply(rows_, viewOf(cloud), cloud.data.data());
}

void
StretchAxes::turnBack(pcl::PCLPointCloud2& cloud) const
{
  if (areTurned())
    apply(rows_.transpose(), viewOf(cloud), cloud.data.data());
}

Stretch
Stretch::ofMap(const Matrix3d& map)
{
  if (!map.allFinite())
    throw InvalidArgument("scale_map_not_finite", {});
  const Eigen::JacobiSVD<Matrix3d> singular(map, Eigen::ComputeFullV);
  // gcc takes what a reference refers to for uninitialized.
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
  const Vector3d factors = singular.singularValues(); // descending
  if (!(factors[2] > least_singular_value * factors[0]))
    throw InvalidArgument("scale_map_flat", {});
  // The order of the axes is the one that stays nearest to x, y and z, so that a
  // diagonal map gives its diagonal.
  const Matrix3d directions = singular.matrixV().transpose();
  std::array<Eigen::Index, 3> order = {0, 1, 2}, best = order;
  double nearest = -1.0;
  do {
    double near = 0.0;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      near += std::abs(directions(order[static_cast<std::size_t>(axis)], axis));
    if (near > nearest) {
      nearest = near;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  Stretch stretch;
  Matrix3d rows;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Index from = best[static_cast<std::size_t>(axis)];
    rows.row(axis) = directions.row(from);
    stretch.scale[axis] = static_cast<float>(factors[from]);
  }
  stretch.rotation = anglesOf(rows);
  return stretch;
}

} // namespace pcl_uvol::detail
