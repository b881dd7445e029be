// SPDX-License-Identifier: BSD-3-Clause
// What is beyond isovalues by estimates of blocks: lines for people and a table.
#pragma once

#include "interpolation/block_volumes.h"
#include "shared/facts.h"
#include "shared/measure_table.h"

#include <string>

namespace uvol_tools {

/** \brief A row for each isovalue. Columns are named as those of surfaces: isovalue,
 * piece (-1), volume, centroid, and the mean and the integral of the field. */
MeasureTable
makeTable(const pcl_uvol::detail::BlockVolumes& found, const std::string& field);

/** \brief Lines for people, and the table for programs: "blocks" and "beyond". */
Facts
describeBlocks(const pcl_uvol::detail::BlockVolumes& found, const std::string& field);

} // namespace uvol_tools
