// SPDX-License-Identifier: BSD-3-Clause
// The splats of a cloud that is to be drawn: those that it holds, or those that are
// generated for its points.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/common/stage.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief True if a cloud has the fields of splats.
 * \param cloud whose fields are looked at */
PCL_UVOL_EXPORTS bool
hasSplats(const CloudView& cloud);

/** \brief The farthest coordinate and the largest radius of splats: float holds the
 * products of lengths that such coordinates have between them. */
constexpr float most_splat_reach = 1e18f;

/** \brief The smallest radius: float holds its square. */
constexpr float least_splat_radius = 1e-18f;

/** \brief True for a splat that rays can meet: it is finite, has a normal and a radius
 * of least_splat_radius or more, and lies within most_splat_reach.
 * \param splat of a cloud */
PCL_UVOL_EXPORTS bool
isDrawable(const PointSplat& splat);

/** \brief The splats that a cloud holds; those that are not drawable, or without a
 * tangent, are left out, counted as "bad_splats" and named in a warning.
 * \param cloud with the fields of PointSplat
 * \param report gets the count and the warning */
PCL_UVOL_EXPORTS Splats
readSplats(const CloudView& cloud, Report& report);

namespace detail {

/** \brief generateSplats() for a picture.
 * \param largest_alone radius of the splats of points that stand alone, at most; where
 * all do they are the picture, and reach half the way to the next one */
Splats
generateSplats(const CloudView& cloud,
               const std::vector<std::uint32_t>& use,
               const SplatParameters& parameters,
               float largest_alone,
               unsigned threads,
               Report& report);

} // namespace detail

/** \brief The usable splats that a cloud holds, which may be none, else those generated
 * for all its points; isopoints that bridge a gap become dots, and specks of noise no
 * more than that: a pixel in size in a picture of 1000 by 1000 pixels of all points but
 * a few far ones.
 * \param is_asked_for the user chose parameters: a warning tells where they go unused
 * \param cloud with splats, or points of a surface
 * \param parameters of splats that are generated
 * \param threads 0: all cores
 * \param report gets counts, times and warnings
 * \throws InvalidArgument as SplatGeneration::compute */
PCL_UVOL_EXPORTS Splats
findSplats(const CloudView& cloud,
           const SplatParameters& parameters,
           bool is_asked_for,
           unsigned threads,
           Report& report);

/** \brief Count splats that were left out, and name them in a warning.
 * \param count splats that there were before
 * \param splats that are left */
void
warnOfBadSplats(std::size_t count, const Splats& splats, Report& report);

} // namespace pcl_uvol
