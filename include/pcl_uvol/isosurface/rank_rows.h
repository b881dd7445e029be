// SPDX-License-Identifier: BSD-3-Clause
// The samples between which isopoints lie, with all their fields, wherever they are.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/rank_group.h>
#include <pcl_uvol/common/report.h>
#include <pcl_uvol/isosurface/iso_edges.h>
#include <pcl_uvol/isosurface/piece_isopoints.h>

#include <pcl/PCLPointCloud2.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief The number of a process's first point where the points of all processes are
 * counted one process after another.
 * \param count points of this process */
PCL_UVOL_EXPORTS std::uint64_t
findFirstRow(std::uint64_t count, RankGroup& ranks);

/** \brief Some points of a cloud that processes hold parts of. */
struct RankRows {
  pcl::PCLPointCloud2 cloud;
  IsoEdges edges; ///< one per isopoint, in this cloud: for interpolateFields
};

/** \brief Get the ends of isopoints' edges from the processes that hold them.
 * \param points of this process; all processes have the same fields
 * \param first_row number of the first of them, see findFirstRow: what the sources of
 * isopoints count
 * \param isopoints of this process, one isovalue after another
 * \param report gets the count "bytes_of_fields" \throws InvalidArgument on this
 * process if an isopoint comes from a point that nobody has */
PCL_UVOL_EXPORTS RankRows
fetchRows(const pcl::PCLPointCloud2& points,
          std::uint64_t first_row,
          const std::vector<std::vector<GlobalIsopoint>>& isopoints,
          RankGroup& ranks,
          Report& report);

} // namespace pcl_uvol
