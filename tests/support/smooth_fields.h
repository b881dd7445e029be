// SPDX-License-Identifier: BSD-3-Clause
// Smooth functions with known isosurfaces: the truth that isopoints are measured by.
#pragma once

#include "generation/analytic_fields.h"
#include <pcl_uvol/common/point_types.h>

#include <Eigen/Core>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace uvol_test {

/** \brief A smooth function and an isovalue of it, in a cube about the origin whose
 * uniform samples have the mean spacing 1. */
struct SmoothField {
  const char* name;
  std::function<double(const Eigen::Vector3d&)> value;
  double isovalue, side;
};

/** \brief radial (thesis Table 2.9), waves (of about 20 spacings on a radial field),
 * decay, gyroid, torus, fourth_power or growth (both of the distance, the latter
 * tenfold in ten spacings), in the cube for n samples. */
SmoothField
makeSmoothField(const std::string& name, std::size_t n);

/** \brief Half the divergence of the unit gradient. */
double
meanCurvatureOf(const SmoothField& field, const Eigen::Vector3d& x);

/** \brief Distance of every point to the isosurface, along the gradient. */
std::vector<double>
deviations(const SmoothField& field,
           const pcl::PointCloud<pcl_uvol::PointIso>& surface);

/** \brief n samples, uniform, or clustered about the origin: density ~ r^-3 over a
 * factor 27,000. The scalar is that at the position in single precision.
 * \param noise standard deviation of Gaussian noise, in units of the isovalue */
pcl::PointCloud<pcl::PointXYZI>::Ptr
sampleSmoothField(const SmoothField& field,
                  std::size_t n,
                  std::uint64_t seed,
                  bool clustered,
                  double noise = 0.0);

/** \brief n samples on lines, as uvol_generate has them. */
pcl::PointCloud<pcl::PointXYZI>::Ptr
sampleOnLines(const SmoothField& field,
              pcl_uvol::Scatter lines,
              std::uint64_t n,
              std::uint64_t seed);

double
mean(const std::vector<double>& values);

/** \brief The value that this part of the values does not exceed. */
double
quantile(std::vector<double> values, double part);

} // namespace uvol_test
