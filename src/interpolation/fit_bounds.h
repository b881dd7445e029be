// SPDX-License-Identifier: BSD-3-Clause
// The polynomials through the neighbours of a sample: their kernel, compiled for every
// instruction set, and what is asked of them.
#pragma once

#include "common/dispatch.h"
#include "derivatives/polynomial_kernel.h"

namespace pcl_uvol::detail {

constexpr KernelTable<PolynomialKernel> polynomial_kernel_table{
    baseline::fitPolynomials, avx2::fitPolynomials, avx512::fitPolynomials};

/** \brief Share of the distance of the farthest sample, where there are so few samples
 * that all of them are neighbours: none should lose its weight. */
constexpr double radius_of_few = 1.5;

/** \brief A bound of a cubic that is no larger than 1 in a ball of radius 1: first and
 * second derivatives at the centre (Bernstein's inequality), and room for samples that
 * lie on one side or do not show its largest value. */
constexpr double steepest = 2.0 * 3.0, most_curved = 4.0 * 9.0;

} // namespace pcl_uvol::detail
