// SPDX-License-Identifier: BSD-3-Clause
#include "common/report_parts.h"

#include <algorithm>

namespace pcl_uvol {

void
addCounts(const Report& stage, const std::vector<std::string>& names, Report& report)
{
  for (const auto& [name, value] : stage.counts)
    if (std::find(names.begin(), names.end(), name) != names.end())
      report.count(name, value);
}

} // namespace pcl_uvol
