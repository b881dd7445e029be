// SPDX-License-Identifier: BSD-3-Clause
// Scalar fields given by formulas: truth for tests and data to try things on.
#pragma once

#include <pcl_uvol/common/sample_positions.h>

namespace pcl_uvol {

/** \brief A scalar field with the box it is meant for. */
struct AnalyticField {
  std::string name;
  ScalarFunction value;
  Box domain;
  double isovalue; ///< one that gives a surface worth looking at
};

/** \brief radial, sphere, torus, gyroid, marschner_lobb, hydrogen, star. */
PCL_UVOL_EXPORTS const std::vector<std::string>&
analyticFieldNames();

/** \brief A field by name.
 *
 * | name | value | domain |
 * |---|---|---|
 * | radial | distance to the centre (the thesis's test, Table 2.9) | [0, L]^3 with L =
 * 160 (samples / 4e6)^(1/3), where samples are spaced by 1 on average |
 * | sphere | 1 - r^2 | [-1.5, 1.5]^3 |
 * | torus | depth below a torus of radii 1 and 0.35 | [-1.5, 1.5]^2 x [-0.6, 0.6] |
 * | gyroid | sin x cos y + sin y cos z + sin z cos x | two periods: [-2 pi, 2 pi]^3 |
 * | marschner_lobb | the test signal of Marschner and Lobb 1994, alpha = 0.25, f_M = 6 |
 * [-1, 1]^3 |
 * | hydrogen | electron density of the orbital 3d_z2, its maximum being 1; lengths in
 * Bohr radii | [-25, 25]^3 |
 * | star | density of a star torn by tides: a core, maximum about 1, and two arms 30
 * times thinner, over a vacuum of 1e-5 and less | [-8, 8]^2 x [-3, 3] |
 * \param samples number of samples the field will get: radial's domain depends on it
 * \throws InvalidArgument that lists the names */
PCL_UVOL_EXPORTS AnalyticField
makeAnalyticField(const std::string& name, std::size_t samples);

} // namespace pcl_uvol
