// SPDX-License-Identifier: BSD-3-Clause
// The memory of derived fields.
#pragma once

#include "common/memory.h"
#include <pcl_uvol/common/export.h>

#include <string>

namespace pcl_uvol {

/** \brief What addDerivedField takes at most and leaves, told by the expression alone.
 * \param point_step of the points; becomes that with the field */
PCL_UVOL_EXPORTS MemoryNeed
derivedFieldNeed(const std::string& expression, double points, double& point_step);

} // namespace pcl_uvol
