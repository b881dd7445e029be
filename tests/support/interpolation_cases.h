// SPDX-License-Identifier: BSD-3-Clause
// Samples of functions in double, and interpolation of them.
#pragma once

#include <pcl_uvol/interpolation/field_interpolation.h>

#include <Eigen/Core>
#include <pcl/PCLPointCloud2.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace uvol_test {

using Function = std::function<double(const Eigen::Vector3d&)>;
using Places = std::vector<std::array<double, 3>>;

/** \brief n random places in a cube, whose coordinates float holds. */
Places
randomPlaces(std::size_t n, std::uint64_t seed, double low = 0.0, double high = 1.0);

/** \brief Samples with a double field f0, f1, ... per function. */
pcl::PCLPointCloud2
sampleFunctions(const Places& places, const std::vector<Function>& functions);

/** \brief f0, f1, ... at places, from all samples. */
pcl_uvol::InterpolatedFields
interpolate(const pcl::PCLPointCloud2& samples,
            pcl_uvol::InterpolationParameters parameters,
            const Places& places,
            std::size_t fields = 1,
            unsigned threads = 0,
            pcl_uvol::Report* report = nullptr);

/** \brief Franke's function, with a third coordinate as in Renka (1988), on the unit
 * cube. */
double
franke(const Eigen::Vector3d& x);

/** \brief The gradient by central differences. */
Eigen::Vector3d
gradientOf(const Function& function, const Eigen::Vector3d& x);

Eigen::Vector3d
vectorOf(const std::array<double, 3>& numbers);

} // namespace uvol_test
