// SPDX-License-Identifier: BSD-3-Clause
// What a camera is fitted to in pictures by ray tracing.
#pragma once

#include <pcl_uvol/common/export.h>
#include <pcl_uvol/render/renderer.h>
#include <pcl_uvol/surface/splat_generation.h>

#include <pcl/PCLPointCloud2.h>

#include <memory>
#include <vector>

namespace pcl_uvol {

class PreparedSurface;

/** \brief The splats of a cloud as discs, by the points that they are grown from. The
 * other points do not count, nor do those that PreparedSurface::findFittedDiscs()
 * leaves out. */
class PCL_UVOL_EXPORTS FittedSplats {
public:
  /** \param cloud must outlive the object */
  FittedSplats(const Splats& splats,
               const pcl::PCLPointCloud2& cloud,
               unsigned threads);
  ~FittedSplats();

  /** \brief The discs as a camera sees them, by the points of the cloud, which are
   * sorted in the first call.
   * \param width of the picture, pixels
   * \param height of the picture, pixels */
  std::vector<FittedDisc>
  find(const Camera& camera, int width, int height);

private:
  const pcl::PCLPointCloud2& cloud_;
  unsigned threads_;
  std::vector<FittedDisc> discs_;
  std::unique_ptr<PreparedSurface> prepared_;
};

} // namespace pcl_uvol
