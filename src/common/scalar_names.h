// SPDX-License-Identifier: BSD-3-Clause
// The scalars of a cloud by name.
#pragma once

#include "common/scalar_field.h"
#include <pcl_uvol/common/export.h>

#include <pcl/PCLPointField.h>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Expressions, see ScalarField, of all numbers of a point: `rho`, `vel[0]`,
 * `vel[1]`, ... Coordinates, normals, colours and padding are left out. */
PCL_UVOL_EXPORTS std::vector<std::string>
listScalars(const std::vector<pcl::PCLPointField>& fields);

/** \brief A number of every point, and what listScalars() calls it. */
struct NamedScalar {
  std::string name;
  FieldComponent number;
};

/** \brief The scalars that listScalars() names: of very many, none has to be looked for
 * among all. */
PCL_UVOL_EXPORTS std::vector<NamedScalar>
listNamedScalars(const std::vector<pcl::PCLPointField>& fields);

} // namespace pcl_uvol
