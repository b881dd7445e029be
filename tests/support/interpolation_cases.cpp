// SPDX-License-Identifier: BSD-3-Clause
#include "support/interpolation_cases.h"

#include "support/environment.h"

#include <cmath>
#include <cstring>
#include <numeric>

namespace uvol_test {

namespace {

void
describe(pcl::PCLPointCloud2& cloud,
         const std::string& name,
         std::uint8_t datatype,
         std::uint32_t bytes)
{
  pcl::PCLPointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = datatype;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += bytes;
}

} // namespace

Places
randomPlaces(std::size_t n, std::uint64_t seed, double low, double high)
{
  Random random(seed);
  Places places(n);
  for (auto& place : places)
    for (double& x : place)
      x = static_cast<double>(
          static_cast<float>(low + (high - low) * random.uniform()));
  return places;
}

pcl::PCLPointCloud2
sampleFunctions(const Places& places, const std::vector<Function>& functions)
{
  pcl::PCLPointCloud2 cloud;
  for (const char* name : {"x", "y", "z"})
    describe(cloud, name, pcl::PCLPointField::FLOAT32, 4);
  for (std::size_t f = 0; f < functions.size(); ++f)
    describe(cloud, "f" + std::to_string(f), pcl::PCLPointField::FLOAT64, 8);
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(places.size());
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(cloud.row_step);
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::uint8_t* const point = &cloud.data[i * cloud.point_step];
    const Eigen::Vector3f place = vectorOf(places[i]).cast<float>();
    std::memcpy(point, place.data(), 12);
    for (std::size_t f = 0; f < functions.size(); ++f) {
      const double value = functions[f](place.cast<double>());
      std::memcpy(point + 12 + 8 * f, &value, 8);
    }
  }
  return cloud;
}

pcl_uvol::InterpolatedFields
interpolate(const pcl::PCLPointCloud2& samples,
            pcl_uvol::InterpolationParameters parameters,
            const Places& places,
            std::size_t fields,
            unsigned threads,
            pcl_uvol::Report* report)
{
  parameters.fields.clear();
  for (std::size_t f = 0; f < fields; ++f)
    parameters.fields.push_back("f" + std::to_string(f));
  pcl::Indices indices(samples.width);
  std::iota(indices.begin(), indices.end(), 0);
  pcl_uvol::Report own;
  pcl_uvol::Report& told = report ? *report : own;
  const pcl_uvol::detail::FieldInterpolator interpolator(
      pcl_uvol::viewOf(samples), indices, parameters, threads, told);
  return interpolator.interpolate(places, threads, told);
}

double
franke(const Eigen::Vector3d& x)
{
  const Eigen::Array3d u = 9.0 * x.array();
  const auto hill = [&](double a, double b, double c, double width) {
    return std::exp(-((u - Eigen::Array3d(a, b, c)).square().sum()) / width);
  };
  return 0.75 * hill(2, 2, 2, 4) +
         0.75 * std::exp(-(u[0] + 1) * (u[0] + 1) / 49 - (u[1] + 1) / 10 -
                         (u[2] + 1) / 10) +
         0.5 * hill(7, 3, 5, 4) - 0.2 * hill(4, 7, 5, 1);
}

Eigen::Vector3d
gradientOf(const Function& function, const Eigen::Vector3d& x)
{
  constexpr double step = 1e-5;
  Eigen::Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d offset = step * Eigen::Vector3d::Unit(axis);
    gradient[axis] = (function(x + offset) - function(x - offset)) / (2.0 * step);
  }
  return gradient;
}

Eigen::Vector3d
vectorOf(const std::array<double, 3>& numbers)
{
  return {numbers[0], numbers[1], numbers[2]};
}

} // namespace uvol_test
