// SPDX-License-Identifier: BSD-3-Clause
// Meshes of solids whose area, volume and moments are known.
#pragma once

#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/mesh/surface_measures.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace uvol_test {

/** \brief Vertices, with normals where there are any, and triangles. */
struct MeasuredShape {
  std::vector<Eigen::Vector3d> places, normals;
  std::vector<float> isovalues, caps;
  std::vector<pcl_uvol::Triangle> triangles;

  void
  transform(const Eigen::Matrix3d& turn, const Eigen::Vector3d& offset)
  {
    for (Eigen::Vector3d& place : places)
      place = turn * place + offset;
    for (Eigen::Vector3d& normal : normals)
      normal = turn * normal;
  }

  void
  append(const MeasuredShape& other)
  {
    const auto first = static_cast<std::uint32_t>(places.size());
    const auto join = [](auto& to, const auto& from) {
      const std::size_t count = from.size(); // a shape may be appended to itself
      to.reserve(to.size() + count);
      for (std::size_t i = 0; i < count; ++i)
        to.push_back(from[i]);
    };
    join(places, other.places);
    join(normals, other.normals);
    join(isovalues, other.isovalues);
    join(caps, other.caps);
    const std::size_t own = triangles.size();
    join(triangles, other.triangles);
    for (std::size_t i = own; i < triangles.size(); ++i)
      for (std::uint32_t& corner : triangles[i])
        corner += first;
  }

  /** Vertices of one place become one. */
  void
  mergeEqualPlaces()
  {
    std::map<std::array<double, 3>, std::uint32_t> first;
    std::vector<std::uint32_t> names;
    std::vector<Eigen::Vector3d> merged;
    for (const Eigen::Vector3d& place : places) {
      const auto [at, is_new] = first.insert(
          {{place[0], place[1], place[2]}, static_cast<std::uint32_t>(merged.size())});
      if (is_new)
        merged.push_back(place);
      names.push_back(at->second);
    }
    places = merged;
    for (pcl_uvol::Triangle& triangle : triangles)
      for (std::uint32_t& vertex : triangle)
        vertex = names[vertex];
  }

  pcl_uvol::Dataset
  toDataset() const
  {
    pcl_uvol::Dataset dataset;
    std::vector<double> xyz;
    for (const Eigen::Vector3d& place : places)
      xyz.insert(xyz.end(), place.data(), place.data() + 3);
    dataset.cloud.width = static_cast<std::uint32_t>(places.size());
    dataset.cloud.height = 1;
    pcl_uvol::setCoordinates(dataset, xyz);
    const char* const names[] = {"normal_x", "normal_y", "normal_z"};
    for (int axis = 0; axis < 3 && !normals.empty(); ++axis) {
      std::vector<double> numbers;
      for (const Eigen::Vector3d& normal : normals)
        numbers.push_back(normal[axis]);
      pcl_uvol::setField(dataset, names[axis], numbers);
    }
    if (!isovalues.empty())
      pcl_uvol::setField(dataset, "isovalue", isovalues);
    if (!caps.empty())
      pcl_uvol::setField(dataset, "cap", caps);
    return dataset;
  }
};

inline pcl_uvol::SurfaceFigures
measure(const MeasuredShape& shape,
        const std::shared_ptr<const pcl_uvol::Dataset>& samples = nullptr,
        const pcl_uvol::SurfaceMeasuresParameters& parameters = {})
{
  pcl_uvol::SurfaceMeasures measures;
  measures.setInputSurface(std::make_shared<pcl_uvol::Dataset>(shape.toDataset()),
                           shape.triangles);
  measures.setInputSamples(samples);
  measures.setParameters(parameters);
  return measures.compute();
}

