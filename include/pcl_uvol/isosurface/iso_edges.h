// SPDX-License-Identifier: BSD-3-Clause
// Where isopoints lie between the samples, and what the samples' other fields are
// there.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/report.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/point_cloud.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pcl_uvol {

/** \brief The edge of one isopoint: two points of the input cloud and the place between
 * them where the scalar, interpolated linearly, has the isovalue: 0 at the first, 1 at
 * the second. A smooth isopoint lies beside it, but all fields that are carried along
 * agree there, the scalar with its isovalue among them. */
struct IsoEdge {
  std::uint32_t first, second; ///< indices into the input cloud
  float t;                     ///< in [0, 1]
};

/** \brief One edge per isopoint, in the order of the isopoints. */
using IsoEdges = std::vector<IsoEdge>;

/** \brief Leave only the isopoints, and their edges, that keep says yes to.
 * \param isopoints of an extraction
 * \param edges one per isopoint
 * \param keep asked once for each isopoint
 * \return how many went
 * \throws InvalidArgument if sizes disagree */
PCL_UVOL_EXPORTS std::size_t
filterIsopoints(pcl::PointCloud<PointIso>& isopoints,
                IsoEdges& edges,
                const std::function<bool(const PointIso&)>& keep);

/** \brief Add to a cloud of isopoints every field of the samples' cloud that it lacks,
 * under its own name, type and count.
 *
 * Floating-point fields are interpolated linearly, NaN where a sample that counts is
 * NaN; integers, labels and packed colours come from the nearer sample.
 * \param isopoints as many points as edges; comes out without padding fields, and so
 * that viewOf() takes it
 * \param threads 0 (default) = all cores
 * \param samples that the edges join
 * \param edges one per isopoint
 * \throws InvalidArgument if sizes disagree or an edge points outside the samples */
PCL_UVOL_EXPORTS void
interpolateFields(const CloudView& samples,
                  const IsoEdges& edges,
                  pcl::PCLPointCloud2& isopoints,
                  unsigned threads = 0);

/** \brief The same for a cloud, which needs no positions.
 * \param samples that the edges join
 * \param edges one per isopoint
 * \param isopoints as many points as edges
 * \param threads 0 (default) = all cores */
PCL_UVOL_EXPORTS void
interpolateFields(const pcl::PCLPointCloud2& samples,
                  const IsoEdges& edges,
                  pcl::PCLPointCloud2& isopoints,
                  unsigned threads = 0);

/** \brief The same for points that stand for one point of another cloud each: the
 * fields that they lack are copied.
 * \param sources index of the other point, one per point
 * \param cloud that has the fields
 * \param points get them
 * \param threads 0 (default) = all cores
 * \throws InvalidArgument as interpolateFields */
PCL_UVOL_EXPORTS void
copyFields(const pcl::PCLPointCloud2& cloud,
           const std::vector<std::uint32_t>& sources,
           pcl::PCLPointCloud2& points,
           unsigned threads = 0);

/** \brief Warn of every field of the samples that gives way to one of the isopoints, a
 * column called error, say, before fields are carried along. Coordinates and normals
 * are meant to.
 * \param samples fields of the samples
 * \param isopoints fields of the isopoints
 * \param report gets the warnings */
PCL_UVOL_EXPORTS void
warnOfReplacedFields(const std::vector<pcl::PCLPointField>& samples,
                     const std::vector<pcl::PCLPointField>& isopoints,
                     Report& report);

} // namespace pcl_uvol
