// SPDX-License-Identifier: BSD-3-Clause
// Samples around a sphere in any unit of length, and their isopoints.
#pragma once

#include "io/point_stream.h"
#include "pipeline/extract_out_of_core.h"
#include "support/environment.h"
#include <pcl_uvol/io/dataset.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

namespace uvol_test {

using pcl_uvol::Interpolation;
using pcl_uvol::IsosurfaceParameters;
using pcl_uvol::PointIso;
using pcl_uvol::Report;
using Cloud = pcl::PointCloud<pcl::PointXYZI>;
using Isopoints = pcl::PointCloud<PointIso>;

constexpr double sphere_radius = 0.3;

/** Samples in [1, 2)^3, so that nothing that is made of them is a subnormal number at
 * 2^-100; intensity is the distance to the middle. */
inline Cloud::Ptr
makeSamples(int exponent, std::size_t count = 3000)
{
  Cloud::Ptr cloud(new Cloud);
  uvol_test::Random random(5);
  for (std::size_t i = 0; i < count; ++i) {
    pcl::PointXYZI point;
    double sq_dist = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      point.data[axis] = static_cast<float>(1.0 + random.uniform());
      sq_dist += std::pow(point.data[axis] - 1.5, 2);
      point.data[axis] = std::ldexp(point.data[axis], exponent);
    }
    point.intensity = static_cast<float>(std::sqrt(sq_dist));
    cloud->push_back(point);
  }
  return cloud;
}

inline Isopoints
extract(const Cloud::ConstPtr& cloud,
        const IsosurfaceParameters& settings,
        Report* report = nullptr)
{
  pcl_uvol::IsosurfaceExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIsoValues(settings.isovalues);
  extraction.setInterpolation(settings.interpolation);
  extraction.setScale(settings.scale);
  Isopoints isopoints;
  extraction.extract(isopoints);
  if (report != nullptr)
    *report = extraction.getReport();
  return isopoints;
}

inline IsosurfaceParameters
settingsOf(Interpolation interpolation)
{
  IsosurfaceParameters settings;
  settings.field = "intensity";
  settings.isovalues = {sphere_radius};
  settings.interpolation = interpolation;
  return settings;
}

inline void
expectSame(const Isopoints& expected, const Isopoints& found)
{
  ASSERT_EQ(expected.size(), found.size());
  EXPECT_EQ(0,
            std::memcmp(expected.points.data(),
                        found.points.data(),
                        expected.size() * sizeof(PointIso)));
}

inline std::vector<std::uint32_t>
allOf(std::size_t count)
{
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/** \brief Their isopoints by pieces on disk, in the least memory. */
inline Isopoints
extractFromDisk(const pcl_uvol::Dataset& samples,
                const IsosurfaceParameters& settings,
                Report& report)
{
  const TemporaryFolder folder;
  pcl_uvol::saveDataset(folder / "in.pcd", samples);
  pcl_uvol::PointStream points(folder / "in.pcd");
  pcl_uvol::OutOfCoreSettings out_of_core;
  out_of_core.max_memory = pcl_uvol::leastOutOfCoreMemory(points.size(), 1);
  out_of_core.scratch_folder = folder / "";
  return extractOutOfCore(points, settings, out_of_core, report).isopoints;
}

} // namespace uvol_test
