// SPDX-License-Identifier: BSD-3-Clause
// How tools read and write points.
#pragma once

#include <pcl_uvol/common/report.h>
#include <pcl_uvol/io/dataset.h>

#include <string>

namespace uvol_tools {

/** \brief Read a file, as a step of the report; its notes become warnings.
 * \param where keep only the points for which that holds, see selectRows; "": all
 * \throws IOError, and InvalidArgument for a file without points */
pcl_uvol::Dataset
loadPoints(const std::string& path,
           pcl_uvol::Report& report,
           const pcl_uvol::LoadOptions& options = {},
           const std::string& where = "");

/** \brief Write a file, as a step of the report.
 * \throws IOError */
void
savePoints(const std::string& path,
           const pcl_uvol::Dataset& dataset,
           const pcl_uvol::SaveOptions& options,
           pcl_uvol::Report& report);

} // namespace uvol_tools
