// SPDX-License-Identifier: BSD-3-Clause
// Flows whose gradients are known: the truth that derived fields are measured by.
#pragma once

#include <pcl_uvol/common/dataset.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace uvol_test {

/** \brief A flow in a cube about the origin. */
struct Flow {
  std::string name;
  double half_side;
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> velocity;
  /** Where its derivatives have no steps within a distance. */
  std::function<bool(const Eigen::Vector3d&, double distance)> is_smooth;
};

/** \brief Taylor and Green's vortices, the flow of Arnold, Beltrami and Childress, and
 * Hill's spherical vortex of radius 1 in the flow around it. */
std::vector<Flow>
makeFlows();

/** \brief Row i is the gradient of component i, by central differences. */
Eigen::Matrix3d
jacobianOf(const Flow& flow, const Eigen::Vector3d& x);

/** \brief n uniform samples with the float64 fields vx, vy and vz. */
pcl_uvol::Dataset
sampleFlow(const Flow& flow, std::size_t n, std::uint64_t seed);

/** \brief Root mean square deviations of what sampleFlow() derives from the truth. */
struct FlowErrors {
  double gradient, curl, q, lambda2;
};

/** \brief Errors of sampleFlow() at the samples that lie a distance inside, and as far
 * from steps. */
FlowErrors
measureDerivatives(const Flow& flow,
                   std::size_t n,
                   std::uint64_t seed,
                   double distance);

/** \brief Mean distance of n samples. */
double
spacingOf(const Flow& flow, std::size_t n);

} // namespace uvol_test
