// SPDX-License-Identifier: BSD-3-Clause
// Numbers in order across processes.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/distributed/communicator.h>

#include <vector>

namespace pcl_uvol {

/** \brief Bring the numbers of all processes into one order: those of each process
 * follow those of the processes before it, and equal ones are on one process. Each gets
 * about as many, but for equal ones (sample sort, Frazer and McKellar 1970).
 *
 * \param numbers of this process, ascending
 *
 * \return its share of the order */
PCL_UVOL_EXPORTS std::vector<double>
sortTogether(const std::vector<double>& numbers,
             Communicator& communicator,
             unsigned threads);

} // namespace pcl_uvol
