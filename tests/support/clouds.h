// SPDX-License-Identifier: BSD-3-Clause
// Seeded clouds of every awkward shape: what the neighbour search must survive.
#pragma once

#include "neighbors/sample_set.h"
#include <pcl_uvol/common/dataset.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace uvol_test {

/** \brief Names that makeCloud knows. */
const std::vector<std::string>&
cloudShapes();

/** \brief The name of a shape as a part of a test's name. */
std::string
testNameOf(std::string shape);

/** \brief All points of a cloud as samples. */
pcl_uvol::SampleSet::ConstPtr
buildSamples(const pcl::PointCloud<pcl::PointXYZI>& cloud, unsigned threads = 0);

/** \brief About n points (a lattice rounds down to a cube) with intensity = distance to
 * the centre of the unit cube, plus a little noise by index for lattices of equal
 * values. */
pcl::PointCloud<pcl::PointXYZI>::Ptr
makeCloud(const std::string& shape, std::size_t n, std::uint64_t seed);

/** \brief Some of the points of a dataset, from begin to end. */
pcl_uvol::Dataset
rowsOf(const pcl_uvol::Dataset& dataset, std::size_t begin, std::size_t end);

/** \brief The thesis's radial test (Table 2.9): n uniform samples in a cube of mean
 * spacing 1, intensity = distance to the centre; side = 160 (n / 4e6)^(1/3), radius =
 * 46/160 of it. */
struct RadialCloud {
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud;
  double center, radius;
};

RadialCloud
makeRadialCloud(std::size_t n, std::uint64_t seed);

} // namespace uvol_test