/** \brief The unit sphere, of 8 times 4^levels triangles. */
inline MeasuredShape
makeUnitSphere(int levels)
{
  MeasuredShape sphere;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0})
      sphere.places.emplace_back(side * Eigen::Vector3d::Unit(axis));
  for (std::uint32_t x : {0u, 1u})
    for (std::uint32_t y : {2u, 3u})
      for (std::uint32_t z : {4u, 5u})
        if ((x + y + z) % 2 == 0)
          sphere.triangles.push_back({x, y, z});
        else
          sphere.triangles.push_back({x, z, y});
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middleOf = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middles.insert(
          {std::minmax(a, b), static_cast<std::uint32_t>(sphere.places.size())});
      if (is_new)
        sphere.places.push_back((sphere.places[a] + sphere.places[b]).normalized());
      return at->second;
    };
    std::vector<pcl_uvol::Triangle> finer;
    for (const auto& [a, b, c] : sphere.triangles) {
      const std::uint32_t ab = middleOf(a, b), bc = middleOf(b, c), ca = middleOf(c, a);
      for (const pcl_uvol::Triangle& part :
           {pcl_uvol::Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(part);
    }
    sphere.triangles = finer;
  }
  sphere.normals = sphere.places;
  return sphere;
}

/** \brief An ellipsoid about the origin by its half axes. */
inline MeasuredShape
makeEllipsoid(const Eigen::Vector3d& half_axes, int levels)
{
  MeasuredShape shape = makeUnitSphere(levels);
  for (std::size_t i = 0; i < shape.places.size(); ++i) {
    shape.normals[i] = shape.places[i].cwiseQuotient(half_axes).normalized();
    shape.places[i] = shape.places[i].cwiseProduct(half_axes);
  }
  return shape;
}

/** \brief A torus about the z axis. */
inline MeasuredShape
makeTorus(double large, double small, std::uint32_t around, std::uint32_t across)
{
  MeasuredShape torus;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2.0 * M_PI * i / around, v = 2.0 * M_PI * j / across;
      const Eigen::Vector3d out(std::cos(u), std::sin(u), 0.0);
      torus.normals.emplace_back(std::cos(v) * out +
                                 std::sin(v) * Eigen::Vector3d::UnitZ());
      torus.places.emplace_back(large * out + small * torus.normals.back());
      const auto vertex = [&](std::uint32_t a, std::uint32_t b) {
        return a % around * across + b % across;
      };
      torus.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      torus.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return torus;
}

/** \brief A box from the origin, without normals. */
inline MeasuredShape
makeBox(const Eigen::Vector3d& sides)
{
  MeasuredShape box;
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    box.places.emplace_back((corner & 1) != 0 ? sides[0] : 0.0,
                            (corner & 2) != 0 ? sides[1] : 0.0,
                            (corner & 4) != 0 ? sides[2] : 0.0);
  for (const std::array<std::uint32_t, 4>& face :
       {std::array<std::uint32_t, 4>{0, 2, 3, 1},
        {4, 5, 7, 6},
        {0, 1, 5, 4},
        {2, 6, 7, 3},
        {0, 4, 6, 2},
        {1, 3, 7, 5}}) {
    box.triangles.push_back({face[0], face[1], face[2]});
    box.triangles.push_back({face[0], face[2], face[3]});
  }
  return box;
}

/** \brief The upper half of a ball about the origin, closed by a cap. */
inline MeasuredShape
makeHalfBall(double radius, int levels)
{
  MeasuredShape ball = makeUnitSphere(levels);
  ball.caps.assign(ball.places.size(), 0.0f);
  for (std::size_t i = 0; i < ball.places.size(); ++i) {
    Eigen::Vector3d& place = ball.places[i];
    if (place[2] < 0.0) {
      // Pressed flat, away from the rim.
      place = Eigen::Vector3d(place[0], place[1], 0.0);
      ball.normals[i] = -Eigen::Vector3d::UnitZ();
      ball.caps[i] = 1.0f;
    }
    place *= radius;
  }
  return ball;
}

} // namespace uvol_test
