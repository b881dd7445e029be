// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"

#include "support/environment.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace uvol_test {

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZI>;

void
add(Cloud& cloud, double x, double y, double z)
{
  pcl::PointXYZI point;
  point.x = static_cast<float>(x);
  point.y = static_cast<float>(y);
  point.z = static_cast<float>(z);
  point.intensity = std::hypot(point.x - 0.5f, point.y - 0.5f, point.z - 0.5f);
  cloud.push_back(point);
}

void
fillLattice(Cloud& cloud, std::size_t n, std::size_t ratio)
{
  const auto side =
      static_cast<std::size_t>(std::cbrt(static_cast<double>(ratio * n)) + 1e-9);
  const double step = 1.0 / static_cast<double>(side);
  for (std::size_t k = 0; k < side; k += ratio)
    for (std::size_t j = 0; j < side; ++j)
      for (std::size_t i = 0; i < side; ++i)
        add(cloud,
            static_cast<double>(i) * step,
            static_cast<double>(j) * step,
            static_cast<double>(k) * step);
}

void
fillRandomly(Cloud& cloud, const std::string& shape, std::size_t n, Random& random)
{
  while (cloud.size() < n) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    const std::size_t i = cloud.size();
    if (shape == "uniform")
      add(cloud, x, y, z);
    else if (shape == "clustered") // density ~ r^-2 about the centre
      add(cloud,
          0.5 + 0.5 * x * (y - 0.5),
          0.5 + 0.5 * x * (z - 0.5),
          0.5 + x * x * y / 2);
    else if (shape == "planar")
      add(cloud, x, y, 0.25);
    else if (shape == "linear")
      add(cloud, 0.75, y, 0.25);
    else if (shape == "oblique line")
      add(cloud, x, x, x);
    else if (shape == "duplicates") // a coarse raster: most points coincide
      add(cloud, std::floor(8 * x) / 8, std::floor(8 * y) / 8, std::floor(8 * z) / 8);
    else if (shape == "three planes")
      add(cloud, x, y, 0.25 * static_cast<double>(1 + i % 3));
    else if (shape == "drill holes") { // 400 vertical holes on a 20 x 20 raster
      const std::size_t hole = i % 400;
      add(cloud,
          static_cast<double>(hole % 20) / 20,
          static_cast<double>(hole / 20) / 20,
          z);
    }
    else if (shape == "one plane and noise")
      add(cloud, x, y, i % 100 == 0 ? z : 0.5);
    else
      throw std::invalid_argument("unknown shape " + shape);
  }
}

} // namespace

const std::vector<std::string>&
cloudShapes()
{
  static const std::vector<std::string> shapes{"uniform",
                                               "clustered",
                                               "lattice",
                                               "slices",
                                               "planar",
                                               "linear",
                                               "oblique line",
                                               "duplicates",
                                               "three planes",
                                               "drill holes",
                                               "one plane and noise"};
  return shapes;
}

Cloud::Ptr
makeCloud(const std::string& shape, std::size_t n, std::uint64_t seed)
{
  Cloud::Ptr cloud(new Cloud);
  Random random(seed);
  if (shape == "lattice")
    fillLattice(*cloud, n, 1);
  else if (shape == "slices") // five times as far from one another
    fillLattice(*cloud, n, 5);
  else
    fillRandomly(*cloud, shape, n, random);
  return cloud;
}

RadialCloud
makeRadialCloud(std::size_t n, std::uint64_t seed)
{
  const double side = 160.0 * std::cbrt(static_cast<double>(n) / 4e6);
  RadialCloud radial{Cloud::Ptr(new Cloud), side / 2, side * 46.0 / 160.0};
  Random random(seed);
  radial.cloud->resize(n);
  for (auto& point : *radial.cloud) {
    point.x = static_cast<float>(side * random.uniform());
    point.y = static_cast<float>(side * random.uniform());
    point.z = static_cast<float>(side * random.uniform());
    point.intensity = static_cast<float>(std::hypot(
        point.x - radial.center, point.y - radial.center, point.z - radial.center));
  }
  return radial;
}

pcl_uvol::Dataset
rowsOf(const pcl_uvol::Dataset& dataset, std::size_t begin, std::size_t end)
{
  pcl_uvol::Dataset rows = dataset;
  const std::size_t step = dataset.cloud.point_step;
  rows.cloud.data.assign(
      dataset.cloud.data.begin() + static_cast<std::ptrdiff_t>(begin * step),
      dataset.cloud.data.begin() + static_cast<std::ptrdiff_t>(end * step));
  rows.cloud.width = static_cast<pcl::uindex_t>(end - begin);
  rows.cloud.row_step = rows.cloud.width * rows.cloud.point_step;
  return rows;
}

std::string
testNameOf(std::string shape)
{
  std::replace(shape.begin(), shape.end(), ' ', '_');
  return shape;
}

pcl_uvol::SampleSet::ConstPtr
buildSamples(const pcl::PointCloud<pcl::PointXYZI>& cloud, unsigned threads)
{
  std::vector<std::uint32_t> use(cloud.size());
  std::iota(use.begin(), use.end(), 0u);
  pcl_uvol::Report report;
  return pcl_uvol::SampleSet::build(&cloud[0].x,
                                    sizeof(pcl::PointXYZI) / sizeof(float),
                                    use,
                                    pcl_uvol::Position{{1.0f, 1.0f, 1.0f}},
                                    threads,
                                    report);
}

} // namespace uvol_test
