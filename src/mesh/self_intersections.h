// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a mesh that go through one another.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/dataset.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/mesh/surface_measures.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl_uvol::detail {

/** \brief Whether two triangles have more in common than the vertices and edges that
 * they share by number: exact, touching counts. One that is a line or a point
 * intersects nothing. */
PCL_UVOL_EXPORTS bool
doIntersect(const std::vector<Eigen::Vector3d>& places,
            const Triangle& a,
            const Triangle& b);

/** \brief All pairs of triangles of one surface that intersect, ascending, the lower
 * one first.
 * \param surface_of by vertex: surfaces of several isovalues may touch, as their caps
 * do; empty: all are of one
 * \param report gets the time and progress of "intersections"
 * \throws InvalidArgument for more than 10 million */
PCL_UVOL_EXPORTS std::vector<std::pair<std::uint32_t, std::uint32_t>>
findSelfIntersections(const std::vector<Eigen::Vector3d>& places,
                      const std::vector<Triangle>& triangles,
                      const std::vector<double>& surface_of,
                      unsigned threads,
                      Report& report);

/** \brief The same with their places, surface by `isovalue`.
 * \param origin of the vertices
 * \param report gets their count, time and progress as "intersections", and a warning
 * where there are any
 * \throws InvalidArgument as findSelfIntersections() does */
std::vector<TriangleIntersection>
describeIntersections(const CloudView& vertices,
                      const std::vector<Triangle>& triangles,
                      const std::array<double, 3>& origin,
                      unsigned threads,
                      Report& report);

} // namespace pcl_uvol::detail
