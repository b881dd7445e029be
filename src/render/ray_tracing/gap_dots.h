// SPDX-License-Identifier: BSD-3-Clause
// Isopoints in gaps of the sampling in pictures by ray tracing: dots of about a pixel.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/ray_tracing/ray_tracer.h>

#include <cstdint>
#include <vector>

namespace pcl_uvol {

/** \brief Add an object to a scene. The dots among its splats, see findSplats() and
 * findBridged(), become an object of their own: they have no side that light could fall
 * on, and get their colour, paler, as it is.
 * \param object made of the splats of a cloud, with its material
 * \param cloud that the splats were found for
 * \param sources the points that the splats stand for
 * \param side pixels of the shorter side of the picture
 * \param scene has its background */
PCL_UVOL_EXPORTS void
addWithDots(SplatObject&& object,
            const CloudView& cloud,
            const std::vector<std::uint32_t>& sources,
            int side,
            Scene& scene);

} // namespace pcl_uvol
