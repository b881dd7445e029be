// SPDX-License-Identifier: BSD-3-Clause
#include "shared/point_files.h"

#include <pcl_uvol/common/exceptions.h>

namespace uvol_tools {

pcl_uvol::Dataset
loadPoints(const std::string& path,
           pcl_uvol::Report& report,
           const pcl_uvol::LoadOptions& options,
           const std::string& where)
{
  const pcl_uvol::StepTimer timer(report, "read");
  pcl_uvol::Dataset dataset = pcl_uvol::loadDataset(path, options);
  report.warnings.insert(
      report.warnings.end(), dataset.notes.begin(), dataset.notes.end());
  if (!where.empty())
    report.count("removed_by_where", pcl_uvol::selectRows(dataset, where));
  if (dataset.cloud.width == 0)
    throw pcl_uvol::InvalidArgument(
        path + " has no points" + (where.empty() ? "." : " for which " + where + "."));
  return dataset;
}

void
savePoints(const std::string& path,
           const pcl_uvol::Dataset& dataset,
           const pcl_uvol::SaveOptions& options,
           pcl_uvol::Report& report)
{
  const pcl_uvol::StepTimer timer(report, "write");
  pcl_uvol::saveDataset(path, dataset, options);
}

} // namespace uvol_tools
