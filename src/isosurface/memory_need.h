// SPDX-License-Identifier: BSD-3-Clause
// How large isosurfaces will be, told by a thinned cloud, and the bytes of their
// extraction.
#pragma once

#include "common/memory.h"
#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/export.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief About how large the isosurface of one isovalue is. */
struct SurfaceSize {
  double crossing = 0.0;  ///< samples next to it
  double isopoints = 0.0; ///< edges across it
};

/** \brief The sizes of isosurfaces before they are extracted, from some samples at
 * random: of N samples c N^(2/3) lie next to a surface. It assumes that the surface is
 * resolved by the thinned cloud and that the field is smooth: of finer detail and of
 * noise there is more.
 * \param parameters of the extraction; neighbours are those that its criterion leaves
 * of its candidates, of a diagram or the tree of the thinned cloud
 * \return one per isovalue; of size 0 where the field does not tell */
PCL_UVOL_EXPORTS std::vector<SurfaceSize>
estimateSurfaces(const CloudView& cloud,
                 const IsosurfaceParameters& parameters,
                 unsigned threads);

/** \brief A size that forecasts count with: surfaces of measured and simulated data
 * have finer detail than thinned clouds tell. */
PCL_UVOL_EXPORTS SurfaceSize
allowForDetail(const SurfaceSize& estimated);

/** \brief Bytes that an IsosurfaceExtraction keeps for the next isovalue: the tree, and
 * the values in its order. */
PCL_UVOL_EXPORTS double
extractionBytes(double samples);

/** \brief The memory of IsosurfaceExtraction besides the cloud: 52 to 68 bytes per
 * sample, and per isopoint 76 that remain, as many again while they are joined, and 40
 * for their edges. What it keeps does not count as kept.
 * \param surfaces one per isovalue */
PCL_UVOL_EXPORTS MemoryNeed
isosurfaceNeed(double samples, const std::vector<SurfaceSize>& surfaces);

} // namespace pcl_uvol
