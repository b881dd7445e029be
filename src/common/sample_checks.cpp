// SPDX-License-Identifier: BSD-3-Clause
#include "common/sample_checks.h"

#include "common/printable.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl_uvol {

void
refuseNames(const Dataset& samples, const std::string& field)
{
  if (samples.labels.count(field) > 0)
    throw InvalidArgument(
        "The field " + quoteText(field) +
        " holds names, and a field of numbers is needed: -where chooses among names.");
}

void
warnOfConflicts(std::uint64_t samples, std::size_t fields, Report& report)
{
  constexpr double most_unnoticed = 0.03;
  const double share =
      static_cast<double>(report.getCount("conflicting_duplicates")) /
      static_cast<double>(std::max<std::uint64_t>(samples * fields, 1));
  if (share <= most_unnoticed)
    return;
  std::ostringstream percent;
  percent << std::round(100.0 * share);
  report.warnings.push_back(
      "At " + percent.str() + " % of the " + std::to_string(samples) +
      " places of samples several lie whose values differ, and their median is taken: "
      "-where chooses among them, as in -where \"experiment=1\".");
}

} // namespace pcl_uvol
