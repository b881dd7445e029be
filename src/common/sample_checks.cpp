// SPDX-License-Identifier: BSD-3-Clause
#include "common/sample_checks.h"

#include "common/printable.h"
#include "common/records.h"
#include "common/scalar_field.h"
#include <pcl_uvol/common/exceptions.h>

#include <algorithm>
#include <cmath>

namespace pcl_uvol {

void
refuseNames(const Dataset& samples, const std::string& field)
{
  if (samples.labels.count(field) > 0)
    throw InvalidArgument("field_of_names", {{"field", shortenText(field)}});
}

std::string
chooseField(const Dataset& samples, const std::string& named)
{
  if (named.empty())
    return ScalarField::defaultName(listNumberFields(samples));
  refuseNames(samples, named);
  return named;
}

void
warnOfConflicts(std::uint64_t conflicting, std::uint64_t values, Report& report)
{
  constexpr double most_unnoticed = 0.03;
  const double share = static_cast<double>(conflicting) /
                       static_cast<double>(std::max<std::uint64_t>(values, 1));
  if (share <= most_unnoticed)
    return;
  report.warn("conflicting_samples", {{"percent", std::round(100.0 * share)}});
}

} // namespace pcl_uvol
