// SPDX-License-Identifier: BSD-3-Clause
// Ranks that are threads of one process, to test what processes do together.
#pragma once

#include <pcl_uvol/distributed/communicator.h>

#include <cstddef>
#include <functional>

namespace uvol_test {

/** \brief Call body on as many ranks at once. The first exception, by time, is rethrown
 * when all have returned; a rank that waits for one that threw throws as well. */
void
runRanks(std::size_t count, const std::function<void(pcl_uvol::Communicator&)>& body);

} // namespace uvol_test
