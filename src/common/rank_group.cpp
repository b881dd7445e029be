// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_uvol/common/rank_group.h>

namespace pcl_uvol {

RankGroup::~RankGroup() = default;

void
RankGroup::meet()
{
  std::vector<std::uint64_t> nothing{0};
  sum(nothing);
}

std::vector<Bytes>
RankGroup::gatherAll(const Bytes& message)
{
  return exchange(std::vector<Bytes>(size(), message));
}

} // namespace pcl_uvol
