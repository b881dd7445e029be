// SPDX-License-Identifier: BSD-3-Clause
// Points with all their fields, wherever they are.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/distributed/communicator.h>

#include <pcl/PCLPointCloud2.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The index of each process's first point where the points of all processes are
 * counted one process after another, and behind them how many there are in all.
 * \param count points of this process */
PCL_UVOL_EXPORTS std::vector<std::uint64_t>
findFirstIndices(std::uint64_t count, Communicator& communicator);

/** \brief Get points from the processes that hold them.
 * \param points of this process; all processes have the same fields
 * \param first index of the first of them, see findFirstIndices
 * \param wanted indices of points, ascending, each once
 * \return these points, in that order
 * \param report gets the count "bytes_of_fields"
 * \throws InvalidArgument on the process that is asked for a point nobody has */
PCL_UVOL_EXPORTS pcl::PCLPointCloud2
fetchPoints(const pcl::PCLPointCloud2& points,
            std::uint64_t first,
            const std::vector<std::uint64_t>& wanted,
            Communicator& communicator,
            Report& report);

} // namespace pcl_uvol
