// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/distributed/communicator.h>

namespace pcl_uvol {

Communicator::~Communicator() = default;

void
Communicator::barrier()
{
  std::vector<std::uint64_t> nothing{0};
  allReduce(nothing);
}

std::vector<Bytes>
Communicator::allGather(const Bytes& message)
{
  return allToAll(std::vector<Bytes>(size(), message));
}

} // namespace pcl_uvol
