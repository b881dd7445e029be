// SPDX-License-Identifier: BSD-3-Clause
// Isopoints that an automatic bound of the error keeps: the samples locate them more
// precisely than their edge does.
#pragma once

#include <pcl_uvol/common/cloud_view.h>
#include <pcl_uvol/common/point_types.h>
#include <pcl_uvol/isosurface/isosurface_extraction.h>
#include <pcl_uvol/neighbors/neighbor_graph.h>
#include <pcl_uvol/pipeline/isosurface_result.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_uvol {

/** \brief Whether the error of an isopoint is at most half of its edge, whose ends
 * alone locate it that well. */
bool
isPrecise(const PointIso& point);

/** \brief Finds the isopoints that the samples support.
 *
 * These are the ones of isPrecise(), and others by the sampling. If samples are all
 * around: crossings between two values that many samples have, as at the border of a
 * material, because the surface can only be located between the two samples. That is
 * not enough if an edge bridges a gap or passes between other samples. If samples are
 * on lines or sheets: crossings between neighbours of one of these, because their edges
 * are short compared with the gaps, and the surface crosses them. Predicted isopoints
 * have no edge between measured samples: their error must be at most half of the gap,
 * in the stretched space. */
class SupportedIsopoints {
public:
  /** \param samples between which the edges lie, which must outlive this
   * \param parameters that the isopoints were extracted by
   * \param gaps null, if they were not filled */
  SupportedIsopoints(const CloudView& samples,
                     const IsosurfaceParameters& parameters,
                     const std::optional<SamplingSummary>& sampling,
                     const GapFilling* gaps);

  /** \param isopoints one isovalue after another
   * \return one per isopoint: 1 if it is supported */
  std::vector<std::uint8_t>
  find(const pcl::PointCloud<PointIso>& isopoints,
       const IsoEdges& edges,
       unsigned threads) const;

private:
  /** \param is_jump whether values jump along its edge
   * \param spacing of the samples at the ends of such edges */
  bool
  contain(const PointIso& point,
          const IsoEdge& edge,
          bool is_jump,
          float spacing) const;

  const CloudView& samples_;
  std::string field_;
  Eigen::Array3f scale_;
  bool lies_all_around_;
  float half_gap_ = 0.0f; ///< in the stretched space; 0: there are no gaps
  float along_ = 0.0f;    ///< spacing in lines or sheets; 0: samples are all around
  float longest_ = 0.0f;  ///< edge in a line or a sheet
};

} // namespace pcl_uvol
