// SPDX-License-Identifier: BSD-3-Clause
// The scalars of a cloud by name.
#pragma once

#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointField.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Expressions, see ScalarField, of all numbers of a point: `rho`, `vel[0]`,
 * `vel[1]`, ... Coordinates, normals, colours and padding are left out. */
PCL_UVOL_EXPORTS std::vector<std::string>
listScalars(const std::vector<pcl::PCLPointField>& fields);

} // namespace pcl_uvol
